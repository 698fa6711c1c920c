// The pair loops of every instruction set against the plain double sum over all pairs, equation by equation.
#include <gtest/gtest.h>

#include <cmath>

#include "base/instruction_set.hpp"
#include "cloud.hpp"
#include "sph/core/fields.hpp"
#include "sph/kernel/kernel.hpp"

using namespace courant;
using courant::test::Cloud;

namespace {

struct Terms {
  int dim;
  bool uniform_h, monaghan, stress, keep_gradients;
  KernelChoice kernel = KernelChoice::cubic_spline;
  bool windows = false;  ///< gradients as they are kept over steps
  bool rounded = false;  ///< the sum over all pairs is that of numbers rounded as windows keep them; the step
                         ///< compared is a later one of the window
  bool quadratic = true;  ///< viscosity has its quadratic part
  bool diffusing = true;  ///< density diffuses
  Real tolerance() const { return windows && !rounded ? 1e-4 : 1e-12; }
  /// Of what factors of windows enter.
  Real factor_tolerance() const { return windows && !rounded ? 4e-3 : 1e-12; }
  Real q2() const { return quadratic ? 1.5 : 1e-20; }
};

/// What the passes must give for particle i, from eqs 6, 7, 12, 15-17.
struct Expected {
  Real drhodt = 0, heat = 0, diffusion = 0;
  Vec f = Vec::Zero();
  Matrix D = Matrix::Zero();
};

/// grad_i W(x_i - x_j, h) / (x_i - x_j)
template <int Dim>
Real gradient(KernelChoice choice, Real r, Real h) {
  return with_kernel(choice, [&](auto kernel) {
    using Kernel = decltype(kernel);
    return Kernel::C(Dim) * Kernel::slope(r / h) / (std::pow(h, Dim + 1) * r);
  });
}

/// To the nearest number of single precision whose last 16 bits are 0.
Real rounded_to_float16(Real x) {
  int exponent;
  const Real mantissa = std::frexp(static_cast<float>(x), &exponent);  // 0.5 to 1
  return std::ldexp(std::floor(256 * mantissa + 0.5), exponent - 8);
}

template <int Dim>
class Oracle {
 public:
  Oracle(const Cloud& cloud, const Terms& c)
      : cloud_(cloud),
        p_(cloud.world.particles),
        case_(c),
        tau_(dynamic_cast<const Field<Real>*>(p_.fields.find("stress"))) {}

  Expected of(Index i) const {
    Expected e;
    for (Index j = 0; j < p_.moving; ++j) {
      const Vec d = p_.x.vec(i) - p_.x.vec(j);
      const Real r = d.norm();
      if (j == i || r == 0) continue;
      const Real gi = gradient<Dim>(case_.kernel, r, p_.h[i]), gj = gradient<Dim>(case_.kernel, r, p_.h[j]);
      if (gi == 0 && gj == 0) continue;  // every term has one of them; spares most of the time
      if (case_.rounded) {
        add_rounded(i, j, d, gi, e);
        continue;
      }
      const Vec u = p_.v.vec(i) - p_.v.vec(j);
      const Real Vj = p_.m[j] / p_.rho[j];
      e.drhodt += p_.rho[i] * Vj * u.dot(d) * gi;
      e.D -= 0.5 * Vj * gi * (u * d.transpose() + d * u.transpose());
      e.diffusion -= 2 * delta * p_.h[i] / p_.c[i] * Vj *
                     (p_.p[j] - p_.p[i] + p_.rho[i] * gravity().dot(p_.x.vec(i) - p_.x.vec(j))) * gi;
      const Real mm = p_.m[i] * p_.m[j] / (p_.rho[i] * p_.rho[j]);
      e.f -= mm * (p_.p[i] * gi + p_.p[j] * gj) * d;
      if (case_.monaghan) {
        const Real h = 0.5 * (p_.h[i] + p_.h[j]), rho = 0.5 * (p_.rho[i] + p_.rho[j]);
        const Real c = 0.5 * (p_.c[i] + p_.c[j]);
        const Real phi = u.dot(d) < 0 ? h * u.dot(d) / (r * r + 0.01 * h * h) : 0;
        const Real Pi = (-0.1 * c * phi + case_.q2() * phi * phi) / rho;
        const Vec force = p_.m[i] * p_.m[j] * Pi * 0.5 * (gi + gj) * d;
        e.f -= force;
        e.heat += 0.5 * force.dot(u);
      }
      if (case_.stress) e.f += mm * (tau_->tensor(i) * gi + tau_->tensor(j) * gj) * d;
    }
    return e;
  }
  static constexpr Real delta = 0.1;
  static Vec gravity() { return {300, -2000, Dim == 3 ? 500.0 : 0.0}; }

 private:
  /// The pair's part of `of` as windows keep it: the gradient in units of a 32767th of the steepest, the
  /// factors of viscosity and diffusion with eight significant bits. g: (dW/dr)/r.
  void add_rounded(Index i, Index j, const Vec& d, Real g, Expected& e) const {
    const Real h = p_.h[i], r2 = d.squaredNorm();
    const Real unit = with_kernel(case_.kernel, [&](auto kernel) {
      using Kernel = decltype(kernel);
      return -Kernel::C(Dim) * Kernel::slope(Kernel::steepest) / (std::pow(h, Dim + 1) * 32767);
    });
    Vec G;
    for (int k = 0; k < 3; ++k) G[k] = unit * std::round(g * d[k] / unit);
    const Vec u = p_.v.vec(i) - p_.v.vec(j);
    const Real s = u.dot(G), Vi = p_.m[i] / p_.rho[i], Vj = p_.m[j] / p_.rho[j];
    e.drhodt += p_.rho[i] * Vj * s;
    e.D -= 0.5 * Vj * (u * G.transpose() + G * u.transpose());
    const Real gh2 = rounded_to_float16(-g / unit * h) * unit / h;  // of -(dW/dr)/r
    e.diffusion += 2 * delta * h / p_.c[i] * Vj * gh2 *
                   (p_.p[j] - p_.p[i] + p_.rho[i] * gravity().dot(p_.x.vec(i) - p_.x.vec(j)));
    e.f -= Vi * Vj * (p_.p[i] + p_.p[j]) * G;
    if (case_.stress) e.f += Vi * Vj * (tau_->tensor(i) + tau_->tensor(j)) * G;
    if (!case_.monaghan || s <= 0) return;
    const Real mV = std::exp2(std::floor(std::log2(p_.m[0] * p_.m[0] / p_.rho[0])));
    const Real mu_of_s = -h * unit / (g * (r2 + 0.01 * h * h));
    const Real w = mu_of_s * p_.m[i] * p_.m[j] / ((p_.rho[i] + p_.rho[j]) * mV);
    const Real Q = rounded_to_float16(0.1 * (p_.c[i] + p_.c[j]) * w);
    const Real P = case_.quadratic ? rounded_to_float16(2 * case_.q2() * mu_of_s * w) : 0;
    const Vec force = mV * (s / unit) * (Q + P * s / unit) * G;
    e.f -= force;
    e.heat += 0.5 * force.dot(u);
  }

  const Cloud& cloud_;
  const Particles& p_;
  Terms case_;
  const Field<Real>* tau_;
};

void expect_near(const Vec& a, const Vec& b, Real error) {
  for (int k = 0; k < 3; ++k) EXPECT_NEAR(a[k], b[k], error);
}

void evaluate(Cloud& cloud, const Terms& c) {
  Particles& p = cloud.world.particles;
  cloud.run_rates();
  if (!c.monaghan)
    for (Index i = 0; i < p.moving; ++i) sph_fields::pressure_plus_q(p)[i] = p.p[i];
  cloud.run_forces();
}

/// A later step of the window: other velocities and pressures, which count, and other positions, which do
/// not.
void evaluate_again(Cloud& cloud, const Terms& c, std::mt19937& random) {
  Particles& p = cloud.world.particles;
  std::uniform_real_distribution<Real> u(-1, 1);
  std::vector<Vec> x;
  for (Index i = 0; i < p.size(); ++i) {
    x.push_back(p.x.vec(i));
    p.x.set(i, x.back() + Vec(0.001 * u(random), 0.001 * u(random), 0));
    p.v.set(i, {u(random), u(random), cloud.world.dim == 3 ? u(random) : 0});
    p.p[i] = 300 - 0.7 * p.p[i];  // as equal as before for the two in one position
    p.f.set(i, Vec::Zero());
  }
  evaluate(cloud, c);
  for (Index i = 0; i < p.size(); ++i) p.x.set(i, x[static_cast<std::size_t>(i)]);
}

/// By up to 0.0014, half the skin being 0.0015: what was out of reach when lists were built comes within, and
/// what was within goes out.
void move_within_the_skin(Particles& p) {
  for (Index i = 0; i < p.moving; ++i) {
    const Vec x = p.x.vec(i);
    p.x.add(i,
            0.0008 * Vec(std::cos(900 * x[1]), std::sin(1100 * x[0]), x[2] == 0 ? 0 : std::cos(1300 * x[0])));
  }
}

template <int Dim>
void compare(const Terms& c, std::optional<Neighbours::Region> region) {
  Cloud cloud(Dim, Dim == 2 ? 21 : 9, 0.01, 0.25);
  World& w = cloud.world;
  Particles& p = w.particles;
  std::mt19937 random(11);
  std::uniform_real_distribution<Real> u(-1, 1);
  for (Index i = 0; i < p.size(); ++i) {
    p.v.set(i, {u(random), u(random), Dim == 3 ? u(random) : 0});
    p.p[i] = 1000 * u(random), p.rho[i] = 1000 + 200 * u(random), p.c[i] = 30 + 5 * u(random);
    p.m[i] *= 1 + 0.3 * u(random);
    if (!c.uniform_h) p.h[i] *= 1 + 0.3 * u(random);
  }
  p.x.set(3, p.x.vec(4)), p.p[3] = p.p[4];  // two particles in one position
  cloud.settings.kernel = c.kernel;
  cloud.settings.uniform_h = c.uniform_h;
  cloud.settings.viscosity =
      c.monaghan ? ArtificialViscosity(MonaghanViscosity{c.q2()}) : ArtificialViscosity(BulkViscosity{});
  cloud.settings.density_diffusion = c.diffusing ? Oracle<Dim>::delta : 0;
  Field<Real>*tau = nullptr, *D = nullptr;
  if (c.stress) {
    cloud.settings.mu.assign(1, 1.0);
    tau = &sph_fields::stress(p), D = &sph_fields::strain_rate(p);
    for (Index i = 0; i < p.size(); ++i)
      for (int k = 0; k < 6; ++k) tau->data(k)[i] = Dim == 3 || k < 2 || k == 3 ? 500 * u(random) : 0;
  }
  cloud.neighbours = std::make_shared<Neighbours>(cloud.neighbours->skin(), region, kernel_support(c.kernel));
  c.windows ? cloud.make_frozen_pairs() : cloud.make_pairs(c.keep_gradients);
  cloud.refresh();
  if (!c.windows) move_within_the_skin(p);
  if (c.diffusing)
    for (Index i = 0; i < p.moving; ++i)
      sph_fields::potential(p)[i] = -Oracle<Dim>::gravity().dot(p.x.vec(i));
  evaluate(cloud, c);
  if (c.rounded) evaluate_again(cloud, c, random);
  const Oracle<Dim> oracle(cloud, c);
  const auto& heat = sph_fields::dissipation(p);
  const Field<Real>* diffusion = c.diffusing ? &sph_fields::density_diffusion(p) : nullptr;
  Real f = 0, sum_f = 0, drhodt = 0, most_heat = 0, most_diffusion = 0;
  Vec momentum = Vec::Zero();
  for (Index i = 0; i < p.active; ++i) {
    f = std::max(f, p.f.vec(i).norm()), drhodt = std::max(drhodt, std::abs(p.drhodt[i]));
    sum_f += p.f.vec(i).norm(), momentum += p.f.vec(i);
    most_heat = std::max(most_heat, heat[i]);
    if (diffusion) most_diffusion = std::max(most_diffusion, std::abs((*diffusion)[i]));
  }
  if (!region) EXPECT_LT(momentum.norm(), 1e-12 * sum_f);
  for (Index i = 0; i < p.active; ++i) {
    const Expected e = oracle.of(i);
    EXPECT_NEAR(p.drhodt[i], e.drhodt, c.tolerance() * drhodt);
    expect_near(p.f.vec(i), e.f, (c.monaghan ? c.factor_tolerance() : c.tolerance()) * f);
    if (diffusion) EXPECT_NEAR((*diffusion)[i], e.diffusion, c.factor_tolerance() * most_diffusion);
    if (c.monaghan) EXPECT_NEAR(heat[i], e.heat, c.factor_tolerance() * most_heat);
    if (!c.stress) continue;
    const Matrix found = D->tensor(i);
    EXPECT_LT((found - e.D).cwiseAbs().maxCoeff(), c.tolerance() * drhodt / 1000);
  }
}

const Neighbours::Region box{Vec(-1, 0.024, -1), Vec(1, 0.051, 1)};  // cuts the cloud

class PairSums : public testing::TestWithParam<InstructionSet> {};

TEST_P(PairSums, GiveWhatTheSumOverAllPairsGives) {
  const InstructionSet before = instruction_set();
  use_instruction_set(GetParam());
  for (const int dim : {2, 3})
    for (int k = 0; k < 32; ++k) {
      Terms c{dim, (k & 1) != 0, (k & 2) != 0, (k & 4) != 0, (k & 8) != 0};
      c.quadratic = (k & 16) == 0;
      if (!c.quadratic && !c.monaghan) continue;
      SCOPED_TRACE(testing::Message()
                   << dim << "D, uniform h " << c.uniform_h << ", Monaghan " << c.monaghan << ", stress "
                   << c.stress << ", gradients kept " << c.keep_gradients << ", quadratic " << c.quadratic);
      for (const auto& region : {std::optional<Neighbours::Region>(), std::optional(box)})
        dim == 2 ? compare<2>(c, region) : compare<3>(c, region);
    }
  use_instruction_set(before);
}

TEST_P(PairSums, GiveItForEveryKernel) {
  const InstructionSet before = instruction_set();
  use_instruction_set(GetParam());
  for (const KernelChoice kernel : every_kernel)
    for (const int dim : {2, 3})
      for (int k = 0; k < 4; ++k) {  // gradients worked out twice and kept, one h and several
        const Terms c{dim, (k & 1) != 0, true, true, (k & 2) != 0, kernel};
        SCOPED_TRACE(testing::Message() << kernel_name(kernel) << ", " << dim << "D, uniform h "
                                        << c.uniform_h << ", gradients kept " << c.keep_gradients);
        dim == 2 ? compare<2>(c, std::nullopt) : compare<3>(c, std::nullopt);
      }
  use_instruction_set(before);
}

TEST_P(PairSums, GiveItWithFrozenGradients) {
  const InstructionSet before = instruction_set();
  use_instruction_set(GetParam());
  for (const KernelChoice kernel : every_kernel)
    for (const int dim : {2, 3})
      for (int k = 0; k < 32; ++k) {
        Terms c{dim, true, (k & 1) != 0, (k & 2) != 0, false, kernel, true};
        c.rounded = (k & 4) != 0, c.quadratic = (k & 8) != 0, c.diffusing = (k & 16) != 0;
        if (!c.quadratic && !(c.monaghan && c.rounded)) continue;
        // what a scene lacks has nothing to do with the kernel
        if (kernel != KernelChoice::cubic_spline && !(c.quadratic && c.diffusing)) continue;
        SCOPED_TRACE(testing::Message() << kernel_name(kernel) << ", " << dim << "D, Monaghan " << c.monaghan
                                        << ", stress " << c.stress << ", rounded " << c.rounded
                                        << ", quadratic " << c.quadratic << ", diffusing " << c.diffusing);
        dim == 2 ? compare<2>(c, std::nullopt) : compare<3>(c, std::nullopt);
        if (kernel == KernelChoice::cubic_spline && c.rounded && c.quadratic)
          dim == 2 ? compare<2>(c, box) : compare<3>(c, box);
      }
  use_instruction_set(before);
}

INSTANTIATE_TEST_SUITE_P(All, PairSums, testing::ValuesIn(instruction_sets()),
                         [](const auto& set) { return std::string(name_of(set.param)); });

}  // namespace
