#pragma once
#include <cstdint>
#include <limits>
#include <string>

#include "base/real.hpp"
#include "state/pass.hpp"
#include "state/saved_state.hpp"

namespace courant {

/// A nearly constant step. Leapfrog conserves v^2 + omega^2 x^2 (1 - (omega dt)^2/4) of a mode only at
/// constant dt: steps that follow a limit as it oscillates with the strain of the smallest element, or as
/// corners touch and separate, pump the highest modes of the mesh (parametric resonance). So the step falls
/// at once, to slightly below the limit. After an interval with larger limits it grows slowly to the least
/// limit of that interval. Theory: docs/theory.md.
class SteadyStep {
 public:
  /// `ringing`: limit of the passes that would be pumped, `others`: limit of the other passes [T], not both
  /// infinite; `who`: source of the smaller one. Called once per cycle. `others` far below `ringing` are used
  /// directly, as they are where nothing rings, once the step has grown to them.
  TimeLimit::Limit next(Real ringing, Real others, std::string who);
  /// `allowed`: finite [T].
  Real next(Real allowed);
  void keep(Archive& archive);

 private:
  void look_again();

  static constexpr Real none = std::numeric_limits<Real>::infinity();
  Real dt_ = none;         ///< the last one [T]
  Real target_ = none;     ///< to which it grows [T]
  Real least_ = none;      ///< limit in this interval [T]
  std::int64_t left_ = 0;  ///< remaining steps of this interval
  std::string who_;        ///< source of the last fall
};

}  // namespace courant
