// *COURANT_DAMPING_ZONE: a force against the velocity that grows along a direction.
//   f = - m RATE s^EXP v,  s = ((x - start) . e)/L from 0 at the start to 1 at the end and beyond
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>

#include "extension/additions.hpp"
#include "keyword/registry.hpp"
#include "loads/damping_zone_cards.hpp"
#include "loads/loads.hpp"
#include "loads/middle_velocity.hpp"
#include "parallel/parallel.hpp"

namespace courant {

namespace {

const RegisterKeyword<DampingZoneCard> damping_zone_keyword{courant_damping_zone_table()};

struct DampingZoneShape {
  Vec start = Vec::Zero(), along = Vec::Zero();  ///< `along`: (end - start)/L^2, so that s needs no division
  Real rate = 0, exponent = 2;                   ///< [1/T], [-]
  std::optional<Box> box{};
  /// Damping at a position [1/T]
  Real at(const Vec& x) const {
    const Real s = std::min<Real>(1, (x - start).dot(along));
    if (s <= 0 || (box && !box->contains(x))) return 0;
    return rate * std::pow(s, exponent);
  }
};

class DampingZone : public Force, public TimeLimit, public EnergyTerm {
 public:
  DampingZone(Points points, DampingZoneShape shape) : points_(points), shape_(std::move(shape)) {}
  std::string name() const override { return "damping zone"; }
  const FieldSet& over(const World&) const override { return points_.fields(); }
  void declare(const World&, Accesses& a) const override {
    a.reads(*points_.x).reads(*points_.v).reads(*points_.m).updates(*points_.f);
  }
  void block(World&, const Clock&, Index begin, Index end) override {
    for (Index i = begin; i < end; ++i)
      if (const Real rate = shape_.at(points_.x->vec(i)); rate > 0) points_.f->add(i, force(i, rate));
  }
  // A longer step would turn the velocity round.
  Limit limit(const World&, const Clock&) override { return {1 / shape_.rate, name()}; }
  void record(World& world, const Clock& clock, EnergyLedger& ledger) override {
    const MiddleVelocity v(points_, clock);
    const Real taken = sum(loaded_points(points_, world), [&](Index i) {
      const Real rate = shape_.at(points_.x->vec(i));
      return rate > 0 ? -force(i, rate).dot(v(i)) * clock.dt_mean() : Real(0);
    });
    ledger.dissipated += taken;
    ledger.throughput += std::abs(taken);
  }
  void sample(const World&, const Clock&, EnergyLedger&) const override {}

 private:
  /// [ML/T2]
  Vec force(Index i, Real rate) const { return -(*points_.m)[i] * rate * points_.v->vec(i); }
  Points points_;
  DampingZoneShape shape_;
};

void build_damping_zones(const Deck& deck, const Model& model, World& world, Diagnostics& diagnostics) {
  for (const DampingZoneCard& card : deck.all<DampingZoneCard>()) {
    DampingZoneShape shape{.start = Vec(card.xs, card.ys, world.dim == 3 ? card.zs : 0),
                           .rate = card.rate,
                           .exponent = card.exp};
    const Vec length = Vec(card.xe, card.ye, world.dim == 3 ? card.ze : 0) - shape.start;
    if (!(length.norm() > 0)) {
      deck.error(diagnostics, card, "XE", "the damping zone has no length",
                 "its end is another point than its start");
      continue;
    }
    if (!(card.exp > 0)) {
      deck.error(diagnostics, card, "EXP", fmt::format("the exponent is {:g}", card.exp),
                 "it must be above 0");
      continue;
    }
    if (world.particles.size() == 0) {
      deck.error(diagnostics, card, "XS", "the damping zone slows particles, and the deck has none",
                 "*DAMPING_PART_MASS slows nodes");
      continue;
    }
    shape.along = length / length.squaredNorm();
    if (card.boxid != 0) {
      const auto box = model.boxes.find(card.boxid);
      if (box == model.boxes.end()) {
        deck.error(diagnostics, card, "BOXID", fmt::format("box {} does not exist", card.boxid),
                   "define it with *DEFINE_BOX");
        continue;
      }
      shape.box = box->second;
    }
    const Particles& p = world.particles;
    if (maximum(p.size(), [&](Index i) { return shape.at(p.x.vec(i)); }) == 0)
      deck.warning(diagnostics, card, "XS", "no particle is in the damping zone at the start",
                   "it slows only what comes there later: look at its start and end");
    world.passes.add(std::make_shared<DampingZone>(points_of(world.particles), std::move(shape)));
  }
}

const RegisterAddition damping_zones{"damping zones", build_damping_zones};

}  // namespace

}  // namespace courant
