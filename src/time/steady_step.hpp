#pragma once
#include <cstdint>
#include <limits>
#include <string>

#include "base/real.hpp"
#include "state/pass.hpp"
#include "state/saved_state.hpp"

namespace courant {

/// A step that stays what it is. Leapfrog keeps, of a mode, v^2 + omega^2 x^2 (1 - (omega dt)^2/4) with one
/// dt alone: steps that follow a limit as it goes back and forth with the strain of the smallest element, or
/// as corners touch and leave, pump the highest modes of the mesh (parametric resonance). So the step falls
/// at once, to somewhat below the limit; and after a while in which more was allowed it grows slowly to the
/// least of that while. Theory: docs/theory.md.
class SteadyStep {
 public:
  /// `ringing`: what those allow that would be pumped, `others` the others [T], not both infinite; `who` sets
  /// the smaller one now. Once a cycle. Others that are far below do no harm, and are taken as they come, as
  /// they are where nothing rings, once the step has grown to them.
  TimeLimit::Limit next(Real ringing, Real others, std::string who);
  /// `allowed`: finite [T].
  Real next(Real allowed);
  void keep(Archive& archive);

 private:
  void look_again();

  static constexpr Real none = std::numeric_limits<Real>::infinity();
  Real dt_ = none;         ///< the last one [T]
  Real target_ = none;     ///< to which it grows [T]
  Real least_ = none;      ///< allowed in this while [T]
  std::int64_t left_ = 0;  ///< steps of this while
  std::string who_;        ///< made it fall
};

}  // namespace courant
