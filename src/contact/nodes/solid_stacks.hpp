#pragma once
// Depth of a body behind a face of a solid.
#include <array>
#include <vector>

#include "state/world.hpp"

namespace courant {

/// Solids of the world that are behind each other, as they are at the start.
class SolidStacks {
 public:
  explicit SolidStacks(const World& world);
  /// Sum of V/A, A of its front, of the solid behind a face of `area` and of those behind that, each across
  /// the face opposite its front, up to `enough`. Where elements may fail: of the first alone. [L]
  Real behind(Index segment, Real area, Real enough) const;

 private:
  struct Solid {
    std::array<Index, 8> node;
    Real volume;
  };
  /// Solids that have all four nodes but for `not_this`; -1: none.
  Index with(const std::array<Index, 4>& face, Index not_this) const;
  const World& world_;
  bool erodes_;
  std::vector<Solid> solids_;
  std::vector<Index> first_, of_node_;  ///< solids of each node of the world
};

}  // namespace courant
