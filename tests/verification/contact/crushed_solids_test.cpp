// *EOS_TABULATED_COMPACTION and *EOS_SACK_TUESDAY: what is crushed, and the products of a detonation.
#include <gtest/gtest.h>

#include <cmath>

#include "pressure_decks.hpp"
#include "same_bits.hpp"
#include "solid_decks.hpp"

using namespace courant;
using test::do_nothing;
using test::expect_same_bits;
using test::simulation_of;
using test::SolidDeck;
using test::start_ledger;

namespace {

const Field<Real>& of_group(const Simulation& s, const char* name) {
  const auto* field = dynamic_cast<const Field<Real>*>(s.world().groups.at(0)->fields.find(name));
  EXPECT_NE(field, nullptr) << name;
  return *field;
}
Real pressure_of(const Simulation& s, Index e) {
  const Field<Real>& stress = of_group(s, "stress");
  return -(stress.data(0)[e] + stress.data(1)[e] + stress.data(2)[e]) / 3;
}

/// n cubes along x, 1 long altogether, that move along x alone; the end at x = 0 is held.
SolidDeck crushed_row(int n, const std::string& cards) {
  SolidDeck deck;
  deck.block(Vec(1, 1.0 / n, 1.0 / n), n, 1, 1, 1);
  deck.cards = "*PART\nrow\n1,1,1,1\n*SECTION_SOLID\n1,1\n" + cards;
  deck.node_set(1, [](const Vec&) { return true; });
  deck.node_set(2, [](const Vec& x) { return x[0] < 1e-9; });
  deck.node_set(3, [](const Vec& x) { return x[0] > 1e-9; });
  deck.cards += "*BOUNDARY_SPC_SET\n1,0,0,1,1\n2,0,1,1,1\n";
  return deck;
}

/// C 0, 1, 10 and K 20, 20, 40 at ln V = 0, -0.1, -0.5.
const std::string soil =
    "*MAT_NULL\n1,2.0,-1e20,0.0\n"
    "*EOS_TABULATED_COMPACTION\n1,0.0\n0.0,-0.1,-0.5\n\n0.0,1.0,10.0\n\n0.0\n\n20.0,20.0,40.0\n\n";

}  // namespace

// A cube is pressed to V = 0.74, let go until V = 0.9, pressed to V = 0.7.
TEST(CrushedSolids, ComeBackAlongTheirModulusAndKeepTheEnergyBalance) {
  for (const auto& [tssfac, bound] : {std::pair(0.4, 1e-3), std::pair(0.1, 1e-4)}) {
    SolidDeck deck = crushed_row(1, soil + "*CONTROL_BULK_VISCOSITY\n1e-9,1e-9\n");
    deck.cards += fmt::format(
        "*CONTROL_TIMESTEP\n0.0,{}\n*BOUNDARY_PRESCRIBED_MOTION_SET\n3,1,0,1\n*DEFINE_CURVE\n1\n0.0,-0.01\n"
        "26.0,-0.01\n26.0001,0.01\n42.0,0.01\n42.0001,-0.01\n62.0,-0.01\n",
        tssfac);
    auto s = simulation_of(deck.text(100));
    start_ledger(*s);
    const Field<Real>& x = s->world().nodes.x;
    const auto look = [&](Real t) {
      test::run_until(*s, t);
      s->step(do_nothing);
      Real width = 0;  // a step after the law
      for (Index n = 0; n < s->world().nodes.size(); ++n) width = std::max(width, x.data(0)[n]);
      return std::pair(width, pressure_of(*s, 0));
    };
    const auto C = [](Real e) { return e < 0.1 ? 10 * e : 1 + 22.5 * (e - 0.1); };
    const auto K = [](Real e) { return e < 0.1 ? 20 : 20 + 50 * (e - 0.1); };
    const auto v_dt = 0.01 * s->clock().dt;
    const Real e1 = -std::log(0.74);
    for (const Real t : {5.0, 15.0, 25.0}) {
      const auto [V, p] = look(t);
      EXPECT_NEAR(p, C(-std::log(V)), 30 * v_dt + bound) << t;
    }
    for (const Real t : {30.0, 35.0, 41.0, 46.0, 55.0}) {
      const auto [V, p] = look(t);
      EXPECT_NEAR(p, C(e1) + K(e1) * (-std::log(V) - e1), 50 * v_dt + bound) << t;
    }
    const auto [V, p] = look(61);
    EXPECT_NEAR(p, C(-std::log(V)), 40 * v_dt + bound);
    EXPECT_NEAR(of_group(*s, "greatest_compression")[0], 1 / V - 1, 2 * v_dt + bound);
    EXPECT_LT(test::energy_error_of_a_step(*s), 1e-3);
  }
}

// Of the steeper way: K(0) = 20 of density 2, though C begins with 10.
TEST(CrushedSolids, HaveTheStepOfTheSteeperWay) {
  auto s = simulation_of(crushed_row(4, soil + "*CONTROL_BULK_VISCOSITY\n1e-9,1e-9\n").text(1));
  s->step(do_nothing);
  EXPECT_NEAR(s->clock().dt, 0.9 * 0.25 / std::sqrt(10.0), 1e-6);
}

// A row flies against its held end. Behind the shock p = C(s1), s1 = ln(rho1/RO), RO us^2 (1 - V1) = p, us =
// up/(1 - V1); where it comes to the free end, all springs back along K(s1) and stays as dense as p = 0 has
// it.
TEST(CrushedSolids, AShockCrushesAndARarefactionLeavesThemSo) {
  constexpr Real up = 0.5, ro = 2, modulus = 10;  // C = 10 s all the path, K = 40
  const std::string straight =
      "*MAT_NULL\n1,2.0,-1e20,0.0\n*EOS_TABULATED_COMPACTION\n1,0.0,0.0,1.0,1,0,2\n"
      "*DEFINE_CURVE\n1\n0.0,0.0\n1.0,10.0\n*DEFINE_CURVE\n2\n0.0,40.0\n1.0,40.0\n";
  Real V1 = 0, most = 1;  // ro up^2 = -modulus ln V1 (1 - V1)
  for (int k = 0; k < 100; ++k) {
    const Real V = 0.5 * (V1 + most);
    (-modulus * std::log(V) * (1 - V) > ro * up * up ? V1 : most) = V;
  }
  const Real p1 = -modulus * std::log(V1), us = up / (1 - V1), left = V1 * std::exp(p1 / 40);
  for (const int n : {50, 100, 200}) {
    SolidDeck deck = crushed_row(n, straight);
    deck.cards += fmt::format("*INITIAL_VELOCITY\n3\n{:.6g},0.0,0.0\n", -up);
    auto s = simulation_of(deck.text(1));
    start_ledger(*s);
    const auto mean = [&](Real from, Real to, bool of_volume) {
      Real sum = 0;
      const ElementGroup& group = *s->world().groups.at(0);
      const Field<Real>& x = s->world().nodes.x;
      int count = 0;
      for (Index e = static_cast<Index>(from * n); e < static_cast<Index>(to * n); ++e, ++count) {
        Real low = 1e30, high = -1e30;
        for (int c = 0; c < 8; ++c)
          low = std::min(low, x.data(0)[group.node.data(c)[e]]),
          high = std::max(high, x.data(0)[group.node.data(c)[e]]);
        sum += of_volume ? (high - low) * n : pressure_of(*s, e);
      }
      return sum / count;
    };
    test::run_until(*s, 0.9 / us);
    EXPECT_NEAR(mean(0.2, 0.8, false) / p1, 1, 0.01) << n;
    EXPECT_NEAR(mean(0.2, 0.8, true) / V1, 1, 0.005) << n;
    test::run_until(*s, 1 / us + 0.35 * V1 / std::sqrt(40 / ro * V1));
    EXPECT_NEAR(mean(0.8, 0.95, false) / p1, 0, 0.03) << n;
    EXPECT_NEAR(mean(0.8, 0.95, true) / left, 1, 0.01) << n;
    EXPECT_LT(test::energy_error_of_a_step(*s), 1e-3) << n;
  }
}

// Without A3 it is a gas with p = B2 E/V: p V^(1 + B2) stays, as V grows to 2, slowly and without viscosity.
TEST(CrushedSolids, ProductsOfADetonationFollowTheirIsentrope) {
  for (const Real a3 : {1e-12, 0.5}) {
    SolidDeck deck =
        crushed_row(1, fmt::format("*MAT_NULL\n1,1.0\n*EOS_SACK_TUESDAY\n1,2.0,1.0,{},0.25,0.4,2.5,1.0\n"
                                   "*CONTROL_BULK_VISCOSITY\n1e-9,1e-9\n*CONTROL_TIMESTEP\n0.0,0.1\n",
                                   a3));
    deck.cards += "*BOUNDARY_PRESCRIBED_MOTION_SET\n3,1,0,1\n*DEFINE_CURVE\n1\n0.0,0.02\n1e9,0.02\n";
    auto s = simulation_of(deck.text(100));
    start_ledger(*s);
    test::run_until(*s, 50);
    s->step(do_nothing);
    const Real V = 1 + 0.02 * (s->clock().t - s->clock().dt_old);
    // dE = -(A(v) + 0.4 E/v) dv by Simpson's rule in small parts: (E v^0.4)' = -A v^0.4
    const auto A = [&](Real v) { return a3 / (v * v) * std::exp(-v) * (1 - 0.25 / v) * std::pow(v, 0.4); };
    constexpr int parts = 1000;
    Real sum = 2.5;
    for (int k = 0; k < parts; ++k) {
      const Real h = (V - 1) / parts, v = 1 + k * h;
      sum -= h / 6 * (A(v) + 4 * A(v + h / 2) + A(v + h));
    }
    const Real E = sum / std::pow(V, 0.4), p = a3 / (V * V) * std::exp(-V) * (1 - 0.25 / V) + 0.4 * E / V;
    EXPECT_NEAR(pressure_of(*s, 0), p, 2e-5) << a3;
    EXPECT_NEAR(of_group(*s, "internal_energy")[0], E, 5e-5) << a3;
    EXPECT_LT(test::energy_error_of_a_step(*s), 1e-4) << a3;
  }
}

TEST(CrushedSolids, HaveTheSameBitsOnAnyNumberOfThreadsAndAfterARestart) {
  SolidDeck deck;
  deck.block(Vec(0.4, 0.3, 0.2), 8, 6, 4, 1);
  deck.cards =
      "*PART\nblock\n1,1,1,1\n*SECTION_SOLID\n1,1\n*MAT_ELASTIC_PLASTIC_HYDRO\n1,2.0,1.0,0.1\n"
      "*EOS_TABULATED_COMPACTION\n1,0.5\n0.0,-0.1,-0.5\n\n0.0,1.0,10.0\n\n1.0,1.0,2.0\n\n20.0,20.0,40.0\n\n"
      "*CONTROL_TIMESTEP\n0.0,0.5\n*INITIAL_VELOCITY\n0\n-0.6,0.1,-0.3\n"
      "*RIGIDWALL_PLANAR\n0\n-0.001,0.0,0.0,1.0,0.0,0.0\n";
  expect_same_bits(deck.text(1), 150, 60);
}

TEST(CrushedSolids, ParticlesRememberToo) {
  const std::string text = test::particles_against_a_wall(8, 16, 0.02, 0.5, soil);
  auto s = simulation_of(text);
  start_ledger(*s);
  test::run_until(*s, 0.6);
  const Particles& p = s->world().particles;
  const auto* most = dynamic_cast<const Field<Real>*>(p.fields.find("greatest_compression"));
  ASSERT_NE(most, nullptr);
  int back = 0;
  for (Index i = 0; i < p.size(); ++i) {
    EXPECT_GE((*most)[i], p.rho[i] / 2 - 1);
    const Real e = std::log1p((*most)[i]), C = e < 0.1 ? 10 * e : 1 + 22.5 * (e - 0.1),
               K = e < 0.1 ? 20 : 20 + 50 * (e - 0.1);
    EXPECT_NEAR(p.p[i], C + K * (std::log(p.rho[i] / 2) - e), 1e-9) << i;
    back += p.rho[i] / 2 - 1 < (*most)[i];
  }
  EXPECT_GT(back, 20);
  EXPECT_LT(test::energy_error_of_a_step(*s), 0.02);
  expect_same_bits(text, 60, 25);
}
