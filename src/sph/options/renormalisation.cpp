// FORM of *CONTROL_SPH, the renormalised ones among its values, and *COURANT_RENORMALISATION.
#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "base/eigenvalues.hpp"
#include "keyword/registry.hpp"
#include "search/neighbours.hpp"
#include "sph/cards.hpp"
#include "sph/core/fields.hpp"
#include "sph/core/pair_volumes.hpp"
#include "sph/core/view.hpp"
#include "sph/options/option_cards.hpp"
#include "sph/options/renormal_loops.hpp"
#include "sph/sph.hpp"

namespace courant {

namespace {

const RegisterKeyword<CourantRenormalisation> renormalisation_keyword{courant_renormalisation_table()};

/// Least eigenvalue of the moment matrix up to which gradients are not corrected, and from which on they are
/// to the full; 1 inside, 1/2 at a plane surface. Where water breaks up, full corrections are unstable.
struct Eigenvalues {
  Real least, full;
};
constexpr Eigenvalues of_liquids{0.6, 0.8};
/// Solids keep their neighbours, so that sums at their surfaces (1/2) and edges (1/4) are corrected, too.
constexpr Eigenvalues of_solids{0.1, 0.2};

void take_arrays(RenormalArrays& a, World& world, const PairVolumes& volumes, Field<Real>& excess) {
  Particles& p = world.particles;
  for (int k = 0; k < 3; ++k) a.x[k] = p.x.data(k), a.v[k] = p.v.data(k), a.f[k] = p.f.data(k);
  for (int k = 0; k < 6; ++k) a.excess[k] = excess.data(k);
  a.V = volumes.current(), a.h = p.h.data();
}

/// B_i = (sum_j V_j (x_j - x_i) (x) grad W_ij)^-1 makes gradients of linear functions exact (Randles and
/// Libersky 1996, Bonet and Lok 1999). Continuity becomes drho_i/dt = rho_i sum_j V_j v_ij . B_i grad W_ij,
/// in the middle of the step as plain sums, with the mean of B before and after; the force, its transpose,
///   -V_i sum_j V_j (p_i B_i + p_j B_j) grad W_ij.
/// So pair forces cancel and energy is kept, but no longer angular momentum. With the reverse correction
/// (Zhang et al., arXiv 2406.02222) it is -V_i sum_j V_j (p_i B_j + p_j B_i) grad W_ij: where sum_j V_j (B_i
/// + B_j) grad W_ij is small, as inside settled water, that is V_i B_i sum_j V_j (p_i - p_j) grad W_ij, exact
/// for linear pressures. Pair forces cancel all the same, but it is no transpose of the continuity. This adds
/// what plain sums lack. By the least eigenvalue of the matrix B goes over to 1 towards surfaces and where it
/// is near singular: `renormalisation_left_out` counts the most particles at once that are not corrected at
/// all. Particles beside the box keep their state, and B is 1 for them.
class RenormalRates : public Rate, public Refresh {
 public:
  RenormalRates(const SphSettings& s, World& world, std::shared_ptr<Neighbours> neighbours,
                std::shared_ptr<PairVolumes> volumes)
      : dim_(s.dim),
        loop_(renormal_rates_loop(s.kernel, s.dim)),
        neighbours_(with_whole_lists(std::move(neighbours))),
        volumes_(std::move(volumes)),
        excess_(sph_fields::renormalisation(world.particles)),
        moment_(sph_fields::moment(world.particles)),
        gradient_(sph_fields::plain_gradient(world.particles)),
        strength_(s.strength) {
    a_.kernel = &any_kernel(s.kernel);
    if (!s.walls.segments.empty()) {
      wall_moment_ = &sph_fields::wall_moment(world.particles);
      wall_gradient_ = &sph_fields::wall_gradient(world.particles);
    }
    for (Index i = 0; i < world.particles.size(); ++i) excess_.set_tensor(i, Matrix::Zero());
    world.counters.try_emplace(counter, 0);
  }
  std::string name() const override { return "renormalisation (rates)"; }
  void declare(const World& world, Accesses& a) const override {
    const Particles& p = world.particles;
    a.reads(p.x, Reach::others).reads(p.v, Reach::others).reads(p.h).reads(volumes_->before(), Reach::others);
    a.reads_before(p.rho).updates(p.drhodt).updates(p.f);  // forces only give their address
    a.updates(excess_).writes(moment_).writes(gradient_);
    if (wall_moment_) a.reads(*wall_moment_).reads(*wall_gradient_);
    if (!strength_.empty()) a.reads(p.part);
  }

  void start(World& world, const Clock& clock) override {
    take_arrays(a_, world, *volumes_, excess_);
    for (int k = 0; k < 6; ++k) a_.moment[k] = moment_.data(k), a_.gradient[k] = gradient_.data(k);
    a_.half_step = 0.5 * clock.dt_old;
    left_out_.assign(static_cast<std::size_t>(block_count(world.particles.active)), 0);
  }
  void block(World& world, const Clock&, Index begin, Index end) override {
    loop_(a_, lists_of(*neighbours_, begin, end));
    const Particles& p = world.particles;
    with_dimension(dim_, [&](auto dim) {
      with_bool(wall_moment_ != nullptr, [&](auto walls) {
        for (Index i = begin; i < end; ++i) {
          const bool solid = !strength_.empty() && strength_[p.part[i]];
          correct<dim(), walls()>(world.particles, i, solid ? of_solids : of_liquids);
        }
      });
    });
  }
  void refreshed(World&, const Clock&, std::span<const Index>) override {
    for (const Index i : neighbours_->left()) excess_.set_tensor(i, Matrix::Zero());
  }
  void finish(World& world, const Clock&) override {
    std::int64_t sum = 0;
    for (const Index n : left_out_) sum += n;
    auto& most = world.counters[counter];
    most = std::max(most, sum);
  }

 private:
  template <int Dim, bool Walls>
  void correct(Particles& p, Index i, const Eigenvalues& from) {
    using Square = Eigen::Matrix<Real, Dim, Dim>;
    Square moment = moment_.tensor(i).template topLeftCorner<Dim, Dim>();
    if constexpr (Walls) moment += wall_moment_->tensor(i).template topLeftCorner<Dim, Dim>();
    const Real least = least_eigenvalue(moment);
    Matrix excess = Matrix::Zero();
    if (least > from.least) {
      const Real share = std::min((least - from.least) / (from.full - from.least), Real(1));
      excess.template topLeftCorner<Dim, Dim>() = share * (moment.inverse() - Square::Identity());
    } else {
      ++left_out_[static_cast<std::size_t>(i / block_size)];
    }
    const Matrix mean = 0.5 * (excess_.tensor(i) + excess);
    p.drhodt[i] += p.rho[i] * mean.cwiseProduct(gradient_.tensor(i)).sum();
    if constexpr (Walls) p.drhodt[i] += p.rho[i] * mean.cwiseProduct(wall_gradient_->tensor(i)).sum();
    excess_.set_tensor(i, excess);
  }

  static constexpr const char* counter = "renormalisation_left_out";
  int dim_;
  RenormalLoop loop_;
  std::shared_ptr<Neighbours> neighbours_;
  std::shared_ptr<PairVolumes> volumes_;
  Field<Real>&excess_, &moment_, &gradient_;
  Field<Real>*wall_moment_ = nullptr, *wall_gradient_ = nullptr;  ///< where walls support particles
  std::vector<std::shared_ptr<const StrengthLaw>> strength_;      ///< per part; empty: none has any
  std::vector<Index> left_out_;                                   ///< in each block
  RenormalArrays a_{};
};

/// The velocity gradient L = D + W of plain sums, with D its symmetric part and W its spin, becomes L B. With
/// it forces of stress are the transpose of the rates of strain, so that energy is kept.
class RenormalStrain : public Rate {
 public:
  explicit RenormalStrain(World& world)
      : excess_(sph_fields::renormalisation(world.particles)),
        rate_(sph_fields::strain_rate(world.particles)),
        spin_(sph_fields::spin(world.particles)) {}
  std::string name() const override { return "renormalisation (strain)"; }
  void declare(const World&, Accesses& a) const override { a.reads(excess_).revises(rate_).revises(spin_); }
  void block(World&, const Clock&, Index begin, Index end) override {
    for (Index i = begin; i < end; ++i) {
      const Vec w = spin_.vec(i);
      Matrix L = rate_.tensor(i);
      L(0, 1) -= w[2], L(1, 0) += w[2];
      L(1, 2) -= w[0], L(2, 1) += w[0];
      L(2, 0) -= w[1], L(0, 2) += w[1];
      L += (L * excess_.tensor(i)).eval();
      rate_.set_tensor(i, 0.5 * (L + L.transpose()));
      spin_.set(i, 0.5 * Vec(L(2, 1) - L(1, 2), L(0, 2) - L(2, 0), L(1, 0) - L(0, 1)));
    }
  }

 private:
  Field<Real>&excess_, &rate_, &spin_;
};

class RenormalForces : public Force {
 public:
  RenormalForces(const SphSettings& s, World& world, std::shared_ptr<Neighbours> neighbours,
                 std::shared_ptr<PairVolumes> volumes)
      : loop_(renormal_forces_loop(s.kernel, s.dim, s.uniform_h,
                                   s.reverse_correction ? RenormalForce::reverse
                                   : s.strength.empty() ? RenormalForce::pressure
                                                        : RenormalForce::stress)),
        neighbours_(with_whole_lists(std::move(neighbours))),
        volumes_(std::move(volumes)),
        excess_(sph_fields::renormalisation(world.particles)) {
    a_.kernel = &any_kernel(s.kernel);
    if (std::holds_alternative<BulkViscosity>(s.viscosity))
      total_pressure_ = &sph_fields::pressure_plus_q(world.particles);
    if (!s.strength.empty()) tau_ = &sph_fields::stress(world.particles);
  }
  std::string name() const override { return "renormalisation (forces)"; }
  void declare(const World& world, Accesses& a) const override {
    const Particles& p = world.particles;
    a.reads(p.x, Reach::others).reads(p.v).reads(p.h, Reach::others).reads(volumes_->now(), Reach::others);
    a.reads(excess_, Reach::others).reads(total_pressure_ ? *total_pressure_ : p.p, Reach::others);
    if (tau_) a.reads(*tau_, Reach::others);
    a.updates(p.f);
  }

  void start(World& world, const Clock&) override {
    take_arrays(a_, world, *volumes_, excess_);
    for (int k = 0; tau_ && k < 6; ++k) a_.tau[k] = tau_->data(k);
    a_.p = total_pressure_ ? total_pressure_->data() : world.particles.p.data();
  }
  void block(World&, const Clock&, Index begin, Index end) override {
    loop_(a_, lists_of(*neighbours_, begin, end));
  }

 private:
  RenormalLoop loop_;
  std::shared_ptr<Neighbours> neighbours_;
  std::shared_ptr<PairVolumes> volumes_;
  Field<Real>& excess_;
  Field<Real>*total_pressure_ = nullptr, *tau_ = nullptr;
  RenormalArrays a_{};
};

bool is_renormalised(int form) {
  return form == 1 || form == 3 || form == 6 || form == 16;
}

void warn_of_smoothing(const Deck& deck, const ControlSph& c, Diagnostics& diagnostics) {
  if (c.form != 15 && c.form != 16) return;
  deck.warning(diagnostics, c, "FORM",
               fmt::format("'{}' smooths densities and pressures by an unpublished method: taken as FORM "
                           "{}, without smoothing",
                           c.form, c.form == 15 ? 5 : 6),
               "*COURANT_DENSITY_DIFFUSION evens out the noise of pressures");
}

void read_correction(const Deck& deck, const ControlSph* c, SphSettings& s, Diagnostics& diagnostics) {
  const auto* r = deck.last<CourantRenormalisation>();
  if (r == nullptr || (r->reverse == 0 && r->pressure == 0)) return;
  s.reverse_correction = r->reverse == 1;
  s.plain_pressure = r->pressure == 1;
  const char* field = s.plain_pressure ? "PRESSURE" : "REVERSE";
  if (c == nullptr || !is_renormalised(c->form))
    deck.error(diagnostics, *r, field, "nothing is corrected: FORM of *CONTROL_SPH is not 1, 3, 6 or 16",
               "ask for a renormalised FORM, or leave the card out");
  else if (s.reverse_correction && s.plain_pressure)
    deck.error(diagnostics, *r, "PRESSURE",
               "REVERSE corrects the pressure forces that PRESSURE 1 leaves plain", "give one of the two");
  else if (s.plain_pressure && !s.strength.empty())
    deck.error(diagnostics, *r, "PRESSURE",
               "stresses of a material with strength would no longer be the transpose of rates of strain",
               "leave it blank: it is for fluids");
  else if (s.density_diffusion == 0)
    deck.warning(diagnostics, *r, field, "without density diffusion these forces lose or gain much energy",
                 "use *COURANT_DENSITY_DIFFUSION, and look at the residual of the energy balance");
}

}  // namespace

void read_form(const Deck& deck, SphSettings& s, Diagnostics& diagnostics) {
  const auto* c = deck.last<ControlSph>();
  read_correction(deck, c, s, diagnostics);
  if (c == nullptr || c->form == 0) return;
  const auto refuse = [&](const std::string& why, const std::string& hint) {
    deck.error(diagnostics, *c, "FORM", fmt::format("expected 0 {}, got '{}'", why, c->form), hint);
  };
  s.renormalised = is_renormalised(c->form);
  if (!s.uniform_h && c->form != 1)
    refuse("or 1 where h differs or changes",
           "use HMIN = HMAX = 1 and one CSLH and spacing for all SPH parts, or FORM 0 or 1");
  warn_of_smoothing(deck, *c, diagnostics);
}

void add_renormalisation(const SphSettings& s, World& world, std::shared_ptr<Neighbours> neighbours,
                         std::shared_ptr<PairVolumes> volumes) {
  world.passes.add(std::make_shared<RenormalRates>(s, world, neighbours, volumes));
  if (!s.strength.empty()) world.passes.add(std::make_shared<RenormalStrain>(world));
  if (!s.plain_pressure)
    world.passes.add(std::make_shared<RenormalForces>(s, world, std::move(neighbours), std::move(volumes)));
}

}  // namespace courant
