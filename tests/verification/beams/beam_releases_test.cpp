// Ends of beams that are released: RT1 to RR2 of *ELEMENT_BEAM, ELFORM 2.
#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "beam_decks.hpp"
#include "same_bits.hpp"
#include "solid_decks.hpp"
#include "state/shared_fields.hpp"

using namespace courant;
using namespace courant::test::beams;
using test::simulation_of;
using test::start_ledger;

namespace {

struct Released {
  int rt1 = 0, rr1 = 0, rt2 = 0, rr2 = 0;
};
/// n beams on [0, 1] of the x axis, some released.
BeamDeck released_line(int n, const std::function<const char*(int)>& codes,
                       const std::function<Released(int)>& of_beam) {
  BeamDeck deck;
  deck.part(1, square_2, steel_of_beams);
  for (int k = 0; k <= n; ++k) deck.at({Real(k) / n, 0, 0}, codes(k));
  const int third = deck.at({0, 1, 0}, ",7,7");
  for (int k = 0; k < n; ++k) {
    const Released r = of_beam(k);
    deck.elements += fmt::format("{:8}{:8}{:8}{:8}{:8}{:8}{:8}{:8}{:8}{:8}\n", ++deck.element, 1, k + 1,
                                 k + 2, third, r.rt1, r.rr1, r.rt2, r.rr2, 2);
  }
  return deck;
}
constexpr Real stiffness_of_released = 175;  // EI

/// Of a node, the time between crossings of its position at rest.
Real released_frequency(Simulation& s, int axis, Index node, int count) {
  std::vector<Real> at;
  Real before = 0, t_before = 0;
  while (static_cast<int>(at.size()) < count && s.clock().t < 10) {
    s.step(test::do_nothing);
    const Real u = s.world().nodes.x.data(axis)[node], t = s.clock().t;
    if (before * u < 0) at.push_back(t_before + before / (before - u) * (t - t_before));
    before = u, t_before = t;
  }
  return static_cast<Real>(at.size() - 1) / (2 * (at.back() - at.front()));
}

}  // namespace

// Clamped nodes, hinges at the outer ends: pi/(2 L^2) sqrt(EI/(rho A)) = 23.45331 Hz, as a beam that is
// simply supported; with one hinge 36.6399 Hz (15.4182 instead of pi^2).
TEST(ReleasedBeams, FrequencyBetweenHinges) {
  for (const bool both : {true, false})
    for (const int axis : {1, 2})
      for (const int n : {10, 20, 40}) {
        if (n == 40 && axis == 2) continue;
        BeamDeck deck = released_line(
            n, [n](int k) { return k == 0 || k == n ? ",7,7" : ""; },
            [&](int k) { return Released{.rr1 = k == 0 ? 5 : 0, .rr2 = both && k == n - 1 ? 5 : 0}; });
        deck.velocity([&](int k) -> Vec {
          const Real x = Real(k - 1) / n;
          if (k > n) return Vec::Zero();
          const Real b = 3.926602;
          const Real one = std::sin(b * x) - std::sin(b) / std::sinh(b) * std::sinh(b * x);
          return 0.01 * (both ? std::sin(pi * x) : one) * Vec::Unit(axis);
        });
        auto s = simulation_of(deck.text(1));
        start_ledger(*s);
        const Real f = released_frequency(*s, axis, n / 2, 7) / (both ? 23.45331 : 36.63906);
        testing::Test::RecordProperty(fmt::format("{}_n{}_axis{}", both ? "two" : "one", n, axis),
                                      fmt::format("{:.5f}", f));
        EXPECT_NEAR(f, 1, 0.01) << both << n;
        EXPECT_LT(test::energy_error_of_a_step(*s), 0.015);
      }
}

// Clamped at both ends, a hinge in the middle under P (Gerber): each half a cantilever, P L^3/(48 EI). A
// hinge about s alone leaves bending about t as it was: /192.
TEST(ReleasedBeams, GerberBeam) {
  const Real P = 2, lengths = P / stiffness_of_released;
  // of one beam on each side, too, whose free end turns by itself
  for (const auto& [code, n] : {std::pair(2, 10), {5, 10}, {7, 10}, {5, 2}})
    for (const int dof : {2, 3}) {
      BeamDeck deck = released_line(
          n, [&, n = n](int k) { return k == 0 || k == n ? ",7,7" : ""; },
          [&, n = n, code = code](int k) { return Released{.rr2 = k == n / 2 - 1 ? code : 0}; });
      deck.cards += fmt::format(
          "*LOAD_NODE_POINT\n{},{},1,{}\n*DEFINE_CURVE\n1\n0.0,0.0\n0.3,1.0\n9.0,1.0\n*DAMPING_GLOBAL\n0,150."
          "0\n",
          n / 2 + 1, dof, P);
      auto s = simulation_of(deck.text(1));
      while (s->clock().t < 0.6) s->step(test::do_nothing);
      const bool hinge = code != 2 || dof == 3;  // about s = y bends along z
      const Real y = s->world().nodes.x.data(dof - 1)[n / 2] / lengths * (hinge ? 48 : 192);
      testing::Test::RecordProperty(fmt::format("gerber_code{}_n{}_dof{}", code, n, dof),
                                    fmt::format("{:.5f}", y));
      EXPECT_NEAR(y, 1, 0.01) << code << " " << n << dof;
    }
}

// Hinges about all axes at one end: the node spins as it likes, and the beam does not feel it.
TEST(ReleasedBeams, NodesSpinAtHinges) {
  for (const int code : {7, 1}) {
    BeamDeck deck = released_line(
        2, [](int k) { return k == 0   ? ",7,7"
                              : k == 1 ? ",7"
                                       : ""; },
        [&](int k) { return k == 0 ? Released{.rr2 = code} : Released{.rr1 = 7}; });
    auto s = simulation_of(deck.text(1));
    Field<Real>& w = *shared_fields::angular_velocity.find(s->world().nodes.fields);
    const Vec spin = code == 7 ? Vec(3, 40, -20) : Vec(40, 0, 0);
    w.set(1, spin);
    start_ledger(*s);
    while (s->clock().t < 0.1) s->step(test::do_nothing);
    EXPECT_LT((w.vec(1) - spin).norm(), 1e-9) << code;
    EXPECT_LT(s->world().nodes.v.vec(2).norm(), 1e-9) << code;
  }
}

// RT1 = 1: pulled apart at 1 m/s, no force; without the release E A v t/L.
TEST(ReleasedBeams, SlideAlongTheirLine) {
  for (const int slides : {0, 1}) {
    BeamDeck deck = released_line(
        1, [](int k) { return k == 0 ? ",7,7" : ",5,7"; }, [&](int) { return Released{.rt1 = slides}; });
    deck.cards += "*BOUNDARY_PRESCRIBED_MOTION_NODE\n2,1,0,1\n*DEFINE_CURVE\n1\n0.0,1.0\n9.0,1.0\n";
    auto s = simulation_of(deck.text(1));
    while (s->clock().t < 1e-3) s->step(test::do_nothing);
    const Real pull = s->world().groups.at(0)->corner_force->data(0)[0];
    const Real stretch = s->world().nodes.x.data(0)[1] - 1 - s->clock().dt;
    EXPECT_NEAR(pull, slides ? 0 : 2.1e7 * stretch, 0.02 * 2.1e4) << slides;
  }
}

// A pendulum of one beam on a hinge swings through a large angle, beside its clamped node: its length and
// energy stay.
TEST(ReleasedBeams, APendulumTurnsAroundItsHinge) {
  BeamDeck deck = released_line(
      2, [](int k) { return k == 0 ? ",7,7" : ""; }, [](int k) { return Released{.rr1 = k == 0 ? 7 : 0}; });
  const Real omega = 2 * pi;
  deck.velocity([&](int k) -> Vec { return k > 3 ? Vec(Vec::Zero()) : Vec(0, omega * (k - 1) / 2.0, 0); });
  auto s = simulation_of(deck.text(2));
  Field<Real>& w = *shared_fields::angular_velocity.find(s->world().nodes.fields);
  for (Index n = 1; n < 3; ++n) w.set(n, Vec(0, 0, omega));
  start_ledger(*s);
  while (s->clock().t < 0.4) s->step(test::do_nothing);
  const Vec end = s->world().nodes.x.vec(2);
  EXPECT_NEAR(end.norm(), 1, 1e-3);
  Real angle = std::atan2(end[1], end[0]);
  if (angle < 0) angle += 2 * pi;
  EXPECT_NEAR(angle, omega * s->clock().t, 0.01);
  EXPECT_LT(test::energy_error_of_a_step(*s), 0.01);
}

TEST(ReleasedBeams, SameBitsOnThreadsAndAfterARestart) {
  BeamDeck deck = released_line(
      40, [](int k) { return k == 0 || k == 40 ? ",7,7" : ""; },
      [](int k) {
        return Released{.rr1 = k % 4 == 0 ? 5 : k % 7 == 0 ? 1 : 0, .rr2 = k == 20 ? 7 : 0};
      });
  deck.velocity(
      [](int n) { return n > 40 || n == 1 ? Vec(0, 0, 0) : Vec(0.1 * n, std::sin(n), std::cos(n)); });
  test::expect_same_bits(deck.text(1), 60, 25);
}

// Every third beam of a free rubber rod is hinged; nodes fly off at random and bend it by half a radian and
// more.
TEST(ReleasedBeams, BentFarKeepTheirEnergy) {
  for (const auto& [code, bound] : {std::pair(0, 0.01), {1, 0.01}, {4, 0.01}, {6, 0.01}, {3, 0.01}}) {
    BeamDeck deck;
    deck.part(1, "         2\n 7.854e-05 4.909e-10 4.909e-10 9.817e-10\n",
              "*MAT_ELASTIC\n         1    1100.0   1.0E+06       0.3\n");
    constexpr int n = 16;
    for (int k = 0; k <= n; ++k) deck.at({0.05 * k, 0, 0});
    const int third = deck.at({0, 1, 0}, ",7,7");
    for (int k = 0; k < n; ++k)
      deck.elements += fmt::format("{:8}{:8}{:8}{:8}{:8}{:8}{:8}{:8}{:8}{:8}\n", ++deck.element, 1, k + 1,
                                   k + 2, third, 0, 0, 0, k % 3 == 1 ? code : 0, 2);
    std::mt19937 random(3);
    std::uniform_real_distribution<Real> number(-1, 1);
    deck.velocity([&](int k) -> Vec {
      return k > n + 1 ? Vec::Zero() : Vec(Vec(number(random), number(random), number(random)));
    });
    deck.cards += "*CONTROL_TIMESTEP\n       0.0       0.3\n";
    auto s = simulation_of(deck.text(1e6));
    start_ledger(*s);
    Real worst = 0;
    for (int k = 0; k < 10'000; ++k) {
      s->step(test::do_nothing);
      if (k % 100 == 0) worst = std::max(worst, test::energy_error_of_a_step(*s));
    }
    testing::Test::RecordProperty(fmt::format("energy_released_by_{}", code), fmt::format("{:.5f}", worst));
    EXPECT_LT(worst, bound) << code;
  }
}
