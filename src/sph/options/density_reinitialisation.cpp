// *COURANT_DENSITY_REINITIALISATION: every few steps density becomes what that of the neighbours says.
#include <cmath>

#include "base/eigenvalues.hpp"
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

namespace courant {

namespace {

const RegisterKeyword<CourantDensityReinitialisation> reinitialisation_keyword{
    courant_density_reinitialisation_table()};

/// Least second moment of the neighbours' places about their mean, over h^2, with which least squares fit a
/// plane. It is 0.32 inside (cubic spline, 2D), 0.1 at a surface, 0 where particles are in a line.
constexpr Real least_moment = 0.02;

/// Every NCYC steps rho_i becomes the value at x_i of what fits the densities rho_j of the neighbours with
/// the weights V_j W_ij best: of a constant (Shepard), sum m_j W_ij / sum V_j W_ij, or of a linear function
/// (moving least squares, Colagrossi and Landrini 2003, eqs 8-11). Both in differences to rho_i, with
/// deviations about weighted means instead of the moment matrix: a change by
///   <delta> - <d> . C^-1 <(d - <d>) delta>,  C = <(d - <d>)(d - <d>)>,  delta = rho_j - rho_i, d = x_j -
///   x_i,
/// of which Shepard has the first term. So has least squares where the positions of neighbours do not tell a
/// gradient: counted as `density_mls_to_shepard`.
class DensityReinitialisation : public Rate {
 public:
  DensityReinitialisation(const SphSettings& s, World& world, std::shared_ptr<Neighbours> neighbours,
                          std::shared_ptr<PairVolumes> volumes)
      : source_(s, world, s.density_diffusion == 0 && s.volume_tau == 0),
        dim_(s.dim),
        kernel_(&any_kernel(s.kernel)),
        rules_(s.reinitialisation),
        neighbours_(with_whole_lists(std::move(neighbours))),
        volumes_(std::move(volumes)),
        rate_(sph_fields::reinitialisation_rate(world.particles)) {
    if (rules_.linear) world.counters.try_emplace(counter, 0);
  }
  std::string name() const override { return "density re-initialisation"; }
  void declare(const World& world, Accesses& a) const override {
    const Particles& p = world.particles;
    source_.declare(p, a, true);
    a.reads(p.x, Reach::others).reads(p.m, Reach::others).reads(p.h);
    a.reads(volumes_->before(), Reach::others).updates(rate_);
  }

  void start(World& world, const Clock& clock) override {
    due_ = clock.cycle > 0 && clock.cycle % rules_.every == 0;
    if (due_) constant_.assign(static_cast<std::size_t>(block_count(world.particles.active)), 0);
  }
  void block(World& world, const Clock& clock, Index begin, Index end) override {
    Particles& p = world.particles;
    if (!due_) return source_.none(begin, end);
    with_dimension(dim_, [&](auto d) { look<d()>(p, clock.dt_old, begin, end); });
    source_.add(p, rate_.data(), begin, end, clock.dt_old);
  }
  void finish(World& world, const Clock&) override {
    if (!due_ || !rules_.linear) return;
    for (const Index n : constant_) world.counters[counter] += n;
  }

 private:
  template <int Dim>
  void look(const Particles& p, Real dt, Index begin, Index end) {
    for (Index g = begin / Neighbours::lanes; g * Neighbours::lanes < end; ++g)
      for (Index i = g * Neighbours::lanes; i < std::min(end, (g + 1) * Neighbours::lanes); ++i) {
        Moments<Dim> m;
        sum_up(m, p, i, neighbours_->of_group(g));
        Real change = m.change / m.weight;
        if (rules_.linear && !add_slope(m, change)) ++constant_[static_cast<std::size_t>(begin / block_size)];
        rate_[i] = change / dt;
      }
  }

  /// Sums over neighbours and the particle itself with the weights V_j W_ij; places over h.
  template <int Dim>
  struct Moments {
    using Place = Eigen::Matrix<Real, Dim, 1>;
    Real weight = 0, change = 0;
    Place place = Place::Zero(), place_change = Place::Zero();
    Eigen::Matrix<Real, Dim, Dim> places = Eigen::Matrix<Real, Dim, Dim>::Zero();
  };

  template <int Dim>
  void sum_up(Moments<Dim>& m, const Particles& p, Index i, std::span<const Index> neighbours) const {
    const Real support2 = kernel_->support * kernel_->support;
    const Real* V = volumes_->current();
    const Vec xi = p.x.vec(i);
    const Real h = p.h[i], rho = p.rho[i];
    for (const Index j : neighbours) {
      const Vec d = (p.x.vec(j) - xi) / h;
      const Real R2 = d.squaredNorm();
      if (!(R2 < support2)) continue;
      const Real weight = V[j] * kernel_->shape(std::sqrt(R2)), change = weight * (p.m[j] / V[j] - rho);
      m.weight += weight;
      m.change += change;
      if (!rules_.linear) continue;
      const auto place = d.template head<Dim>();
      m.place += weight * place;
      m.place_change += change * place;
      m.places += weight * place * place.transpose();
    }
  }

  /// False where the neighbours do not tell a slope.
  template <int Dim>
  static bool add_slope(const Moments<Dim>& m, Real& change) {
    const auto mean = (m.place / m.weight).eval();
    const Eigen::Matrix<Real, Dim, Dim> C = m.places / m.weight - mean * mean.transpose();
    if (!(least_eigenvalue(C) > least_moment)) return false;
    change -= mean.dot(C.inverse() * (m.place_change / m.weight - mean * change));
    return true;
  }

  static constexpr const char* counter = "density_mls_to_shepard";
  DensitySource source_;
  int dim_;
  const AnyKernel* kernel_;
  ReinitialisationRules rules_;
  bool due_ = false;
  std::vector<Index> constant_;  ///< in each block: particles without a slope
  std::shared_ptr<Neighbours> neighbours_;
  std::shared_ptr<PairVolumes> volumes_;
  Field<Real>& rate_;
};

}  // namespace

// Two liquids would take over each other's density.
ReinitialisationRules read_density_reinitialisation(const Deck& deck, const Model& model,
                                                    Diagnostics& diagnostics) {
  const auto* c = deck.last<CourantDensityReinitialisation>();
  if (c == nullptr) return {};
  const std::string differ = parts_of_several_materials(model);
  if (c->ncyc > 0 && !differ.empty())
    deck.error(diagnostics, *c, "NCYC",
               "expected 0 where SPH parts are of several materials: " + differ +
                   ", and densities would be smoothed across",
               "give all SPH parts one material and one equation of state, or leave the keyword out");
  return {.every = c->ncyc, .linear = c->method == 1};
}

void add_density_reinitialisation(const SphSettings& s, World& world, std::shared_ptr<Neighbours> neighbours,
                                  std::shared_ptr<PairVolumes> volumes) {
  world.passes.add(
      std::make_shared<DensityReinitialisation>(s, world, std::move(neighbours), std::move(volumes)));
}

}  // namespace courant
