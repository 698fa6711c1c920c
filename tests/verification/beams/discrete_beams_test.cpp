// Discrete beams (*SECTION_BEAM ELFORM 6) of six springs: *MAT_066, _067, _068.
#include <gtest/gtest.h>

#include <cmath>

#include "beam_decks.hpp"
#include "laws/discrete/discrete_beam_law.hpp"
#include "same_bits.hpp"
#include "solid_decks.hpp"
#include "state/shared_fields.hpp"

using namespace courant;
using test::do_nothing;
using test::expect_same_bits;
using test::simulation_of;
using test::start_ledger;
using test::beams::BeamDeck;

namespace {

/// VOL 1, INER 0.4: with RO 2 each end has 1 and 0.2.
std::string six_springs_section(int scoor, int cid = 0) {
  return fmt::format("6,,,,{}\n1.0,0.4,{}\n", scoor, cid);
}
/// A discrete beam from the origin, node 1 is held; `codes` of node 2.
BeamDeck six_springs_deck(const Vec& end, const char* codes, const std::string& section,
                          const std::string& material) {
  BeamDeck deck;
  deck.at({0, 0, 0}, ",7,7"), deck.at(end, codes);
  deck.beam(1, 1, 2);
  deck.cards = fmt::format("*PART\nbeams\n1,1,1\n*SECTION_BEAM\n1,{}", section) + material;
  return deck;
}
const std::string springs_066 =
    "*MAT_LINEAR_ELASTIC_DISCRETE_BEAM\n1,2.0,100.0,200.0,300.0,20.0,40.0,60.0\n0.0\n";
const Field<Real>& six_of(const Simulation& s, const char* name) {
  const auto* field = dynamic_cast<const Field<Real>*>(s.world().groups.at(0)->fields.find(name));
  EXPECT_NE(field, nullptr) << name;
  return *field;
}
Field<Real>& spins_of(Simulation& s) {
  return *shared_fields::angular_velocity.find(s.world().nodes.fields);
}
/// From rests of a component: the first `count` changes of sign of a rate.
Real frequency_of_rate(Simulation& s, const Field<Real>& rate, int axis, int count) {
  std::vector<Real> at;
  Real before = rate.data(axis)[1], t_before = s.clock().t;
  while (static_cast<int>(at.size()) < count && s.clock().t < 100) {
    s.step(do_nothing);
    const Real now = rate.data(axis)[1], t = s.clock().t;
    if (before * now < 0) at.push_back(t_before + before / (before - now) * (t - t_before));
    before = now, t_before = t;
  }
  return static_cast<Real>(at.size() - 1) / (2 * (at.back() - at.front()));
}
constexpr const char* turned_system = "*DEFINE_COORDINATE_SYSTEM\n7,0.0,0.0,0.0,0.0,1.0,0.0\n-1.0,0.0,0.0\n";

}  // namespace

// Of each of the six alone sqrt(K/m)/2 pi, along global axes and along a system whose r is y and s is -x.
TEST(DiscreteBeams, FrequencyOfEachSpring) {
  const Real k[] = {100, 200, 300, 20, 40, 60};
  constexpr const char* only[] = {",5,7", ",6,7", ",4,7", ",7,5", ",7,6", ",7,4"};
  for (const bool turned : {false, true})
    for (int d = 0; d < 6; ++d) {
      BeamDeck deck =
          six_springs_deck({0, 0, 0}, only[d], six_springs_section(0, turned ? 7 : 0), springs_066);
      deck.cards += std::string(turned ? turned_system : "") + "*CONTROL_TIMESTEP\n0.0,0.1\n";
      auto s = simulation_of(deck.text(100));
      Field<Real>& rate = d < 3 ? s->world().nodes.v : spins_of(*s);
      rate.data(d % 3)[1] = 0.01;
      start_ledger(*s);
      const int spring = turned && d % 3 < 2 ? d / 3 * 3 + 1 - d % 3 : d;
      const Real w = std::sqrt(k[spring] / (d < 3 ? 1 : 0.2));
      const Real f = frequency_of_rate(*s, rate, d % 3, 9) * 2 * pi / w;
      testing::Test::RecordProperty(fmt::format("spring{}{}", d, turned ? "_turned" : ""),
                                    fmt::format("{:.6f}", f));
      EXPECT_NEAR(f, 1, 2e-3) << d << turned;
      EXPECT_LT(test::energy_error_of_a_step(*s), 5e-3) << d;
    }
}

// u'' + 2 z w u' + w^2 u = 0 with TD = 4, RD = 0.8: z w = 2.
TEST(DiscreteBeams, DampingOfEachSpring) {
  constexpr const char* only[] = {",5,7", ",6,7", ",4,7", ",7,5", ",7,6", ",7,4"};
  const Real k[] = {100, 200, 300, 20, 40, 60};
  for (int d = 0; d < 6; ++d) {
    BeamDeck deck =
        six_springs_deck({0, 0, 0}, only[d], six_springs_section(0),
                         "*MAT_066\n1,2.0,100.0,200.0,300.0,20.0,40.0,60.0\n4.0,4.0,4.0,0.8,0.8,0.8\n");
    deck.cards += "*CONTROL_TIMESTEP\n0.0,0.02\n";
    auto s = simulation_of(deck.text(100));
    Field<Real>& rate = d < 3 ? s->world().nodes.v : spins_of(*s);
    rate.data(d % 3)[1] = 1;
    const Real w = std::sqrt(k[d] / (d < 3 ? 1 : 0.2) - 4);
    while (s->clock().t < 1) s->step(do_nothing);
    const Real t = s->clock().t;
    EXPECT_NEAR(six_of(*s, "displacement").data(d)[0],
                std::exp(-2 * (t - s->clock().dt)) * std::sin(w * (t - s->clock().dt)) / w, 1e-2 / w)
        << d;
  }
}

// FO, MO without displacement: u = -F0/K (1 - cos w t).
TEST(DiscreteBeams, PreloadsPull) {
  for (const int d : {0, 1, 2, 3, 4, 5}) {
    constexpr const char* only[] = {",5,7", ",6,7", ",4,7", ",7,5", ",7,6", ",7,4"};
    const Real k[] = {100, 200, 300, 20, 40, 60}, start[] = {1, 2, 3, 0.4, 0.5, 0.6};
    BeamDeck deck = six_springs_deck({0, 0, 0}, only[d], six_springs_section(0),
                                     springs_066 + "1.0,2.0,3.0,0.4,0.5,0.6\n");
    deck.cards += "*CONTROL_TIMESTEP\n0.0,0.05\n";
    auto s = simulation_of(deck.text(100));
    Real most = 0;
    const Real w = std::sqrt(k[d] / (d < 3 ? 1 : 0.2));
    while (s->clock().t < 2 * pi / w) {
      s->step(do_nothing);
      most = std::min(most, six_of(*s, "displacement").data(d)[0]);
    }
    EXPECT_NEAR(most, -2 * start[d] / k[d], 1e-2 * start[d] / k[d]) << d;
  }
}

// Two ends fly and tumble, r, s and t apart: nothing from outside.
TEST(DiscreteBeams, MomentsBalance) {
  for (const int scoor : {-3, -2, 2, 3}) {
    BeamDeck deck = six_springs_deck({0.8, 0.3, -0.2}, "", six_springs_section(scoor), springs_066);
    deck.nodes = "1,0.0,0.0,0.0\n2,0.8,0.3,-0.2\n3,0.0,1.0,0.0,7,7\n";
    deck.elements = fmt::format("{:8}{:8}{:8}{:8}{:8}\n", 1, 1, 1, 2, 3);
    deck.velocity([](int n) {
      return n == 1 ? Vec(0.3, -0.2, 0.5) : n == 2 ? Vec(-0.1, 0.6, 0.2) : Vec(0, 0, 0);
    });
    deck.cards += "*CONTROL_TIMESTEP\n0.0,0.2\n";
    auto s = simulation_of(deck.text(100));
    const Nodes& nodes = s->world().nodes;
    spins_of(*s).set(0, Vec(0.5, 1.0, -0.7)), spins_of(*s).set(1, Vec(-0.2, 0.3, 0.9));
    start_ledger(*s);
    const auto sums = [&] {
      Vec p = Vec::Zero(), L = Vec::Zero();
      for (Index n = 0; n < 2; ++n) {
        p += nodes.m[n] * nodes.v.vec(n);
        L += nodes.m[n] * nodes.x.vec(n).cross(nodes.v.vec(n)) + 0.2 * spins_of(*s).vec(n);
      }
      return std::pair(p, L);
    };
    const auto [p, L] = sums();
    while (s->clock().t < 10) s->step(do_nothing);
    const auto [p_end, L_end] = sums();
    EXPECT_LT((p_end - p).norm(), 1e-12) << scoor;
    EXPECT_LT((L_end - L).norm(), 1e-11) << scoor;
    EXPECT_LT(test::energy_error_of_a_step(*s), 0.02) << scoor;
  }
}

// A beam 0.5 long that turns as one by 0.2 rad: no spring across or about answers.
TEST(DiscreteBeams, TurnAsOneWithoutForce) {
  for (const int scoor : {-3, -2, 2, 3}) {
    BeamDeck deck = six_springs_deck({0.5, 0, 0}, "", six_springs_section(scoor), springs_066);
    deck.nodes = "1,0.0,0.0,0.0\n2,0.5,0.0,0.0\n";
    deck.cards += "*CONTROL_TIMESTEP\n0.0,0.02\n";
    auto s = simulation_of(deck.text(100));
    const Vec omega(0, 0, 1e-2);
    for (Index n = 0; n < 2; ++n) {
      spins_of(*s).set(n, omega);
      s->world().nodes.v.set(n, omega.cross(Vec(s->world().nodes.x.vec(n) - Vec(0.25, 0, 0))));
    }
    while (s->clock().t < 20) s->step(do_nothing);
    const Vec line = s->world().nodes.x.vec(1) - s->world().nodes.x.vec(0);
    EXPECT_NEAR(std::atan2(line[1], line[0]), 0.2, 2e-4) << scoor;
    for (int d = 1; d < 6; ++d) EXPECT_NEAR(six_of(*s, "displacement").data(d)[0], 0, 2e-6) << scoor << d;
  }
}

// Force P across at end 2, L away: it turns by P L/(2 RK), and yields by P/TK + P L^2/(4 RK).
TEST(DiscreteBeams, ShearForcesTurnTheEnds) {
  const Real P = 0.05, L = 0.5;
  for (const int scoor : {-3, -1}) {
    BeamDeck deck = six_springs_deck({L, 0, 0}, "", six_springs_section(scoor), springs_066);
    deck.cards += fmt::format(
        "*LOAD_NODE_POINT\n2,2,9,{}\n*DEFINE_CURVE\n9\n0.0,0.0\n2.0,1.0\n100.0,1.0\n*DAMPING_GLOBAL\n0,8.0\n",
        P);
    auto s = simulation_of(deck.text(100));
    while (s->clock().t < 6) s->step(do_nothing);
    const Real turn = scoor == -3 ? P * L / (2 * 60) : 0;
    const Real y = P / 200 + turn * L / 2;
    EXPECT_NEAR(s->world().nodes.x.data(1)[1], y, 1e-3 * y) << scoor;
    EXPECT_NEAR(shared_fields::rotation.find(s->world().nodes.fields)->data(2)[1], turn, 1e-3 * P * L / 120)
        << scoor;
  }
}

namespace {

/// Node 2 moves along (d < 3) or about an axis with a displacement over time.
std::string driven_six(int d, const std::string& curve) {
  return fmt::format(
      "*BOUNDARY_PRESCRIBED_MOTION_NODE\n2,{},2,50\n*DEFINE_CURVE\n50\n{}*CONTROL_TIMESTEP\n0.0,0.02\n",
      d < 3 ? d + 1 : d + 2, curve);
}
constexpr const char* free_along[] = {",5,7", ",6,7", ",4,7", ",7,5", ",7,6", ",7,4"};
Real force_of_six(const Simulation& s, int d) {
  return six_of(s, "end_forces").data(d)[0];
}

}  // namespace

// A curve from 0, 0 is mirrored, one with a side below 0 is not; damping adds 3 times the rate.
TEST(DiscreteBeams, CurvesOfForceAndDamping) {
  const std::string curves =
      "*DEFINE_CURVE\n1\n0.0,0.0\n0.1,20.0\n0.3,30.0\n*DEFINE_CURVE\n2\n-1.0,-10.0\n0.0,0.0\n1.0,400.0\n"
      "*DEFINE_CURVE\n3\n0.0,0.0\n1.0,3.0\n";
  for (int d = 0; d < 6; ++d)
    for (const Real side : {1, -1}) {
      const int first = d % 2 == 0 ? 1 : 2;
      BeamDeck deck =
          six_springs_deck({0, 0, 0}, free_along[d], six_springs_section(0),
                           "*MAT_NONLINEAR_ELASTIC_DISCRETE_BEAM\n1,2.0,1,2,1,2,1,2\n3,3,3,3,3,3\n" + curves);
      deck.cards += driven_six(d, fmt::format("0.0,0.0\n1.0,{}\n", 0.2 * side));
      auto s = simulation_of(deck.text(1));
      for (const Real until : {0.25, 0.9}) {
        while (s->clock().t < until) s->step(do_nothing);
        const Real u = six_of(*s, "displacement").data(d)[0], far = std::abs(u);
        const Real mirrored = side * (far < 0.1 ? 200 * far : 20 + 50 * (far - 0.1));
        const Real force = (first == 1 ? mirrored : u > 0 ? 400 * u : 10 * u) + 3 * 0.2 * side;
        EXPECT_NEAR(force_of_six(*s, d), force, 1e-6) << d << side << until;
      }
    }
}

// The same by *MAT_119 and, along r, *MAT_121; they fail at limits that differ in tension and compression.
TEST(DiscreteBeams, GeneralNonlinearBeamsFollowTheirCurves) {
  const std::string curves =
      "*DEFINE_CURVE\n1\n0.0,0.0\n0.1,20.0\n0.3,30.0\n*DEFINE_CURVE\n2\n-1.0,-10.0\n0.0,0.0\n1.0,400.0\n"
      "*DEFINE_CURVE\n3\n0.0,0.0\n1.0,3.0\n";
  for (int d = -1; d < 6; ++d)  // -1: *MAT_121
    for (const Real side : {1, -1}) {
      const int axis = std::max(d, 0);
      const std::string material =
          d < 0 ? "*MAT_GENERAL_NONLINEAR_1DOF_DISCRETE_BEAM\n1,2.0,0.0,0,0.0,0.9\n1,0,3\n0.15,0.1\n"
                : "*MAT_GENERAL_NONLINEAR_6DOF_DISCRETE_BEAM\n1,2.0,0.0,0.0,0,0.0,0.9\n1,2,1,2,1,2\n0\n3,3,3,"
                  "3,3,3\n"
                  "0\n0.15,0.15,0.15,0.15,0.15,0.15\n0.1,0.1,0.1,0.1,0.1,0.1\n";
      BeamDeck deck =
          six_springs_deck({0, 0, 0}, free_along[axis], six_springs_section(0), material + curves);
      deck.cards += driven_six(axis, fmt::format("0.0,0.0\n1.0,{}\n", 0.2 * side));
      auto s = simulation_of(deck.text(1));
      Real last = 0;
      while (s->clock().t < 0.95) {
        s->step(do_nothing);
        const Real u = six_of(*s, "displacement").data(axis)[0], far = std::abs(u);
        if (s->clock().t > 0.1 && force_of_six(*s, axis) == 0) break;
        const Real mirrored = side * (far < 0.1 ? 200 * far : 20 + 50 * (far - 0.1));
        const Real force = (axis % 2 == 0 ? mirrored : u > 0 ? 400 * u : 10 * u) + 3 * 0.2 * side;
        if (s->clock().t > 0.1) EXPECT_NEAR(force_of_six(*s, axis), force, 1e-6) << d << side;
        last = u;
      }
      EXPECT_NEAR(last, side > 0 ? 0.15 : -0.1, 0.003) << d;
    }
}

// K = 100, yields at 5, hardens by 20 up to the plastic stretch 0.1, then level at 7: to 0.3 and back to 0.
TEST(DiscreteBeams, SpringsYield) {
  for (int d = 0; d < 6; ++d)
    for (const Real side : {1, -1}) {
      BeamDeck deck = six_springs_deck({0, 0, 0}, free_along[d], six_springs_section(0),
                                       "*MAT_NONLINEAR_PLASTIC_DISCRETE_BEAM\n1,2.0,100.0,100.0,100.0,100.0,"
                                       "100.0,100.0\n0.0\n1,1,1,1,1,1\n"
                                       "*DEFINE_CURVE\n1\n0.0,5.0\n0.1,7.0\n1.0,7.0\n");
      deck.cards += driven_six(d, fmt::format("0.0,0.0\n1.0,{}\n2.0,0.0\n", 0.3 * side));
      auto s = simulation_of(deck.text(2));
      const auto u = [&] { return six_of(*s, "displacement").data(d)[0]; };
      while (side * u() < 0.1) s->step(do_nothing);
      const Real p = (side * u() - 0.05) * 100 / 120;
      EXPECT_NEAR(force_of_six(*s, d), side * (5 + 20 * p), 1e-9) << d;
      while (s->clock().t < 0.99) s->step(do_nothing);
      EXPECT_NEAR(force_of_six(*s, d), side * 7, 1e-9) << d;
      Real most = 0;
      while (s->clock().t < 1.1) {
        s->step(do_nothing);
        most = std::max(most, side * u());
      }
      EXPECT_NEAR(force_of_six(*s, d), side * (7 - 100 * (most - side * u())), 1e-9) << d;
    }
}

// All of it in one step, over the bend of the curve.
TEST(DiscreteBeams, SpringsYieldOverBends) {
  Curve curve;
  curve.abscissa = {0, 0.1, 1}, curve.ordinate = {5, 7, 7};
  BeamSpring spring;
  spring.k = 100, spring.yield = YieldCurve(curve);
  for (const Real side : {1, -1}) {
    Real state[SpringLaw::numbers] = {};
    EXPECT_NEAR(spring.answer({.stretch = 0.3 * side, .rate = 0, .change = 0.3 * side}, state).force,
                7 * side, 1e-12);
    EXPECT_NEAR(state[1], 0.3 - 7.0 / 100, 1e-12);
  }
}

// The sum of squares of forces, or of displacements, over their limits comes to 1: at 3/4 of u = 0.2, or
// where both of 0.1 and 0.1 count at 0.1/sqrt(2).
TEST(DiscreteBeams, FailByForcesAndDisplacements) {
  struct Case {
    std::string forces, displacements;
    Real at;
  };
  for (const Case& one : {Case{"15.0,0.0", "0.0", 0.15}, Case{"0.0", "0.12", 0.12},
                          Case{"10.0,10.0", "0.0", 0.1 / std::sqrt(2)}}) {
    BeamDeck deck =
        six_springs_deck({0, 0, 0}, ",4,7", six_springs_section(0),
                         "*MAT_NONLINEAR_ELASTIC_DISCRETE_BEAM\n1,2.0,1,1\n\n0.0\n" + one.forces + "\n" +
                             one.displacements + "\n*DEFINE_CURVE\n1\n0.0,0.0\n1.0,100.0\n");
    deck.nodes = "1,0.0,0.0,0.0,7,7\n2,0.0,0.0,0.0,3,7\n";
    const bool both = one.forces == "10.0,10.0";
    deck.cards += driven_six(0, "0.0,0.0\n1.0,0.2\n");
    if (both) deck.cards += "*BOUNDARY_PRESCRIBED_MOTION_NODE\n2,2,2,50\n";
    auto s = simulation_of(deck.text(1));
    Real last = 0;
    while (s->clock().t < 1) {
      s->step(do_nothing);
      if (force_of_six(*s, 0) > 0) last = s->world().nodes.x.data(0)[1];
    }
    EXPECT_NEAR(last, one.at, 0.02 * one.at) << one.forces;
    EXPECT_EQ(force_of_six(*s, 0), 0);
  }
}

// RRCON, SRCON, TRCON: the triad stays about an axis about which its end turns.
TEST(DiscreteBeams, AxesThatAreHeldDoNotTurn) {
  for (const bool held : {false, true}) {
    BeamDeck deck = six_springs_deck({0, 0, 0}, ",7,4", six_springs_section(1), springs_066);
    deck.cards =
        fmt::format("*PART\nbeams\n1,1,1\n*SECTION_BEAM\n1,6,,,,1\n1.0,0.4,0,,,0,0,{}\n", int(held)) +
        springs_066;
    deck.cards += driven_six(5, "0.0,0.0\n1.0,0.5\n");
    auto s = simulation_of(deck.text(1));
    while (s->clock().t < 1) s->step(do_nothing);
    const Real half = 0.5 * (s->clock().t - s->clock().dt) * 0.5;  // of the angle
    EXPECT_NEAR(six_of(*s, "triad").data(3)[0], held ? 0 : std::sin(half), 5e-3);
  }
}

TEST(DiscreteBeams, SameBitsOnThreadsAndAfterARestart) {
  BeamDeck deck =
      six_springs_deck({0.8, 0.3, -0.2}, "", six_springs_section(-2),
                       "*MAT_068\n1,2.0,100.0,200.0,300.0,20.0,40.0,60.0\n0.5,0.5,0.5,0.1,0.1,0.1\n"
                       "1,1,1,1,1,1\n0.0\n0.0,0.0,0.0,1.5\n0.1,0.2\n*DEFINE_CURVE\n1\n0.0,0.5\n1.0,2.0\n");
  for (int k = 3; k < 40; ++k) {
    deck.at({0.1 * k, 0.3, 0.01 * k});
    deck.beam(1, k - 1, k);
  }
  deck.velocity([](int n) { return Vec(0.3 * n, std::sin(n), 0.5 - 0.1 * n); });
  expect_same_bits(deck.text(100), 60, 25);
}
