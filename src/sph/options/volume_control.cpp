// *COURANT_VOLUME_CONTROL: takes back slowly what the density of water has lost touch with.
#include <algorithm>
#include <cmath>

#include "keyword/registry.hpp"
#include "parallel/parallel.hpp"
#include "sph/cards.hpp"
#include "sph/core/fields.hpp"
#include "sph/core/pair_volumes.hpp"
#include "sph/core/view.hpp"
#include "sph/kernel/kernel.hpp"
#include "sph/options/density_source.hpp"
#include "sph/options/option_cards.hpp"
#include "sph/sph.hpp"
#include "state/restartable.hpp"

namespace courant {

namespace {

const RegisterKeyword<CourantVolumeControl> volume_control_keyword{courant_volume_control_table()};

/// Slope of the sum of kernels, times h, from which on a particle is at a surface; with the cubic spline.
constexpr Real surface_slope = 0.4;
/// How much a particle is surrounded, below which it is spray and from which on water.
constexpr Real spray = 0.3, water = 0.5;
constexpr Real looks_per_tau = 50;

/// Continuity changes the density of a particle just as sum_j V_j W_ij changes. At a free surface that sum is
/// less than 1, with the density right; water that goes under takes the difference along for good: it stands
/// too far apart for its density, and the pressure keeps it so. Here
///   d rho_i/dt += rho_i w_i (sum_j V_j W_ij / S - 1) / TAU,
/// S the sum of a square lattice, w_i = max(0, 1 - (h |sum_j V_j grad W_ij| / 0.4)^2), which is 0 at
/// surfaces; for other kernels than the cubic spline 0.4 is scaled by what that slope is at a plane surface.
/// Drops of one particle, of two in one position and rows of particles have no slope either, and a sum far
/// below S: w_i falls to 0 where -sum_j V_j r dW/dr / dim, 1 in water and 0.5 at its surface, falls from 0.5
/// to 0.3. Else their density would fall to a third, and what tension then held together would be thrown
/// apart.
class VolumeControl : public Rate, public TimeLimit, public Restartable {
 public:
  VolumeControl(const SphSettings& s, World& world, std::shared_ptr<Neighbours> neighbours,
                std::shared_ptr<PairVolumes> volumes)
      : source_(s, world, s.density_diffusion == 0),
        dim_(s.dim),
        kernel_(s.kernel),
        surface_slope_(surface_slope *
                       with_kernel(s.kernel, [&](auto k) { return slope_at_plane<decltype(k)>(s.dim); }) /
                       slope_at_plane<CubicSpline>(s.dim)),
        tau_(s.volume_tau),
        neighbours_(with_whole_lists(std::move(neighbours))),
        volumes_(std::move(volumes)),
        rate_(sph_fields::volume_rate(world.particles)) {
    if (!s.walls.segments.empty()) {
      wall_slope_ = &sph_fields::wall_slope(world.particles);
      wall_fill_ = &sph_fields::wall_fill(world.particles);
    }
    const Particles& p = world.particles;
    const Index i = p.size() - 1;  // represents all
    if (i >= 0) lattice_ = lattice_sum(p.h[i] / std::pow(p.m[i] / p.rho[i], 1.0 / dim_));
  }
  std::string name() const override { return "volume control"; }
  void declare(const World& world, Accesses& a) const override {
    const Particles& p = world.particles;
    source_.declare(p, a);
    a.reads(p.x, Reach::others).reads(p.h).reads(volumes_->before(), Reach::others).updates(rate_);
    if (wall_slope_) a.reads(*wall_slope_).reads(*wall_fill_);
  }

  /// A longer step would take densities past their aim.
  Limit limit(const World&, const Clock&) override { return {tau_, name()}; }
  bool rings() const override { return false; }

  void start(World&, const Clock& clock) override {
    due_ = clock.t >= next_look_;
    if (due_) next_look_ = clock.t + tau_ / looks_per_tau;
  }
  void block(World& world, const Clock&, Index begin, Index end) override {
    Particles& p = world.particles;
    if (due_)
      with_kernel(kernel_, [&](auto k) {
        with_dimension(dim_, [&](auto d) { look<decltype(k), d()>(p, begin, end); });
      });
    source_.add(p, rate_.data(), begin, end);
  }
  void keep(Archive& archive) override { archive("next_look", next_look_); }

 private:
  template <class Kernel, int Dim>
  void look(const Particles& p, Index begin, Index end) {
    const Real* V = volumes_->current();
    for (Index g = begin / Neighbours::lanes; g * Neighbours::lanes < end; ++g)
      for (Index i = g * Neighbours::lanes; i < std::min(end, (g + 1) * Neighbours::lanes); ++i) {
        const Vec xi = p.x.vec(i);
        const Real h = p.h[i];
        Real sum = 0, around = 0;
        Vec slope = Vec::Zero();
        for (const Index j : neighbours_->of_group(g)) {
          const Vec d = xi - p.x.vec(j);
          const Real r2 = d.squaredNorm();
          if (!(r2 < Kernel::support * Kernel::support * h * h)) continue;
          const Real r = std::sqrt(r2), R = r / h;
          sum += V[j] * Kernel::shape(R), around -= V[j] * Kernel::slope(R) * R;
          if (r > 0) slope += (V[j] * Kernel::slope(R) / r) * d;
        }
        const Real norm = Kernel::C(Dim) / power<Dim>(h);
        slope *= norm / h, sum *= norm, around *= norm / Dim;
        if (wall_slope_) slope += wall_slope_->vec(i), sum += (*wall_fill_)[i];
        const Real edge = h * slope.norm() / surface_slope_;
        const Real share = std::clamp((around - spray) / (water - spray), Real(0), Real(1));
        rate_[i] = p.rho[i] * share * std::max(Real(0), 1 - edge * edge) * (sum / lattice_ - 1) / tau_;
      }
  }
  Real lattice_sum(Real h) const {
    return with_kernel(kernel_, [&](auto kernel) {
      using Kernel = decltype(kernel);
      Real sum = 0;
      const int most = static_cast<int>(Kernel::support * h), depth = dim_ == 3 ? most : 0;
      for (int k = -depth; k <= depth; ++k)
        for (int j = -most; j <= most; ++j)
          for (int i = -most; i <= most; ++i)
            sum += Kernel::shape(std::sqrt(Real(i * i + j * j + k * k)) / h);
      return sum * (dim_ == 3 ? Kernel::C(3) / power<3>(h) : Kernel::C(2) / power<2>(h));
    });
  }
  /// Integral of the kernel over a line (2D) or plane (3D) through its middle, times h: h |grad S| at the
  /// edge of a half-space.
  template <class Kernel>
  static Real slope_at_plane(int dim) {
    constexpr int n = 1000;
    Real sum = 0;
    for (int k = 0; k < n; ++k) {
      const Real R = Kernel::support * (k + 0.5) / n;
      sum += (dim == 3 ? 2 * pi * R : 2) * Kernel::shape(R);
    }
    return Kernel::C(dim) * sum * Kernel::support / n;
  }

  DensitySource source_;
  int dim_;
  KernelChoice kernel_;
  Real surface_slope_;
  Real tau_, lattice_ = 1, next_look_ = 0;
  bool due_ = true;
  std::shared_ptr<Neighbours> neighbours_;
  std::shared_ptr<PairVolumes> volumes_;
  Field<Real>& rate_;
  Field<Real>*wall_slope_ = nullptr, *wall_fill_ = nullptr;  ///< where walls support particles
};

}  // namespace

void add_volume_control(const SphSettings& s, World& world, std::shared_ptr<Neighbours> neighbours,
                        std::shared_ptr<PairVolumes> volumes) {
  world.passes.add(std::make_shared<VolumeControl>(s, world, std::move(neighbours), std::move(volumes)));
}

}  // namespace courant
