// *COURANT_LEVEL_OUTLET: its law against formulas, and a channel that settles to the level.
#include <gtest/gtest.h>

#include <cmath>

#include <fmt/format.h>

#include "../app/small_scene.hpp"
#include "parallel/parallel.hpp"

namespace courant {
namespace {

using test::SmallScene;

constexpr Real g_earth = 9.81;

/// The law once more, for the block of a SmallScene; flow along `axis`, the band from `from` to `to` [L].
struct Law {
  Real level = 0.4, tau = 0.05, gain = 1, tint = 20 * std::sqrt(0.4 / g_earth);
  int axis = 0;
  Real from = 0.1, to = 0.6, width = 1, lowest = 0, mean = 0, U = 0;
  bool started = false;

  Real place(const Particles& p, Index i) const { return (p.x.vec(i)[axis] - from) / (to - from); }
  bool inside(const Particles& p, Index i) const {
    return place(p, i) > 0 && place(p, i) < 1 && p.x.vec(i)[1 - axis] > lowest;
  }
  Real force(const Particles& p, Index i) const {
    if (!inside(p, i)) return 0;
    const Real s = place(p, i), w = s < 0.5 ? 0.5 * (1 - std::cos(2 * pi * s)) : 1;
    return p.m[i] * w * ((to > from ? U : -U) - p.v.vec(i)[axis]) / tau;
  }
  /// U of the next step.
  void measure(const Particles& p, Real dt_old) {
    Real volume = 0, flow = 0;
    for (Index i = 0; i < p.active; ++i) {
      const Real s = place(p, i);
      if (!inside(p, i) || s > 0.5) continue;
      const Real V = (1 - std::cos(4 * pi * s)) * p.m[i] / p.rho[i];
      volume += V, flow += V * p.v.vec(i)[axis] * (to > from ? 1 : -1);
    }
    const Real excess =
        gain * std::sqrt(g_earth / level) * (volume / (0.5 * std::abs(to - from) * width) - level);
    mean = started ? mean + excess * dt_old / tint : flow / volume;
    mean = std::max(mean, 0.0), U = std::max(mean + excess, 0.0);
    started = true;
  }
};

std::string gravity(char axis = 'Y') {
  return fmt::format("*LOAD_BODY_{}\n1\n*DEFINE_CURVE\n1\n0.,9.81\n100.,9.81\n", axis);
}

void expect_forces(SmallScene scene, const std::string& cards, Law law) {
  const auto plain = test::build(scene);
  scene.extra += cards;
  const auto drawn = test::build(scene);
  ASSERT_TRUE(plain && drawn);
  std::string who;
  drawn->evaluate(who), plain->evaluate(who);  // the first step measures
  law.measure(plain->world().particles, 0);
  drawn->evaluate(who), plain->evaluate(who);
  const Particles &p = drawn->world().particles, &q = plain->world().particles;
  int pushed = 0;
  Real most = 0;
  for (Index i = 0; i < p.active; ++i) most = std::max(most, std::abs(law.force(q, i)));
  for (Index i = 0; i < p.active; ++i) {
    const Vec got = p.f.vec(i) - q.f.vec(i);
    EXPECT_NEAR(got[law.axis], law.force(q, i), 1e-10 * most) << p.id[i];
    EXPECT_EQ(got[1 - law.axis], 0) << p.id[i];
    pushed += got[law.axis] != 0;
  }
  EXPECT_GT(pushed, 0);
  EXPECT_LT(pushed, p.active);
}

TEST(LevelOutlet, ForceIsThatOfTheFormula) {
  SmallScene scene;
  scene.start = "0.5,0.1,0.";
  scene.extra = gravity() + "*DEFINE_BOX\n7,0.1,0.6,0.,1.,0.,0.\n";
  expect_forces(scene, "*COURANT_LEVEL_OUTLET\n7,0.4,0.05\n", {});
  expect_forces(scene, "*COURANT_LEVEL_OUTLET\n7,0.9,0.02,,0.5,3.\n",
                {.level = 0.9, .tau = 0.02, .gain = 0.5, .tint = 3});
}

TEST(LevelOutlet, AgainstTheAxisAndAlongAnother) {
  SmallScene scene;
  scene.start = "-0.5,0.1,0.";
  scene.extra = gravity() + "*DEFINE_BOX\n7,0.1,0.6,0.2,1.,0.,0.\n";
  expect_forces(scene, "*COURANT_LEVEL_OUTLET\n7,0.4,0.05,-1\n", {.from = 0.6, .to = 0.1, .lowest = 0.2});
  scene.start = "0.1,0.5,0.";
  scene.extra = gravity('X') + "*DEFINE_BOX\n7,0.,1.,0.1,0.6,0.,0.\n";
  expect_forces(scene, "*COURANT_LEVEL_OUTLET\n7,0.4,0.05,2\n", {.axis = 1});
}

TEST(LevelOutlet, InThreeDimensionsDividesByTheWidth) {
  SmallScene scene;
  scene.dim = 3;
  scene.start = "0.5,0.1,0.";
  scene.extra = gravity() + "*DEFINE_BOX\n7,0.1,0.6,0.,1.,0.,0.6\n";
  expect_forces(scene, "*COURANT_LEVEL_OUTLET\n7,0.4,0.05\n", {.width = 0.6});
}

TEST(LevelOutlet, StopsTheWaterButDoesNotTurnItRound) {
  SmallScene scene;
  scene.start = "0.2,0.,0.";
  scene.extra = gravity() + "*DEFINE_BOX\n7,0.1,0.6,0.,3.,0.,0.\n";
  Law law{.level = 2};
  const auto s = test::build(scene);
  std::string who;
  s->evaluate(who);
  law.measure(s->world().particles, 0);
  ASSERT_EQ(law.U, 0);
  expect_forces(scene, "*COURANT_LEVEL_OUTLET\n7,2.,0.05\n", {.level = 2});
}

// Energy is that of what moved, whatever the pass says of its force.
TEST(LevelOutlet, WorkIsThatOfTheForceAndClosesTheLedger) {
  SmallScene scene;
  scene.timestep = "0.,0.1";  // kinetic energy is that of half a step before
  scene.start = "0.5,0.,0.";
  scene.extra =
      gravity() + "*DEFINE_BOX\n7,0.1,0.8,-0.1,1.,0.,0.\n*COURANT_LEVEL_OUTLET\n7,0.4,0.05,1,1.,0.5\n";
  const auto s = test::build(scene);
  ASSERT_TRUE(s);
  Law law{.tint = 0.5, .to = 0.8, .lowest = -0.1};
  Real work = 0;
  for (int k = 0; s->clock().t < 0.06; ++k)
    s->step([&](World& world, const Clock& clock, const std::string&) {
      if (k == 0) sample_energy(world, clock), world.energy.initial = world.energy.total();
      const Particles& p = world.particles;
      if (law.started)
        for (Index i = 0; i < p.active; ++i)
          work += law.force(p, i) * (p.v.vec(i)[0] + 0.5 * p.f.vec(i)[0] / p.m[i] * clock.dt_mean()) *
                  clock.dt_mean();
      law.measure(p, clock.dt_old);
    });
  const EnergyLedger e = s->sample("").energy;
  EXPECT_GT(std::abs(work), 1);
  EXPECT_NEAR(e.external_work, work, 1e-9 * std::abs(work));
  EXPECT_LT(std::abs(e.residual()), 0.01 * std::abs(work));
}

TEST(LevelOutlet, LimitsTheStep) {
  SmallScene scene;
  scene.extra = gravity() + "*DEFINE_BOX\n7,0.1,0.6,0.,1.,0.,0.\n*COURANT_LEVEL_OUTLET\n7,0.4,1.E-5\n";
  const auto s = test::build(scene);
  std::string who;
  s->evaluate(who);
  EXPECT_EQ(s->clock().dt, 1e-5);
  EXPECT_EQ(who, "TAU of level outlet 7");
}

constexpr Real outlet_dx = 0.024, length = 1.2, start_depth = 0.096, level = 0.12, q = 0.04;

/// A channel over a symmetry plane; at first its water is lower than what flows in, and than the level.
std::string channel() {
  std::string nodes = "*NODE\n", elements = "*ELEMENT_SPH\n";
  Id id = 0;
  const int columns = static_cast<int>(length / outlet_dx + 0.5),
            rows = static_cast<int>(start_depth / outlet_dx + 0.5);
  for (int i = 0; i < columns; ++i)
    for (int j = 0; j < rows; ++j) {
      nodes += fmt::format("{},{:.6g},{:.6g},0.\n", ++id, (i + 0.5) * outlet_dx, (j + 0.5) * outlet_dx);
      elements += fmt::format("{},1,{:.6g}\n", id, 1000 * outlet_dx * outlet_dx);
    }
  return "*KEYWORD\n*CONTROL_TERMINATION\n10.\n*CONTROL_SPH\n1,1,1e20,2\n0,0,0,0,0,0,0\n" +
         fmt::format("*DEFINE_BOX\n1,0.,{0},-1.,1.,-1.,1.\n2,{1},{0},0.,0.5,0.,0.\n", length, length - 0.4) +
         fmt::format("*DEFINE_SPH_INJECTION_SIMPLIFIED\n1,{},{},{}\n0.,{},0.,1.,0.,0.\n", q / level,
                     level / 2, outlet_dx, level / 2) +
         fmt::format("*INITIAL_VELOCITY\n0\n{},0.,0.\n", q / start_depth) +
         "*PART\nwater\n1,1,1,1,1\n*SECTION_SPH\n1,1.2,1,1\n*MAT_NULL\n1,1000.0\n"
         "*EOS_LINEAR_POLYNOMIAL\n1,0,1e5\n\n*HOURGLASS\n1,0,0,0,1e-20,0.05\n"
         "*COURANT_DENSITY_DIFFUSION\n0.1\n*COURANT_VOLUME_CONTROL\n0.2\n"
         "*BOUNDARY_SPH_SYMMETRY_PLANE\n0,0,0,0,1,0\n" +
         gravity() + fmt::format("*COURANT_LEVEL_OUTLET\n2,{},0.02\n", level) + nodes + elements + "*END\n";
}

struct OutletFlow {
  Real depth = 0;        ///< mean between 0.3 and 0.8 [L]
  Real in = 0, out = 0;  ///< per unit of width [L2/T]
};

/// From the particles that are there, that entered (less those that splash back over the inlet, some 3 %) and
/// that left between `from` and `to`.
OutletFlow flow(Simulation& s, Real from, Real to) {
  OutletFlow f, first;
  Real begin = -1, end = 0;
  int states = 0;
  while (s.clock().t < to)
    s.step([&](World& world, const Clock& clock, const std::string&) {
      if (clock.t < from || clock.cycle % 20 != 0) return;
      const Particles& p = world.particles;
      OutletFlow now;
      for (Index i = 0; i < p.size(); ++i) {
        const Real x = p.place(i, clock.t)[0], V = p.m[i] / 1000;
        if (p.state[i] == particle_waiting || x < 0) continue;
        now.in += V;
        if (x > 0.3 && x < 0.8) now.depth += V / 0.5;
        if (x > length) now.out += V;
      }
      if (begin < 0) begin = clock.t, first = now;
      end = clock.t, ++states;
      f.depth += now.depth, f.in = now.in - first.in, f.out = now.out - first.out;
    });
  return {f.depth / states, f.in / (end - begin), f.out / (end - begin)};
}

TEST(LevelOutlet, AChannelSettlesToTheLevel) {
  set_threads(1);
  const auto s = test::build_deck(channel());
  ASSERT_TRUE(s);
  const OutletFlow f = flow(*s, 5, 10);
  EXPECT_NEAR(f.depth, level, 0.02 * level);
  EXPECT_NEAR(f.in, q, 0.05 * q);
  EXPECT_NEAR(f.out, f.in, 0.02 * q);
  set_threads(0);
}

TEST(LevelOutlet, HasTheSameBitsOnAnyNumberOfThreads) {
  std::vector<Real> reference;
  for (const int n : {1, 2, 4}) {
    set_threads(n);
    const auto s = test::build_deck(channel());
    while (s->clock().t < 0.5) s->step([](World&, const Clock&, const std::string&) {});
    const Particles& p = s->world().particles;
    std::vector<Real> state{s->clock().t, s->world().energy.external_work};
    for (const auto* field : {&p.x, &p.v})
      for (int k = 0; k < 2; ++k) state.insert(state.end(), field->data(k), field->data(k) + p.size());
    if (reference.empty()) reference = state;
    EXPECT_TRUE(reference == state) << n << " threads";
  }
  set_threads(0);
}

}  // namespace
}  // namespace courant
