// Renormalised forms: their loops against the plain sum over all pairs, what they are exact for, and
// balances.
#include <gtest/gtest.h>

#include <cmath>

#include <fmt/format.h>
#include <Eigen/Eigenvalues>

#include "../app/small_scene.hpp"
#include "base/instruction_set.hpp"
#include "cloud.hpp"
#include "laws/strength/strength.hpp"
#include "sph/core/fields.hpp"
#include "sph/kernel/kernel.hpp"

namespace courant {
namespace {

using test::Cloud;

template <int Dim>
Vec gradient(const Vec& d, Real h) {
  const Real r = d.norm();
  if (r == 0) return Vec::Zero();
  return CubicSpline::C(Dim) * CubicSpline::slope(r / h) / (std::pow(h, Dim + 1) * r) * d;
}

template <int Dim>
Eigen::Matrix<Real, Dim, Dim> moment(const Particles& p, Index i) {
  Eigen::Matrix<Real, Dim, Dim> sum = Eigen::Matrix<Real, Dim, Dim>::Zero();
  for (Index j = 0; j < p.moving; ++j) {
    const Vec d = p.x.vec(i) - p.x.vec(j);
    const Vec grad = p.m[j] / p.rho[j] * gradient<Dim>(d, p.h[i]);
    sum -= d.head<Dim>() * grad.head<Dim>().transpose();
  }
  return sum;
}
/// A law for parts that count as solid, whose stress nobody looks at.
struct NoStrength : StrengthLaw {
  NoStrength() { ro = 1000; }
  void update(const PointBlock&) const override {}
  Real bulk_modulus() const override { return 9e5; }
  Real shear_modulus() const override { return 0; }
};

/// The least eigenvalue of a symmetric moment, by iteration; all are some 1.
template <int Dim>
Real least(const Eigen::Matrix<Real, Dim, Dim>& moment) {
  Matrix in_space = 10 * Matrix::Identity();
  in_space.topLeftCorner<Dim, Dim>() = moment;
  return Eigen::SelfAdjointEigenSolver<Matrix>(in_space, Eigen::EigenvaluesOnly).eigenvalues()[0];
}

/// B - 1 of particle i, less near surfaces.
template <int Dim>
Matrix excess(const Particles& p, Index i) {
  const auto M = moment<Dim>(p, i);
  Matrix out = Matrix::Zero();
  const Real eigenvalue = least(M);
  if (eigenvalue <= 0.6) return out;
  const Real share = std::min((eigenvalue - 0.6) / 0.2, 1.0);
  out.topLeftCorner<Dim, Dim>() = share * (M.inverse() - Eigen::Matrix<Real, Dim, Dim>::Identity());
  return out;
}

/// A cloud of disorder and the passes, of which the rates ran twice: so that B is the same before and after.
struct Flow : Cloud {
  explicit Flow(int dim, Real half_step = 0, bool reverse = false,
                const std::optional<Neighbours::Region>& region = {}, bool same_h = true)
      : Cloud(dim, dim == 2 ? 21 : 9, 0.01, 0.2) {
    settings.reverse_correction = reverse;
    settings.uniform_h = same_h;
    neighbours = std::make_shared<Neighbours>(neighbours->skin(), region);
    Particles& p = world.particles;
    std::mt19937 random(11);
    std::uniform_real_distribution<Real> u(-1, 1);
    for (Index i = 0; i < p.size(); ++i) {
      p.v.set(i, {u(random), u(random), dim == 3 ? u(random) : 0});
      p.p[i] = 1000 * u(random), p.rho[i] = 1000 + 100 * u(random), p.m[i] *= 1 + 0.1 * u(random);
      if (!same_h) p.h[i] *= 1 + 0.1 * u(random);
    }
    p.x.set(3, {1, 1, 0});  // far from all others
    add_renormalisation(settings, world, neighbours, make_pair_volumes(world));
    refresh();
    clock.dt_old = 2 * half_step;
    rates_again();
    rates_again();
    run(*world.passes.in_phase(Phase::forces, world).back());
  }
  void rates_again() {
    Particles& p = world.particles;
    for (Index i = 0; i < p.active; ++i) p.drhodt[i] = 0, p.f.set(i, Vec::Zero());
    run(*world.passes.in_phase(Phase::rates, world).back());
  }
};

template <int Dim>
void compare(Real half_step, bool reverse, const std::optional<Neighbours::Region>& region, bool same_h) {
  Flow flow(Dim, half_step, reverse, region, same_h);
  const Particles& p = flow.world.particles;
  std::vector<Matrix> B;
  for (Index i = 0; i < p.moving; ++i) B.push_back(i < p.active ? excess<Dim>(p, i) : Matrix(Matrix::Zero()));
  const auto of = [&](Index i) { return B[static_cast<std::size_t>(i)]; };
  Real most_f = 0, most_rate = 0;
  for (Index i = 0; i < p.active; ++i)
    most_f = std::max(most_f, p.f.vec(i).norm()), most_rate = std::max(most_rate, std::abs(p.drhodt[i]));
  for (Index i = 0; i < p.active; ++i) {
    Vec force = Vec::Zero();
    Real rate = 0;
    const Real Vi = p.m[i] / p.rho[i], h = p.h[i];
    for (Index j = 0; j < p.moving; ++j) {
      const Vec d = p.x.vec(i) - p.x.vec(j), u = p.v.vec(i) - p.v.vec(j);
      const Real Vj = p.m[j] / p.rho[j], s = 1e-9;
      if (j == i || d.norm() > 2.1 * std::max(h, p.h[j])) continue;
      const Vec grad = gradient<Dim>(d, h);
      const Vec change = (gradient<Dim>(d + s * u, h) - gradient<Dim>(d - s * u, h)) / (2 * s);
      rate += p.rho[i] * Vj * u.dot(of(i) * (grad - half_step * change));
      // each matrix with the gradient of the particle that it belongs to
      const Vec by_i = of(i) * grad, by_j = of(j) * gradient<Dim>(d, p.h[j]);
      force -= Vi * Vj * (reverse ? p.p[j] * by_i + p.p[i] * by_j : p.p[i] * by_i + p.p[j] * by_j);
    }
    EXPECT_NEAR(p.drhodt[i], rate, (half_step > 0 ? 1e-6 : 1e-11) * most_rate);
    for (int k = 0; k < Dim; ++k) EXPECT_NEAR(p.f.vec(i)[k], force[k], 1e-11 * most_f);
  }
}

class RenormalLoops : public testing::TestWithParam<InstructionSet> {};

TEST_P(RenormalLoops, GiveWhatTheSumOverAllPairsGives) {
  const InstructionSet before = instruction_set();
  use_instruction_set(GetParam());
  const Neighbours::Region box{Vec(-1, 0.024, -1), Vec(1, 0.051, 1)};
  for (const Real half_step : {0.0, 1e-4})
    for (const bool reverse : {false, true})
      for (const auto& region : {std::optional<Neighbours::Region>(), std::optional(box)})
        for (const bool same_h : {true, false}) {
          compare<2>(half_step, reverse, region, same_h);
          compare<3>(half_step, reverse, region, same_h);
        }
  use_instruction_set(before);
}

INSTANTIATE_TEST_SUITE_P(All, RenormalLoops, testing::ValuesIn(instruction_sets()),
                         [](const auto& set) { return std::string(name_of(set.param)); });

TEST(Renormalisation, ContinuityIsExactForLinearVelocities) {
  Flow flow(2);
  Particles& p = flow.world.particles;
  for (Index i = 0; i < p.size(); ++i) {
    const Vec x = p.x.vec(i);
    p.v.set(i, {3 * x[0] - 2 * x[1], x[0] + 0.5 * x[1], 0});
  }
  flow.rates_again();
  int exact = 0, left_out = 0;
  for (Index i = 0; i < p.active; ++i) {
    Real plain = 0;
    for (Index j = 0; j < p.active; ++j)
      plain += p.rho[i] * p.m[j] / p.rho[j] *
               (p.v.vec(i) - p.v.vec(j)).dot(gradient<2>(p.x.vec(i) - p.x.vec(j), p.h[i]));
    const Real eigenvalue = least(moment<2>(p, i));
    left_out += eigenvalue <= 0.6 ? 1 : 0;
    if (eigenvalue < 0.8) continue;
    EXPECT_NEAR(plain + p.drhodt[i], -3.5 * p.rho[i], 1e-9 * p.rho[i]);
    ++exact;
  }
  EXPECT_GT(exact, 200);
  EXPECT_GT(left_out, 20);
  EXPECT_EQ(flow.world.counters.at("renormalisation_left_out"), left_out);
}

/// Particles move between two looks: the density changes by the mean of the matrices before and after, as it
/// does over a step from the one to the other.
TEST(Renormalisation, ContinuityTakesTheMeanOfTheMatricesBeforeAndAfter) {
  Flow flow(2);
  Particles& p = flow.world.particles;
  std::vector<Matrix> before;
  for (Index i = 0; i < p.active; ++i) before.push_back(excess<2>(p, i));
  std::mt19937 random(5);
  std::uniform_real_distribution<Real> u(-5e-4, 5e-4);  // lists hold until 0.0015
  for (Index i = 0; i < p.active; ++i) p.x.add(i, {u(random), u(random), 0});
  flow.rates_again();
  Real most = 0, most_apart = 0;
  for (Index i = 0; i < p.active; ++i) most = std::max(most, std::abs(p.drhodt[i]));
  for (Index i = 0; i < p.active; ++i) {
    const Matrix after = excess<2>(p, i), mean = 0.5 * (before[static_cast<std::size_t>(i)] + after);
    Real rate = 0, of_after = 0;
    for (Index j = 0; j < p.active; ++j) {
      const Vec slope = p.rho[i] * p.m[j] / p.rho[j] * gradient<2>(p.x.vec(i) - p.x.vec(j), p.h[i]);
      const Vec v = p.v.vec(i) - p.v.vec(j);
      rate += v.dot(mean * slope), of_after += v.dot(after * slope);
    }
    EXPECT_NEAR(p.drhodt[i], rate, 1e-11 * most) << i;
    most_apart = std::max(most_apart, std::abs(rate - of_after));
  }
  EXPECT_GT(most_apart, 1e-3 * most);
}

// Strain and spin of particles with strength: of a body that turns and stretches, at its surface, too.
TEST(Renormalisation, StrainAndSpinAreExactForLinearVelocities) {
  for (const int dim : {2, 3}) {
    Cloud cloud(dim, dim == 2 ? 15 : 7, 0.01, 0.2);
    Particles& p = cloud.world.particles;
    Matrix L = Matrix::Zero();
    L << 3, -7, 2, 5, -0.5, -4, 1, 6, -2;
    if (dim == 2) L.row(2).setZero(), L.col(2).setZero();
    for (Index i = 0; i < p.size(); ++i) p.v.set(i, L * p.x.vec(i));
    cloud.settings.renormalised = true;
    cloud.settings.spacing_of_part = {0.01};
    cloud.settings.strength = {std::make_shared<NoStrength>()};
    add_sph_passes(cloud.world, cloud.settings, cloud.neighbours, nullptr);
    cloud.refresh();
    for (BlockPass* pass : cloud.world.passes.in_phase(Phase::rates, cloud.world)) cloud.run(*pass);
    const Vec spin = 0.5 * Vec(L(2, 1) - L(1, 2), L(0, 2) - L(2, 0), L(1, 0) - L(0, 1));
    int exact = 0;
    for (Index i = 0; i < p.active; ++i) {
      const Real eigenvalue = dim == 2 ? least(moment<2>(p, i)) : least(moment<3>(p, i));
      if (eigenvalue < 0.2) continue;
      EXPECT_LT((sph_fields::strain_rate(p).tensor(i) - 0.5 * (L + L.transpose())).norm(), 1e-8) << i;
      EXPECT_LT((sph_fields::spin(p).vec(i) - spin).norm(), 1e-8) << i;
      ++exact;
    }
    EXPECT_GT(exact, 0.8 * p.active);
  }
}

TEST(Renormalisation, KeepsMomentumAndGivesBackTheWorkOfPressure) {
  Flow flow(2);
  const Particles& p = flow.world.particles;
  Vec force = Vec::Zero();
  Real size = 0, power = 0, stored = 0;
  for (Index i = 0; i < p.active; ++i) {
    force += p.f.vec(i), size += p.f.vec(i).norm(), power += p.f.vec(i).dot(p.v.vec(i));
    stored += p.p[i] * p.m[i] / (p.rho[i] * p.rho[i]) * p.drhodt[i];
  }
  EXPECT_LT(force.norm(), 1e-12 * size);
  EXPECT_NEAR(power + stored, 0, 1e-11 * size);
}

TEST(Renormalisation, ReversedKeepsMomentum) {
  Flow flow(2, 0, true);
  const Particles& p = flow.world.particles;
  Vec force = Vec::Zero();
  Real size = 0;
  for (Index i = 0; i < p.active; ++i) force += p.f.vec(i), size += p.f.vec(i).norm();
  EXPECT_GT(size, 0);
  EXPECT_LT(force.norm(), 1e-12 * size);
}

/// Largest error of the force on a particle inside where a linear pressure is 0, of its right value: there
/// the sum of B grad W, which has to be small by itself, does not matter.
Real error_of_linear_pressure(bool reverse) {
  Flow flow(2, 0, reverse);
  Particles& p = flow.world.particles;
  const Vec slope{1e5, -3e4, 0};
  Real most = 0;
  for (Index k = 0; k < p.active; k += 7) {
    if (least(moment<2>(p, k)) < 0.95) continue;
    const Vec x = p.x.vec(k);
    for (Index i = 0; i < p.size(); ++i) p.p[i] = slope.dot(p.x.vec(i) - x), p.f.set(i, Vec::Zero());
    flow.run(*flow.world.passes.in_phase(Phase::forces, flow.world).back());
    Vec force = p.f.vec(k) * p.rho[k] / p.m[k];
    for (Index j = 0; j < p.active; ++j)
      force -= p.m[j] / p.rho[j] * p.p[j] * gradient<2>(x - p.x.vec(j), p.h[k]);
    most = std::max(most, (force + slope).norm() / slope.norm());
  }
  EXPECT_GT(most, 0);
  return most;
}

TEST(Renormalisation, ReversedIsExactForLinearPressures) {
  EXPECT_LT(error_of_linear_pressure(true), 1e-9);
  EXPECT_GT(error_of_linear_pressure(false), 1e-2);
}

/// Rates of a corrected form, forces of a plain one: so momentum and angular momentum are kept.
TEST(Renormalisation, LeavesPressureForcesPlainWhereAskedTo) {
  const auto first_step = [](const std::string& control, const std::string& cards) {
    test::SmallScene scene;
    scene.n = 10, scene.control_sph = control;
    scene.extra = "*COURANT_DENSITY_DIFFUSION\n0.1\n" + cards + "*INITIAL_VELOCITY_NODE\n";
    for (int node = 1; node <= 100; ++node)
      scene.extra +=
          fmt::format("{},{},{},0.\n", node, -0.02 * (node / 10) * (node % 10), 0.03 * (node % 10));
    auto s = test::build(scene);
    Particles& p = s->world().particles;
    for (Index i = 0; i < p.size(); ++i) p.rho[i] *= 1 + 1e-3 * std::sin(double(p.id[i]));
    std::string who;
    s->evaluate(who);
    return s;
  };
  const auto only_rates = first_step(",0,1", "*COURANT_RENORMALISATION\n0,1\n"), plain = first_step("", ""),
             both = first_step(",0,1", "");
  const Particles &a = only_rates->world().particles, &b = plain->world().particles,
                  &c = both->world().particles;
  Real forces = 0, rates = 0;
  for (Index i = 0; i < a.active; ++i) {
    EXPECT_EQ(a.f.vec(i), b.f.vec(i)) << a.id[i];
    EXPECT_EQ(a.drhodt[i], c.drhodt[i]) << a.id[i];
    forces = std::max(forces, (a.f.vec(i) - c.f.vec(i)).norm()),
    rates = std::max(rates, std::abs(a.drhodt[i] - b.drhodt[i]));
  }
  EXPECT_GT(forces, 1);
  EXPECT_GT(rates, 1);
}

// Water is drawn through a box; particles beside it keep their state and are not corrected, and what they do
// to those inside is work from outside.
TEST(Renormalisation, GoesThroughABoxAndCountsTheWork) {
  for (const bool reverse : {false, true}) {
    test::SmallScene scene;
    scene.n = 12, scene.start = "2.,0.,0.", scene.box = "1", scene.control_sph = ",0,1";
    scene.timestep = "0,0.1";
    scene.eos = "*EOS_LINEAR_POLYNOMIAL\n1,0.,1.E5\n";
    scene.extra = "*DEFINE_BOX\n1,0.55,1.15,-1.,5.,-1.,1.\n*INITIAL_VELOCITY_NODE\n";
    for (const int node : {67, 68, 69, 79, 80, 81}) scene.extra += fmt::format("{},-2.,0.,0.\n", node);
    if (reverse) scene.extra += "*COURANT_RENORMALISATION\n1\n*COURANT_DENSITY_DIFFUSION\n0.1\n";
    const auto s = test::build(scene);
    ASSERT_TRUE(s);
    EnergyLedger e;
    while (s->clock().t < 0.1)
      s->step([&](World&, const Clock&, const std::string& who) { e = s->sample(who).energy; });
    Particles& p = s->world().particles;
    const Field<Real>& correction = sph_fields::renormalisation(p);
    int corrected = 0, left = 0;
    for (Index i = 0; i < p.size(); ++i) {
      if (i < p.active) corrected += correction.tensor(i).norm() > 1e-3 ? 1 : 0;
      if (i < p.active) continue;
      EXPECT_EQ(correction.tensor(i).norm(), 0) << p.id[i];
      left += p.x.vec(i)[0] > 1.15 ? 1 : 0;
    }
    EXPECT_GT(corrected, 20);
    EXPECT_GT(left, 12);
    EXPECT_GT(e.dissipated, 0);
    // reversed ones lose some themselves
    EXPECT_LT(std::abs(e.residual()), (reverse ? 0.06 : 0.02) * e.dissipated);
  }
}

std::string form(int number) {
  return fmt::format(",0,{}", number);
}

/// Positions after some steps of a drop of water on a mirror.
std::vector<Vec> places(int number, const std::string& more = "") {
  test::SmallScene scene;
  scene.n = 10, scene.control_sph = form(number), scene.start = "0.3,-1.,0.";
  scene.extra = "*BOUNDARY_SPH_SYMMETRY_PLANE\n0.,0.,0.,0.,1.,0.\n" + more;
  const auto s = test::build(scene);
  if (!s) return {};
  EnergyLedger e;
  while (s->clock().t < 0.05)
    s->step([&](World&, const Clock&, const std::string& who) { e = s->sample(who).energy; });
  const Particles& p = s->world().particles;
  std::vector<Vec> out(static_cast<std::size_t>(p.size()));
  for (Index i = 0; i < p.size(); ++i) out[static_cast<std::size_t>(p.id[i] - 1)] = p.x.vec(i);
  EXPECT_LT(std::abs(e.residual()), 0.06 * e.initial) << number;
  return out;
}

TEST(Form, PlainOnesAndCorrectedOnesAreTheSameAmongThemselves) {
  const std::vector<Vec> plain = places(0), corrected = places(1);
  for (const int number : {2, 5, 15}) EXPECT_EQ(places(number), plain) << number;
  for (const int number : {3, 6, 16}) EXPECT_EQ(places(number), corrected) << number;
  Real most = 0;
  for (std::size_t i = 0; i < plain.size(); ++i) most = std::max(most, (plain[i] - corrected[i]).norm());
  EXPECT_GT(most, 1e-3);
  EXPECT_LT(most, 0.05);
  EXPECT_EQ(places(1, "*COURANT_RENORMALISATION\n0\n"), corrected);
  const std::string diffusion = "*COURANT_DENSITY_DIFFUSION\n0.1\n";
  const auto only_rates = places(1, "*COURANT_RENORMALISATION\n0,1\n" + diffusion);
  EXPECT_NE(only_rates, places(1, diffusion));
  EXPECT_NE(only_rates, places(0, diffusion));
  EXPECT_NE(places(1, "*COURANT_RENORMALISATION\n1\n*COURANT_DENSITY_DIFFUSION\n0.1\n"),
            places(1, "*COURANT_DENSITY_DIFFUSION\n0.1\n"));
}

}  // namespace
}  // namespace courant
