// Mass scaling against the frequencies, accelerations and energies that follow from the masses.
#include <gtest/gtest.h>

#include <cmath>

#include "base/run_error.hpp"
#include "beam_decks.hpp"
#include "rigid/bodies/rigid.hpp"
#include "same_bits.hpp"
#include "shell_decks.hpp"
#include "solid_decks.hpp"
#include "state/reports.hpp"
#include "state/shared_fields.hpp"

using namespace courant;
using test::do_nothing;
using test::ShellDeck;
using test::simulation_of;
using test::SolidDeck;
using test::start_ledger;

namespace {

/// *CONTROL_TIMESTEP with TSSFAC 0.8.
std::string scaled_to(Real dt2ms, int ms1st = 0) {
  return fmt::format("*CONTROL_TIMESTEP\n       0.0       0.8         0       0.0{:10.3e}{:30}\n", dt2ms,
                     ms1st);
}

Real mass_of_nodes(const World& world) {
  return sum(world.nodes.size(), [&](Index n) { return world.nodes.m[n]; });
}

/// Free bar of E = 1, rho = 1, without Poisson's ratio: 10 long in steps of 0.5, thrown in its first mode.
SolidDeck free_bar(const std::string& cards) {
  SolidDeck deck;
  deck.block(Vec(10, 0.5, 0.5), 20, 1, 1, 1);
  deck.cards = cards +
               "*PART\nbar\n         1         1         1\n*SECTION_SOLID\n         1         1\n"
               "*MAT_ELASTIC\n         1       1.0       1.0       0.0\n*CONTROL_BULK_VISCOSITY\n    1.0E-9  "
               "  1.0E-9\n"
               "*INITIAL_VELOCITY_NODE\n";
  for (std::size_t n = 0; n < deck.nodes.size(); ++n)
    deck.cards += fmt::format("{:10}{:10.3e}\n", n + 1, 1e-4 * std::cos(pi * deck.nodes[n][0] / 10));
  return deck;
}

/// From the first two times at which a component of a node's velocity changes its sign: a half period.
Real swing_frequency(Simulation& s, Index node, int axis) {
  const Real* v = s.world().nodes.v.data(axis);
  std::vector<Real> at;
  for (Real before = v[node]; at.size() < 3 && s.clock().cycle < 100000; before = v[node]) {
    const Real t = s.clock().t;
    s.step(do_nothing);
    if (before * v[node] < 0) at.push_back(t + before / (before - v[node]) * s.clock().dt_old);
  }
  return at.size() < 3 ? 0 : 1 / (at[2] - at[0]);
}

}  // namespace

// The elements' step is 0.5/c = 0.5; with 1.0 asked for, each weighs 4 times as much: f = c/(2 L) falls to
// half.
TEST(MassScaling, ABarOfFourTimesItsMassSwingsHalfAsFast) {
  for (const auto& [dt2ms, ratio] : {std::pair(0.0, 1.0), {-0.4, 1.0}, {-1.0, 4.0}, {0.25, 0.25}}) {
    auto s = simulation_of(free_bar(scaled_to(dt2ms)).text(1e9));
    start_ledger(*s);
    EXPECT_NEAR(mass_of_nodes(s->world()), 2.5 * ratio, 1e-9) << dt2ms;
    EXPECT_NEAR(swing_frequency(*s, 0, 0), 1 / (20 * std::sqrt(ratio)), 2e-4) << dt2ms;
    EXPECT_NEAR(s->clock().dt_old, 0.8 * 0.5 * std::sqrt(ratio), 1e-3) << dt2ms;
    EXPECT_LT(test::energy_error(*s), 0.03) << dt2ms;  // of half a step
    // its waves press elements by 1E-4, which then get a little more
    EXPECT_NEAR(s->world().maxima["added_mass"], 2.5 * (ratio - 1), 5e-3);
  }
}

// A simply supported plate: f falls by the root of the mass, rotary inertia with it.
TEST(MassScaling, APlateOfNineTimesItsMassSwingsAThirdAsFast) {
  Real first = 0;
  for (const Real dt2ms : {0.0, -1.0}) {
    ShellDeck deck;
    deck.plate(1, 1, 8, 8, 1);
    deck.part(1, 0.02, "*MAT_ELASTIC\n         1       1.0       1.0       0.3\n");
    deck.hold(1, "z", [](const Vec& x) { return std::min({x[0], x[1], 1 - x[0], 1 - x[1]}) < 1e-9; });
    deck.velocity([](const Vec& x) { return Vec(0, 0, 1e-6 * std::sin(pi * x[0]) * std::sin(pi * x[1])); });
    // step of a square of 1/8: l sqrt(rho (1 - nu^2)/E)
    const Real own = 0.125 * std::sqrt(0.91);
    deck.cards += scaled_to(3 * own * dt2ms);
    auto s = simulation_of(deck.text(1e9));
    const Field<Real>& inertia = *shared_fields::rotary_inertia.find(s->world().nodes.fields);
    const Real of_mass = mass_of_nodes(s->world()) / 0.02,
               of_turns = sum(s->world().nodes.size(), [&](Index n) { return inertia[n]; });
    start_ledger(*s);
    const Real f = swing_frequency(*s, 40, 2);
    if (dt2ms == 0) {
      first = f;
      EXPECT_NEAR(of_mass, 1, 1e-9);
      EXPECT_GT(of_turns, 0);
    } else {
      EXPECT_NEAR(of_mass, 9, 2e-3);  // the step in the deck is rounded
      EXPECT_NEAR(f / first, 1.0 / 3, 1e-3);
    }
    EXPECT_LT(test::energy_error(*s), 0.03);
  }
}

// Weight is that of the material: the block of four times its mass falls with a quarter of the acceleration.
// The same bar of beams and of trusses; rotary inertia grows with the mass.
TEST(MassScaling, BeamsOfFourTimesTheirMassSwingHalfAsFast) {
  for (const char* section :
       {"         1       1.0         2         0\n       0.1       0.1       0.1       0.1\n",
        "         2\n      0.018.3333E-068.3333E-061.6667E-05\n", "         3\n      0.01\n"}) {
    Real alone = 0;
    for (const auto& [dt2ms, ratio] : {std::pair(0.0, 1.0), {-0.4, 1.0}, {-1.0, 4.0}, {0.25, 0.25}}) {
      test::beams::BeamDeck deck;
      deck.line(20, 10, [](int) { return ""; });
      deck.part(1, section, "*MAT_ELASTIC\n         1       1.0       1.0       0.3\n");
      deck.velocity(
          [](int n) -> Vec { return n > 21 ? Vec(0, 0, 0) : Vec(1e-4 * std::cos(pi * (n - 1) / 20), 0, 0); });
      deck.cards += scaled_to(dt2ms);
      auto s = simulation_of(deck.text(1e9));
      start_ledger(*s);
      EXPECT_NEAR(mass_of_nodes(s->world()), 0.1 * ratio, 1e-9) << section << dt2ms;
      EXPECT_NEAR(s->world().maxima["added_mass"], 0.1 * (ratio - 1), 1e-9) << section << dt2ms;
      if (const Field<Real>* inertia = shared_fields::rotary_inertia.find(s->world().nodes.fields)) {
        if (dt2ms == 0) alone = (*inertia)[3];
        EXPECT_NEAR((*inertia)[3], ratio * alone, 1e-9 * alone) << section << dt2ms;
      }
      EXPECT_NEAR(swing_frequency(*s, 0, 0), 1 / (20 * std::sqrt(ratio)), 2e-4) << section << dt2ms;
      EXPECT_NEAR(s->clock().dt_old, 0.8 * 0.5 * std::sqrt(ratio), 1e-3) << section << dt2ms;
      EXPECT_LT(test::energy_error(*s), 0.03) << section << dt2ms;  // of half a step
    }
  }
}

TEST(MassScaling, AddedMassHasNoWeight) {
  SolidDeck deck;
  deck.block(Vec(1, 1, 1), 2, 2, 2, 1);
  deck.cards =
      scaled_to(-1) +
      "*PART\nblock\n         1         1         1\n*SECTION_SOLID\n         1         1\n"
      "*MAT_ELASTIC\n         1       1.0       1.0       0.0\n*LOAD_BODY_Z\n         1       1.0\n"
      "*DEFINE_CURVE\n         1\n                   0                1E-6\n                1E9         "
      "       1E-6\n";
  auto s = simulation_of(deck.text(1e9));
  start_ledger(*s);
  for (int k = 0; k < 100; ++k) s->step(do_nothing);
  const Real t = s->clock().t - 0.5 * s->clock().dt_old;
  for (Index n = 0; n < s->world().nodes.size(); ++n)
    EXPECT_NEAR(s->world().nodes.v.data(2)[n], -1e-6 * t / 4, 1e-9 * t);
  sample_energy(s->world(), s->clock());
  EXPECT_LT(std::abs(s->world().energy.unexplained()), 0.02 * s->world().energy.kinetic);
}

// A block that flies along x and is pressed flat gets mass so that the step stays; that comes with the speed
// of the block, which stays 1, and its kinetic energy counts as work. With MS1ST 1 it gets none and the step
// falls.
TEST(MassScaling, ElementsThatAreSquashedGetMassWhileTheRunGoesOn) {
  for (const int once : {0, 1}) {
    SolidDeck deck;
    deck.block(Vec(1, 1, 1), 2, 2, 2, 1);
    deck.cards =
        scaled_to(-0.5, once) +
        "*PART\nblock\n         1         1         1\n*SECTION_SOLID\n         1         1\n"
        "*MAT_ELASTIC\n         1       1.0       1.0       0.0\n*CONTROL_BULK_VISCOSITY\n    1.0E-9    "
        "1.0E-9\n*BOUNDARY_PRESCRIBED_MOTION_SET\n         1         3         0         1\n"
        "         2         3         0         2\n*DEFINE_CURVE\n         1\n                   0          "
        "         0\n                 1E9                   0\n*DEFINE_CURVE\n         2\n                  "
        " 0               -0.01\n                 1E9               -0.01\n";
    deck.node_set(1, [](const Vec& x) { return x[2] < 1e-9; });
    deck.node_set(2, [](const Vec& x) { return x[2] > 1 - 1e-9; });
    deck.cards += "*INITIAL_VELOCITY_NODE\n";
    for (std::size_t n = 0; n < deck.nodes.size(); ++n) deck.cards += fmt::format("{:10}       1.0\n", n + 1);
    auto s = simulation_of(deck.text(1e9));
    EXPECT_NEAR(mass_of_nodes(s->world()), 1, 1e-9);
    start_ledger(*s);
    while (s->clock().t < 40) s->step(do_nothing);
    // as flat as 0.6, and denser: the step of an element falls by sqrt(0.6), so that it needs 1/0.6 of its
    // mass
    if (once)
      EXPECT_LT(s->clock().dt_old, 0.8 * 0.41);
    else
      EXPECT_GT(s->clock().dt_old, 0.97 * 0.8 * 0.5);
    EXPECT_NEAR(mass_of_nodes(s->world()), once ? 1 : 1 / 0.6, once ? 1e-9 : 0.05);
    EXPECT_LT(test::energy_error(*s), 0.01) << once;
    EXPECT_NEAR(s->world().energy.kinetic, 0.5 * mass_of_nodes(s->world()), 0.01);
    for (Index n = 0; n < s->world().nodes.size(); ++n) EXPECT_NEAR(s->world().nodes.v.data(0)[n], 1, 1e-6);
  }
}

// A fifth of the height in a step: mass follows at once, so that the step stays what is asked for.
TEST(MassScaling, GrowsByTheSquareInEachStep) {
  SolidDeck deck;
  deck.block(Vec(1, 1, 1), 1, 1, 1, 1);
  deck.cards = scaled_to(-1.0) +
               "*PART\nblock\n1,1,1\n*SECTION_SOLID\n1,1\n*MAT_ELASTIC\n1,1.0,1.0,0.0\n*CONTROL_BULK_"
               "VISCOSITY\n1.0E-9,1.0E-9\n"
               "*BOUNDARY_PRESCRIBED_MOTION_SET\n1,3,0,1\n2,3,0,2\n*DEFINE_CURVE\n1\n0.0,0.0\n1.0E9,0.0\n"
               "*DEFINE_CURVE\n2\n0.0,-0.2\n1.0E9,-0.2\n";
  deck.node_set(1, [](const Vec& x) { return x[2] < 1e-9; });
  deck.node_set(2, [](const Vec& x) { return x[2] > 1 - 1e-9; });
  auto s = simulation_of(deck.text(1e9));
  start_ledger(*s);
  while (s->clock().t < 2) s->step(do_nothing);
  const Real height = 1 - 0.2 * (s->clock().t - s->clock().dt_old);
  EXPECT_LT(height, 0.75);
  EXPECT_NEAR(mass_of_nodes(s->world()) * height, 1, 0.01);
  EXPECT_NEAR(s->clock().dt_old, 0.8, 0.01);
}

// A block that is pressed to the height h needs 1/h of its mass: at 1/0.8 ENDMAS 25 ends the run; one that
// has 1.5625 of it at the start is pressed to 0.78125 at twice that of the material.
TEST(MassScaling, EndmasEndsTheRunInTheStepThatPassesIt) {
  for (const auto& [dt2ms, endmas, height] : {std::tuple(-1.0, 25.0, 0.8), {-1.25, 100.0, 0.78125}}) {
    SolidDeck deck;
    deck.block(Vec(1, 1, 1), 1, 1, 1, 1);
    deck.cards = scaled_to(dt2ms) +
                 "*PART\nblock\n1,1,1\n*SECTION_SOLID\n1,1\n*MAT_ELASTIC\n1,1.0,1.0,0.0\n*CONTROL_BULK_"
                 "VISCOSITY\n1.0E-9,1.0E-9\n"
                 "*BOUNDARY_PRESCRIBED_MOTION_SET\n1,3,0,1\n2,3,0,2\n*DEFINE_CURVE\n1\n0.0,0.0\n1.0E9,0.0\n"
                 "*DEFINE_CURVE\n2\n0.0,-0.01\n1.0E9,-0.01\n";
    deck.node_set(1, [](const Vec& x) { return x[2] < 1e-9; });
    deck.node_set(2, [](const Vec& x) { return x[2] > 1 - 1e-9; });
    std::string text = deck.text(1e9);
    const std::string end = "*CONTROL_TERMINATION\n     1e+09\n";
    ASSERT_NE(text.find(end), std::string::npos);
    text.replace(text.find(end), end.size(), fmt::format("*CONTROL_TERMINATION\n1e9,0,0.0,0.0,{}\n", endmas));
    auto s = simulation_of(text);
    start_ledger(*s);
    Real last = 0;
    EXPECT_THROW(
        while (s->clock().t < 60) {
          s->step(do_nothing);
          last = s->clock().t;
        },
        RunError);
    EXPECT_NEAR(1 - 0.01 * last, height, 0.02) << endmas;
  }
}

// A block that is glued to a rigid one is pressed: its own nodes get mass, those of the body none.
TEST(MassScaling, NodesOfBodiesGetNone) {
  SolidDeck deck;
  deck.block(Vec(1, 1, 2), 1, 1, 2, 1);
  deck.elements.replace(8, 8, "       2");  // the lower one
  deck.cards = scaled_to(-1.0) +
               "*PART\nblock\n1,1,1\n*PART\nrigid\n2,1,2\n*SECTION_SOLID\n1,1\n*MAT_ELASTIC\n1,1.0,1.0,0.0\n"
               "*MAT_RIGID\n2,1.0,1.0,0.0\n1.0,7,7\n*BOUNDARY_PRESCRIBED_MOTION_SET\n2,3,0,2\n"
               "*DEFINE_CURVE\n2\n0.0,-0.01\n1.0E9,-0.01\n";
  deck.node_set(2, [](const Vec& x) { return x[2] > 2 - 1e-9; });
  auto s = simulation_of(deck.text(1e9));
  start_ledger(*s);
  const Nodes& nodes = s->world().nodes;
  std::vector<Real> before;
  for (Index n = 0; n < nodes.size(); ++n) before.push_back(nodes.m[n]);
  const Real first = mass_of_nodes(s->world());
  while (s->clock().t < 40) s->step(do_nothing);
  // what is reported is what nodes got, 4 of the 8 corners
  const Real got = mass_of_nodes(s->world()) - first;
  EXPECT_NEAR(got, 0.5 * (1 / 0.6 - 1), 0.05);
  EXPECT_NEAR(s->world().maxima["added_mass"], got, 1e-12);
  std::vector<PartSums> parts(2);
  for (auto* pass : s->world().passes.all<PartReporter>()) pass->report_part(s->world(), parts);
  EXPECT_NEAR(parts[0].added_mass, got, 1e-12);
  EXPECT_NEAR(parts[0].mass, 1 + got, 1e-12);
  // of that, the upper corners carry all: 0.01 is their speed
  EXPECT_NEAR(parts[0].momentum[2], -0.01 * (0.5 + got), 1e-12);
  for (Index n = 0; n < nodes.size(); ++n)
    if (nodes.follow[n])
      EXPECT_EQ(nodes.m[n], before[static_cast<std::size_t>(n)]) << n;
    else
      EXPECT_NEAR(nodes.m[n] / before[static_cast<std::size_t>(n)], 1 / 0.6, 0.05) << n;
  EXPECT_LT(test::energy_error(*s), 0.02);
}

// The rigid half weighs what its card says, whatever elements give to the nodes they share with it. Before
// anything moves the deformable half gives mass to the other nodes alone; the element between nodes of the
// body gets none.
TEST(MassScaling, BodiesOfAGivenMassTakeNone) {
  for (const bool shells : {false, true}) {
    SolidDeck solids;
    ShellDeck flat;
    if (shells)
      flat.plate(1, 1, 2, 1, 1);
    else
      solids.block(Vec(1, 1, 2), 1, 1, 2, 1);
    // step of solids 1, of shells 0.5
    std::string cards = scaled_to(shells ? -1.0 : -2.0) +
                        "*PART\nsoft\n1,1,1\n*MAT_ELASTIC\n1,1.0,1.0,0.0\n*PART_INERTIA\nrigid\n2,2,2\n"
                        "0.5,0.5,0.5,7.0\n2.0,0.0,0.0,3.0,0.0,4.0\n\n*MAT_RIGID\n2,1.0,1.0,0.0\n\n\n";
    std::string text;
    if (shells) {
      flat.cards += cards +
                    "*SECTION_SHELL\n1,2,1.0,2\n0.1,0.1,0.1,0.1\n*SECTION_SHELL\n2,2,1.0,2\n0.1,0.1,"
                    "0.1,0.1\n";
      text = flat.text(1e9);
      const std::size_t second = text.find("       2       1", text.find("*ELEMENT_SHELL"));
      ASSERT_NE(second, std::string::npos);
      text.replace(second, 16, "       2       2");
    } else {
      solids.elements.replace(8, 8, "       2");
      solids.cards = cards + "*SECTION_SOLID\n1,1\n*SECTION_SOLID\n2,1\n";
      text = solids.text(1e9);
    }
    auto s = simulation_of(text);
    ASSERT_NE(s, nullptr);
    EXPECT_EQ(s->bodies()->bodies().front().m, 7);
    const Nodes& nodes = s->world().nodes;
    const Real own = shells ? 0.5 * 0.1 : 1;  // four times that
    Real got = 0;
    for (Index n = 0; n < nodes.size(); ++n)
      if (!nodes.follow[n]) got += nodes.m[n];
    EXPECT_NEAR(got, 0.5 * 4 * own, 1e-6);
    EXPECT_NEAR(s->world().maxima["added_mass"], 0.5 * 3 * own, 1e-6);
    EXPECT_NEAR(s->clock().dt_old, 0, 0);
    start_ledger(*s);
    s->step(do_nothing);
    EXPECT_NEAR(s->clock().dt_old, 0.8 * (shells ? 1 : 2), 1e-6);  // the step is that of all its mass
  }
}

TEST(MassScaling, SameBitsOnAnyNumberOfThreadsAndAfterARestart) {
  SolidDeck deck;
  deck.block(Vec(4, 3, 3), 8, 6, 6, 1);
  deck.cards = scaled_to(-0.55) +
               "*PART\nblock\n         1         1         1\n*SECTION_SOLID\n         1         1\n"
               "*MAT_ELASTIC\n         1       1.0       1.0       0.2\n*INITIAL_VELOCITY_NODE\n";
  for (std::size_t n = 0; n < deck.nodes.size(); ++n)
    deck.cards += fmt::format("{:10}{:10.3e}\n", n + 1, -0.1 * deck.nodes[n][0]);
  test::expect_same_bits(deck.text(1e9), 60, 30);
}
