#pragma once
#include <optional>
#include <string>

#include "state/pass.hpp"

namespace courant {

/// A criterion that ends a run before its end time; the run counts as complete.
struct Ending : virtual Pass {
  /// The reason why the run ends after a step, with positions at clock.t. It has no state, so a restart finds
  /// the same end.
  virtual std::optional<std::string> ended(const World& world, const Clock& clock) const = 0;
};

}  // namespace courant
