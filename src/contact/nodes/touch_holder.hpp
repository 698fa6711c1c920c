#pragma once
#include "state/world.hpp"

namespace courant {

/// Who holds nodes from where they touch on: OPTION 1 and 3 of contacts that hold until they break.
struct TouchHolder {
  virtual ~TouchHolder() = default;
  virtual Id of_contact() const = 0;
  /// A node of SURFA is pushed off the face of a segment.
  virtual void touched(World& world, Index node, Index segment) = 0;
};

}  // namespace courant
