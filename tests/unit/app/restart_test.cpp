// A run that is saved and loaded goes on bit by bit like one that was never stopped.
#include <cstring>
#include <filesystem>
#include <set>

#include "app/run/restart.hpp"
#include "base/restart_error.hpp"
#include "parallel/parallel.hpp"
#include "small_scene.hpp"

namespace courant {
namespace {

using test::steps;

using test::SmallScene;

/// Everything that can be compared: what is saved, and all that can be read of active particles.
SavedState all_of(Simulation& s) {
  SavedState state;
  Archive archive = Archive::saver(state);
  s.keep(archive);
  const Archive::Group group(archive, "fields");
  Particles& p = s.world().particles;
  for (const auto& field : p.fields.all())
    if (auto* reals = dynamic_cast<Field<Real>*>(field.get())) {
      std::vector<Real*> rows;
      for (int k = 0; k < reals->info().components; ++k) rows.push_back(reals->data(k));
      archive.rows(reals->info().name, rows, static_cast<std::size_t>(p.active));
    }
  std::vector<Index> lists;
  for (Index g = 0; 8 * g < p.active; ++g)
    for (const Index j : s.neighbours().listed(g)) lists.push_back(j);
  archive("lists", lists);
  return state;
}

/// All that can be read of active particles. How many wake at a time may depend on how many wait.
SavedState active_of(Simulation& s) {
  SavedState all = all_of(s), out;
  for (const auto& [path, array] : all)
    if (path.rfind("fields/", 0) == 0 || path == "lists") out[path] = array;
  return out;
}

/// Paths whose bits differ, "" where there are none.
std::string difference(const SavedState& a, const SavedState& b) {
  std::string names;
  std::set<std::string> paths;
  for (const auto* state : {&a, &b})
    for (const auto& [path, array] : *state) paths.insert(path);
  for (const std::string& path : paths) {
    const auto x = a.find(path), y = b.find(path);
    const bool both = x != a.end() && y != b.end();
    if (!both || x->second.bytes != y->second.bytes) names += " " + path;
  }
  return names;
}

SavedState saved(Simulation& s) {
  SavedState state;
  Archive archive = Archive::saver(state);
  s.keep(archive);
  return state;
}

void load(Simulation& s, SavedState state) {
  Archive archive = Archive::loader(state);
  s.keep(archive);
}

using Make = std::function<std::unique_ptr<Simulation>()>;

/// Dumps of a run at several moments, each continued in a simulation of its own for at least two rebuilds;
/// the run itself goes on as if nobody had looked.
void expect_same(const Make& make, const std::vector<int>& dumps, int last) {
  const auto whole = make(), watched = make();
  ASSERT_TRUE(whole && watched);
  steps(*whole, last);
  const SavedState end = all_of(*whole);
  int at = 0;
  for (const int n : dumps) {
    steps(*watched, n - at);
    at = n;
    const SavedState state = saved(*watched);
    const auto other = make();
    load(*other, state);
    EXPECT_EQ(difference(saved(*other), state), "") << "just loaded, step " << n;
    steps(*other, last - n);
    EXPECT_EQ(difference(all_of(*other), end), "") << "dumped at step " << n;
  }
  steps(*watched, last - at);
  EXPECT_EQ(difference(all_of(*watched), end), "") << "the run that was dumped";
}

void expect_same(const SmallScene& scene, const std::vector<int>& dumps, int last) {
  expect_same(Make([&] { return test::build(scene); }), dumps, last);
}

TEST(Restart, FallingBlockOnAFloor) {
  expect_same({.start = "0.3,-0.5,0.", .extra = test::gravity_cards + test::floor_cards()},
              {0, 1, 7, 60, 113}, 170);
}

// At the speed of sound: before walls are near, while they hold particles, and after.
TEST(Restart, ParticlesThatAWallHolds) {
  expect_same({.start = "3.,-30.,0.", .extra = test::floor_cards(-0.225)}, {1, 6, 15, 40}, 90);
}

// The measured level and what absorption has moved so far.
TEST(Restart, PaddleThatAbsorbs) {
  const std::string paddle =
      "*NODE\n8001,-0.025,0.,-0.5\n8002,-0.025,0.8,-0.5\n8003,-0.025,0.8,0.5\n8004,-0.025,0.,0.5\n"
      "*ELEMENT_SHELL\n8,8,8001,8002,8003,8004\n*PART\npaddle\n8,8,8\n*SECTION_SHELL\n8,2\n0.05\n"
      "*MAT_RIGID\n8,7850.,2.1E11,0.3\n1,3,4\n*DEFINE_CURVE\n11\n0.,0.\n0.1,0.02\n1.,0.01\n"
      "*COURANT_WAVE_MAKER\n8,1,11,1.,11,0.65\n-0.025,0.,0.,1.,0.,0.\n1.,0.15,0.01,0.5\n"
      "*CONTACT_AUTOMATIC_NODES_TO_SURFACE\n1,8,3,3\n0.\n1.\n";
  expect_same({.extra = test::gravity_cards + test::floor_cards() + paddle}, {0, 1, 30, 75}, 120);
}

TEST(Restart, EveryKernel) {
  for (const char* section : {"1,1.2,1.,1.,0.,0.,0.,1", "1,1.2,0.5,2.,0.,0.,0.,2", "1,1.2,1.,1.,0.,0.,0.,3"})
    expect_same({.section = section, .extra = test::gravity_cards + test::floor_cards()}, {40}, 90);
  for (const std::string name : {"wendland_c2", "wendland_c4"})
    expect_same({.extra = test::gravity_cards + test::floor_cards() + "*COURANT_KERNEL\n" + name + "\n"},
                {40}, 90);
}

TEST(Restart, FrictionAndDamping) {
  SmallScene s;
  s.start = "1.,-1.,0.";
  s.extra = test::gravity_cards + test::floor_cards();
  const std::string contact = "*CONTACT_AUTOMATIC_NODES_TO_SURFACE\n1,2,3,3\n0.\n";
  const auto at = s.extra.find(contact);
  ASSERT_NE(at, std::string::npos);
  s.extra.replace(at, contact.size(), "*CONTACT_AUTOMATIC_NODES_TO_SURFACE\n1,2,3,3\n0.3,0.2,1.,0.,20.\n");
  expect_same(s, {40, 90}, 160);
}

TEST(Restart, MiddleOfAnInflow) {
  SmallScene s;
  s.start = "2.,0.,0.";
  s.box = "1";
  s.extra = "*DEFINE_BOX\n1,0.,20.,-1.,5.,-1.,1.\n*NODE\n";
  std::string particles = "*ELEMENT_SPH\n";
  for (int k = 0; k < 60; ++k) {  // so far off that they are dormant at first, some of them to the end
    s.extra += fmt::format("{},{:.3f},{:.3f},0.\n", 5001 + k, -0.05 - 0.1 * (k / 2), 0.05 + 0.1 * (k % 2));
    particles += fmt::format("{},1,10.\n", 5001 + k);
  }
  s.extra += particles;
  const auto run = test::build(s);
  steps(*run, 60);
  const Index dormant = run->world().particles.size() - run->world().particles.moving;
  steps(*run, 140);
  EXPECT_LT(run->world().particles.size() - run->world().particles.moving, dormant);
  EXPECT_GT(run->world().particles.size(), run->world().particles.moving);
  expect_same(s, {3, 60}, 200);
}

/// Water and an inlet of three nodes at its left side, no box.
SmallScene with_inlet(const std::string& endtim) {
  return {.start = "0.5,0.,0.",
          .termination = endtim,
          .extra =
              "*NODE\n901,0.,0.05,0.\n902,0.,0.15,0.\n903,0.,0.25,0.\n*SET_NODE_LIST\n7\n901,902,903\n"
              "*DEFINE_SPH_INJECTION\n1,7,0,2.\n"};
}

TEST(Restart, MiddleOfAnInjection) {
  const SmallScene scene = with_inlet("4.");
  const auto run = test::build(scene);
  steps(*run, 200);
  EXPECT_GT(run->world().particles.size(), run->world().particles.moving) << "some wait to the end";
  EXPECT_GT(run->world().particles.active, 36) << "some are in";
  expect_same(scene, {0, 3, 60}, 200);
}

TEST(Restart, MiddleOfAFrozenOutlet) {
  const SmallScene scene{
      .start = "0.8,0.,0.",
      .box = "1",
      .extra = std::string("*DEFINE_BOX\n1,-9.,0.7,-9.,9.,-9.,9.\n") + test::gravity_cards +
               "*COURANT_FROZEN_OUTLET\n1,0.5,5,0.,0.4,0.\n*DEFINE_CURVE\n5\n0.,1.\n1.,11.\n"};
  expect_same(scene, {0, 3, 60}, 200);
}

/// The same under a surface that sinks, with a profile, ever slower.
SmallScene with_changing_inlet(const std::string& endtim) {
  SmallScene s = with_inlet(endtim);
  s.extra.pop_back();  // of the line of the inlet
  s.extra += ",0.,0.,0.,-8\n*DEFINE_CURVE\n8\n0.,1.\n4.,0.2\n*DEFINE_CURVE\n9\n0.,0.3\n1.,0.1\n";
  s.extra += std::string("*COURANT_INFLOW\n1,2,0.,0.,0.,9\n1,4.\n") + test::gravity_cards;
  return s;
}

TEST(Restart, InjectionThatChanges) {
  const SmallScene scene = with_changing_inlet("4.");
  expect_same(scene, {0, 3, 60}, 200);
}

TEST(Restart, InjectionThatChangesWithAnotherEndTime) {
  const auto shorter = test::build(with_changing_inlet("0.4")),
             longer = test::build(with_changing_inlet("1.2"));
  ASSERT_TRUE(shorter && longer);
  EXPECT_LT(shorter->world().particles.size(), longer->world().particles.size());
  std::map<Id, std::pair<Vec, Vec>> there;
  const Particles &a = shorter->world().particles, &b = longer->world().particles;
  for (Index i = 0; i < b.size(); ++i) there[b.id[i]] = {b.x.vec(i), b.v.vec(i)};
  for (Index i = 0; i < a.size(); ++i) {
    EXPECT_EQ(there.at(a.id[i]).first, a.x.vec(i)) << a.id[i];
    EXPECT_EQ(there.at(a.id[i]).second, a.v.vec(i)) << a.id[i];
  }
}

TEST(Restart, InjectionWithAnotherEndTime) {
  const auto shorter = test::build(with_inlet("0.4")), longer = test::build(with_inlet("1.2"));
  ASSERT_TRUE(shorter && longer);
  EXPECT_LT(shorter->world().particles.size(), longer->world().particles.size());
  steps(*shorter, 120), steps(*longer, 120);
  // the other end only, each way
  const auto extended = test::build(with_inlet("1.2")), cut = test::build(with_inlet("0.4"));
  load(*extended, saved(*shorter)), load(*cut, saved(*longer));
  EXPECT_EQ(cut->world().particles.size(), longer->world().particles.size());
  EXPECT_TRUE(extended->changes().empty());
  while (longer->clock().t < 1.2) steps(*longer, 1), steps(*extended, 1), steps(*cut, 1);
  EXPECT_EQ(difference(all_of(*extended), all_of(*longer)), "") << "as if they had waited from the start";
  EXPECT_EQ(difference(all_of(*cut), all_of(*longer)), "") << "nothing changes where fewer would do";
}

// The usual case: a run that has ended goes on.
TEST(Restart, InjectionGoesOnBehindItsEnd) {
  for (const auto& scene : {with_inlet, with_changing_inlet}) {
    const auto shorter = test::build(scene("0.4")), longer = test::build(scene("1.2"));
    ASSERT_TRUE(shorter && longer);
    while (shorter->clock().t < 0.4) steps(*shorter, 1), steps(*longer, 1);
    const auto extended = test::build(scene("1.2"));
    load(*extended, saved(*shorter));
    EXPECT_TRUE(extended->changes().empty());
    while (longer->clock().t < 1.2) steps(*longer, 1), steps(*extended, 1);
    EXPECT_EQ(difference(active_of(*extended), active_of(*longer)), "");
    EXPECT_GT(longer->world().particles.active, shorter->world().particles.active + 6);
  }
}

TEST(Restart, OutflowWithViscosityAndBox) {
  expect_same({.n = 10,
               .start = "2.,0.,0.",
               .material = "1,1000.,-1.E20,0.5",
               .box = "1",
               .extra = "*DEFINE_BOX\n1,0.1,0.9,-1.,5.,-1.,1.\n"},
              {20, 75}, 118);
}

TEST(Restart, EvolvingSmoothingLength) {
  expect_same({.n = 8,
               .start = "0.,-3.,0.",
               .section = "1,1.2,0.5,2.",
               .extra = test::gravity_cards + test::floor_cards()},
              {30, 80}, 150);
}

TEST(Restart, BulkViscosityWithABox) {
  expect_same({.n = 10,
               .start = "2.,0.,0.",
               .control_sph = ",0,0,0,1.E20,0,0,1",
               .box = "1",
               .extra = "*DEFINE_BOX\n1,0.3,0.9,-1.,5.,-1.,1.\n"},
              {20, 75}, 118);
}

TEST(Restart, FrozenGradients) {
  const std::string cards = test::gravity_cards + test::floor_cards() + "*COURANT_PAIR_GEOMETRY\n0.05\n";
  // so stiff that a window lasts for some fifteen steps; with C2 the speed of sound changes
  const std::string linear = "*EOS_LINEAR_POLYNOMIAL\n1,0.,9.E7\n",
                    curved = "*EOS_LINEAR_POLYNOMIAL\n1,0.,9.E7,9.E9\n";
  const std::string box = "*DEFINE_BOX\n1,0.2,9.,-1.,5.,-1.,1.\n", start = "0.5,-0.5,0.";
  const std::vector<SmallScene> scenes{
      {.start = start, .eos = linear, .extra = cards},
      {.start = start, .eos = linear, .extra = cards + "*COURANT_DENSITY_DIFFUSION\n0.1\n"},
      {.start = start, .eos = linear, .extra = cards + "*BOUNDARY_SPH_SYMMETRY_PLANE\n0,0,0,1,0,0\n"},
      {.start = start, .eos = curved, .hourglass = "1,0,0,0,1.5,0.1", .extra = cards},
      {.start = start, .eos = curved, .box = "1", .extra = cards + box}};
  for (const SmallScene& scene : scenes) {
    const std::vector<int> dumps{20, 21, 22, 23, 24, 150};
    expect_same(scene, dumps, 300);
    const auto s = test::build(scene);
    int open = 0, at = 0;
    for (const int n : dumps) {
      steps(*s, n - at);
      at = n;
      for (const auto& [path, array] : saved(*s)) open += path.ends_with("window_volume");
    }
    EXPECT_GT(open, 3);
  }
}

TEST(Restart, DensityDiffusion) {
  expect_same({.n = 8,
               .start = "0.5,-0.5,0.",
               .extra = test::gravity_cards + test::floor_cards() + "*COURANT_DENSITY_DIFFUSION\n0.1\n"},
              {20, 75}, 120);
}

// It looks fifty times per TAU: in each step, and only every few steps, so that dumps fall between looks.
TEST(Restart, VolumeControl) {
  for (const char* tau : {"0.01", "2."})
    expect_same(
        {.n = 8,
         .start = "0.5,-0.5,0.",
         .extra = test::gravity_cards + test::floor_cards() + "*COURANT_VOLUME_CONTROL\n" + tau + "\n"},
        {20, 21, 23, 75}, 120);
}

TEST(Restart, EddyViscosity) {
  expect_same({.n = 8,
               .start = "0.5,-0.5,0.",
               .extra = test::gravity_cards + test::floor_cards() +
                        "*COURANT_EDDY_VISCOSITY\n0.3,0.09,0.41\n0.,0.,0.,0.,1.,0.\n"},
              {0, 1, 20, 75}, 120);
}

TEST(Restart, WallSupport) {
  // the edge of the floor is in the water, so that some particles see one plane and others pieces of it
  const std::string floor = "*NODE\n9001,-2.,0.,-2.\n9002,0.4,0.,-2.\n9003,0.4,0.,3.\n9004,-2.,0.,3.\n";
  std::string cards = test::floor_cards(0);
  cards.replace(0, cards.find("*ELEMENT_SHELL"), floor);
  expect_same({.start = "0.5,-0.3,0.",
               .extra = test::gravity_cards + cards +
                        "*COURANT_WALL_SUPPORT\n2,3,0.004\n*COURANT_VOLUME_CONTROL\n0.1\n"},
              {0, 1, 33, 80}, 140);
}

TEST(Restart, WallSupportOfAFloorThatMovesWhereHChanges) {
  std::string cards = test::floor_cards(0);
  cards.replace(cards.find("1,7,7"), 5, "0");                                                // free
  for (const std::string node : {"9001,-2.,0,", "9002,3.,0,", "9003,3.,0,", "9004,-2.,0,"})  // one deep
    cards.replace(cards.find(node) + node.size(), node < "9003" ? 3 : 2, node < "9003" ? "0." : "1.");
  expect_same({.start = "0.5,-0.3,0.",
               .control_sph = ",0,1",
               .section = "1,1.2,0.5,2.",
               .extra = test::gravity_cards + cards + "*COURANT_WALL_SUPPORT\n2,3,0.004\n"},
              {0, 1, 33, 80}, 140);
}

TEST(Restart, DensityReinitialisation) {
  for (const char* method : {"0", "1"})
    expect_same({.n = 8,
                 .start = "0.5,-0.5,0.",
                 .extra = test::gravity_cards + test::floor_cards() +
                          "*COURANT_DENSITY_REINITIALISATION\n7," + method + "\n"},
                {20, 21, 75}, 120);
}

TEST(Restart, Renormalisation) {
  expect_same(
      {.n = 8,
       .start = "0.5,-1.,0.",
       .control_sph = ",0,1",
       .extra = std::string(test::gravity_cards) + "*BOUNDARY_SPH_SYMMETRY_PLANE\n0.,0.,0.,0.,1.,0.\n"},
      {1, 20, 75}, 120);
}

TEST(Restart, LevelOutlet) {
  expect_same({.n = 8,
               .start = "0.5,0.,0.",
               .extra = test::gravity_cards + test::floor_cards() +
                        "*DEFINE_BOX\n7,0.3,1.,-0.1,1.,-1.,1.\n*COURANT_LEVEL_OUTLET\n7,0.4,0.05\n"},
              {0, 1, 20, 75}, 120);
}

TEST(Restart, RiemannFluxWithABox) {
  expect_same({.n = 8,
               .start = "0.5,-0.5,0.",
               .box = "1",
               .extra = test::gravity_cards + test::floor_cards() +
                        "*COURANT_RIEMANN\n3.\n*DEFINE_BOX\n1,-1.,0.6,-1.,1.,-1.,1.\n"},
              {1, 20, 75}, 120);
}

TEST(Restart, RenormalisedFormWithABox) {
  expect_same({.n = 8,
               .start = "0.5,-0.5,0.",
               .control_sph = ",0,1",
               .box = "1",
               .extra = test::gravity_cards + test::floor_cards() + "*DEFINE_BOX\n1,-1.,0.6,-1.,1.,-1.,1.\n"},
              {1, 20, 75}, 120);
}

TEST(Restart, ShiftingWithCorrectionsAndXsph) {
  expect_same({.n = 10,
               .start = "1.5,-0.5,0.",
               .control_sph = test::shifting_cards,
               .extra = test::gravity_cards + test::floor_cards() +
                        "*COURANT_SHIFTING\n2.,0.,0.,1\n*COURANT_XSPH\n0.5\n"},
              {1, 20, 75}, 120);
  expect_same(
      {.n = 10,
       .start = "0.5,-1.,0.",
       .control_sph = test::shifting_cards,
       .extra = std::string(test::gravity_cards) + "*BOUNDARY_SPH_SYMMETRY_PLANE\n0.,0.,0.,0.,1.,0.\n"},
      {20, 75}, 120);
}

TEST(Restart, VelocitySmoothing) {
  expect_same({.n = 10,
               .start = "1.5,-0.5,0.",
               .extra = test::gravity_cards + test::floor_cards() + "*COURANT_XSPH\n0.01,1,1\n"},
              {1, 20, 75}, 120);
}

TEST(Restart, SymmetryPlane) {
  expect_same(
      {.n = 8,
       .start = "0.5,-1.,0.",
       .extra = std::string(test::gravity_cards) + "*BOUNDARY_SPH_SYMMETRY_PLANE\n0.,0.,0.,0.,1.,0.\n"},
      {20, 75}, 120);
}

TEST(Restart, PeriodicPlanes) {
  SmallScene s;
  s.n = 8;
  s.start = "3.,-1.,0.";
  s.extra = std::string(test::gravity_cards) +
            "*DEFINE_VECTOR\n1,0.,0.,0.,1.,0.,0.\n2,0.8,0.,0.,-1.,0.,0.\n*BOUNDARY_SPH_PERIODIC\n1,2\n"
            "*BOUNDARY_SPH_SYMMETRY_PLANE\n0.,0.,0.,0.,1.,0.\n";
  const auto run = test::build(s);
  steps(*run, 120);
  EXPECT_GT(run->clock().t * 3, 0.8);  // all have gone through
  for (Index i = 0; i < run->world().particles.size(); ++i) {
    const Real x = run->world().particles.x.vec(i).x();
    EXPECT_TRUE(x >= 0 && x <= 0.8) << x;
  }
  expect_same(s, {20, 75, 76}, 120);
}

TEST(Restart, PrescribedParticles) {
  SmallScene s;
  s.n = 8;
  s.start = "0.5,-0.5,0.";
  s.extra = test::gravity_cards + test::floor_cards() +
            "*DEFINE_CURVE\n7\n0.,0.\n0.05,1.\n0.1,-0.5\n9.,-0.5\n*SET_NODE_LIST\n1\n1,2,9,10\n"
            "*BOUNDARY_PRESCRIBED_MOTION_SET\n1,1,0,7,0.4,0,0.2,0.05\n1,2,2,7,0.05\n"
            "*BOUNDARY_PRESCRIBED_MOTION_NODE\n64,4,1,7,5.,3\n*DEFINE_VECTOR\n3,0.,0.,0.,1.,1.,0.\n";
  expect_same(s, {10, 30, 60},
              120);  // before, at and behind the corners of the curve, and the end of a motion
}

TEST(Restart, PrescribedBody) {
  SmallScene s;
  s.dim = 3, s.n = 4;
  s.start = "0.5,-0.5,0.";
  s.extra = test::gravity_cards + test::floor_cards(-0.025, 1, "1,6,4") +
            "*DEFINE_CURVE\n7\n0.,0.\n0.05,1.\n0.1,-0.5\n9.,-0.5\n"
            "*BOUNDARY_PRESCRIBED_MOTION_RIGID\n2,2,0,7,0.4\n2,7,0,7,0.05\n";
  expect_same(s, {10, 30, 60}, 120);
}

TEST(Restart, MovingRigidBody) {
  expect_same({.dim = 3,
               .n = 4,
               .start = "0.,-2.,0.",
               .extra = test::gravity_cards + test::floor_cards(-0.025, 1, "1,5,7")},
              {30, 77}, 150);
}

TEST(Restart, SwitchedOffByMaxv) {
  expect_same({.n = 8,
               .start = "0.,-1.,0.",
               .control_sph = ",0,0,0,1.2",
               .extra = test::gravity_cards + test::floor_cards()},
              {10, 60}, 120);
}

TEST(Restart, EveryWholeDeck) {
  for (const auto& file : std::filesystem::directory_iterator(SOURCE_DIR "/tests/decks/accept")) {
    const std::string name = file.path().filename().string();
    if (name.rfind("whole", 0) != 0 || file.path().extension() != ".k") continue;
    const std::string path = file.path().string();
    SCOPED_TRACE(name);
    expect_same(
        [&] {
          Diagnostics diagnostics;
          return Simulation::build(path, {}, diagnostics);
        },
        {3, 9}, 18);
  }
}

TEST(Restart, AnyNumberOfThreads) {
  SmallScene s;
  s.n = 14;
  s.start = "1.,-1.,0.";
  s.box = "1";
  s.extra = "*DEFINE_BOX\n1,0.3,2.,-1.,5.,-1.,1.\n" + (test::gravity_cards + test::floor_cards());
  const int before = threads();
  set_threads(1);
  const auto whole = test::build(s);
  steps(*whole, 120);
  const SavedState end = all_of(*whole);
  for (const auto [first, second] : {std::pair{1, 4}, {2, 1}, {4, 2}}) {
    set_threads(first);
    const auto a = test::build(s);
    steps(*a, 50);
    set_threads(second);
    const auto b = test::build(s);
    load(*b, saved(*a));
    steps(*b, 70);
    EXPECT_EQ(difference(all_of(*b), end), "") << first << " threads, then " << second;
  }
  set_threads(before);
}

TEST(Restart, RefusesTheStateOfAnotherRun) {
  SmallScene s;
  const auto a = test::build(s);
  steps(*a, 3);
  const SavedState state = saved(*a);
  const auto message = [&](SavedState changed, const SmallScene& scene) {
    const auto b = test::build(scene);
    try {
      load(*b, std::move(changed));
    } catch (const RestartError& error) {
      return std::string(error.what());
    }
    return std::string();
  };
  EXPECT_EQ(message(state, s), "");
  SavedState less = state;
  less.erase("state/stepper/first_dt");
  less.erase("state/passes/stepper/first_dt");
  EXPECT_EQ(message(less, s),
            "the saved state does not fit this run: 'state/passes/stepper/first_dt' is not there");
  SmallScene other;
  other.n = 7;
  EXPECT_NE(message(state, other).find("has another length"), std::string::npos);
  other = s;
  other.extra = test::gravity_cards;
  EXPECT_NE(message(state, other).find("'state/passes/body loads/origin' is not there"), std::string::npos);
  SavedState more = state;
  more.try_emplace("state/passes/magnet/pull");
  EXPECT_EQ(message(more, s),
            "the saved state does not fit this run, which knows no 'state/passes/magnet/pull'");
}

/// Whatever counts and indices a state holds, it is loaded or refused: nothing is read or written elsewhere.
TEST(Restart, SurvivesWrongCountsAndIndices) {
  SmallScene s;
  s.extra = test::floor_cards(0.02);
  s.start = "0.,-1.,0.";
  const auto a = test::build(s);
  steps(*a, 30);
  const SavedState state = saved(*a);
  int refused = 0;
  for (const auto& [path, array] : state) {
    if (array.type != SavedType::integer32 && array.type != SavedType::integer64) continue;
    const std::size_t n = array.count(), width = array.width();
    for (const std::size_t at : std::set<std::size_t>{0, n / 2, n - 1})
      for (const std::int64_t value : {std::int64_t(-1), std::int64_t(1) << 29}) {
        if (n == 0) continue;
        SavedState changed = state;
        std::memcpy(changed.at(path).bytes.data() + at * width, &value, width);
        const auto b = test::build(s);
        try {
          load(*b, std::move(changed));
        } catch (const RestartError&) {
          ++refused;
        } catch (const std::bad_alloc&) {
          ADD_FAILURE() << path << " number " << at << " of " << n << ": " << value;
        }
      }
  }
  EXPECT_GT(refused, 10);
}

TEST(Restart, TheCommandToGoOnIsWhatAShellTakes) {
  RunOptions options;
  options.dir = "my results";
  EXPECT_EQ(call_to_go_on("d.k", options, "my results/restart/runrsf.h5"),
            "courant run d.k -o 'my results' --restart 'my results/restart/runrsf.h5'");
  options.dir = "out", options.params = {"c0=40", "name=it's"}, options.until = 0.25;
  EXPECT_EQ(call_to_go_on("d.k", options, "out/restart/runrsf.h5"),
            "courant run d.k -o out --restart out/restart/runrsf.h5 --param c0=40 --param 'name=it'\\''s' "
            "--until 0.25");
}

TEST(Restart, AHugeNumberOfCyclesIsNever) {
  const std::string text =
      "*KEYWORD\n*DATABASE_BINARY_D3DUMP\n1.0E+20\n*DATABASE_BINARY_RUNRSF\n100,2\n*END\n";
  const ReadDeck read = read_in_memory(in_memory(text));
  ASSERT_EQ(read.diagnostics.text(), "");
  RestartSchedule schedule(read.deck);
  EXPECT_TRUE(schedule.due(1).empty());
  EXPECT_EQ(schedule.due(100), std::vector<std::string>{"runrsf01"});
}

}  // namespace
}  // namespace courant
