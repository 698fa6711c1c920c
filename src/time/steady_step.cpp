#include "time/steady_step.hpp"

#include <algorithm>
#include <utility>

namespace courant {

namespace {

constexpr Real growth = 1.002;       ///< a step
constexpr std::int64_t steps = 200;  ///< of a while
constexpr Real most_below = 0.01;    ///< the limit
constexpr Real further = 4;   ///< the step falls than the limit did, so that it soon lies below its swing
constexpr Real worth = 0.02;  ///< growth

}  // namespace

void SteadyStep::look_again() {
  least_ = none, left_ = steps;
}

TimeLimit::Limit SteadyStep::next(Real ringing, Real others, std::string who) {
  constexpr Real far_below = 0.5;
  if (ringing == none) {
    const Real steady = dt_ == none ? none : next(std::max(others, dt_));
    if (steady < (1 - 3 * most_below) * others) return {steady, who_ + ", in a step before"};
    *this = {};
    return {others, std::move(who)};
  }
  const Real before = dt_, now = std::min(ringing, others);
  const Real steady = next(std::min(ringing, std::max(others, far_below * ringing)));
  if (others <= steady) return {others, std::move(who)};
  if (steady < before) who_ = who;
  if (steady < (1 - 2 * most_below) * now) return {steady, who_ + ", in a step before"};
  return {steady, std::move(who)};
}

Real SteadyStep::next(Real allowed) {
  if (dt_ == none || !(allowed >= dt_)) {  // NaN goes through: the run must stop there
    const Real fall = dt_ == none ? 0 : 1 - allowed / dt_;
    dt_ = target_ = allowed * (1 - std::min(most_below, further * fall));
    look_again();
    return dt_;
  }
  least_ = std::min(least_, allowed);
  if (--left_ == 0) {
    if (least_ > (1 + worth) * dt_) target_ = (1 - most_below) * least_;
    look_again();
  }
  dt_ = std::max(dt_, std::min({growth * dt_, target_, allowed}));
  return dt_;
}

void SteadyStep::keep(Archive& archive) {
  archive("steady_dt", dt_);
  archive("steady_target", target_);
  archive("steady_least", least_);
  archive("steady_left", left_);
  archive("steady_who", who_);
}

}  // namespace courant
