// What gauges measure, of states that are known.
#include "gauges/gauge.hpp"

#include <cmath>

#include "../app/small_scene.hpp"
#include "parallel/parallel.hpp"

namespace courant {
namespace {

using test::build_deck;
using test::SmallScene;

/// Neighbours are known, so that particles are active.
std::unique_ptr<Simulation> evaluated(std::unique_ptr<Simulation> s) {
  std::string dt_set_by;
  if (s) s->evaluate(dt_set_by);
  return s;
}

/// Gauges of the small scene: a block of water from 0 to 0.6 with particles 0.1 apart.
std::unique_ptr<Simulation> scene_with(const std::string& gauges, SmallScene scene = {}) {
  scene.extra += gauges;
  return evaluated(build_deck(scene.text(), false));
}

std::vector<Real> measured(Simulation& s, std::size_t gauge = 0) {
  return s.sample("", false, {gauge}).gauges.at(0).values;
}

/// Finds the particles again after they have moved by hand.
void sort_again(Simulation& s) {
  s.get<std::shared_ptr<Neighbours>>()->force_refresh();
  std::string dt_set_by;
  s.evaluate(dt_set_by);
}

/// Pressure 5000 - rho g y and velocity (y, x, 0) of all particles.
void set_still_fields(World& world) {
  Particles& p = world.particles;
  for (Index i = 0; i < p.size(); ++i) {
    const Vec x = p.x.vec(i);
    p.p[i] = 5000 - p.rho[i] * 9.81 * x.y();
    p.v.set(i, {x.y(), x.x(), 0});
  }
}

// Also where a wall is, half a spacing beyond the outer row, and in a corner.
TEST(PointGauge, HasStillWaterAndLinearVelocitiesExactly) {
  for (const Vec& at : {Vec(0.31, 0.27, 0), Vec(0.3, 0, 0), Vec(0, 0, 0), Vec(0.6, 0.3, 0)}) {
    auto s =
        scene_with(fmt::format("{}*COURANT_GAUGE_POINT\n1,0.1,{},{}\n", test::gravity_cards, at.x(), at.y()));
    set_still_fields(s->world());
    const std::vector<Real> v = measured(*s);
    ASSERT_EQ(v.size(), 6U);
    EXPECT_EQ(v[0], 1) << at;
    EXPECT_NEAR(v[1], 5000 - 9810 * at.y(), 1e-6) << at;
    EXPECT_NEAR(v[2], at.y(), 1e-10) << at;
    EXPECT_NEAR(v[3], at.x(), 1e-10) << at;
    EXPECT_NEAR(v[5], 1000, 1e-6) << at;
  }
}

TEST(PointGauge, HasLinearVelocitiesExactlyInSpace) {
  SmallScene scene{.dim = 3};
  scene.extra = "*COURANT_GAUGE_POINT\n1,0.1,0.,0.25,0.6\n";
  auto s = evaluated(build_deck(scene.text(), false));
  Particles& p = s->world().particles;
  for (Index i = 0; i < p.size(); ++i) p.v.set(i, Vec(0, 0, p.x.vec(i).dot(Vec(1, 2, 3))));
  EXPECT_NEAR(measured(*s)[4], 0.5 + 1.8, 1e-9);
}

// A row of particles has no slope across: the mean of what is near.
TEST(PointGauge, TakesTheMeanWhereParticlesLieOnALine) {
  SmallScene scene{.n = 2, .start = "2.,0.,0."};
  scene.extra = "*COURANT_GAUGE_POINT\n1,0.1,0.07,0.05\n";
  auto s = evaluated(build_deck(scene.text(), false));
  Particles& p = s->world().particles;
  for (Index i = 0; i < p.size(); ++i) p.p[i] = 7, p.x.set(i, {p.x.vec(i).x(), 0.05, 0});
  EXPECT_NEAR(measured(*s)[1], 7, 1e-12);
  EXPECT_NEAR(measured(*s)[2], 2, 1e-12);
}

TEST(PointGauge, IsDryOutsideTheWater) {
  auto s = scene_with("*COURANT_GAUGE_POINT\n1,0.1,0.3,0.69\n");
  const std::vector<Real> v = measured(*s);
  EXPECT_EQ(v[0], 0);
  for (std::size_t k = 1; k < v.size(); ++k) EXPECT_TRUE(std::isnan(v[k])) << k;
}

Real level(const std::string& line) {
  auto s = scene_with("*COURANT_GAUGE_LEVEL\n1,0.1\n" + line + "\n");
  const std::vector<Real> v = measured(*s);
  return v[0] == 1 ? v[1] : -v[0];
}

// A flat surface 0.05 above the upper row; on the line at the edge half of the kernel is missing.
TEST(LevelGauge, FindsTheSurface) {
  EXPECT_NEAR(level("0.3,0.,0.,0.3,1."), 0.6, 0.005);
  EXPECT_NEAR(level("0.3,-0.5,0.,0.3,2."), 1.1, 0.005);
  EXPECT_NEAR(level("0.,0.,0.,0.,1."), 0.6, 0.01);
  EXPECT_NEAR(level("0.,0.3,0.,1.,0.3"), 0.6, 0.005);                  // along x
  EXPECT_NEAR(level("0.,0.3,0.,1.,1.3"), 0.3 * std::sqrt(2.0), 0.01);  // aslant
}
TEST(LevelGauge, SaysWhereThereIsNone) {
  EXPECT_EQ(level("0.9,0.,0.,0.9,1."), 0);
  EXPECT_EQ(level("0.3,0.,0.,0.3,0.4"), -2);
}

// A drop of one particle above the water is no surface.
TEST(LevelGauge, PassesOverSpray) {
  auto s = scene_with("*COURANT_GAUGE_LEVEL\n1,0.1\n0.3,0.,0.,0.3,2.\n");
  Particles& p = s->world().particles;
  for (Index i = 0; i < p.size(); ++i)
    if (p.id[i] == 1) p.x.set(i, {0.3, 1.5, 0});  // from the corner
  sort_again(*s);
  EXPECT_NEAR(measured(*s)[1], 0.6, 0.005);
}

TEST(RunupGauge, EndsWhereTheRowOfParticlesDoes) {
  const std::string at_floor = "*COURANT_GAUGE_RUNUP\n1,0.1\n-0.5,0.,0.,2.,0.\n";
  auto s = scene_with(at_floor);
  EXPECT_NEAR(measured(*s)[1], 1.1, 1e-9);
  Particles& p = s->world().particles;
  for (Index i = 0; i < p.size(); ++i)
    if (p.id[i] == 36) p.x.set(i, {1.4, 0.05, 0});  // spray ahead of the water
  sort_again(*s);
  EXPECT_NEAR(measured(*s)[1], 1.1, 1e-9);
  for (Index i = 0; i < p.size(); ++i)
    if (p.id[i] == 36) p.x.set(i, {0.7, 0.05, 0});
  sort_again(*s);
  EXPECT_NEAR(measured(*s)[1], 1.25, 1e-9);
  EXPECT_NEAR(measured(*s)[2], 0.75, 1e-9);
}

// One plane through a block that passes: what went through is the block, whatever the interval of the
// lattice.
TEST(FluxGauge, SumsToTheVolumeThatWentThrough) {
  SmallScene scene;
  scene.start = "2.,0.5,0.";
  auto s = scene_with("*COURANT_GAUGE_FLUX\n1,0.1\n1.,-5.,0.,1.,5.\n", scene);
  Particles& p = s->world().particles;
  const Real step = 0.013;
  Real volume = 0, mass = 0, energy = 0;
  Vec momentum = Vec::Zero();
  for (int k = 0; k < 150; ++k) {
    for (Index i = 0; i < p.size(); ++i) p.x.set(i, p.x.vec(i) + Vec(step, 0, 0));
    sort_again(*s);
    for (Index i = 0; i < p.size(); ++i) p.p[i] = 300;
    const std::vector<Real> v = measured(*s);
    const Real dt = step / 2;
    volume += v[1] * dt, mass += v[2] * dt, energy += v[7] * dt;
    momentum += Vec(v[3], v[4], v[5]) * dt;
    EXPECT_NEAR(v[6], 300 * v[0], 1e-9);
  }
  EXPECT_NEAR(volume, 0.36, 1e-4);
  EXPECT_NEAR(mass, 360, 0.1);
  EXPECT_NEAR(momentum.x(), 720, 0.2);
  EXPECT_NEAR(momentum.y(), 180, 0.05);
  EXPECT_NEAR(energy, 360 * 0.5 * 4.25 + 0.36 * 300, 0.3);
}

// Through half of the height, against the normal.
TEST(FluxGauge, CountsWhatIsWithinItsEndsAlone) {
  SmallScene scene;
  scene.start = "2.,0.,0.";
  auto s = scene_with("*COURANT_GAUGE_FLUX\n1,0.1\n0.3,0.3,0.,0.3,0.\n", scene);
  const std::vector<Real> v = measured(*s);
  EXPECT_NEAR(v[0], 0.3, 0.01);
  EXPECT_NEAR(v[1], -2 * v[0], 1e-12);
}

TEST(FluxGauge, TakesAParallelogramInSpace) {
  SmallScene scene{.dim = 3};
  scene.start = "0.,0.,3.";
  scene.extra = "*COURANT_GAUGE_FLUX\n1,0.1\n0.,0.,0.3,0.6,0.,0.3\n0.,0.3,0.3\n";
  auto s = evaluated(build_deck(scene.text(), false));
  const std::vector<Real> v = measured(*s);
  EXPECT_NEAR(v[0], 0.18, 0.006);
  EXPECT_NEAR(v[1], 3 * v[0], 1e-12);
}

// At a periodic plane the far side is near, too: the flow and the level are those of the middle.
TEST(Gauges, MeasureThroughPeriodicPlanes) {
  const std::string planes =
      "*DEFINE_VECTOR\n1,0.,0.,0.,1.,0.,0.\n2,0.6,0.,0.,-1.,0.,0.\n*BOUNDARY_SPH_PERIODIC\n1,2\n";
  const auto at = [&](Real x) {
    SmallScene scene;
    scene.start = "2.,0.,0.";
    auto s =
        scene_with(fmt::format("{}*COURANT_GAUGE_FLUX\n1,0.1\n{},0.,0.,{},0.6\n*COURANT_GAUGE_LEVEL\n2,0.1\n"
                               "{},0.,0.,{},1.\n*COURANT_GAUGE_POINT\n3,0.1,{},0.3\n",
                               planes, x, x, x, x, x),
                   scene);
    std::vector<Real> out = measured(*s, 0);
    for (const std::size_t k : {1U, 2U})
      for (const Real value : measured(*s, k)) out.push_back(value);
    return out;
  };
  const std::vector<Real> middle = at(0.3);
  EXPECT_NEAR(middle[11], 0.6, 0.01);  // area of the flux, behind point and level
  for (const Real x : {0.0, 0.6}) {
    const std::vector<Real> v = at(x);
    ASSERT_EQ(v.size(), middle.size());
    for (std::size_t k = 0; k < v.size(); ++k)
      if (k != 8)
        EXPECT_NEAR(v[k], middle[k], 1e-9 * (1 + std::abs(middle[k]))) << x << " " << k;  // 8: position.x
  }
}

// Particles that lie on the floor off its middle, so that there is a moment.
TEST(ForceGauge, IsThatOfTheContactWithItsLever) {
  SmallScene scene;
  scene.extra = test::floor_cards(0.03);
  auto s = scene_with("*COURANT_GAUGE_FORCE\n1,0.1,2,3,0.1,-0.2,0.\n", scene);
  test::steps(*s, 1);
  std::string dt_set_by;
  s->evaluate(dt_set_by);
  const Sample sample = s->sample(dt_set_by, true, {0});
  const Vec on_water = sample.interfaces.at(0).on_surfa;
  const std::vector<Real>& v = sample.gauges.at(0).values;
  ASSERT_GT(on_water.y(), 1);
  EXPECT_NEAR(v[1], -on_water.y(), 1e-9 * on_water.y());
  // the particles are symmetric about x = 0.3
  EXPECT_NEAR(v[5], -on_water.y() * 0.2, 1e-6 * on_water.y());
}

std::vector<Real> all_values(const std::string& gauges, int threads_wanted) {
  const int before = threads();
  set_threads(threads_wanted);
  SmallScene scene;
  scene.start = "0.3,-0.2,0.", scene.extra = test::gravity_cards;
  auto s = scene_with(gauges, scene);
  test::steps(*s, 60);
  std::vector<Real> out;
  for (const GaugeSample& one : s->sample("", false, {0, 1, 2}).gauges)
    out.insert(out.end(), one.values.begin(), one.values.end());
  set_threads(before);
  return out;
}

TEST(Gauges, HaveTheSameBitsOnAnyNumberOfThreads) {
  const std::string gauges =
      "*COURANT_GAUGE_POINT\n1,0.1,0.3,0.2\n*COURANT_GAUGE_LEVEL\n2,0.1\n0.3,0.,0.,0.3,1.\n"
      "*COURANT_GAUGE_FLUX\n3,0.1\n0.3,0.,0.,0.3,1.\n";
  const std::vector<Real> one = all_values(gauges, 1);
  EXPECT_EQ(one.size(), 6U + 5U + 8U);
  EXPECT_EQ(one, all_values(gauges, 4));
  EXPECT_FALSE(std::isnan(one[1]) || std::isnan(one[7]));
}

// A body that turns by hand: the gauge goes with it.
TEST(PointGauge, MovesWithABody) {
  RigidBodyMotion start, now;
  start.x = Vec(1, 0, 0), now.x = Vec(2, 1, 0);
  now.axes << 0, -1, 0, 1, 0, 0, 0, 0, 1;  // a quarter of a turn
  World world;
  world.dim = 2;
  const auto gauge = make_point_gauge({}, 0.1, Vec(1.5, 0, 0), 0, start);
  const std::vector<RigidBodyMotion> bodies{now};
  const GaugeView view{world, KernelChoice::cubic_spline, bodies};
  const std::vector<Real> v = gauge->measure(view, {});
  ASSERT_EQ(v.size(), 9U);
  EXPECT_NEAR(v[6], 2, 1e-12);
  EXPECT_NEAR(v[7], 1.5, 1e-12);
}

TEST(GaugeLayout, NamesFilesByTitlesOrNumbers) {
  auto s = scene_with(
      "*COURANT_GAUGE_POINT_TITLE\nat the wall\n4,0.1,0.3,0.2\n*COURANT_GAUGE_POINT\n7,0.1,0.3,0.2\n");
  const auto all = s->world().passes.all<const Gauges>();
  ASSERT_EQ(all.size(), 1U);
  EXPECT_EQ(all[0]->all()[0]->layout().name, "at_the_wall");
  EXPECT_EQ(all[0]->all()[1]->layout().name, "7");
}

}  // namespace
}  // namespace courant
