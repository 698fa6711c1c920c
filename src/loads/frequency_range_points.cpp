// *DAMPING_FREQUENCY_RANGE: forces on nodes of masses that dashpots couple to them.
#include <algorithm>

#include "extension/additions.hpp"
#include "loads/frequency_range.hpp"
#include "loads/middle_velocity.hpp"
#include "parallel/parallel.hpp"
#include "state/shared_fields.hpp"

namespace courant {

namespace {

/// Mechanism k of a node of mass m is a mass c_k m behind a dashpot c_k m/tau_k. Its velocity behind that of
/// the node, y_k, obeys y_k' = v' - y_k/tau_k, and f_d = -m sum c_k/tau_k y_k. y_k is of the middles of
/// steps; f_d takes the mean of y_k before and after the kick, which is known but for the share of f in it.
/// The step before represents the one to come.
class RangeDamping : public Constraint, public EnergyTerm {
 public:
  RangeDamping(const std::vector<FrequencyRange>& of_part, Points points)
      : of_part_(of_part), points_(points), driven_(points) {
    std::size_t most = 0;
    for (const FrequencyRange& range : of_part_) most = std::max(most, range.time.size());
    const std::string what = points.turns ? "turning_behind_mechanisms" : "velocity_behind_mechanisms";
    const auto add = [&](const std::string& name, std::size_t components) {
      return &points.set->add<Real>({.name = name,
                                     .dimension = points.turns ? "1/T" : "L/T",
                                     .components = static_cast<int>(components)});
    };
    behind_ = add(what, 3 * most), last_ = add(what + "_last", 3);
    force_ = &points.set->add<Real>(
        {.name = what + "_force", .dimension = "-", .components = 3, .restart = false});
    held_axes_ = points_.held().find(*points_.set);
  }
  std::string name() const override { return "damping of a range of frequencies, " + points_.name(); }
  const FieldSet& over(const World&) const override { return points_.fields(); }
  void declare(const World&, Accesses& a) const override {
    a.reads(*points_.v).reads(*points_.m).revises(*points_.f).reads(*points_.part);
    a.updates(*behind_).updates(*last_).updates(*force_);
    if (points_.follow) a.reads(*points_.follow);
    if (held_axes_) a.reads(*held_axes_);
    driven_.declare(a);
  }

  void start(World&, const Clock& clock) override {
    steps_.resize(of_part_.size());
    for (std::size_t p = 0; p < of_part_.size(); ++p) {
      steps_[p].clear();
      const FrequencyRange::Step step = of_part_[p].step(clock.dt_old);
      for (std::size_t k = 0; k < of_part_[p].time.size(); ++k) {
        const Real left = step.left[k], c = of_part_[p].share[k];
        steps_[p].push_back(
            {left, step.mean[k], c / of_part_[p].time[k] * 0.5 * (1 + left), 0.5 * c * (1 - left)});
      }
    }
  }
  void block(World&, const Clock& clock, Index begin, Index end) override {
    for (Index i = begin; i < end; ++i) {
      const Index part = (*points_.part)[i];
      const bool moves = part >= 0 && !(points_.follow && (*points_.follow)[i]);
      for (int axis = 0; axis < 3; ++axis) {
        Real& force = force_->data(axis)[i];
        force = 0;
        if (!moves) continue;
        const auto [resists, gives] = advance(i, axis, static_cast<std::size_t>(part), clock.cycle == 0);
        if (held_axes_ && ((*held_axes_)[i] & (1 << axis))) continue;
        Real& f = points_.f->data(axis)[i];
        const Real damped = (f - (*points_.m)[i] * resists) / (1 + gives);
        force = damped - f, f = damped;
      }
      if (!driven_.any(i)) continue;
      const Vec all = force_->vec(i), across = driven_.across(i, all);
      force_->set(i, across), points_.f->add(i, across - all);
    }
  }
  void record(World&, const Clock& clock, EnergyLedger& ledger) override {
    const MiddleVelocity v(points_, clock);
    const Real lost = sum(points_.fields().size(), [&](Index i) -> Real {
      const Vec force = force_->vec(i);  // 0 where others move the point, which may have no mass
      return force.isZero(0) ? 0 : -force.dot(v(i)) * clock.dt_mean();
    });
    ledger.dissipated += lost;
    ledger.throughput += std::abs(lost);
  }
  void sample(const World&, const Clock&, EnergyLedger&) const override {}

 private:
  struct Step {
    Real left, mean;      ///< of y_k, and of the change of v in y_k
    Real resists, gives;  ///< f_d/m of y_k before the kick, and of f/m in the kick
  };
  /// Takes the mechanisms of a node to the middle of the step before; f_d/m of them, and the share of f.
  std::pair<Real, Real> advance(Index i, int axis, std::size_t part, bool first) {
    const Real v = points_.v->data(axis)[i];
    Real& last = last_->data(axis)[i];
    const Real change = first ? 0 : v - last;
    last = v;
    Real resists = 0, gives = 0;
    for (std::size_t k = 0; k < steps_[part].size(); ++k) {
      const Step& step = steps_[part][k];
      Real& y = behind_->data(3 * static_cast<int>(k) + axis)[i];
      y = step.left * y + step.mean * change;
      resists += step.resists * y, gives += step.gives;
    }
    return {resists, gives};
  }

  std::vector<FrequencyRange> of_part_;
  Points points_;
  DrivenPoints driven_;
  Field<Real>*behind_, *last_, *force_;
  const Field<Index>* held_axes_;         ///< null: there are none
  std::vector<std::vector<Step>> steps_;  ///< of each part, of each mechanism
};

void damp_ranges(const Deck& deck, const Model& model, World& world, Diagnostics& diagnostics) {
  const auto why_not = [&](std::size_t part) {
    return model.parts[part].has_sph ? std::string("it has particles, and nodes alone are damped")
                                     : std::string();
  };
  const std::vector<FrequencyRange> of_part = frequency_ranges(deck, model, false, why_not, diagnostics);
  const bool any =
      std::any_of(of_part.begin(), of_part.end(), [](const FrequencyRange& r) { return r.any(); });
  if (!any || model.phase == RunPhase::relaxation) return;  // that has damping of its own
  world.passes.add(std::make_shared<RangeDamping>(of_part, points_of(world.nodes)));
  if (has_rotations(world.nodes))
    world.passes.add(std::make_shared<RangeDamping>(of_part, rotations_of(world.nodes)));
}
const RegisterAddition damping_of_ranges{"damping of a range of frequencies", damp_ranges};

}  // namespace

}  // namespace courant
