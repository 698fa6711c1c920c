// *CONTROL_DYNAMIC_RELAXATION: what is preloaded stands as in statics, and stays so in the run behind it.
#include <gtest/gtest.h>

#include <atomic>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>
#include <vector>

#include "app/run/relaxation.hpp"
#include "beam_decks.hpp"
#include "same_bits.hpp"
#include "shell_decks.hpp"
#include "solid_decks.hpp"

using namespace courant;

namespace {

std::unique_ptr<Simulation> built(const std::string& text, RunPhase phase) {
  Diagnostics diagnostics;
  ReadOptions options;
  options.open = [text](const std::string&) { return text; };
  auto s = Simulation::build("test.k", options, diagnostics, nullptr, phase);
  EXPECT_TRUE(s != nullptr) << diagnostics.text();
  return s;
}
/// The simulation of a deck behind its relaxation.
struct Relaxed {
  std::unique_ptr<Simulation> run;
  RelaxationEnd end;
};
Relaxed relaxed(const std::string& text) {
  Relaxed out{built(text, RunPhase::transient), {}};
  EXPECT_TRUE(out.run->relaxation().asked);
  auto before = built(text, RunPhase::relaxation);
  out.end = relax(
      *before, [] { return false; }, [](const std::string&) {});
  out.run->start_from(*before);
  return out;
}
/// How far a coordinate of a node swings in `seconds`: least and largest.
std::pair<Real, Real> swing(Simulation& s, Index node, int axis, Real seconds) {
  std::pair<Real, Real> out{1e30, -1e30};
  while (s.clock().t < seconds) {
    const Real x = s.world().nodes.x.data(axis)[node];
    out.first = std::min(out.first, x), out.second = std::max(out.second, x);
    s.step(test::do_nothing);
  }
  return out;
}
std::string relaxation(int every, Real tolerance, Real factor, Real term = 0, int flag = 1) {
  return fmt::format(
      "*CONTROL_DYNAMIC_RELAXATION\n{:10}{:10.3e}{:10.6f}{:10.3e}         0         0         0{:10}\n",
      every, tolerance, factor, term, flag);
}
std::string constant(int id, int sidr, Real value = 1) {
  return fmt::format("*DEFINE_CURVE\n{:10}{:10}\n{:20.9e}{:20.9e}\n{:20.9e}{:20.9e}\n", id, sidr, 0.0, value,
                     1e3, value);
}

/// A cantilever of EI = 175, L = 1 under a force of 5 at its end: P L^3/(3 EI) = 9.5238 mm, 8.355 Hz.
std::string cantilever(const std::string& section, int n, const std::string& control, int sidr = 2) {
  using namespace test::beams;
  BeamDeck deck;
  deck.part(1, section, steel_of_beams);
  deck.line(n, 1, [](int k) { return k == 0 ? ",7,7" : ""; });
  deck.cards += fmt::format("*LOAD_NODE_POINT\n{:10}         3         1       5.0\n", n + 1) +
                constant(1, sidr) + control;
  return deck.text(0.3);
}

}  // namespace

// The deflection is that of statics, to 1 %, and does not swing behind it; without a relaxation it would
// between 0 and twice that.
TEST(Relaxation, ACantileverHangsStillUnderItsLoad) {
  using namespace test::beams;
  for (const std::string& section : {square_1, square_2})
    for (const int n : {5, 10, 20}) {
      // 2 w dt with dt = 0.9 L/(n c): 0.0018 for n = 10
      const Relaxed r = relaxed(cantilever(section, n, relaxation(500, 1e-6, 1 - 0.018 / n)));
      EXPECT_TRUE(r.end.converged);
      const Real statics = 5 / (3 * 175.0) * (section == square_1 ? 1 - 0.25 / (n * n) : 1);
      EXPECT_NEAR(r.run->world().nodes.x.data(2)[n] / statics, 1, 5e-3) << n << section;
      EXPECT_EQ(r.run->clock().t, 0);
      EXPECT_EQ(r.run->world().nodes.v.vec(n).norm(), 0);
      const auto [least, most] = swing(*r.run, n, 2, 0.15);
      EXPECT_LT((most - least) / statics, 0.01) << n << section;
    }
}

// Far too much damping: nodes creep with next to no kinetic energy, and the phase goes on until they are
// there. It tells the DRFCTR that suits, 1 - 2 w dt.
TEST(Relaxation, DoesNotEndWhileNodesCreep) {
  using namespace test::beams;
  const std::string text = cantilever(square_2, 10, relaxation(250, 1e-3, 0.95));
  const Relaxed r = relaxed(text);
  EXPECT_TRUE(r.end.converged);
  EXPECT_NEAR(r.run->world().nodes.x.data(2)[10] / (5 / (3 * 175.0)), 1, 5e-3);
  auto first = built(text, RunPhase::relaxation);
  first->step(test::do_nothing);
  EXPECT_NEAR((1 - r.end.factor) / (2 * 2 * pi * 8.355 * first->clock().dt), 1, 0.2);
}

// A loose node that a force drifts without end does not keep the phase from its end, and the verdict tells of
// it.
TEST(Relaxation, EndsWhereSomethingLooseDrifts) {
  test::SolidDeck deck;
  deck.block({1, 1, 1}, 1, 1, 1, 1);
  deck.block({1, 1, 1}, 1, 1, 1, 2, [](const Vec& x) { return Vec(x + Vec(3, 0, 0)); });
  deck.cards =
      "*PART\nheld\n1,1,1\n*PART\nloose\n2,1,2\n*SECTION_SOLID\n1,1\n*MAT_ELASTIC\n1,1000,1e6,0.3\n"
      "*MAT_ELASTIC\n2,0.001,1.0,0.3\n*DEFINE_CURVE\n1,2\n0,1\n10,1\n*BOUNDARY_SPC_SET\n1,,1,1,1\n"
      "*LOAD_NODE_SET\n2,3,1,1e4\n*LOAD_NODE_SET\n3,1,1,1e-8\n" +
      relaxation(50, 1e-3, 0.995);
  deck.node_set(1, [](const Vec& x) { return x[0] < 2 && x[2] < 0.5; });
  deck.node_set(2, [](const Vec& x) { return x[0] < 2 && x[2] > 0.5; });
  deck.node_set(3, [](const Vec& x) { return x[0] > 2; });
  const Relaxed r = relaxed(deck.text(1));
  EXPECT_TRUE(r.end.converged);
}

// SIDR 1: the load is gone when the run begins, and the beam springs back as far to the other side.
TEST(Relaxation, CurvesActInTheirPhase) {
  using namespace test::beams;
  const Relaxed r = relaxed(cantilever(square_2, 10, relaxation(500, 1e-6, 0.998), 1));
  const Real x = r.run->world().nodes.x.data(2)[10];
  EXPECT_NEAR(x, 5 / (3 * 175.0), 1e-4);
  const auto [least, most] = swing(*r.run, 10, 2, 0.15);
  EXPECT_NEAR(least / x, -1, 0.05);
  EXPECT_LT(most / x, 1.05);
  // SIDR 0: nothing happens before, all within
  const Relaxed none = relaxed(cantilever(square_2, 10, relaxation(500, 1e-6, 0.998), 0));
  EXPECT_EQ(none.run->world().nodes.x.data(2)[10], 0);
  EXPECT_NEAR(swing(*none.run, 10, 2, 0.15).second / x, 2, 0.05);
  // SIDR 2 asks by itself
  EXPECT_TRUE(built(cantilever(square_2, 10, "", 2), RunPhase::transient)->relaxation().asked);
  EXPECT_FALSE(built(cantilever(square_2, 10, "", 0), RunPhase::transient)->relaxation().asked);
  // so does a curve of the relaxation alone, LCIDDR
  for (const int sidr : {0, 1, 2}) {
    const std::string weight = fmt::format(
        "*LOAD_BODY_Z\n90,1.0,91\n*DEFINE_CURVE\n90\n0,1\n10,1\n"
        "*DEFINE_CURVE\n91,{}\n0,1\n10,1\n",
        sidr);
    EXPECT_EQ(built(cantilever(square_2, 10, weight, 0), RunPhase::transient)->relaxation().asked, sidr != 0);
  }
}

TEST(Relaxation, ThatDoesNotConvergeIsTold) {
  using namespace test::beams;
  const std::string text = cantilever(square_2, 10, relaxation(100, 1e-8, 0.9999, 0.05));
  auto before = built(text, RunPhase::relaxation);
  const RelaxationEnd end = relax(
      *before, [] { return false; }, [](const std::string&) {});
  EXPECT_FALSE(end.converged);
  EXPECT_NEAR(end.time, 0.05, 1e-4);
  auto run = built(text, RunPhase::transient), again = built(text, RunPhase::relaxation);
  const std::string dir = testing::TempDir() + "relaxation";
  std::filesystem::create_directories(dir);
  RunOptions options;
  options.dir = dir, options.relaxing = again.get(), options.until = 1e-3;
  const Summary summary = courant::run(*run, "test.k", options);
  EXPECT_EQ(summary.verdict, "doubtful");
  ASSERT_FALSE(summary.verdict_reasons.empty());
  EXPECT_NE(summary.verdict_reasons[0].find("dynamic relaxation"), std::string::npos);
  std::ifstream file(dir + "/relax");
  std::string line, last;
  int lines = 0;
  while (std::getline(file, line)) last = line, ++lines;
  EXPECT_GT(lines, 10);
  auto alone = built(text, RunPhase::transient);
  options.relaxing = nullptr;
  EXPECT_EQ(courant::run(*alone, "test.k", options).termination, "error");
}

TEST(Relaxation, OfWhatNothingLoadsHasConvergedHoweverShortItIs) {
  using namespace test::beams;
  auto s = built(cantilever(square_2, 10, relaxation(100000, 1e-8, 0.9999, 0.001), 0), RunPhase::relaxation);
  const RelaxationEnd end = relax(
      *s, [] { return false; }, [](const std::string&) {});
  EXPECT_TRUE(end.converged);
  EXPECT_EQ(end.ratio, 0);
}

// A bar that turns about an end, which body loads represent: u(L) = rho w^2 L^3/(3 E).
TEST(Relaxation, ABarThatTurnsIsStretched) {
  for (const int n : {5, 10, 20})
    for (const int elform : {1, 2}) {
      test::SolidDeck deck;
      deck.block({1, 0.1, 0.1}, n, 1, 1, 1);
      deck.cards += fmt::format(
          "*PART\nbar\n         1         1         1\n*SECTION_SOLID\n         1{:10}\n", elform);
      deck.cards += "*MAT_ELASTIC\n         1       1.0    4.0E+4       0.0\n";
      deck.node_set(1, [](const Vec& x) { return x[0] < 1e-9; });
      deck.cards += "*BOUNDARY_SPC_SET\n         1         0         1         1         1\n*LOAD_BODY_RZ\n";
      deck.cards += fmt::format("{:10}{:10.3f}         2       0.0      0.05      0.05\n", 1, 2.0);
      // the curve of the relaxation is another one than that of the run
      deck.cards += constant(1, 0, 0.5) + constant(2, 0, 1) + relaxation(100, 1e-8, 0.95);
      const Relaxed r = relaxed(deck.text(1));
      EXPECT_TRUE(r.end.converged);
      const Real u = r.run->world().nodes.x.data(0)[n] - 1;
      const Real of_lumps = 1 + 0.5 / (n * n);  // half an element's mass is at the end
      EXPECT_NEAR(u / (4.0 / (3 * 4e4)), of_lumps, 1e-3) << n << " " << elform;
    }
}

// The twisted beam of MacNeal and Harder (1985): 12 x 1.1 x 0.32, a quarter turn, E 29e6, nu 0.22, unit load
// at the end: 5.424e-3 in the plane of the load, 1.754e-3 out of it.
// By shells of 2 x 2 points, and by those of one with warp (BWC 1).
TEST(Relaxation, TwistedBeam) {
  for (const auto& [nx, ny, within, elform] :
       {std::tuple{24, 4, 0.04, 16}, {48, 8, 0.02, 16}, {24, 4, 0.04, 2}, {48, 8, 0.02, 2}})
    for (const bool in_plane : {true, false}) {
      test::ShellDeck deck;
      deck.plate(12, 1.1, nx, ny, 1, [](const Vec& x) {
        const Real a = 0.5 * pi * x[0] / 12, y = x[1] - 0.55;
        return Vec(x[0], y * std::cos(a), y * std::sin(a));
      });
      deck.part(1, 0.32, "*MAT_ELASTIC\n         1   2.59E-4    2.9E+7      0.22\n", 2, 5.0 / 6);
      deck.cards.replace(deck.cards.find("         2  0.833333"), 10, fmt::format("{:10}", elform));
      if (elform == 2) deck.cards += "*CONTROL_SHELL\n20.0,1,-1,0,2,1\n*CONTROL_HOURGLASS\n4,0.05\n";
      deck.hold(1, "xyzXYZ", [](const Vec& x) { return x[0] < 1e-9; });
      deck.node_set(2, [](const Vec& x) { return x[0] > 12 - 1e-9; });
      // edges of the end carry half of what others do
      const int first = nx + 1;
      for (int j = 0; j <= ny; ++j)
        deck.cards += fmt::format("*LOAD_NODE_POINT\n{:10}{:10}         1{:10.6f}\n", first + j * (nx + 1),
                                  in_plane ? 3 : 2, (j == 0 || j == ny ? 0.5 : 1.0) / ny);
      deck.cards += constant(1, 2) + relaxation(1000, 1e-6, in_plane ? 1 - 0.05 / nx : 1 - 0.025 / nx);
      const Relaxed r = relaxed(deck.text(1));
      EXPECT_TRUE(r.end.converged);
      const Index middle = nx + (ny / 2) * (nx + 1);
      const Real x = r.run->world().nodes.x.data(in_plane ? 2 : 1)[middle];
      const Real u = (x - 0) / (in_plane ? 5.424e-3 : 1.754e-3);
      EXPECT_NEAR(u, 1, within) << elform << " " << nx << " " << in_plane << " steps " << r.end.steps;
    }
}

// Motions that are silent, or along another axis, leave a node free to come to rest.
TEST(Relaxation, SlowsNodesThatMotionsDoNotDriveNow) {
  using namespace test::beams;
  const Real plain =
      relaxed(cantilever(square_2, 10, relaxation(500, 1e-6, 0.998))).run->world().nodes.x.data(2)[10];
  for (const int sidr : {0, 2}) {
    const std::string motion = fmt::format(
        "*BOUNDARY_PRESCRIBED_MOTION_NODE\n        11         2         0        77       "
        "1.0\n*DEFINE_CURVE\n"
        "        77{:10}\n0.0,0.0\n1.0,0.0\n",
        sidr);
    const Relaxed r = relaxed(cantilever(square_2, 10, relaxation(500, 1e-6, 0.998, 5) + motion));
    EXPECT_TRUE(r.end.converged) << sidr;
    EXPECT_NEAR(r.run->world().nodes.x.data(2)[10] / plain, 1, 1e-3) << sidr;
  }
}

// A node, a rotation, and the end of a bar that is pulled by a velocity: where the curve says, not where the
// factor of the relaxation lets them come.
TEST(Relaxation, DrivenNodesGoAsTheirCurvesSay) {
  using namespace test::beams;
  const std::string ramp = "*DEFINE_CURVE\n77,1\n0.0,0.0\n0.01,0.003\n1000.0,0.003\n";
  const std::string velocity = "*DEFINE_CURVE\n77,1\n0.0,0.1\n0.02,0.1\n0.0201,0.0\n1000.0,0.0\n";
  for (const bool by_velocity : {false, true}) {
    const std::string motion = fmt::format("*BOUNDARY_PRESCRIBED_MOTION_NODE\n11,3,{},77,1.0\n{}",
                                           by_velocity ? 0 : 2, by_velocity ? velocity : ramp);
    const std::string text = cantilever(square_2, 10, relaxation(500, 1e-6, 0.99) + motion, 0);
    auto s = built(text, RunPhase::relaxation);
    Real farthest = 0;
    while (s->clock().t < 0.03) {
      s->step(test::do_nothing);
      const Real t = s->clock().t, x = s->world().nodes.x.data(2)[10],
                 is_due = by_velocity ? (t < 0.02 ? 0.1 * t : x) : 0.003 * std::min<Real>(1, t / 0.01);
      farthest = std::max(farthest, std::abs(x - is_due));
    }
    EXPECT_LT(farthest, 1e-7) << by_velocity;
    if (by_velocity) EXPECT_NEAR(s->world().nodes.x.data(2)[10], 0.1 * 0.02005, 1e-5);
  }
}

// Stopped by a signal: the state it had come to is in histories and summary, doubtful, and no restart file
// lets the run go on without the rest.
TEST(Relaxation, StoppedOnItsWayLeavesHistories) {
  using namespace test::beams;
  const std::string text = cantilever(square_2, 10,
                                      relaxation(100, 1e-12, 0.9999) +
                                          "*DATABASE_GLSTAT\n0.01\n*DATABASE_NODOUT\n"
                                          "0.01\n*DATABASE_HISTORY_NODE\n11\n");
  auto run = built(text, RunPhase::transient), before = built(text, RunPhase::relaxation);
  const std::string dir = testing::TempDir() + "stopped_relaxation";
  std::filesystem::remove_all(dir);
  std::filesystem::create_directories(dir);
  std::atomic<bool> stop = true;
  RunOptions options;
  options.dir = dir, options.relaxing = before.get(), options.stop = &stop;
  const Summary summary = courant::run(*run, "test.k", options);
  EXPECT_EQ(summary.termination, "interrupted");
  EXPECT_EQ(summary.reason, "stopped by a signal at time 0, in the relaxation before it");
  EXPECT_EQ(summary.verdict, "doubtful");
  EXPECT_TRUE(summary.restart_file.empty());
  for (const char* file : {"/glstat", "/nodout", "/relax", "/history.h5", "/summary.yaml"})
    EXPECT_GT(std::filesystem::file_size(dir + file), 50U) << file;
  std::ifstream nodout(dir + "/nodout");
  const std::string all((std::istreambuf_iterator<char>(nodout)), {});
  EXPECT_NE(all.find("\n       11 "), std::string::npos) << all;
  EXPECT_TRUE(!std::filesystem::exists(dir + "/restart") || std::filesystem::is_empty(dir + "/restart"));
}

TEST(Relaxation, LeavesInitialVelocitiesToTheRun) {
  using namespace test::beams;
  const std::string text =
      cantilever(square_2, 10,
                 relaxation(500, 1e-6, 0.998) + "*INITIAL_VELOCITY_NODE\n        11       0.0       0.1\n");
  const Relaxed r = relaxed(text);
  EXPECT_EQ(r.run->world().nodes.v.vec(10), Vec(0, 0.1, 0));
  EXPECT_NEAR(r.run->world().nodes.x.data(1)[10], 0, 1e-12);
  EXPECT_NEAR(r.run->world().nodes.x.data(2)[10], 5 / (3 * 175.0), 1e-4);
}

// Two relaxations of a deck give the same bits, and so do the runs behind them, on any number of threads; a
// restart goes on with the state of the run.
TEST(Relaxation, HasTheSameBitsOnAnyNumberOfThreadsAndAfterARestart) {
  using namespace test::beams;
  const std::string text = cantilever(square_1, 80, relaxation(50, 1e-3, 0.99, 2e-4));
  std::vector<Real> reference;
  for (const int threads : {1, 2, 4}) {
    set_threads(threads);
    const Relaxed r = relaxed(text);
    for (int k = 0; k < 20; ++k) r.run->step(test::do_nothing);
    const std::vector<Real> state = test::state_of(r.run->world());
    if (reference.empty()) reference = state;
    EXPECT_TRUE(reference == state) << threads << " threads";
  }
  set_threads(0);
  const Relaxed r = relaxed(text);
  for (int k = 0; k < 10; ++k) r.run->step(test::do_nothing);
  SavedState saved;
  Archive save = Archive::saver(saved);
  r.run->keep(save);
  auto second = built(text, RunPhase::transient);
  Archive load = Archive::loader(saved);
  second->keep(load);
  for (int k = 0; k < 10; ++k) second->step(test::do_nothing);
  EXPECT_TRUE(reference == test::state_of(second->world()));
}

// A block hangs at another one by springs that end at 0.05 s: the relaxation goes on for longer, in a time of
// its own, and the weight hangs there until then.
TEST(Relaxation, TiesThatEndInTheRunHoldBeforeIt) {
  test::SolidDeck deck;
  for (const int part : {1, 2}) {
    deck.block(Vec(1, 1, 1), 2, 2, 2, part, [part](const Vec& x) { return Vec(x - Vec(0, 0, part)); });
    deck.cards += fmt::format("*PART\nblock\n{0},1,1\n", part);
  }
  deck.cards += "*SECTION_SOLID\n1,1\n*MAT_ELASTIC\n1,1000.0,1.0e6,0.0\n";
  deck.node_set(1, [](const Vec& x) { return x[2] > -1e-9; });
  deck.cards += "*BOUNDARY_SPC_SET\n1,0,1,1,1\n*LOAD_BODY_Z\n1,10.0\n" + constant(1, 2) +
                "*CONTACT_TIED_SURFACE_TO_SURFACE_OFFSET_ID\n7,glue\n2,1,3,3\n,,,,,,0.0,0.05\n\n" +
                relaxation(250, 1e-3, 0.995);
  const Relaxed r = relaxed(deck.text(0.1));
  EXPECT_TRUE(r.end.converged);
  const auto hangs = [&] {
    return r.run->world().passes.all<InterfaceReporter>().at(0)->report().on_surfa[2];
  };
  while (r.run->clock().t < 0.04) {
    r.run->step(test::do_nothing);
    EXPECT_NEAR(std::abs(hangs()), 1e4, 300);
  }
  while (r.run->clock().t < 0.06) r.run->step(test::do_nothing);
  EXPECT_EQ(hangs(), 0);
}
