// *COURANT_RIEMANN: its loops against the plain sum over all pairs, balances, and what it does to water.
#include <gtest/gtest.h>

#include <cmath>

#include <fmt/format.h>

#include "base/instruction_set.hpp"
#include "checkerboard_tank.hpp"
#include "cloud.hpp"
#include "sph/core/fields.hpp"
#include "sph/kernel/kernel.hpp"

namespace courant {
namespace {

using test::run;

using test::Cloud;

/// States of two particles, and what Zhang, Hu and Adams make of them.
struct Pair {
  Real rho_i, rho_j, c_i, c_j, p_i, p_j;
  Real u_l, u_r;  ///< velocities from i towards j
  Real rho() const { return 0.5 * (rho_i + rho_j); }
  Real c() const { return 0.5 * (c_i + c_j); }
  Real pressure(Real eta) const {
    const Real beta = eta > 0 ? std::min(eta * std::max(u_l - u_r, Real(0)) / c(), Real(1)) : 1;
    return 0.5 * (p_i + p_j) + 0.5 * rho() * c() * beta * std::max(u_l - u_r, Real(0));
  }
  Real velocity() const { return 0.5 * (u_l + u_r) + (p_i - p_j) / (2 * rho() * c()); }
};

struct Flux {
  Vec force = Vec::Zero();
  Real density = 0, heat = 0, decay = 0;
};

/// 2 sum V_j (...) of p* and u* for particle i, with pressures less those of gravity in u*; less plain sums.
/// u* has the mean velocity where a pressure is cut off.
template <int Dim>
Flux oracle(const Particles& p, const std::vector<Real>& c, const Vec& gravity, Real eta, Real pc, Index i) {
  Flux out;
  const Real Vi = p.m[i] / p.rho[i];
  for (Index j = 0; j < p.moving; ++j) {
    const Vec d = p.x.vec(i) - p.x.vec(j);
    const Real r = d.norm(), h = p.h[i], Vj = p.m[j] / p.rho[j];
    if (j == i || r == 0 || r >= 2 * h) continue;
    const Vec e = d / r, v = p.v.vec(i) - p.v.vec(j);
    const Vec grad = CubicSpline::C(Dim) * CubicSpline::slope(r / h) / std::pow(h, Dim + 1) * e;
    const auto id = [&](Index k) { return static_cast<std::size_t>(p.id[k] - 1); };
    const Pair pair{p.rho[i], p.rho[j], c[id(i)],           c[id(j)],
                    p.p[i],   p.p[j],   -p.v.vec(i).dot(e), -p.v.vec(j).dot(e)};
    const Vec force = -2 * Vi * Vj * pair.pressure(eta) * grad + Vi * Vj * (p.p[i] + p.p[j]) * grad;
    out.force += force;
    out.heat -= 0.5 * force.dot(v);
    if (p.p[i] <= pc || p.p[j] <= pc) continue;
    Pair still = pair;  // of u*, what pressures beside those of gravity do
    still.p_i -= pair.rho() * gravity.dot(p.x.vec(i)), still.p_j -= pair.rho() * gravity.dot(p.x.vec(j));
    const Vec mean = 0.5 * (p.v.vec(i) + p.v.vec(j));
    const Vec star = mean - (still.velocity() - 0.5 * (pair.u_l + pair.u_r)) * e;
    out.density += 2 * p.rho[i] * Vj * (p.v.vec(i) - star).dot(grad) - p.rho[i] * Vj * v.dot(grad);
    out.decay += p.rho[i] * pair.c_i * pair.c_i * Vj / (pair.rho() * pair.c()) * grad.norm();
  }
  return out;
}

/// A cloud of disorder and the two passes.
struct RiemannCloud : Cloud {
  RiemannCloud(int dim, Real eta, std::optional<Neighbours::Region> region = {}, Real pc = -1e20)
      : Cloud(dim, dim == 2 ? 21 : 9, 0.01, 0.25), c(static_cast<std::size_t>(world.particles.size())) {
    Particles& p = world.particles;
    settings.viscosity = RiemannFlux{eta > 0 ? eta : 1e30, pc};
    neighbours = std::make_shared<Neighbours>(neighbours->skin(), region);
    std::mt19937 random(11);
    std::uniform_real_distribution<Real> u(-1, 1);
    for (Index i = 0; i < p.size(); ++i) {
      p.v.set(i, {6 * u(random), 6 * u(random), dim == 3 ? 6 * u(random) : 0});
      p.p[i] = std::max(1000 * u(random), pc), p.rho[i] = 1000 + 200 * u(random),
      p.m[i] *= 1 + 0.3 * u(random);
      c[static_cast<std::size_t>(i)] = 30 + 5 * u(random);
    }
    p.x.set(3, p.x.vec(4));  // two particles in one position
    add_riemann(settings, world, neighbours, make_pair_volumes(world));
    refresh();
    for (Index i = 0; i < p.moving; ++i) {
      sph_fields::viscous_speed(p)[i] = c[static_cast<std::size_t>(p.id[i] - 1)];
      sph_fields::potential(p)[i] = -gravity.dot(p.x.vec(i));
      p.f.set(i, Vec::Zero());
    }
    run(*world.passes.in_phase(Phase::rates, world).back());
    run(*world.passes.in_phase(Phase::forces, world).back());
  }
  Vec gravity{300, -2000, 0};
  std::vector<Real> c;  ///< by id
};

template <int Dim>
void compare(Real eta, std::optional<Neighbours::Region> region, Real pc) {
  RiemannCloud flow(Dim, eta, region, pc);
  Particles& p = flow.world.particles;
  Real force = 0, rate = 0, heat = 0, decay = 0;
  std::vector<Flux> expected;
  for (Index i = 0; i < p.active; ++i) {
    expected.push_back(oracle<Dim>(p, flow.c, flow.gravity, eta, pc, i));
    force = std::max(force, expected.back().force.norm()), heat = std::max(heat, expected.back().heat);
    rate = std::max(rate, std::abs(expected.back().density));
    decay = std::max(decay, expected.back().decay);
  }
  for (Index i = 0; i < p.active; ++i) {
    const Flux& e = expected[static_cast<std::size_t>(i)];
    for (int k = 0; k < Dim; ++k) EXPECT_NEAR(p.f.vec(i)[k], e.force[k], 1e-12 * force);
    EXPECT_NEAR(sph_fields::dissipation(p)[i], e.heat, 1e-12 * heat);
    EXPECT_NEAR(sph_fields::density_diffusion(p)[i], e.density, 1e-11 * rate);
  }
  EXPECT_NEAR(flow.world.passes.all<TimeLimit>().back()->limit(flow.world, {}).dt, 1.25 / decay,
              1e-12 / decay);
}

class RiemannLoops : public testing::TestWithParam<InstructionSet> {};

TEST_P(RiemannLoops, GiveWhatTheSumOverAllPairsGives) {
  const InstructionSet before = instruction_set();
  use_instruction_set(GetParam());
  const Neighbours::Region box{Vec(-1, 0.024, -1), Vec(1, 0.051, 1)};
  for (const Real eta : {0.0, 3.0})
    for (const auto& region : {std::optional<Neighbours::Region>(), std::optional(box)}) {
      SCOPED_TRACE(testing::Message() << "eta " << eta << ", box " << region.has_value());
      for (const Real pc : {-1e20, 0.0}) {
        compare<2>(eta, region, pc);
        compare<3>(eta, region, pc);
      }
    }
  use_instruction_set(before);
}

INSTANTIATE_TEST_SUITE_P(All, RiemannLoops, testing::ValuesIn(instruction_sets()),
                         [](const auto& set) { return std::string(name_of(set.param)); });

TEST(Riemann, KeepsMomentumAndVolumeAndTurnsWhatItTakesIntoHeat) {
  RiemannCloud flow(2, 3);
  Particles& p = flow.world.particles;
  Vec force = Vec::Zero();
  Real power = 0, heat = 0, size = 0, volume = 0, rates = 0;
  for (Index i = 0; i < p.active; ++i) {
    force += p.f.vec(i), size += p.f.vec(i).norm(), power += p.f.vec(i).dot(p.v.vec(i));
    heat += sph_fields::dissipation(p)[i];
    const Real change = p.m[i] / (p.rho[i] * p.rho[i]) * sph_fields::density_diffusion(p)[i];
    volume += change, rates += std::abs(change);
  }
  EXPECT_LT(force.norm(), 1e-12 * size);
  EXPECT_LT(std::abs(volume), 1e-12 * rates);
  EXPECT_GT(heat, 0);
  EXPECT_NEAR(heat, -power, 1e-12 * heat);
}

/// Water `columns` x `rows` of spacing 0.1, c0 = 20, between mirrors left, right and below, with the velocity
/// u to the left.
std::string water(int columns, int rows, Real u, const std::string& more) {
  std::string text = fmt::format(
      "*KEYWORD\n*CONTROL_TERMINATION\n50.\n*CONTROL_TIMESTEP\n0,0.6\n*CONTROL_SPH\n1,0,1e20,2\n0,0,0,0,0,0,"
      "0\n"
      "*PART\nwater\n1,1,1,1,1\n*SECTION_SPH\n1,1.2,1,1\n*MAT_NULL\n1,1000.0\n*EOS_LINEAR_POLYNOMIAL\n1,0,"
      "4e5\n\n"
      "*HOURGLASS\n1,0,0,0,1e-20,1e-20\n*INITIAL_VELOCITY\n0\n{},0.,0.\n"
      "*BOUNDARY_SPH_SYMMETRY_PLANE\n0,0,0,0,1,0\n0,0,0,1,0,0\n",
      -u);
  std::string elements = "*ELEMENT_SPH\n";
  text += more + "*NODE\n";
  for (int k = 0; k < columns * rows; ++k) {
    text +=
        fmt::format("{},{:.17g},{:.17g},0\n", k + 1, 0.1 * (k % columns) + 0.05, 0.1 * (k / columns) + 0.05);
    elements += fmt::format("{},1,10.0\n", k + 1);
  }
  return text + elements;
}

/// With a TSSFAC for this scheme.
std::unique_ptr<Simulation> tank(const std::string& more, Real noise) {
  return test::checkerboard_tank("*CONTROL_TIMESTEP\n0,0.6\n" + more, noise);
}

const std::string riemann_on = "*COURANT_RIEMANN\n";

TEST(Riemann, LeavesTheHydrostaticPressureAlone) {
  const auto s = tank(riemann_on + "\n", 0);
  run(*s, 2);
  const Particles& p = s->world().particles;
  Real top = 0;
  for (Index i = 0; i < p.active; ++i) {
    top = std::max(top, p.x.vec(i)[1]);
    EXPECT_NEAR(p.rho[i], 1000 + (9810 * (1 - p.x.vec(i)[1])) / 400, 2.5);  // rho g dx / c^2
  }
  EXPECT_NEAR(top, 0.95, 0.02);
}

TEST(Riemann, EvensOutACheckerboardOfPressuresAndCountsIt) {
  const auto with = tank(riemann_on + "3.\n", 500), without = tank("", 500);
  run(*with, 0.03), run(*without, 0.03);  // five times h/c
  EXPECT_LT(test::roughness(*with), 0.05 * test::roughness(*without));
  EnergyLedger e;
  while (with->clock().t < 0.5)
    with->step([&](World&, const Clock&, const std::string& who) { e = with->sample(who).energy; });
  EXPECT_GT(e.dissipated, 0);
  EXPECT_LT(std::abs(e.residual()), 0.03 * e.dissipated);
}

// Behind a shock at the wall p = rho0 c0 u (1 + u/c0 + ..): mass and momentum with p = c0^2 (rho - rho0).
TEST(Riemann, WaterThatHitsAWallStopsBehindAShock) {
  const Real u = 1;
  const auto s = test::build_deck(
      water(60, 8, u, riemann_on + "3.\n*BOUNDARY_SPH_SYMMETRY_PLANE\n0,0.8,0,0,0,0\n") + "*END\n");
  EnergyLedger e;
  while (s->clock().t < 0.15)  // the shock is near 2.9
    s->step([&](World&, const Clock&, const std::string& who) { e = s->sample(who).energy; });
  const Particles& p = s->world().particles;
  Real pressure = 0, speed = 0;
  int n = 0;
  for (Index i = 0; i < p.active; ++i) {
    if (p.x.vec(i)[0] > 1.5 || p.x.vec(i)[0] < 0.3) continue;
    pressure += p.p[i], speed += p.v.vec(i)[0], ++n;
  }
  // U (rho - rho0) = rho0 u with the wall at rest, rho0 (U + u) u = p, p = c0^2 (rho - rho0)
  const Real U = 0.5 * (std::sqrt(u * u + 4 * 400) - u);
  EXPECT_NEAR(pressure / n, 1000 * (U + u) * u, 0.01 * 1000 * 20 * u);
  EXPECT_NEAR(speed / n, 0, 0.01 * u);
  EXPECT_GT(e.dissipated, 0);
  EXPECT_LT(std::abs(e.residual()), 0.01 * 0.5 * 480 * 10 * u * u);
}

// What particles beyond the box, which keep their state, do to those inside counts as work from outside.
TEST(Riemann, CountsTheWorkAcrossABox) {
  test::SmallScene scene;
  scene.n = 12, scene.start = "2.,0.,0.", scene.box = "1";
  scene.timestep = "0,0.5";
  scene.eos = "*EOS_LINEAR_POLYNOMIAL\n1,0.,1.E5\n";
  scene.extra = riemann_on + "0.\n*DEFINE_BOX\n1,0.55,2.,-1.,5.,-1.,1.\n" +
                "*INITIAL_VELOCITY_NODE\n67,-2.,0.,0.\n68,-2.,0.,0.\n69,-2.,0.,0.\n79,-2.,0.,0.\n80,-2.,0.,0."
                "\n81,-2.,0.,0.\n";
  const auto s = test::build(scene);
  ASSERT_TRUE(s);
  EnergyLedger e;
  while (s->clock().t < 0.1)
    s->step([&](World&, const Clock&, const std::string& who) { e = s->sample(who).energy; });
  EXPECT_GT(e.dissipated, 0);
  EXPECT_LT(std::abs(e.residual()), 0.1 * e.dissipated);  // falls with the step; without that work 0.57
}

TEST(Riemann, WithNegativeLimiterIsNotThere) {
  const auto a = tank("*COURANT_RIEMANN\n-1.\n", 500), b = tank("", 500);
  run(*a, 0.05), run(*b, 0.05);
  for (Index i = 0; i < 100; ++i) EXPECT_EQ(a->world().particles.x.vec(i), b->world().particles.x.vec(i));
  EXPECT_EQ(a->passes(), b->passes());
}

TEST(Riemann, WarnsOfViscosityThatIsNotUsed) {
  test::SmallScene scene;
  scene.extra = riemann_on + "3.\n";
  std::string text = scene.text();
  Diagnostics diagnostics;
  auto s = Simulation::build("deck.k", in_memory(text), diagnostics);
  ASSERT_TRUE(s) << diagnostics.text();
  EXPECT_NE(diagnostics.text().find("*HOURGLASS"), std::string::npos) << diagnostics.text();
}

// Particles that crowd, as at a wall of shells, exchange mass faster than a lattice does; a step of 0.6 h/c,
// which is stable on a lattice, made a checkerboard of theirs grow.
TEST(Riemann, StepsAreAsShortAsCrowdedParticlesAsk) {
  std::string who;
  const auto step = [&](int copies) {
    const auto s = test::checkerboard_tank(riemann_on + "3.\n*CONTROL_TIMESTEP\n0,0.9\n", 0, 0, copies);
    s->evaluate(who);
    return s->clock().dt;
  };
  const Real lattice = step(1);
  EXPECT_NEAR(lattice, 0.64 * 0.12 / 20, 0.01 * 0.12 / 20);
  EXPECT_NEAR(step(2), lattice / 2, 0.01 * lattice);
  EXPECT_EQ(who, "Riemann flux");

  const auto crowded = test::checkerboard_tank(riemann_on + "3.\n*CONTROL_TIMESTEP\n0,0.9\n", 500, 0, 2);
  crowded->evaluate(who);
  const Real before = test::roughness(*crowded);
  run(*crowded, 0.03);
  EXPECT_LT(test::roughness(*crowded), 0.05 * before);
}

}  // namespace
}  // namespace courant
