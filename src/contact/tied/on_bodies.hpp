#pragma once
// Masses that rigid bodies get from nodes that are tied to their faces.
#include <vector>

#include "contact/tied/build.hpp"
#include "contact/tied/constraint.hpp"

namespace courant {

/// Whether all corners of the face belong to one rigid body.
bool is_on_body(const Tie& tie, const WallBodies& bodies);

/// Make it before start_constraint, and call `give` after that.
class MassesOfBodies {
 public:
  MassesOfBodies(const TiedConstraint& tied, const TiedOptions& options, const World& world);
  /// Returns the mass that counts for nothing, as that of the body is given. [M]
  Real give(World& world) const;

 private:
  struct Corner {
    Index node;
    Real mass, inertia;
  };
  const TiedConstraint& tied_;
  const TiedOptions& options_;
  std::vector<Corner> corners_{};  ///< of rigid bodies, with what they have before
};

}  // namespace courant
