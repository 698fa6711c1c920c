#include <fmt/format.h>

#include "model/cards.hpp"
#include "parallel/parallel.hpp"
#include "sph/sph.hpp"
#include "state/keeper.hpp"

namespace courant {

Vec gravity_at(const std::vector<BodyLoad>& loads, Real t) {
  Vec g = Vec::Zero();
  for (const BodyLoad& load : loads)
    if (load.kind == BodyLoad::Kind::translation && load.parts.empty())
      g -= load.sf * load.curve(t) * load.direction;  // the base accelerates, bodies feel the opposite
  return g;
}
std::function<Vec(Real t)> gravity_of(std::vector<BodyLoad> loads) {
  return [loads = std::move(loads)](Real t) { return gravity_at(loads, t); };
}

void warn_of_loads_along_z(const Deck& deck, Diagnostics& diagnostics) {
  for (const LoadBodyCard& card : deck.all<LoadBodyCard>())
    if (card.name == 2 && card.sf != 0)
      diagnostics.warning(deck.where(card),
                          fmt::format("{}: in 2D nothing moves along z: no effect", deck.keyword(card)),
                          "gravity of a 2D scene is *LOAD_BODY_X or *LOAD_BODY_Y");
}

namespace {

/// LOAD_BODY_X/Y/Z on active particles. Potential energy is - sum m g(t).x; where the curve changes or
/// particles enter and leave, the difference is external work.
class Gravity : public Force, public EnergyTerm, public Refresh, public Keeper {
 public:
  Gravity(const Model& model, World& world, std::shared_ptr<Neighbours> neighbours)
      : loads_(model.body_loads), neighbours_(std::move(neighbours)) {
    const Particles& p = world.particles;  // heights count from the lowest particle against gravity
    const Vec g = gravity_at(loads_, 0);
    for (Index i = 0; i < p.size(); ++i) {
      const Real height = -g.dot(p.x.vec(i));
      if (i == 0 || height < -g.dot(origin_)) origin_ = p.x.vec(i);
    }
  }
  std::string name() const override { return "gravity"; }
  void declare(const World& world, Accesses& a) const override {
    a.reads(world.particles.m).updates(world.particles.f);
  }

  void block(World& world, const Clock& clock, Index begin, Index end) override {
    Particles& p = world.particles;
    const Vec g = gravity_at(loads_, clock.t);
    for (int k = 0; k < 3; ++k) {
      if (g[k] == 0) continue;
      Real* f = p.f.data(k);
      const Real *m = p.m.data(), gk = g[k];
      for (Index i = begin; i < end; ++i) f[i] += m[i] * gk;
    }
  }

  void record(World& world, const Clock& clock, EnergyLedger& ledger) override {
    const Vec change = gravity_at(loads_, clock.t + clock.dt) - gravity_at(loads_, clock.t);
    if (change.isZero(0)) return;
    const Real work = potential(world, change);
    ledger.external_work += work;
    ledger.throughput += std::abs(work);
  }

  void refreshed(World& world, const Clock& clock, std::span<const Index>) override {
    const Vec g = gravity_at(loads_, clock.t);
    if (!first_) {  // at once: from now on the potential energy is that of the other particles
      Real exchanged = 0;
      for (const Index i : neighbours_->entered()) exchanged += potential_of(world.particles, g, i);
      for (const Index i : neighbours_->left()) exchanged -= potential_of(world.particles, g, i);
      if (neighbours_->images()) exchanged -= g.dot(neighbours_->images()->brought_back());
      world.energy.external_work += exchanged;
      world.energy.throughput += std::abs(exchanged);
    }
    first_ = false;
  }

  void keep(Archive& archive) override {
    archive("origin", origin_);
    archive("first", first_);
  }

  Real potential(const World& world, const Vec& g) const {
    return sum(world.particles.active, [&](Index i) { return potential_of(world.particles, g, i); });
  }
  void sample(const World& world, const Clock& clock, EnergyLedger& ledger) const override {
    ledger.potential += potential(world, gravity_at(loads_, clock.t));
  }

 private:
  Real potential_of(const Particles& p, const Vec& g, Index i) const {
    return -p.m[i] * g.dot(p.x.vec(i) - origin_);
  }
  std::vector<BodyLoad> loads_;
  std::shared_ptr<Neighbours> neighbours_;
  Vec origin_ = Vec::Zero();
  bool first_ = true;
};

}  // namespace

std::shared_ptr<Force> make_gravity(const Model& model, World& world,
                                    std::shared_ptr<Neighbours> neighbours) {
  return std::make_shared<Gravity>(model, world, std::move(neighbours));
}

}  // namespace courant
