// *COURANT_RIEMANN: fluxes between pairs by a linearised Riemann problem instead of artificial viscosity.
#include "sph/options/option_cards.hpp"
#include "sph/options/riemann_loops.hpp"

#include <algorithm>
#include <vector>

#include <fmt/format.h>

#include "keyword/registry.hpp"
#include "parallel/parallel.hpp"
#include "search/neighbours.hpp"
#include "sph/cards.hpp"
#include "sph/core/fields.hpp"
#include "sph/core/pair_volumes.hpp"
#include "sph/core/view.hpp"
#include "sph/sph.hpp"

namespace courant {

namespace {

const RegisterKeyword<CourantRiemann> riemann_keyword{courant_riemann_table()};

/// Zhang, Hu and Adams 2017 (J. Comput. Phys. 335), eqs 12-20: along each pair
///   p* = (p_i + p_j)/2 + 1/2 rho_bar c_bar beta w,  beta = min(eta max(w/c_bar, 0), 1),
///   u* = mean + (p_i - p_j)/(2 rho_bar c_bar),
/// w the speed of approach. The means are what plain sums have. Here is the rest of p*, a force; the rest of
/// u* needs the pressures of neighbours and comes with the forces.
class RiemannMomentum : public Rate {
 public:
  RiemannMomentum(const SphSettings& s, World& world, std::shared_ptr<Neighbours> neighbours,
                  std::shared_ptr<PairVolumes> volumes)
      : loop_(riemann_momentum_loop(s.kernel, s.dim, s.uniform_h)),
        eta_(std::get<RiemannFlux>(s.viscosity).eta),
        c_(sph_fields::viscous_speed(world.particles)),
        heat_(sph_fields::dissipation(world.particles)),
        neighbours_(with_whole_lists(std::move(neighbours))),
        volumes_(std::move(volumes)) {
    a_.kernel = &any_kernel(s.kernel);
  }
  std::string name() const override { return "Riemann flux (momentum)"; }
  void declare(const World& world, Accesses& a) const override {
    const Particles& p = world.particles;
    a.reads(p.x, Reach::others).reads(p.v, Reach::others).reads(p.m, Reach::others);
    a.reads(p.h, Reach::others);
    a.reads(volumes_->before(), Reach::others).reads(c_, Reach::others).updates(p.f).writes(heat_);
  }

  void start(World& world, const Clock&) override {
    Particles& p = world.particles;
    for (int k = 0; k < 3; ++k) a_.x[k] = p.x.data(k), a_.v[k] = p.v.data(k), a_.f[k] = p.f.data(k);
    a_.m = p.m.data(), a_.V = volumes_->current(), a_.c = c_.data(), a_.heat = heat_.data();
    a_.h = p.h.data(), a_.h0 = p.active > 0 ? p.h[0] : 1, a_.eta = eta_;
  }
  void block(World&, const Clock&, Index begin, Index end) override {
    loop_(a_, lists_of(*neighbours_, begin, end));
  }

 private:
  RiemannLoop loop_;
  Real eta_;
  Field<Real>&c_, &heat_;
  std::shared_ptr<Neighbours> neighbours_;
  std::shared_ptr<PairVolumes> volumes_;
  RiemannArrays a_{};
};

/// Largest step by the decay of the particle's pressure. An explicit step holds up to 2/lambda, and lambda,
/// the fastest decay of all patterns of pressure, was 1.02 to 1.49 of the largest decay of one particle's: on
/// square and cubic lattices of h/dx 1 to 2, the same with two particles in each position, disturbed ones and
/// particles strewn at random.
constexpr Real most_decay = 1.25;

/// What the next rates add to the density, and how long a step may carry it: particles that crowd at a wall
/// exchange mass faster.
class RiemannMass : public Force, public TimeLimit {
 public:
  RiemannMass(const SphSettings& s, World& world, std::shared_ptr<Neighbours> neighbours,
              std::shared_ptr<PairVolumes> volumes)
      : loop_(riemann_mass_loop(s.kernel, s.dim, s.uniform_h)),
        c_(sph_fields::viscous_speed(world.particles)),
        potential_(sph_fields::potential(world.particles)),
        rate_(sph_fields::density_diffusion(world.particles)),
        pc_(std::get<RiemannFlux>(s.viscosity).pc),
        neighbours_(with_whole_lists(std::move(neighbours))),
        volumes_(std::move(volumes)) {
    a_.kernel = &any_kernel(s.kernel);
  }
  std::string name() const override { return "Riemann flux (mass)"; }
  void declare(const World& world, Accesses& a) const override {
    const Particles& p = world.particles;
    a.reads(p.x, Reach::others).reads(p.m, Reach::others).reads(p.h, Reach::others);
    a.reads(volumes_->now(), Reach::others);
    a.reads(c_, Reach::others).reads(p.p, Reach::others).reads(potential_, Reach::others).writes(rate_);
  }

  void start(World& world, const Clock&) override {
    Particles& p = world.particles;
    for (int k = 0; k < 3; ++k) a_.x[k] = p.x.data(k);
    a_.m = p.m.data(), a_.V = volumes_->current(), a_.c = c_.data(), a_.p = p.p.data();
    a_.potential = potential_.data(), a_.rate = rate_.data();
    decay_.resize(static_cast<std::size_t>(p.active));
    a_.decay = decay_.data(), a_.pc = pc_;
    a_.h = p.h.data(), a_.h0 = p.active > 0 ? p.h[0] : 1;
    fastest_.assign(block_count(p.active), 0);
  }
  void block(World&, const Clock&, Index begin, Index end) override {
    loop_(a_, lists_of(*neighbours_, begin, end));
    fastest_[begin / block_size] = *std::max_element(decay_.data() + begin, decay_.data() + end);
  }
  bool rings() const override { return false; }
  Limit limit(const World&, const Clock&) override {
    Real fastest = 0;
    for (const Real decay : fastest_) fastest = std::max(fastest, decay);
    return {most_decay / fastest, "Riemann flux"};
  }

 private:
  RiemannLoop loop_;
  Field<Real>&c_, &potential_, &rate_;
  Real pc_;
  std::vector<Real> decay_, fastest_;  ///< of each particle, of the fastest one of each block [1/T]
  std::shared_ptr<Neighbours> neighbours_;
  std::shared_ptr<PairVolumes> volumes_;
  RiemannArrays a_{};
};

/// Unused coefficients of artificial viscosity in a deck.
template <class T>
void warn_of_viscosity(const Deck& deck, Diagnostics& diagnostics) {
  constexpr Real off = 1e-9;
  for (const T& c : deck.all<T>())
    if (c.q1 > off || c.q2 > off)
      deck.warning(diagnostics, c, c.q1 > off ? "Q1" : "Q2",
                   "is not used: *COURANT_RIEMANN replaces artificial viscosity",
                   "set Q1 and Q2 to 1.0E-20, or leave *COURANT_RIEMANN out");
}

}  // namespace

void read_riemann(const Deck& deck, const Model& model,
                  const std::function<SphMaterial(Index part)>& material, SphSettings& s,
                  Diagnostics& diagnostics) {
  const auto* c = deck.last<CourantRiemann>();
  if (c == nullptr || c->eta < 0) return;
  bool refused = false;
  const auto refuse = [&](const std::string& why, const std::string& hint) {
    deck.error(diagnostics, *c, "ETA", "expected a number < 0, which means none, " + why, hint);
    refused = true;
  };
  if (std::holds_alternative<BulkViscosity>(s.viscosity))
    refuse("beside IAVIS 1 of *CONTROL_SPH: the flux replaces artificial viscosity",
           "use IAVIS 0, or leave the keyword out");
  if (s.density_diffusion > 0)
    refuse("beside *COURANT_DENSITY_DIFFUSION: the flux diffuses density itself", "leave one of the two out");
  if (const std::string differ = parts_of_several_materials(model); !differ.empty())
    refuse("where SPH parts are of several materials: " + differ + ", and the flux is that of one liquid",
           "give all SPH parts one material and one equation of state, or leave the keyword out");
  if (acceleration_of_particles(model).by_parts())
    refuse("where body loads do not act on all SPH parts alike", "let them act on all or on none");
  if (refused) return;
  warn_of_viscosity<Hourglass>(deck, diagnostics);
  warn_of_viscosity<ControlBulkViscosity>(deck, diagnostics);
  constexpr Real without_limiter = 1e30;
  const auto liquid =
      std::find_if(model.parts.begin(), model.parts.end(), [](const auto& p) { return p.has_sph; });
  RiemannFlux flux{.eta = c->eta > 0 ? c->eta : without_limiter};
  if (liquid != model.parts.end()) flux.pc = material(static_cast<Index>(liquid - model.parts.begin())).pc;
  s.viscosity = flux;
  s.loads = acceleration_of_particles(model);
  for (PartViscosity& q : s.q) q = {.q1 = 1, .q2 = 0};
}

void add_riemann(const SphSettings& s, World& world, std::shared_ptr<Neighbours> neighbours,
                 std::shared_ptr<PairVolumes> volumes) {
  world.passes.add(std::make_shared<RiemannMomentum>(s, world, neighbours, volumes));
  world.passes.add(std::make_shared<RiemannMass>(s, world, std::move(neighbours), std::move(volumes)));
}

}  // namespace courant
