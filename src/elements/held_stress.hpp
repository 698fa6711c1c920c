#pragma once
// Stress at points of elements that is given, not that of the law.
#include <memory>

#include "laws/point_block.hpp"
#include "state/entities.hpp"

namespace courant {

class HeldStress {
 public:
  virtual ~HeldStress() = default;
  /// Of the stresses to come. [T]
  virtual void start(Real t) = 0;
  /// Behind the law at a point of the elements from `begin` on: changes their stress.
  virtual void hold(int point, Index begin, const PointBlock& points) const = 0;
};

/// Forces of a group whose stress can be given.
struct HoldsStress {
  virtual ~HoldsStress() = default;
  virtual const ElementGroup& of_group() const = 0;
  virtual void hold_by(std::shared_ptr<HeldStress> stress) = 0;
};

}  // namespace courant
