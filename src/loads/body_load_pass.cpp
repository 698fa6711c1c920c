// *LOAD_BODY and *LOAD_GRAVITY_PART as forces on points.
#include "loads/loads.hpp"
#include "parallel/parallel.hpp"
#include "state/restartable.hpp"
#include "state/shared_fields.hpp"
#include "state/tied_mass.hpp"

namespace courant {

namespace {

/// Potential energy is sum m phi(x, t), phi that of BodyAcceleration; where the loads change in time or
/// particles enter and leave, the difference is external work.
class BodyLoadPass : public Force, public EnergyTerm, public Refresh, public Restartable {
 public:
  BodyLoadPass(BodyAcceleration acceleration, Points points, World& world,
               std::shared_ptr<Neighbours> neighbours)
      : acceleration_(std::move(acceleration)),
        points_(points),
        neighbours_(std::move(neighbours)),
        added_(shared_fields::added_mass.find(points.fields())),
        tied_(shared_fields::tied_mass.find(points.fields())) {
    // heights count from the lowest point against gravity; where it begins at 0, from the mean of all
    // positions, which no order of points changes
    const Vec g = acceleration_.at(0).everywhere();
    Vec mean = Vec::Zero();
    Real count = 0;
    for (Index i = 0; i < points_.set->size(); ++i) {
      if (!acts_on(i)) continue;
      const Vec x = points_.x->vec(i);
      if (count == 0 || -g.dot(x) < -g.dot(origin_)) origin_ = x;
      mean += x, ++count;
    }
    if (g.isZero(0) && count > 0) origin_ = mean / count;
    particles_ = points_.set == &world.particles.fields;
  }
  std::string name() const override {
    return particles_ ? "body loads" : "body loads of " + points_.fields().name();
  }
  const FieldSet& over(const World&) const override { return points_.fields(); }
  void declare(const World&, Accesses& a) const override {
    a.reads(*points_.m).updates(*points_.f);
    if (points_.follow) a.reads(*points_.follow);
    if (added_) a.reads(*added_);
    if (tied_) a.reads(*tied_);
    if (acceleration_.uniform()) return;
    a.reads(*points_.x);
    if (points_.part) a.reads(*points_.part);
  }

  void start(World&, const Clock& clock) override { now_ = acceleration_.at(clock.t); }
  void block(World&, const Clock&, Index begin, Index end) override {
    if (acceleration_.uniform()) return add_uniform(now_.everywhere(), begin, end);
    for (Index i = begin; i < end; ++i)
      if (acts_on(i)) points_.f->add(i, weighs(i) * now_(points_.x->vec(i), part_of(i)));
  }

  void record(World& world, const Clock& clock, EnergyLedger& ledger) override {
    const BodyAcceleration::At change = acceleration_.change(clock.t, clock.t + clock.dt);
    if (change.zero()) return;
    const Real work = potential(world, change);
    ledger.external_work += work;
    ledger.throughput += std::abs(work);
  }
  void sample(const World& world, const Clock& clock, EnergyLedger& ledger) const override {
    ledger.potential += potential(world, acceleration_.at(clock.t));
  }

  void refreshed(World& world, const Clock& clock, std::span<const Index>) override {
    if (!neighbours_) return;
    const BodyAcceleration::At now = acceleration_.at(clock.t);
    if (!first_) {  // at once: from now on the potential energy is that of the other particles
      Real exchanged = 0;
      for (const Index i : neighbours_->entered()) exchanged += potential_of(now, i);
      for (const Index i : neighbours_->left()) exchanged -= potential_of(now, i);
      // loads that are not uniform do not change along a period (check_body_loads_periodic)
      for (const auto& [part, shift] : neighbours_->brought_back())
        exchanged += now.rise(Vec::Zero(), shift, part);
      world.energy.external_work += exchanged;
      world.energy.throughput += std::abs(exchanged);
    }
    first_ = false;
  }

  void keep(Archive& archive) override {
    archive("origin", origin_);
    archive("first", first_);
  }

 private:
  /// Nodes that faces carry weigh where they are; bodies have weights of their own.
  bool acts_on(Index i) const { return !points_.follow || (*points_.follow)[i] != 1; }
  /// Mass that mass scaling added has no weight, nor what a node has of those that its faces carry. [M]
  Real weighs(Index i) const {
    return (*points_.m)[i] - (added_ ? (*added_)[i] : 0) - (tied_ ? (*tied_)[i] : 0);
  }
  Index part_of(Index i) const { return points_.part ? (*points_.part)[i] : -1; }

  void add_uniform(const Vec& g, Index begin, Index end) {
    for (int k = 0; k < 3; ++k) {
      if (g[k] == 0) continue;
      Real* f = points_.f->data(k);
      const Real *m = points_.m->data(), gk = g[k];
      if (added_ || tied_) {
        for (Index i = begin; i < end; ++i)
          if (acts_on(i)) f[i] += weighs(i) * gk;
      } else if (points_.follow) {
        const Index* follow = points_.follow->data();
        for (Index i = begin; i < end; ++i) f[i] += follow[i] ? 0 : m[i] * gk;
      } else {
        for (Index i = begin; i < end; ++i) f[i] += m[i] * gk;
      }
    }
  }

  Real potential_of(const BodyAcceleration::At& now, Index i) const {
    return acts_on(i) ? weighs(i) * now.rise(origin_, points_.x->vec(i) - origin_, part_of(i)) : 0;
  }
  Real potential(const World& world, const BodyAcceleration::At& now) const {
    return sum(loaded_points(points_, world), [&](Index i) { return potential_of(now, i); });
  }

  BodyAcceleration acceleration_;
  BodyAcceleration::At now_;
  Points points_;
  std::shared_ptr<Neighbours> neighbours_;
  const Field<Real>* added_;  ///< null: no mass scaling
  const Field<Real>* tied_;   ///< null: no node is tied exactly
  bool particles_ = false;
  Vec origin_ = Vec::Zero();
  bool first_ = true;
};

}  // namespace

std::shared_ptr<Force> make_body_load(BodyAcceleration acceleration, Points points, World& world,
                                      std::shared_ptr<Neighbours> neighbours) {
  return std::make_shared<BodyLoadPass>(std::move(acceleration), points, world, std::move(neighbours));
}

}  // namespace courant
