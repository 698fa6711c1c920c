#pragma once
// Sub-cycling: forces between particles in every N-th step of the structure.
#include <algorithm>
#include <limits>
#include <map>
#include <memory>
#include <string>

#include "state/restartable.hpp"

namespace courant {

/// Pushes points by springs, with which kicks by slow forces could resonate.
struct Springs : virtual Pass {
  /// The longest time between two kicks on what it pushes, below half the period of its vibration. [T]
  virtual Real between_kicks(const World& world, const Clock& clock) const = 0;
};

/// Impulse multiple time stepping (r-RESPA: Tuckerman, Berne and Martyna 1992, J. Chem. Phys. 97). All points
/// move with the short step. Slow passes run at the outer steps only: their forces act there as a kick that
/// is as long as the time between the middles of the outer intervals before and after, and their rates hold
/// over the whole interval before.
class Subcycle : public virtual Pass, public Restartable {
 public:
  static constexpr int usual_most = 16;
  /// `most`: steps of an outer interval; 1: each step is an outer one.
  explicit Subcycle(int most) : most_(most) {}
  std::string name() const override { return "sub-cycling"; }
  /// That of a world; null: every pass runs in each step.
  static Subcycle* of(const World& world);

  void add_slow(BlockPass& pass);
  bool is_slow(const Pass& pass) const { return slow_passes_.contains(&pass); }
  /// What runs in its stead: a slow pass at the time of outer steps, another one itself.
  BlockPass* in_stead_of(BlockPass& pass) const {
    const auto found = slow_passes_.find(&pass);
    return found == slow_passes_.end() ? &pass : found->second.get();
  }
  /// Each step is an outer one from now on. `why`: for reports.
  void switch_off(std::string why) { most_ = 1, why_off_ = std::move(why); }
  const std::string& why_off() const { return why_off_; }  ///< empty: it is on

  /// At the start of a step: whether it is an outer one. Plans the interval that follows with the step
  /// before.
  bool begin(const Clock& clock);
  /// At an outer step, once dt is known. `limit`: the longest interval by the slow passes' own limits;
  /// `between`: by Springs. [T]
  void chosen(const Clock& clock, Real limit, Real between);
  /// After the motion of a step: decides whether the next one is an outer one.
  void end(const Clock& clock);
  /// The next step is an outer one whatever was planned.
  void make_outer() { outer_ = true; }

  bool outer() const { return outer_; }    ///< this step is an outer one
  bool single() const { return single_; }  ///< the interval before this outer step was one step
  Real weight() const { return weight_; }  ///< of the slow forces in this outer step, in kicks of one step
  Real interval() const { return slow_.dt_old; }  ///< before this outer step [T]
  int steps() const { return n_; }                ///< of the present interval, as planned
  Real limit() const { return limit_; }           ///< of the last outer step, by the slow passes [T]
  /// What an inner step may be at most. [T]
  Real left() const { return overrun * longest() - elapsed_; }
  /// The time of slow passes: dt_old is the interval before, dt_mean() that of the kick.
  const Clock& slow() const { return slow_; }
  /// The time from the half step of velocities, as slow forces count, to now, before the kick of this step.
  Real lag() const { return lag_; }
  /// Steps of an interval where a step is dt. [T]
  int steps_at(Real dt) const;

  void keep(Archive& archive) override;

 private:
  static constexpr Real overrun = 1.05;  ///< of the limit, where the step grows in an interval
  static constexpr Real reserve = 0.98;  ///< below which an interval gets one step more
  Real longest() const { return std::min(limit_, between_); }

  int most_;
  std::string why_off_;
  std::map<const Pass*, std::unique_ptr<BlockPass>> slow_passes_;
  bool outer_ = true, single_ = true, plain_ = true;
  int n_ = 1, taken_ = 0;  ///< steps planned, and taken since the last outer step
  Real weight_ = 1, elapsed_ = 0, planned_ = 0, lag_ = 0;
  Real ahead_ = 0;  ///< how far the last kick reaches beyond now [T]
  Real limit_ = std::numeric_limits<Real>::infinity(), between_ = std::numeric_limits<Real>::infinity();
  Clock slow_;
};

}  // namespace courant
