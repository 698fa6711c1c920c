// Inlets: particles that *DEFINE_SPH_INJECTION makes enter as those of a block that a deck writes out would.
#include <cmath>
#include <filesystem>
#include <map>
#include <set>

#include "../../generate_deck.hpp"
#include "parallel/parallel.hpp"
#include "small_scene.hpp"
#include "sph/inlets/injection.hpp"

namespace courant {
namespace {

using test::run;
using test::steps;

constexpr Real dx = 0.125;  // exact, as all locations below: so results can be compared bit by bit
constexpr Real v = 2;

/// Water at rest in 0 < x < 1, and an inlet of four nodes at x = 0 below its surface.
struct Inflow {
  int dim = 2;
  std::string box = "";  ///< *DEFINE_BOX
  std::string inlet = "*DEFINE_SPH_INJECTION\n2,7,0,2.\n";
  std::string endtim = "2.";
  std::string extra = "";
  bool water = true;
  std::string control = "";

  std::string text() const {
    std::string nodes, particles;
    Id id = 0;
    const int depth = dim == 3 ? 4 : 1;
    for (int k = 0; k < depth; ++k)
      for (int j = 0; j < 6 && water; ++j)
        for (int i = 0; i < 8; ++i) {
          nodes += fmt::format("{},{},{},{}\n", ++id, (i + 0.5) * dx, (j + 0.5) * dx, k * dx);
          particles += fmt::format("{},1,{}\n", id, -std::pow(dx, dim));
        }
    Id node = 900;
    for (int k = 0; k < depth; ++k)
      for (int j = 0; j < 4; ++j) nodes += fmt::format("{},0.,{},{}\n", ++node, (j + 0.5) * dx, k * dx);
    return "*KEYWORD\n*NODE\n" + nodes + (water ? "*ELEMENT_SPH\n" + particles : "") +
           "*PART\nwater\n1,1,1,1,1\n*PART\ninflow\n2,1,1,1,1\n*SECTION_SPH\n1,1.2,1.,1.\n"
           "*MAT_NULL\n1,1000.,-1.E20\n*EOS_LINEAR_POLYNOMIAL\n1,0.,9.E5\n*HOURGLASS\n1,0,0,0,1.E-20,0.1\n" +
           fmt::format("*SET_NODE_GENERAL\n7\nNODE{}\n", node_list(node)) + "*CONTROL_SPH\n1," +
           (box.empty() ? "0" : "1") + fmt::format(",1.E20,{}{}\n", dim, control) + "*CONTROL_TERMINATION\n" +
           endtim + "\n" + box + inlet + extra + "*END\n";
  }
  static std::string node_list(Id last) {
    std::string out;
    for (Id n = 901; n <= last && n <= 907; ++n) out += fmt::format(",{}", n);
    for (Id n = 908; n <= last; ++n) out += fmt::format("{}{}", (n - 908) % 7 == 0 ? "\nNODE," : ",", n);
    return out;
  }
};

const char* const box_at_the_plane = "*DEFINE_BOX\n1,0.,9.,-9.,9.,-9.,9.\n";

struct State {
  Vec x, v;
  Real rho, p;
  bool active;
  bool operator==(const State&) const = default;
};
std::map<Id, State> states(Simulation& s) {
  std::map<Id, State> out;
  const Particles& p = s.world().particles;
  for (Index i = 0; i < p.size(); ++i)
    out[p.id[i]] = {p.place(i, s.clock().t), p.v.vec(i), p.rho[i], p.p[i], i < p.active};
  return out;
}

void expect_same_states(const std::map<Id, State>& a, const std::map<Id, State>& b) {
  ASSERT_EQ(a.size(), b.size());
  int different = 0;
  for (const auto& [id, state] : a)
    if (!(state == b.at(id)) && ++different == 1)
      ADD_FAILURE() << "particle " << id << " at " << state.x.transpose() << " and "
                    << b.at(id).x.transpose();
  EXPECT_EQ(different, 0);
}

/// Within `error` of the values of a flow with speeds and lengths of some 1, density 1000.
void expect_near_states(const std::map<Id, State>& a, const std::map<Id, State>& b, Real error) {
  ASSERT_EQ(a.size(), b.size());
  Real most = 0;
  for (const auto& [id, one] : a) {
    const State& other = b.at(id);
    EXPECT_EQ(one.active, other.active) << "particle " << id;
    most = std::max(
        {most, (one.x - other.x).norm(), (one.v - other.v).norm(), std::abs(one.rho - other.rho) / 1000});
  }
  EXPECT_LT(most, error);
}

/// The same scene with the waiting particles of `s` written into the deck.
std::string with_block(const Inflow& scene, Simulation& s) {
  const Particles& p = s.world().particles;
  std::string nodes = "*NODE\n", particles = "*ELEMENT_SPH\n";
  for (Index i = 0; i < p.size(); ++i) {
    if (p.state[i] != particle_waiting) continue;
    nodes += fmt::format("{},{},{},{}\n", p.id[i], p.x.vec(i)[0], p.x.vec(i)[1], p.x.vec(i)[2]);
    particles += fmt::format("{},2,{}\n", p.id[i], -std::pow(dx, scene.dim));
  }
  Inflow block = scene;
  block.inlet = nodes + particles + fmt::format("*INITIAL_VELOCITY_GENERATION\n2,2,0.,{}\n0.\n", v);
  return block.text();
}

Real mass_of_active(Simulation& s, Index part) {
  const Particles& p = s.world().particles;
  Real m = 0;
  for (Index i = 0; i < p.active; ++i)
    if (p.part[i] == part) m += p.m[i];
  return m;
}

// Particles that wait are at start + v t, those of a block add up v dt: round-off, which the flow lets grow.
TEST(Injection, IsABlockThatADeckWritesOut) {
  for (const int dim : {2, 3}) {
    const Inflow scene{.dim = dim, .box = box_at_the_plane, .endtim = "0.4"};
    const auto inlet = test::build_deck(scene.text());
    ASSERT_TRUE(inlet);
    const auto block = test::build_deck(with_block(scene, *inlet));
    ASSERT_TRUE(block);
    for (int k = 0; k < 4; ++k) {
      steps(*inlet, 60), steps(*block, 60);
      EXPECT_NEAR(inlet->clock().t, block->clock().t, 1e-12);
      expect_near_states(states(*inlet), states(*block), 1e-9);
    }
    EXPECT_GT(mass_of_active(*inlet, 1), 0) << "it must matter";
    const auto at = [](Simulation& s) {
      EnergyLedger e = s.sample("").energy;
      return e.external_work;
    };
    EXPECT_NEAR(at(*inlet), at(*block), 1e-9 * std::abs(at(*block)));
  }
}

std::unique_ptr<Simulation> jump(const std::string& scene) {
  const std::string deck =
      (std::filesystem::temp_directory_path() / ("courant_injection_" + scene + ".k")).string();
  Diagnostics diagnostics;
  EXPECT_TRUE(
      test::generate_deck(std::string(SOURCE_DIR) + "/keyword_decks/hydraulic_jump/" + scene + ".yaml", deck,
                          {{"endtim", "0.5"}}, diagnostics))
      << diagnostics.text();
  auto s = Simulation::build(deck, {}, diagnostics);
  EXPECT_TRUE(s) << diagnostics.text();
  std::filesystem::remove(deck);
  return s;
}

/// Particles of the block and of the inlet are in another order: sums differ in their last bits.
TEST(Injection, SceneOfTheJumpFlowsAsThatWithTheBlock) {
  const auto block = jump("scene"), inlet = jump("injection");
  ASSERT_TRUE(block && inlet);
  EXPECT_GE(inlet->world().particles.size(), block->world().particles.size());
  const auto key = [](const Vec& x) { return std::pair(std::lround(x[0] / 1e-4), std::lround(x[1] / 1e-4)); };
  std::map<std::pair<long, long>, Id> at;
  for (const auto& [id, state] : states(*inlet)) at[key(state.x)] = id;
  std::map<Id, Id> same;
  for (const auto& [id, state] : states(*block)) {
    ASSERT_TRUE(at.contains(key(state.x))) << state.x.transpose();
    same[id] = at[key(state.x)];
  }
  steps(*block, 300), steps(*inlet, 300);
  const auto a = states(*block), b = states(*inlet);
  for (const auto& [id, state] : a) {
    EXPECT_NEAR((state.x - b.at(same[id]).x).norm(), 0, 1e-9) << id;
    EXPECT_NEAR((state.v - b.at(same[id]).v).norm(), 0, 1e-6) << id;
    EXPECT_EQ(state.active, b.at(same[id]).active) << id;
  }
  EXPECT_GT(block->world().particles.active, 880);
}

TEST(Injection, NeedsNoBox) {
  // a jet that falls: water that flowed back through the plane would freeze at the box, but not at an inlet
  const Inflow with{.box = box_at_the_plane, .endtim = "0.4", .extra = test::gravity_cards, .water = false},
      without{.endtim = "0.4", .extra = test::gravity_cards, .water = false};
  const auto a = test::build_deck(with.text()), b = test::build_deck(without.text());
  ASSERT_TRUE(a && b);
  for (int k = 0; k < 4; ++k) {
    steps(*a, 60), steps(*b, 60);
    expect_same_states(states(*a), states(*b));
  }
  EXPECT_GT(mass_of_active(*b, 1), 0);
}

TEST(Injection, InsideABoxParticlesWaitForThePlane) {
  const Inflow with{.box = box_at_the_plane, .endtim = "0.4", .extra = test::gravity_cards, .water = false},
      inside{.box = "*DEFINE_BOX\n1,-3.,9.,-9.,9.,-9.,9.\n",
             .endtim = "0.4",
             .extra = test::gravity_cards,
             .water = false};
  const auto a = test::build_deck(with.text()), b = test::build_deck(inside.text());
  ASSERT_TRUE(a && b);
  for (int k = 0; k < 4; ++k) {
    steps(*a, 60), steps(*b, 60);
    expect_same_states(states(*a), states(*b));
  }
}

/// Everybody within the kernel of an active particle is in its list, those that wait as well.
TEST(Injection, WaitingParticlesFillTheKernelOfThoseInside) {
  const Inflow scene{.endtim = "0.5"};
  const auto s = test::build_deck(scene.text());
  ASSERT_TRUE(s);
  Index upstream = 0;
  for (int round = 0; round < 20; ++round) {
    steps(*s, 7);
    const Particles& p = s->world().particles;
    for (Index i = 0; i < p.active; ++i) {
      std::set<Id> expected, got;
      for (Index j = 0; j < p.size(); ++j)
        if (j != i && (p.x.vec(i) - p.place(j, s->clock().t)).norm() < 2 * p.h[i]) {
          expected.insert(p.id[j]);
          if (p.state[j] == particle_waiting) ++upstream;
        }
      for (const Index j : s->neighbours().of(p, i)) got.insert(p.id[j]);
      EXPECT_EQ(got, expected);
    }
  }
  EXPECT_GT(upstream, 100);
}

TEST(Injection, WaterMayFlowBackThroughThePlane) {
  const auto s = test::build_deck(Inflow{.endtim = "0.4"}.text());
  ASSERT_TRUE(s);
  run(*s, 0.4);
  const Particles& p = s->world().particles;
  Index back = 0;
  for (Index i = 0; i < p.active; ++i) back += p.x.vec(i)[0] < 0 ? 1 : 0;
  EXPECT_GT(back, 0);
}

TEST(Injection, BringsInDensityTimesSpeedTimesArea) {
  // into emptiness: what has entered keeps its velocity, so momentum is that of the inflow
  const Inflow scene{.endtim = "3.", .water = false};
  const auto s = test::build_deck(scene.text());
  ASSERT_TRUE(s);
  const Real area = 4 * dx, flow = 1000 * v * area;
  for (const Real t : {1.0, 2.0, 3.0}) {
    run(*s, t);
    const Sample sample = s->sample("");
    const Real now = s->clock().t;
    EXPECT_NEAR(sample.mass, flow * now, 0.51 * 1000 * dx * area) << "half a layer";
    EXPECT_NEAR(sample.mass * sample.velocity[0], v * sample.mass, 1e-9 * v * sample.mass);
    EXPECT_NEAR(sample.energy.external_work, 0.5 * v * v * sample.mass, 1e-9 * sample.mass);
  }
  // whole layers: no rounding to layers left
  const auto t = test::build_deck(scene.text());
  const Real layer = dx / v;
  run(*t, 8.2 * layer);
  const Real before = t->sample("").mass;
  run(*t, 40.2 * layer);
  EXPECT_NEAR((t->sample("").mass - before) / (32 * layer), flow, 1e-9 * flow);
}

TEST(Injection, VolumeFlowGoesThroughThePlaneWhateverTheDirection) {
  const std::string system = "*DEFINE_COORDINATE_SYSTEM\n5,0.,0.,0.,0.,0.,-1.\n0.,1.,0.\n";
  for (const auto& [dim, area, velocity] :
       {std::tuple{2, 0.0, Vec(1.5, -2, 0)}, {3, 0.0, Vec(1, 0.5, -0.25)}, {3, 0.2, Vec(1, 0, 0)}}) {
    Inflow scene{.dim = dim, .water = false};
    scene.inlet = system + fmt::format("*DEFINE_SPH_INJECTION\n2,7,5,{},{},{},{},3\n0.5,1.5\n", velocity[0],
                                       velocity[1], velocity[2], area);
    const auto s = test::build_deck(scene.text(), false);
    ASSERT_TRUE(s);
    const Real A = area > 0 ? area : dim == 2 ? 4 * dx : 16 * dx * dx;
    const Particles& p = s->world().particles;
    Real mass = 0, first = 9, last = 0;
    for (Index i = 0; i < p.size(); ++i) {
      mass += p.m[i];
      EXPECT_EQ(p.v.vec(i), Vec(3 * velocity));
      const Real enters = -p.x.vec(i)[0] / p.v.vec(i)[0];
      first = std::min(first, enters), last = std::max(last, enters);
      const Vec there = p.x.vec(i) + enters * p.v.vec(i);
      EXPECT_NEAR(there[1] / dx - 0.5, std::round(there[1] / dx - 0.5), 1e-9) << "at a node";
    }
    const Real per_layer = 1000 * A * (dim == 2 ? A / 4 : std::sqrt(A / 16));
    const Real layer = per_layer / (1000 * A * 3 * velocity[0]);
    EXPECT_NEAR(mass, 1000 * A * 3 * velocity[0] * 1.0, 0.51 * per_layer);
    EXPECT_NEAR(first, 0.5 + 0.5 * layer, 1e-12);
    EXPECT_LE(last, 1.5);
    EXPECT_GT(last, 1.5 - layer);
  }
}

TEST(Injection, ByRadiusAndByVolumeFlow) {
  Inflow scene{.dim = 3, .water = false};
  scene.inlet = "*DEFINE_SPH_INJECTION_SIMPLIFIED\n2,2.,0.5,0.1,0.25\n1.,2.,3.,0.,0.,-4.\n";
  const auto a = test::build_deck(scene.text());
  scene.inlet = fmt::format(
      "*DEFINE_SPH_INJECTION_SIMPLIFIED_FLOWRATE\n2,{},0.5,0.1,0.25\n1.,2.,3.,0.,0.,-4.\n", 2 * pi * 0.25);
  const auto b = test::build_deck(scene.text());
  scene.inlet =
      "*DEFINE_COORDINATE_SYSTEM\n5,1.,2.,2.75,2.,2.,2.75\n1.,1.,2.75\n"
      "*DEFINE_SPH_INJECTION\n2,0,5,0.,0.,-2.\n0.,0.,0,0.5,0.,0.,0.1\n";
  const auto c = test::build_deck(scene.text());
  ASSERT_TRUE(a && b && c);
  for (const auto* s : {&a, &b, &c}) {
    ASSERT_EQ((*s)->get<Injections>().inlets.size(), 1u);
    const Injection& inlet = (*s)->get<Injections>().inlets[0];
    EXPECT_NEAR(inlet.area * inlet.speed(), 2 * pi * 0.25, 1e-12);
    EXPECT_NEAR((inlet.v - Vec(0, 0, -2)).norm(), 0, 1e-12);
    EXPECT_EQ(inlet.places.size(), 81u);  // of the lattice points within five spacings
    for (const Vec& x : inlet.places) EXPECT_NEAR(x[2], 2.75, 1e-12);
  }
}

TEST(Injection, RoundSetOfNodesIn3D) {
  Inflow scene{.dim = 3, .endtim = "1.2", .water = false};
  std::string nodes = "*NODE\n", set = "*SET_NODE_LIST\n8\n";
  Id id = 2000;
  for (int i = -4; i <= 4; ++i)
    for (int j = -4; j <= 4; ++j)
      if (i * i + j * j <= 16) {
        nodes += fmt::format("{},{},{},0.5\n", ++id, i * dx, j * dx);
        set += fmt::format("{}\n", id);
      }
  scene.inlet = nodes + set + "*DEFINE_SPH_INJECTION\n2,8,0,0.,0.,-2.\n";  // a jet straight down
  const auto s = test::build_deck(scene.text());
  ASSERT_TRUE(s);
  const Real area = 49 * dx * dx, layer = dx / 2;
  run(*s, 2.2 * layer);
  const Real before = s->sample("").mass, t = s->clock().t;
  run(*s, t + 16 * layer);
  const Sample after = s->sample("");
  EXPECT_NEAR((after.mass - before) / (16 * layer), 1000 * 2 * area, 1e-3 * 1000 * 2 * area);
  EXPECT_NEAR(after.mass * after.velocity[2] / after.mass, -2, 1e-9);
}

TEST(Injection, EndsAtItsEndTimeAndGoesOnBeyondThatOfTheRun) {
  Inflow scene{.endtim = "0.5", .water = false};
  scene.inlet = "*DEFINE_SPH_INJECTION\n2,7,0,2.\n0.,0.25\n";
  const auto ends = test::build_deck(scene.text());
  EXPECT_EQ(ends->world().particles.size(), 16);
  EXPECT_EQ(ends->why_not_until(9), "");
  scene.inlet = Inflow{}.inlet;
  const auto goes_on = test::build_deck(scene.text());
  // at the end the kernel of the last one inside is still full
  run(*goes_on, 0.5);
  const Particles& p = goes_on->world().particles;
  Real furthest = 0;
  for (Index i = 0; i < p.size(); ++i) furthest = std::min(furthest, p.place(i, goes_on->clock().t)[0]);
  EXPECT_LT(furthest, -2 * 1.2 * dx);
  EXPECT_EQ(goes_on->why_not_until(0.5), "");
  EXPECT_NE(goes_on->why_not_until(0.6).find("*DEFINE_SPH_INJECTION"), std::string::npos);
}

TEST(Injection, IdsGoOnFromTheHighest) {
  const auto s = test::build_deck(Inflow{.endtim = "0.3"}.text());
  const Particles& p = s->world().particles;
  for (Index i = 48; i < p.size(); ++i) EXPECT_EQ(p.id[i], 904 + i - 47);
}

TEST(Injection, SameBitsOnAnyNumberOfThreads) {
  std::map<Id, State> first;
  for (const int n : {1, 2, 4}) {
    set_threads(n);
    const auto s = test::build_deck(Inflow{.dim = 3, .endtim = "0.3"}.text());
    steps(*s, 150);
    if (first.empty())
      first = states(*s);
    else
      expect_same_states(first, states(*s));
  }
  set_threads(0);
}

TEST(Injection, WaitingParticlesMayStandInWalls) {
  Inflow scene{.endtim = "0.3"};
  scene.extra =
      "*NODE\n9001,-0.2,-9.,-2.\n9002,-0.2,9.,-2.\n9003,-0.2,9.,2.\n9004,-0.2,-9.,2.\n"
      "*ELEMENT_SHELL\n1,3,9001,9002,9003,9004\n*PART\nwall\n3,3,3\n*SECTION_SHELL\n3,2\n0.05\n"
      "*MAT_RIGID\n3,7850.,2.1E11,0.3\n1,7,7\n*CONTACT_AUTOMATIC_NODES_TO_SURFACE\n2,3,3,3\n0.\n1.\n";
  const auto s = test::build_deck(scene.text());
  ASSERT_TRUE(s);
  steps(*s, 100);
  for (const auto& [id, state] : states(*s))
    if (!state.active && id > 904) EXPECT_EQ(state.v, Vec(v, 0, 0));
  EXPECT_EQ(s->world().counters["leaked_particles"], 0);
}

// --- flows over time, surfaces, profiles

TEST(InletRate, TellsWhenACurveHasLetSoMuchIn) {
  const InletRate none;
  EXPECT_EQ(none.time_of(3, 0.5), 3.5);
  // up from 1 to 3, a jump to 2, nothing from 3 to 4, then 5
  const InletRate rate(Curve{1, {0, 2, 2, 3, 3, 4, 4, 6}, {1, 3, 2, 2, 0, 0, 5, 5}});
  const auto sum = [&](Real from, Real to) {  // by small steps
    constexpr int n = 200000;
    Real s = 0;
    for (int k = 0; k < n; ++k) s += rate(from + (k + 0.5) * (to - from) / n) * (to - from) / n;
    return s;
  };
  for (const Real begin : {0.0, 0.7, 2.0, 2.5, 3.2, 5.0, 7.0})
    for (const Real t : {0.9, 1.999, 2.2, 2.999, 4.1, 5.9, 8.0})
      if (t > begin && sum(begin, t) > 0) EXPECT_NEAR(rate.time_of(sum(begin, t), begin), t, 2e-4);
  const InletRate ends(Curve{1, {0, 1, 2}, {2, 2, 0}});
  EXPECT_NEAR(ends.time_of(3 - 1e-12, 0), 2, 2e-6);
  EXPECT_TRUE(std::isinf(ends.time_of(3 + 1e-9, 0)));
  EXPECT_EQ(ends.least(), 0);
  EXPECT_EQ(ends.most(), 2);
}

const char* const ramp = "*DEFINE_CURVE\n3\n0.,1.\n1.,1.\n1.5,2.\n9.,2.\n";

TEST(Injection, FollowsACurveOfTheSpeed) {
  for (const std::string& inlet :
       {std::string("*DEFINE_SPH_INJECTION\n2,7,0,2.,0.,0.,0.,-3\n"),
        std::string("*DEFINE_SPH_INJECTION_SIMPLIFIED\n2,-3,0.25,0.125\n0.,0.25,0.,2.,0.,0.\n"),
        std::string("*DEFINE_SPH_INJECTION_SIMPLIFIED_FLOWRATE\n2,-3,0.25,0.125\n0.,0.25,0.,1.,0.,0.\n")}) {
    const Real base = inlet.find("_SIMPLIFIED") == std::string::npos ? 2
                      : inlet.find("FLOW") == std::string::npos      ? 1
                                                                     : 2;
    const Inflow scene{.inlet = ramp + inlet, .endtim = "3.", .water = false};
    const auto s = test::build_deck(scene.text());
    ASSERT_TRUE(s);
    const Particles& p = s->world().particles;
    for (Index i = 0; i < p.size(); ++i) {  // each has the velocity of the moment at which it comes in
      const Real enters = -p.x.vec(i)[0] / p.v.vec(i)[0];
      const Real rate = enters < 1 ? 1 : std::min(Real(2), 1 + 2 * (enters - 1));
      EXPECT_NEAR(p.v.vec(i)[0], base * rate, 1e-12) << enters;
    }
    const Real area = 4 * dx, layer = 1000 * area * dx;
    for (const auto& [t, times] : {std::pair{0.75, 0.75}, {1.25, 1.3125}, {2.5, 3.75}}) {
      run(*s, t);
      const Real more = (s->clock().t - t) * (t > 1.5 ? 2 : 1.5);
      EXPECT_NEAR(s->sample("").mass, 1000 * area * base * (times + more), 0.6 * layer) << inlet << t;
    }
  }
}

TEST(Injection, StopsWhereItsCurveEnds) {
  const Inflow scene{
      .inlet = "*DEFINE_CURVE\n3\n0.,1.\n0.5,1.\n1.,0.\n9.,0.\n*DEFINE_SPH_INJECTION\n2,7,0,2.,0.,0.,0.,-3\n",
      .endtim = "3.",
      .water = false};
  const auto s = test::build_deck(scene.text());
  ASSERT_TRUE(s);
  EXPECT_EQ(s->world().particles.size(), 4 * 12) << "0.75 s of 2 m/s are 12 layers";
  for (const auto& [id, state] : states(*s)) EXPECT_GT(state.v[0], 0);
}

Inflow under_surface(const std::string& inflow, const std::string& more = "") {
  return {.endtim = "1.",
          .extra = test::gravity_cards + std::string("*COURANT_INFLOW\n") + inflow + more,
          .water = false};
}

TEST(Injection, HasThePressureOfItsDepth) {
  // 900 kPa of modulus: 1 m of water is 1 % of it
  for (const auto& [card, surface] : {std::pair{"2,1\n", 0.5}, {"2,2,9.,0.75,9.\n", 0.75}}) {
    const auto s = test::build_deck(under_surface(card).text());
    ASSERT_TRUE(s);
    const Particles& p = s->world().particles;
    for (Index i = 0; i < p.size(); ++i) {
      const Real expected = 1000 * 9.81 * (surface - p.x.vec(i)[1]);
      EXPECT_NEAR(p.p[i], expected, 1e-6 * expected);
      EXPECT_NEAR(p.m[i], p.rho[i] * dx * dx, 1e-9 * p.m[i]) << "volumes fill the inlet";
    }
    EXPECT_GT(p.size(), 0);
  }
}

TEST(Injection, ASurfaceThatRisesLetsMoreRowsIn) {
  // 2.25 rows until 0.5 s, then 4
  const auto s = test::build_deck(
      under_surface("2,2,0.,0.,0.,4\n", "*DEFINE_CURVE\n4\n0.,0.28125\n0.5,0.28125\n0.5,0.5\n9.,0.5\n")
          .text());
  ASSERT_TRUE(s);
  const Particles& p = s->world().particles;
  std::map<long, int> first, second;  // by row
  for (Index i = 0; i < p.size(); ++i) {
    const Real enters = -p.x.vec(i)[0] / v;
    const long row = std::lround(p.x.vec(i)[1] / dx - 0.5);
    if (enters < 0.5)
      ++first[row];
    else if (enters < 1)
      ++second[row];
  }
  EXPECT_EQ(first, (std::map<long, int>{{0, 8}, {1, 8}, {2, 2}})) << "a quarter of the third row";
  EXPECT_EQ(second, (std::map<long, int>{{0, 8}, {1, 8}, {2, 8}, {3, 8}}));
}

TEST(Injection, ProfilesKeepTheDischarge) {
  const auto speeds = [](const std::string& card, const std::string& more = "") {
    const auto s = test::build_deck(under_surface(card, more).text());
    EXPECT_TRUE(s);
    std::map<long, Real> out;
    const Particles& p = s->world().particles;
    for (Index i = 0; i < p.size(); ++i) out[std::lround(p.x.vec(i)[1] / dx - 0.5)] = p.v.vec(i)[0];
    return out;
  };
  auto power = speeds("2,1\n1,7.\n"), log = speeds("2,1\n2,0.,0.01\n"),
       table = speeds("2,1\n3,0.,0.,5\n", "*DEFINE_CURVE\n5\n0.,0.\n0.5,1.\n");
  Real mean_power = 0, mean_log = 0;
  for (long row = 0; row < 4; ++row) {
    const Real z = (row + 0.5) * dx;
    mean_power += power[row] / 4, mean_log += log[row] / 4;
    EXPECT_NEAR(power[row] / power[0], std::pow(2 * row + 1, 1.0 / 7), 1e-12);
    EXPECT_NEAR(log[row] / log[0], std::log(30 * z / 0.01) / std::log(30 * 0.5 * dx / 0.01), 1e-12);
    EXPECT_NEAR(table[row], v * z / 0.5, 1e-12) << "as it is given";
  }
  EXPECT_NEAR(mean_power, v, 1e-12);
  EXPECT_NEAR(mean_log, v, 1e-12);
}

TEST(Injection, RowsOfAProfileComeInEachByItsSpeed) {
  const auto s = test::build_deck(under_surface("2,1\n1,2.\n").text());
  ASSERT_TRUE(s);
  const Particles& p = s->world().particles;
  std::map<long, std::vector<Real>> times;
  for (Index i = 0; i < p.size(); ++i)
    times[std::lround(p.x.vec(i)[1] / dx - 0.5)].push_back(-p.x.vec(i)[0] / p.v.vec(i)[0]);
  ASSERT_EQ(times.size(), 4u);
  for (auto& [row, t] : times) {
    std::sort(t.begin(), t.end());
    const Real speed = v * std::sqrt(2 * row + 1) * 4 / (1 + std::sqrt(3) + std::sqrt(5) + std::sqrt(7));
    for (std::size_t k = 0; k < t.size(); ++k) EXPECT_NEAR(t[k], (k + 0.5) * dx / speed, 1e-9);
    EXPECT_GE(t.back(), 1 - dx / speed) << "up to the end";
  }
}

}  // namespace
}  // namespace courant
