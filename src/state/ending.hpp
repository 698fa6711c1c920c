#pragma once
#include <optional>
#include <string>

#include "state/pass.hpp"

namespace courant {

/// A criterion that ends a run before its end time, as a run that is complete.
struct Ending : virtual Pass {
  /// Why the run ends, after a step: positions are those at clock.t. It keeps no state, so that a restart
  /// finds the same end.
  virtual std::optional<std::string> ended(const World& world, const Clock& clock) const = 0;
};

}  // namespace courant
