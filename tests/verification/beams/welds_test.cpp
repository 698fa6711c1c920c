// Spot welds: what their section carries against the criterion, plasticity, mass, and sheets that they join.
#include <gtest/gtest.h>

#include <cmath>

#include "elements/beam/weld.hpp"
#include "rigid/bodies/rigid.hpp"
#include "same_bits.hpp"
#include "shell_decks.hpp"
#include "solid_decks.hpp"

namespace courant::test::welds {

namespace {

constexpr Real young = 205000, length = 1.6, diameter = 5;  // steel in N, mm, t
const Real area = pi / 4 * diameter * diameter;

/// One weld along z, its lower end held; `upper`: codes of the upper node.
std::string weld(const std::string& material, const std::string& upper, const std::string& cards,
                 Real endtim = 1e-3) {
  return fmt::format(
             "*KEYWORD\n*CONTROL_TERMINATION\n{}\n*CONTROL_TIMESTEP\n0.0,0.9\n*PART\nweld\n1,1,1\n*SECTION_"
             "BEAM\n"
             "1,9,1.0\n5.0,5.0,0.0,0.0\n*NODE\n1,0.0,0.0,0.0,7,7\n2,0.0,0.0,1.6{}\n*ELEMENT_BEAM\n"
             "       1       1       1       2\n",
             endtim, upper) +
         material + cards + "*DEFINE_CURVE\n1\n0.0,0.0\n1.0e-3,1.0\n1.0,1.0e3\n*END\n";
}
/// *MAT_SPOTWELD with limits NRR to MTT.
std::string strength(const std::string& limits, Real sigy = 1e9, Real eh = 0, const std::string& dt = "0.0",
                     const std::string& tfail = "0.0") {
  return fmt::format("*MAT_SPOTWELD\n1,7.85e-9,205000.0,0.3,{},{},{},{}\n{}\n", sigy, eh, dt, tfail, limits);
}

const WeldReporter& welds_of(const Simulation& s) {
  return *s.world().passes.all<const WeldReporter>().front();
}
WeldForce force_of(const Simulation& s) {
  std::vector<WeldForce> out;
  welds_of(s).report_welds(s.world(), out);
  return out.front();
}
std::int64_t deleted(const Simulation& s) {
  const auto found = s.world().counters.find("deleted_beams");
  return found == s.world().counters.end() ? 0 : found->second;
}
/// Time of failure; 0: it held to the end. [T]
Real failure_of(Simulation& s, Real end) {
  start_ledger(s);
  while (s.clock().t < end && deleted(s) == 0) s.step(do_nothing);
  return deleted(s) > 0 ? force_of(s).failure_time : 0;
}

}  // namespace

// Loads that grow evenly: the weld fails when they are as large as the section carries.
TEST(Welds, FailByEachOfTheirResultants) {
  struct Case {
    const char *limits, *upper, *loads;
  };
  const Case cases[] = {
      {"0.0,3000.0", "", "2,3,1,6000.0\n"},
      {"0.0,0.0,4000.0,4000.0", ",0,7", "2,1,1,8000.0\n"},
      {"0.0,0.0,4000.0,4000.0", ",0,7", "2,1,1,4800.0\n2,2,1,6400.0\n"},
      {"0.0,0.0,0.0,0.0,2000.0", "", "2,7,1,4000.0\n"},
      {"0.0,0.0,0.0,0.0,0.0,3000.0,3000.0", "", "2,5,1,6000.0\n"},
      {"0.0,0.0,0.0,0.0,0.0,3000.0,3000.0", "", "2,5,1,3600.0\n2,6,1,4800.0\n"},
      {"0.0,3000.0,4000.0,4000.0", ",0,7", "2,3,1,3600.0\n2,1,1,6400.0\n"},
      {"0.0,3000.0,0.0,0.0,2000.0", "", "2,3,1,4800.0\n2,7,1,2400.0\n"},
  };
  for (const Case& one : cases) {
    auto s =
        simulation_of(weld(strength(one.limits), one.upper, std::string("*LOAD_NODE_POINT\n") + one.loads));
    ASSERT_NE(s, nullptr);
    EXPECT_NEAR(failure_of(*s, 1e-3), 0.5e-3, 0.01 * 0.5e-3) << one.limits << " " << one.loads;
    EXPECT_LT(test::energy_error_of_a_step(*s), 0.02) << one.limits;
    EXPECT_GT(s->world().energy.dissipated, 0);
  }
}

TEST(Welds, PressureDoesNotBreakThemNorDoesWhatHasNoLimit) {
  for (const char* loads : {"2,3,1,-60000.0\n", "2,1,1,60000.0\n"}) {
    auto s = simulation_of(weld(strength("0.0,3000.0"), ",0,7", std::string("*LOAD_NODE_POINT\n") + loads));
    EXPECT_EQ(failure_of(*s, 1e-3), 0) << loads;
  }
}

// What the weld stored is lost, its forces are gone, and its mass stays.
TEST(Welds, WhatTheyStoredIsDissipated) {
  auto s = simulation_of(weld(strength("0.0,3000.0"), "", "*LOAD_NODE_POINT\n2,3,1,6000.0\n"));
  ASSERT_GT(failure_of(*s, 1e-3), 0);
  const Real stored = 3000.0 * 3000 * length / (2 * young * area);
  EXPECT_NEAR(s->world().energy.dissipated / stored, 1, 0.01);
  EXPECT_EQ(force_of(*s).axial, 0);
  const Real m = 7.85e-9 * area * length;
  EXPECT_NEAR(s->world().nodes.m[1], m / 2, 1e-6 * m);
  for (int k = 0; k < 20; ++k) s->step(do_nothing);
  EXPECT_NEAR(s->world().nodes.f.data(2)[1], 6000 * (s->clock().t - s->clock().dt_old) / 1e-3, 5);
}

// sigma = SIGY + EH (e - sigma/E) in a slow axial force, until e - sigma/E = EFAIL.
// One that breaks within the first looks of the guard ends no healthy run, and the ledger closes: forces of
// the step in which it breaks never push.
TEST(Welds, BreakEarlyWithoutEnergyFromNowhere) {
  auto s = simulation_of(
      "*KEYWORD\n*CONTROL_TERMINATION\n0.0002\n*CONTROL_TIMESTEP\n0,0.9\n*NODE\n1,0,0,0\n2,0.01,0,0\n3,0,1,"
      "0\n"
      "*ELEMENT_BEAM\n       1       1       1       2       3\n*PART\nweld\n1,1,1\n*SECTION_BEAM\n"
      "1,9,1.0,2,1\n0.006,0.006\n*MAT_SPOTWELD\n1,7800,2e11,0.3,1e9,1e9,0,0\n0,2e3\n"
      "*BOUNDARY_SPC_NODE\n1,0,1,1,1,1,1,1\n2,0,0,1,1,1,1,1\n"
      "*BOUNDARY_PRESCRIBED_MOTION_NODE\n2,1,0,9,1.0\n*DEFINE_CURVE\n9\n0,0.05\n1,0.05\n*END\n");
  Guard& guard = s->guard();
  while (s->clock().t < 2e-4)
    s->step([&](World& world, const Clock& clock, const std::string&) {
      if (clock.cycle % Guard::interval == 0) guard.look(world, clock);
    });
  EXPECT_EQ(deleted(*s), 1);
  EXPECT_LT(energy_error_of_a_step(*s), 1e-6);
}

TEST(Welds, HardenAndFailByPlasticStrain) {
  auto s = simulation_of(weld(strength("0.03", 400, 1000), ",4,7",
                              "*BOUNDARY_PRESCRIBED_MOTION_NODE\n2,3,0,2,1.0\n*DEFINE_CURVE\n2\n0.0,"
                              "80.0\n1.0,80.0\n"));
  start_ledger(*s);
  Real strain = 0;
  while (deleted(*s) == 0 && s->clock().t < 1e-3) {
    strain = std::log(force_of(*s).length / length);
    if (strain > 0.005 && strain < 0.03) {
      EXPECT_NEAR(force_of(*s).axial / area, (400 + 1000 * strain) / (1 + 1000 / young), 0.002 * 400);
    }
    s->step(do_nothing);
  }
  EXPECT_NEAR(strain, 0.03 + 430 / young, 0.002 * 0.03);
  EXPECT_LT(test::energy_error_of_a_step(*s), 0.01);
}

// The same of a truss and of a beam of Hughes and Liu, by FS of their material.
TEST(Welds, OtherBeamsFailByTheirMaterial) {
  for (const char* section : {"1,3\n5.0\n", "1,1,1.0,2\n2.0,2.0,2.0,2.0\n"}) {
    std::string text =
        weld("*MAT_PLASTIC_KINEMATIC\n1,7.85e-9,205000.0,0.3,400.0,0.0,1.0\n0.0,0.0,0.03\n", ",4,7",
             "*BOUNDARY_PRESCRIBED_MOTION_NODE\n2,3,0,2,1.0\n*DEFINE_CURVE\n2\n0.0,80.0\n1.0,80.0\n");
    const std::string before = "1,9,1.0\n5.0,5.0,0.0,0.0\n";
    text.replace(text.find(before), before.size(), section);
    auto s = simulation_of(text);
    start_ledger(*s);
    Real strain = 0;
    while (deleted(*s) == 0 && s->clock().t < 1e-3) {
      strain = std::log((s->world().nodes.x.vec(1) - s->world().nodes.x.vec(0)).norm() / length);
      s->step(do_nothing);
    }
    EXPECT_NEAR(strain, 0.03 + 400 / young, 0.002 * 0.03) << section;
    EXPECT_LT(energy_error_of_a_step(*s), 0.01);
  }
}

TEST(Welds, FailAtTheirTime) {
  auto s =
      simulation_of(weld(strength("0.0", 1e9, 0, "0.0", "3.0e-4"), "", "*LOAD_NODE_POINT\n2,3,1,100.0\n"));
  EXPECT_NEAR(failure_of(*s, 1e-3), 3e-4, 4e-7);
}

// The mean over NF steps of what grows evenly lags by (NF - 1)/2 steps.
TEST(Welds, FilteredForcesLagBehind) {
  Real at[2] = {};
  for (const int k : {0, 1}) {
    auto s = simulation_of(weld(strength(fmt::format("0.0,3000.0,0.0,0.0,0.0,0.0,0.0,{}", k == 0 ? 0 : 401)),
                                "", "*LOAD_NODE_POINT\n2,3,1,6000.0\n"));
    at[k] = failure_of(*s, 1e-3) / s->clock().dt_old;
  }
  EXPECT_NEAR(at[1] - at[0], 200, 4);
}

// DT three times the step of the weld: nine times the mass, and rotary inertia with it.
TEST(Welds, GetMassForTheirStep) {
  const Real own = length / std::sqrt(young / 7.85e-9);
  auto light = simulation_of(weld(strength("0.0"), "", "")),
       heavy = simulation_of(weld(strength("0.0", 1e9, 0, fmt::format("{:.9e}", 3 * own)), "", ""));
  EXPECT_NEAR(heavy->world().nodes.m[1] / light->world().nodes.m[1], 9, 1e-5);
  EXPECT_NEAR(heavy->world().maxima["added_mass"] / light->world().nodes.m[1], 16, 1e-4);
  start_ledger(*heavy), heavy->step(do_nothing);
  start_ledger(*light), light->step(do_nothing);
  EXPECT_NEAR(heavy->clock().dt_old / light->clock().dt_old, 3, 1e-6);
}

namespace {

/// Two strips on top of each other, 4 wide, elements of 2.5: the lower one is held at x = 0 and ends behind
/// the weld at x = a, the upper one begins there and is loaded at its end, b behind the weld.
struct Strips {
  ShellDeck deck;
  static constexpr Real a = 28.75, b = 28.75, width = 4, gap = 2;
  Real d;
  explicit Strips(Real diameter_of_weld, int elform = 2) : d(diameter_of_weld) {
    deck.plate(30, width, 12, 1, 1);
    deck.plate(30, width, 12, 1, 1, [](const Vec& x) { return Vec(x[0] + 27.5, x[1], gap); });
    deck.nodes.emplace_back(a, width / 2, 0), deck.nodes.emplace_back(a, width / 2, gap);
    const std::size_t n = deck.nodes.size();
    deck.part(1, 1, "*MAT_ELASTIC\n         1       1.0       1.0       0.0\n");
    if (elform != 2) {
      const std::string from = "         1         2  0.833333";
      deck.cards.replace(deck.cards.find(from), from.size(),
                         fmt::format("         1{:10}  0.833333", elform));
    }
    deck.cards += fmt::format(
        "*PART\nweld\n2,2,2\n*SECTION_BEAM\n2,9,1.0\n{0},{0}\n*MAT_SPOTWELD\n2,1.0,1.0,0.0,1.0e9\n\n"
        "*ELEMENT_BEAM\n{1:8}{2:8}{3:8}{4:8}\n*CONTACT_SPOTWELD\n2,1,3,3\n\n\n",
        d, 1000, 2, n - 1, n);
    deck.hold(1, "xyzXYZ", [](const Vec& x) { return x[0] < 1e-9; });
  }
  std::size_t weld_node() const { return deck.nodes.size() - 1; }
};

}  // namespace

// The tie hands forces and moments over: the end of the upper strip sinks as beams say, whether the weld
// bends or is as good as rigid. A weld whose rotations were free would let it fall.
TEST(Welds, JoinStripsThatBendAsBeams) {
  for (const int elform : {2, 16})
    for (const Real d : {0.5, 3.0}) {
      Strips strips(d, elform);
      constexpr Real P = 1e-6, a = Strips::a, b = Strips::b, h = Strips::gap;
      strips.deck.node_set(2, [](const Vec& x) { return x[0] > 57.4; });
      const Real I = Strips::width / 12, Iw = pi / 64 * d * d * d * d, Aw = pi / 4 * d * d;
      const Real turn = P * (a * a / 2 + a * b) / I, turn_of_weld = P * b * h / Iw;
      const Real sinks = P * (a * a * a / 3 + a * a * b / 2) / I + P * h / Aw + (turn + turn_of_weld) * b +
                         P * b * b * b / (3 * I);
      // half of the mass of the strips moves about as its end; twice that frequency is critical damping
      const Real omega = std::sqrt(P / sinks / (0.25 * 2 * 30 * Strips::width));
      strips.deck.cards += fmt::format(
          "*LOAD_NODE_SET\n2,3,1,{}\n*DEFINE_CURVE\n1\n0.0,1.0\n1.0e9,1.0\n*DAMPING_GLOBAL\n0,{}\n", P / 2,
          2 * omega);
      auto s = simulation_of(strips.deck.text(1e9));
      ASSERT_NE(s, nullptr);
      start_ledger(*s);
      while (s->clock().t < 20 / omega) s->step(do_nothing);
      const Index end = 51;  // of the upper strip
      EXPECT_NEAR((s->world().nodes.x.data(2)[end] - h) / sinks, 1, 0.02) << elform << " " << d;
      EXPECT_NEAR(force_of(*s).axial / P, 1, 0.01);
      EXPECT_NEAR(force_of(*s).moment / (P * b), 1, 0.01);
      EXPECT_LT(test::energy_error(*s), 0.01);
    }
}

// The upper strip is a rigid body, which gets the mass of its end of the weld: momenta of all stay.
TEST(Welds, HoldRigidBodiesAndTheirMassWithThem) {
  Strips strips(3);
  std::string& cards = strips.deck.cards;
  const std::size_t first = strips.deck.elements.find(fmt::format("{:8}{:8}", 13, 1));
  ASSERT_NE(first, std::string::npos);
  for (std::size_t k = 0; k < 12; ++k) strips.deck.elements.replace(first + 49 * k + 8, 8, "       3");
  cards.replace(cards.find("*CONTACT_SPOTWELD\n2,1,3,3"), 25, "*CONTACT_SPOTWELD\n2,7,3,2");
  cards += "*SET_PART_LIST\n7\n1,3\n*PART\nrigid\n3,1,3\n*MAT_RIGID\n3,1.0,1.0,0.0\n\n\n";
  const std::size_t held = cards.find("*BOUNDARY_SPC_SET");
  cards.replace(held, cards.find('\n', cards.find('\n', held) + 1) - held + 1, "");
  strips.deck.velocity([](const Vec& x) { return Vec(0, x[0] < 20 ? 1e-3 : 0, x[2] < 1 ? 1e-3 : 0); });
  auto s = simulation_of(strips.deck.text(1e9));
  ASSERT_NE(s, nullptr);
  const RigidBody& b = s->bodies()->bodies().front();
  const Real own = 30 * Strips::width, end = pi / 4 * 9 * Strips::gap / 2;
  EXPECT_NEAR(b.m, own + end, 1e-9 * own);
  const auto momentum = [&] {
    Vec out = b.m * b.v;
    const Nodes& n = s->world().nodes;
    for (Index i = 0; i < n.size(); ++i)
      if (n.follow[i] == 0) out += n.m[i] * n.v.vec(i);
    return out;
  };
  start_ledger(*s);
  const Vec before = momentum();
  for (int k = 0; k < 3000; ++k) s->step(do_nothing);
  EXPECT_NEAR((momentum() - before).norm(), 0, 1e-10 * before.norm());
  EXPECT_GT(b.v[2], 1e-4);  // it is dragged along
  EXPECT_GT(b.omega.norm(), 1e-7);
  EXPECT_LT(test::energy_error(*s), 0.02);
}

// Two sheets are torn apart: welds fail, threads and a restart between change no bit.
TEST(Welds, SameBitsOnAnyNumberOfThreadsAndAfterARestart) {
  Strips strips(3);
  std::string material = "*MAT_SPOTWELD\n2,1.0,1.0,0.0,1.0e9\n\n";
  const std::size_t at = strips.deck.cards.find(material);
  ASSERT_NE(at, std::string::npos);
  strips.deck.cards.replace(at, material.size(),
                            "*MAT_SPOTWELD\n2,1.0,1.0,0.0,1.0e-2,0.1\n0.0,1.0e-3,1.0e-3,1.0e-3,0.0,0."
                            "0,0.0,5\n");
  strips.deck.velocity([](const Vec& x) { return x[2] > 1 ? Vec(1e-2, 0, 1e-2) : Vec(0, 0, 0); });
  const std::string text = strips.deck.text(1e9);
  auto s = simulation_of(text);
  for (int k = 0; k < 120; ++k) s->step(do_nothing);
  EXPECT_EQ(deleted(*s), 1);
  test::expect_same_bits(text, 120, 3);
  test::expect_same_bits(text, 120, 60);
}

}  // namespace courant::test::welds
