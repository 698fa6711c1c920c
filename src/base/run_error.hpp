#pragma once
#include <stdexcept>
#include <string>
#include <utility>

namespace courant {

/// What kind of fault stops a run. Advice depends on the state of the scene but for the first.
enum class StopCause {
  other,       ///< the text is complete
  not_finite,  ///< NaN or infinity in the state
  density,     ///< rho <= 0
  leap,        ///< a particle moved too far in one step
  element,     ///< an element without volume
  step_size,   ///< below DTMIN, or nothing limits it
  energy,      ///< more than came in, or beyond ENDENG
};

/// The run cannot continue: negative density, NaN, a step below DTMIN. The text names time, particle, part or
/// term.
struct RunError : std::runtime_error {
  explicit RunError(const std::string& text, StopCause why = StopCause::other,
                    std::string what_to_change = {})
      : std::runtime_error(text), cause(why), hint(std::move(what_to_change)) {}
  RunError(const std::string& text, std::string what_to_change)
      : RunError(text, StopCause::other, std::move(what_to_change)) {}
  StopCause cause;
  std::string hint;  ///< one line; empty: advice depends on the state alone
};

}  // namespace courant
