#pragma once
#include <stdexcept>
#include <string>

namespace courant {

/// What kind of fault stops a run: the advice depends on it.
enum class StopCause {
  other,
  not_finite,  ///< NaN or infinity in the state
  density,     ///< rho <= 0
  leap,        ///< a particle moved too far in one step
  element,     ///< an element without volume
  step_size,   ///< below DTMIN, or nothing limits it
  added_mass,  ///< of mass scaling, beyond ENDMAS
  direction,   ///< one that follows nodes has no meaning any more
  energy,      ///< more than came in, or beyond ENDENG
};

/// The run cannot go on: negative density, NaN, a step below DTMIN. The text names time, particle, part or
/// term.
struct RunError : std::runtime_error {
  explicit RunError(const std::string& text, StopCause why = StopCause::other)
      : std::runtime_error(text), cause(why) {}
  StopCause cause;
};

}  // namespace courant
