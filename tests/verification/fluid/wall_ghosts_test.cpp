// METHOD 2 of *COURANT_WALL_SUPPORT: fixed ghost particles behind walls. Water at rest stays so, on upright
// and on oblique walls; walls that move carry it along, do the work they should, and lose neither momentum
// nor energy; a box floats as deep as Archimedes has it.
#include <cmath>

#include "rigid/bodies/rigid.hpp"
#include "same_bits.hpp"
#include "scenes.hpp"

using namespace courant;

namespace wall_ghosts_test {
namespace {

using test::started;

constexpr Real rho0 = 1000, g = 9.81;
using Parameters = std::map<std::string, std::string>;

/// Shells so thin that contact leaves the water to the ghosts.
std::string deck(const std::string& scene, Parameters parameters) {
  parameters["method"] = "2";
  return test::deck_of_scene(scene, parameters);
}
void run(Simulation& s, Real until) {
  while (s.clock().t < until) s.step(test::do_nothing);
}
Real residual(Simulation& s) {
  sample_energy(s.world(), s.clock());
  return s.world().energy.residual() / s.world().energy.scale();
}
/// Root mean square of the pressure's error, and the largest near the lowest point, of rho g depth; the
/// fastest particle, of sqrt(g depth). Means over the time from `from` on.
struct Rest {
  Real rms = 0, tip = 0, speed = 0;
};
Rest rest(Simulation& s, Real depth, Real from, Real until) {
  std::map<Id, Real> mean;
  int samples = 0;
  Rest out;
  while (s.clock().t < until) {
    s.step(test::do_nothing);
    if (s.clock().t < from) continue;
    const Particles& p = s.world().particles;
    ++samples;
    for (Index i = 0; i < p.size(); ++i) {
      mean[p.id[i]] += p.p[i] - rho0 * g * (depth - p.x.vec(i)[1]);
      out.speed = std::max(out.speed, p.v.vec(i).norm() / std::sqrt(g * depth));
    }
  }
  const Particles& p = s.world().particles;
  Real lowest = 1e300;
  for (Index i = 0; i < p.size(); ++i) {
    const Real error = mean[p.id[i]] / samples / (rho0 * g * depth);
    out.rms += error * error / p.size();
    if (p.x.vec(i)[1] < lowest) lowest = p.x.vec(i)[1], out.tip = std::abs(error);
  }
  out.rms = std::sqrt(out.rms);
  return out;
}

}  // namespace

TEST(WallGhosts, HoldWaterAtRestInWedgesOfAnyAngle) {
  for (const char* slope : {"1", "0.5"}) {
    const auto s = started(deck("wedge_tank", {{"slope", slope}}));
    const Rest r = rest(*s, 0.2, 1.5, 2);
    std::printf("slope %s: rms %.2f %%, tip %.2f %%, speed %.4f, energy %.1e\n", slope, 100 * r.rms,
                100 * r.tip, r.speed, residual(*s));
    EXPECT_LT(r.rms, 0.01);
    EXPECT_LT(r.tip, 0.03);
    EXPECT_LT(r.speed, 0.01);
    EXPECT_LT(std::abs(residual(*s)), 0.01);
  }
}

// The pressure that carries the water is that of a force on it, and so is how the surface tilts.
TEST(WallGhosts, PushWaterAsAForceDoes) {
  const Parameters at{{"n", "8"}, {"lid", "0"}, {"gy", "-9.81"}, {"diffusion", "0.1"}};
  Parameters by_force = at, by_walls = at;
  by_force["gx"] = "-3", by_walls["a"] = "3";
  const auto force = started(deck("carried_box", by_force)), goes = started(deck("carried_box", by_walls));
  const auto positions = [](const Simulation& s, const Vec& shift) {
    std::map<Id, Vec> out;
    const Particles& p = s.world().particles;
    for (Index i = 0; i < p.size(); ++i) out[p.id[i]] = p.x.vec(i) - shift;
    return out;
  };
  const auto start = positions(*force, Vec::Zero());
  run(*force, 0.2), run(*goes, 0.2);
  const Real t = goes->clock().t;
  const auto one = positions(*force, Vec::Zero()), other = positions(*goes, Vec(1.5 * t * t, 0, 0));
  Real moved = 0, apart = 0;
  for (const auto& [id, x] : one) {
    moved = std::max(moved, (x - start.at(id)).norm());
    apart = std::max(apart, (x - other.at(id)).norm());
  }
  std::printf("moved by %.2e m, apart by %.2e m, energy %.1e\n", moved, apart, residual(*goes));
  EXPECT_GT(moved, 0.01);
  EXPECT_LT(apart, 5e-3 * moved);  // the first step does not know the acceleration
  EXPECT_LT(std::abs(residual(*goes)), 1e-3);
}

TEST(WallGhosts, TurnWaterWithThem) {
  const auto s = started(deck("carried_box", {{"n", "16"}, {"omega", "6"}}));
  const Vec middle(0.12, 0.08, 0);
  Real speed = 0;
  while (s->clock().t < 0.2) {
    s->step(test::do_nothing);
    const Particles& p = s->world().particles;
    for (Index i = 0; i < p.size(); ++i) {
      const Vec x = p.x.vec(i) - 0.5 * s->clock().dt_old * p.v.vec(i);
      const Vec solid = 6 * Vec(middle[1] - x[1], x[0] - middle[0], 0);
      speed = std::max(speed, (p.v.vec(i) - solid).norm());
    }
  }
  std::printf("speed %.5f of the corners', energy %.1e\n", speed / (6 * middle.norm()), residual(*s));
  EXPECT_LT(speed, 0.05 * 6 * middle.norm());
  EXPECT_LT(std::abs(residual(*s)), 1e-3);
}

// Two free bodies and the water between them in free flight: momentum and its moment.
TEST(WallGhosts, LoseNothingBetweenWaterAndBodies) {
  std::string afloat = deck("floating_box", {{"n", "6"}, {"gy", "0"}, {"weight", "0.5"}});
  const std::string held = "         1         7         7";
  ASSERT_NE(afloat.find(held), std::string::npos);
  afloat.replace(afloat.find(held), held.size(), "         1         3         4");
  const auto s = started(afloat);
  World& w = s->world();
  for (Index i = 0; i < w.particles.size(); ++i)
    w.particles.v.set(i, Vec(w.particles.v.vec(i) + Vec(0.2, -0.3, 0)));
  test::start_ledger(*s);
  const auto momentum = [&] {
    std::array<Real, 4> out{};
    const auto add = [&](const Vec& x, const Vec& mv, Real own) {
      out[0] += mv[0], out[1] += mv[1], out[2] += x.cross(mv)[2] + own, out[3] += mv.norm();
    };
    for (Index i = 0; i < w.particles.active; ++i)
      add(w.particles.x.vec(i), w.particles.m[i] * w.particles.v.vec(i), 0);
    for (const RigidBody& b : s->bodies()->bodies()) add(b.x, b.m * b.v, b.L[2]);
    return out;
  };
  const auto before = momentum();
  run(*s, 0.1);
  const auto after = momentum();
  std::printf("lost %.1e %.1e, turning %.1e, energy %.1e\n", (after[0] - before[0]) / after[3],
              (after[1] - before[1]) / after[3], (after[2] - before[2]) / (0.2 * after[3]), residual(*s));
  for (std::size_t k = 0; k < 2; ++k) EXPECT_LT(std::abs(after[k] - before[k]), 1e-12 * after[3]);
  EXPECT_LT(std::abs(after[2] - before[2]), 1e-12 * 0.2 * after[3]);
  EXPECT_LT(std::abs(residual(*s)), 0.01);
  EXPECT_GT(s->bodies()->bodies().back().v.norm(), 0.03);
}

TEST(WallGhosts, FloatBodiesAsDeepAsArchimedesSays) {
  const auto s = started(deck("floating_box", {}));
  const auto& b = s->bodies()->bodies().back();
  const Real start = b.x[1];
  Real sum = 0, turned = 0;
  int samples = 0;
  while (s->clock().t < 0.6) {
    s->step(test::do_nothing);
    if (s->clock().t < 0.3) continue;
    sum += b.x[1] - start, ++samples, turned = std::max(turned, std::abs(b.q.z()));
  }
  std::printf("%.2f %% too deep, turned %.4f, energy %.1e\n", -100 * sum / samples / 0.08, turned,
              residual(*s));
  EXPECT_LT(std::abs(sum / samples), 0.04 * 0.08);
  EXPECT_LT(std::abs(residual(*s)), 0.01);
}

// Drops see few ghosts, and these see few of them: what a ghost takes must be what it gives, to the last bit
// of its weights.
TEST(WallGhosts, KeepTheEnergyOfDrops) {
  for (const char* n : {"2", "3", "10"})
    for (const char* tssfac : {"0.5", "0.9"}) {
      const auto s = started(deck("falling_block", {{"n", n}, {"tssfac", tssfac}}));
      run(*s, 0.3);
      const Real lost = residual(*s), work = s->world().maxima["wall_ghost_work"] / s->world().energy.scale();
      std::printf("n %s, TSSFAC %s: energy %.1e, work of ghosts %.1e\n", n, tssfac, lost, work);
      EXPECT_LT(std::abs(lost), 0.02);
      EXPECT_LT(std::abs(work), 0.02);
    }
}

TEST(WallGhosts, GiveTheSameBitsOnAnyThreadsAndAfterARestart) {
  test::expect_same_bits(deck("floating_box", {{"n", "6"}, {"lift", "0.02"}}), 60, 25);
  test::expect_same_bits(deck("carried_box", {{"n", "8"}, {"omega", "3"}, {"a", "2"}}), 60, 25);
}

/// With a card before the end.
std::string with_card(std::string text, const std::string& card) {
  const std::size_t end = text.rfind("*END");
  text.insert(end == std::string::npos ? text.size() : end, card);
  return text;
}

// Half of a symmetric scene beside a symmetry plane is half of the whole scene: here water that is pushed
// down into the tip of a wedge, through which the plane goes.
TEST(WallGhosts, AreCopiedBehindSymmetryPlanes) {
  const Parameters at{{"n", "12"}, {"endtim", "0.1"}};
  Parameters half = at;
  half["left"] = "0";
  const auto whole = started(deck("wedge_tank", at));
  const auto part =
      started(with_card(deck("wedge_tank", half), "*BOUNDARY_SPH_SYMMETRY_PLANE\n0.0,0.0,0.0,1.0,0.0,0.0\n"));
  using Position = std::pair<long, long>;
  std::map<Position, Id> of_start;
  const auto key = [](const Vec& x) { return Position(std::lround(1e6 * x[0]), std::lround(1e6 * x[1])); };
  const auto stir = [](Simulation& s) {
    Particles& p = s.world().particles;
    for (Index i = 0; i < p.size(); ++i) p.v.set(i, Vec(2 * p.x.vec(i)[0], -2 * p.x.vec(i)[1], 0));
    test::start_ledger(s);
  };
  std::map<Id, Vec> start;
  for (Index i = 0; i < whole->world().particles.size(); ++i)
    of_start[key(whole->world().particles.x.vec(i))] = whole->world().particles.id[i];
  std::map<Id, Id> twin;
  for (Index i = 0; i < part->world().particles.size(); ++i) {
    const Particles& p = part->world().particles;
    twin[p.id[i]] = of_start.at(key(p.x.vec(i)));
    start[p.id[i]] = p.x.vec(i);
  }
  EXPECT_EQ(2 * twin.size(), of_start.size());
  stir(*whole), stir(*part);
  run(*whole, 0.1), run(*part, 0.1);
  std::map<Id, Vec> ends;
  for (Index i = 0; i < whole->world().particles.size(); ++i)
    ends[whole->world().particles.id[i]] = whole->world().particles.x.vec(i);
  Real apart = 0, moved = 0;
  for (Index i = 0; i < part->world().particles.size(); ++i) {
    const Particles& p = part->world().particles;
    apart = std::max(apart, (p.x.vec(i) - ends.at(twin.at(p.id[i]))).norm());
    moved = std::max(moved, (p.x.vec(i) - start.at(p.id[i])).norm());
  }
  std::printf("moved by %.2e m, apart by %.2e m, energy %.1e of half, %.1e\n", moved, apart, residual(*part),
              residual(*whole));
  EXPECT_GT(moved, 5e-3);
  // particles nearer to a plane than half a spacing are held off it (mirror_core.cpp); copies of ghosts that
  // had no mass were 7e-3 apart
  EXPECT_LT(apart, 1e-3 * moved);
  EXPECT_NEAR(residual(*part), residual(*whole), 5e-4);
  test::expect_same_bits(
      with_card(deck("wedge_tank", half), "*BOUNDARY_SPH_SYMMETRY_PLANE\n0.0,0.0,0.0,1.0,0.0,0.0\n"), 60, 25);
}

// A box afloat in space, a quarter of it between two symmetry planes.
TEST(WallGhosts, FloatAQuarterOfABoxInSpace) {
  const auto s = started(deck("floating_cube", {{"n", "4"}}));
  const auto& b = s->bodies()->bodies().back();
  const Real start = b.x[1];
  Real sum = 0;
  int samples = 0;
  while (s->clock().t < 0.5) {
    s->step(test::do_nothing);
    if (s->clock().t < 0.25) continue;
    sum += b.x[1] - start, ++samples;
  }
  std::printf("%.2f %% too deep, energy %.1e\n", -100 * sum / samples / 0.08, residual(*s));
  EXPECT_LT(std::abs(sum / samples), 0.05 * 0.08);
  EXPECT_LT(std::abs(residual(*s)), 0.01);
}

// Water at rest on a floor between periodic planes, or sliding along it: nothing shows where the planes are.
TEST(WallGhosts, GoOnBehindPeriodicPlanes) {
  for (const char* u : {"0", "0.5"}) {
    const auto s = started(deck("periodic_floor", {{"u", u}}));
    const Rest r = rest(*s, 0.1, 0.5, 0.8);
    const Particles& p = s->world().particles;
    Real across = 0;
    for (Index i = 0; i < p.size(); ++i)
      across = std::max(across, (p.v.vec(i) - Vec(std::stod(u), 0, 0)).norm());
    std::printf("u %s: rms %.2f %%, speed %.4f m/s, energy %.1e\n", u, 100 * r.rms, across, residual(*s));
    EXPECT_LT(r.rms, 0.01);
    EXPECT_LT(across, 0.01);
    EXPECT_LT(std::abs(residual(*s)), 0.01);
  }
}

// The force on the walls of a tank at rest is the weight of the water.
TEST(WallGhosts, CarryTheWeightOfTheWater) {
  const auto s =
      started(deck("carried_box", {{"n", "16"}, {"lid", "0"}, {"gy", "-9.81"}, {"diffusion", "0.1"}}));
  Vec sum = Vec::Zero();
  int samples = 0;
  while (s->clock().t < 0.5) {
    s->step(test::do_nothing);
    if (s->clock().t < 0.25) continue;
    for (const auto* wall : s->world().passes.all<WallForceReporter>())
      sum += wall->report(s->world()).on_surfa, ++samples;
  }
  const Real weight = rho0 * g * 0.24 * 0.16;
  std::printf("carried: %.4f of the weight, %.1e across\n", sum[1] / samples / weight,
              sum[0] / samples / weight);
  EXPECT_NEAR(sum[1] / samples, weight, 0.005 * weight);
  EXPECT_NEAR(sum[0] / samples, 0, 0.005 * weight);
}

}  // namespace wall_ghosts_test
