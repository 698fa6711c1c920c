#pragma once
#include <cstdint>

#include "state/pass.hpp"
#include "state/restartable.hpp"

namespace courant {

/// Examines, when histories are written, whether elements change their shape without the stress of that
/// change, and writes what is missing into `maxima` of the world, for the verdict.
class ShapeWatch : public Pass, public Restartable {
 public:
  /// Does nothing until some steps after the last check: a check takes the time of two steps.
  virtual void look(World& world, std::int64_t cycle) = 0;
};

}  // namespace courant
