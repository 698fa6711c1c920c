// *COURANT_SUBCYCLE: forces between particles in every N-th step of the structure (state/subcycle.hpp).
#include "sph/options/subcycle.hpp"

#include <algorithm>

#include "extension/builders.hpp"
#include "keyword/registry.hpp"
#include "parallel/parallel.hpp"
#include "sph/core/pair_motion.hpp"
#include "sph/options/subcycle_cards.hpp"
#include "sph/skin.hpp"
#include "sph/sph.hpp"
#include "state/force_of_now.hpp"
#include "state/shared_fields.hpp"
#include "state/subcycle.hpp"

namespace courant {

namespace {

const RegisterKeyword<CourantSubcycle> subcycle_keyword{courant_subcycle_table()};

bool has_structure(const Deck& deck, const World& world) {
  return std::any_of(world.groups.begin(), world.groups.end(), [](const auto& g) { return g->pushes; }) ||
         std::any_of(deck.keywords.begin(), deck.keywords.end(),
                     [](const auto& one) { return one.first.starts_with("CONSTRAINED_JOINT"); });
}

/// What needs each step: it takes velocities or forces of the step, or moves particles otherwise than by
/// their velocity. Empty: nothing does.
std::string what_needs_each_step(const Deck& deck, const Model& model, const World& world,
                                 const SphSettings& s) {
  const std::pair<bool, const char*> all[] = {
      {s.geometry_eps > 0, "*COURANT_PAIR_GEOMETRY"},
      {s.renormalised, "FORM of *CONTROL_SPH"},
      {std::holds_alternative<RiemannFlux>(s.viscosity), "*COURANT_RIEMANN"},
      {s.volume_tau > 0, "*COURANT_VOLUME_CONTROL"},
      {s.reinitialisation.every > 0, "re-initialisation of the density"},
      {s.shift.strength > 0, "ISHIFT of *CONTROL_SPH"},
      {s.xsph > 0 || s.velocity_smoothing > 0, "*COURANT_XSPH"},
      {s.has_eddies(), "an eddy viscosity"},
      {!s.walls.segments.empty() || !s.walls.with_ghosts.empty(), "*COURANT_WALL_SUPPORT"},
      {s.artificial_stress.eps > 0, "*COURANT_ARTIFICIAL_STRESS"},
      {s.maxv != 0, "MAXV of *CONTROL_SPH"},
      {s.region.has_value(), "BOXID of *CONTROL_SPH"},
  };
  for (const auto& [on, name] : all)
    if (on) return name;
  // Supports and rigid walls report what stops a particle in a step, which would be that of a kick.
  for (const ModelSph& one : model.sph)
    if (const auto& fixed = model.nodes[static_cast<std::size_t>(one.node)].fixed;
        fixed[0] || fixed[1] || fixed[2])
      return "SPC on particles";
  if (const auto* driven = shared_fields::prescribed_motion.find(world.particles.fields))
    for (Index i = 0; i < world.particles.size(); ++i)
      if ((*driven)[i] != 0) return "a prescribed motion of particles";
  for (const char* begin :
       {"RIGIDWALL_", "BOUNDARY_SPH_", "DEFINE_SPH_", "COURANT_INFLOW", "COURANT_LEVEL_OUTLET"})
    for (const auto& [name, use] : deck.keywords)
      if (name.starts_with(begin)) return "*" + name;
  return {};
}

/// Mean velocity since the last outer step: the motion between the positions over whose change the density
/// changes, whatever contact and loads did in between.
class MeanVelocity : public Rate {
 public:
  MeanVelocity(World& world, const Subcycle& subcycle)
      : subcycle_(subcycle),
        mean_(subcycle_fields::mean_velocity.add(world.particles.fields)),
        before_(subcycle_fields::outer_position.add(world.particles.fields)) {}
  std::string name() const override { return "mean velocity"; }
  void declare(const World& world, Accesses& a) const override {
    a.reads(world.particles.x).reads(world.particles.v).writes(mean_).updates(before_);
  }
  void block(World& world, const Clock&, Index begin, Index end) override {
    for (int k = 0; k < 3; ++k) {
      const Real *x = world.particles.x.data(k), *v = world.particles.v.data(k);
      Real *mean = mean_.data(k), *before = before_.data(k);
      if (subcycle_.single()) {
        std::copy(v + begin, v + end, mean + begin);
      } else {
        const Real per_time = 1 / subcycle_.interval();
        for (Index i = begin; i < end; ++i) mean[i] = (x[i] - before[i]) * per_time;
      }
      std::copy(x + begin, x + end, before + begin);
    }
  }

 private:
  const Subcycle& subcycle_;
  Field<Real>&mean_, &before_;
};

class ClearPairForces : public Rate {
 public:
  explicit ClearPairForces(World& world) : force_(subcycle_fields::pair_force.add(world.particles.fields)) {}
  std::string name() const override { return "clear pair forces"; }
  void declare(const World&, Accesses& a) const override { a.writes(force_); }
  void block(World&, const Clock&, Index begin, Index end) override {
    for (int k = 0; k < 3; ++k) std::fill(force_.data(k) + begin, force_.data(k) + end, 0.0);
  }

 private:
  Field<Real>& force_;
};

/// Rebuilding the lists costs the more against their use the seldomer they are used.
class ListsOfIntervals : public Rate, public Restartable {
 public:
  ListsOfIntervals(Neighbours& neighbours, const World& world, const Subcycle& subcycle)
      : neighbours_(neighbours), subcycle_(subcycle), h_(largest_h(world)) {}
  std::string name() const override { return "lists of intervals"; }
  void declare(const World&, Accesses&) const override {}
  void start(World&, const Clock&) override {
    steps_ = subcycle_.steps();
    choose();
  }
  void block(World&, const Clock&, Index, Index) override {}
  void keep(Archive& archive) override { archive("steps", steps_); }
  void loaded(World&) override { choose(); }

 private:
  static Real largest_h(const World& world) {
    return maximum(world.particles.size(), [&](Index i) { return world.particles.h[i]; });
  }
  void choose() { neighbours_.adapt_skin(least_skin * h_, most_skin * h_, skin_weight * steps_); }
  Neighbours& neighbours_;
  const Subcycle& subcycle_;
  Real h_;  ///< the largest at the start [L]
  int steps_ = 1;
};

/// The kick by the slow forces, as a force of this step; and what it means for the ledger that their kicks
/// are longer than those of the other forces.
class PairKick : public Force, public Impact, public EnergyTerm {
 public:
  PairKick(World& world, const Subcycle& subcycle)
      : subcycle_(subcycle),
        force_(subcycle_fields::pair_force.add(world.particles.fields)),
        of_now_(shared_fields::force_of_now.add(world.particles.fields)) {}
  std::string name() const override { return "pair forces"; }
  void declare(const World& world, Accesses& a) const override { a.reads(force_).updates(world.particles.f); }
  void block(World& world, const Clock&, Index begin, Index end) override {
    const Real weight = subcycle_.weight();
    for (int k = 0; k < world.dim; ++k) {
      const Real* from = force_.data(k);
      Real* f = world.particles.f.data(k);
      for (Index i = begin; i < end; ++i) f[i] += weight * from[i];
    }
  }
  void strike(World& world, const Clock&) override {
    const Real left = subcycle_.outer() ? 1 - subcycle_.weight() : 1;
    for_each(world.particles.active,
             [&](Index i) { of_now_.set(i, world.particles.f.vec(i) + left * force_.vec(i)); });
  }
  void record(World&, const Clock&, EnergyLedger&) override {}
  /// Points count all of f over half a step; the slow part holds since the middle of the last kick.
  void sample(const World& world, const Clock& clock, EnergyLedger& ledger) const override {
    const Particles& p = world.particles;
    const Real half = 0.5 * clock.dt_old;
    const Real more = subcycle_.lag() - (subcycle_.outer() ? half * subcycle_.weight() : 0);
    if (more == 0) return;
    const auto over_particles = [&](auto&& value) {
      return sum(p.active, [&](Index i) {
        const Vec counted = half * p.f.vec(i), whole = counted + more * force_.vec(i);
        return value(p.m[i], p.v.vec(i), counted, whole);
      });
    };
    ledger.half_step += over_particles([](Real m, const Vec& v, const Vec& counted, const Vec& whole) {
      return (whole - counted).dot(v) + 0.5 / m * (whole.squaredNorm() - counted.squaredNorm());
    });
    ledger.below += over_particles([](Real m, const Vec&, const Vec& counted, const Vec& whole) {
      return 0.5 / m * (whole.squaredNorm() - counted.squaredNorm());
    });
  }

 private:
  const Subcycle& subcycle_;
  Field<Real>&force_, &of_now_;
};

void choose(const Deck& deck, const Model& model, World& world, const SphSettings& settings,
            Diagnostics& diagnostics, SubcycleChoice& out) {
  if (world.particles.size() == 0) return;
  const auto* c = deck.last<CourantSubcycle>();
  const auto note = [&](const std::string& why) {
    diagnostics.note(deck.where(*c), "*COURANT_SUBCYCLE changes nothing: " + why);
  };
  if (!c) {
    if (has_structure(deck, world)) out.why_not = "no *COURANT_SUBCYCLE asks for that";
    return;
  }
  if (!has_structure(deck, world)) return note("the deck has no structure with a step of its own");
  const int most = c->nmax > 0 ? c->nmax : Subcycle::usual_most;
  if (most == 1) {
    out.why_not = "NMAX of *COURANT_SUBCYCLE is 1";
  } else if (const std::string what = what_needs_each_step(deck, model, world, settings); !what.empty()) {
    out.why_not = what + " needs the forces of each step";
    note(out.why_not);
  } else {
    out.most = most;
    subcycle_fields::mean_velocity.add(world.particles.fields);
    subcycle_fields::pair_force.add(world.particles.fields);
  }
}

const RegisterBuilder chooser(BuildPhase::conditions, "sub-cycling", choose, Errors::go_on);

}  // namespace

void add_subcycle(const SubcycleChoice& choice, Neighbours& neighbours, World& world) {
  if (choice.most == 1) return;
  const Particles& p = world.particles;
  const auto subcycle = world.passes.add(std::make_shared<Subcycle>(choice.most));
  world.passes.add(std::make_shared<MeanVelocity>(world, *subcycle));
  world.passes.add(std::make_shared<ClearPairForces>(world));
  world.passes.add(std::make_shared<ListsOfIntervals>(neighbours, world, *subcycle));
  const auto clears = [&](const BlockPass& pass) {  // the forces of each step
    Accesses accesses;
    pass.declare(world, accesses);
    return std::any_of(accesses.all().begin(), accesses.all().end(),
                       [&](const Access& a) { return a.what == &p.f && a.mode == Access::Mode::writes; });
  };
  world.passes.add(std::make_shared<PairKick>(world, *subcycle));
  for (BlockPass* pass : world.passes.all<BlockPass>())
    if (pass->phase() <= Phase::forces && &pass->over(world) == &p.fields && !clears(*pass))
      subcycle->add_slow(*pass);
}

}  // namespace courant
