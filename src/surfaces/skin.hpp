#pragma once
// The exterior faces of solids (their skin), as segments that contact can act on.
#include <vector>

#include "state/world.hpp"

namespace courant {

/// What contact needs to know of the solids of a part.
struct SkinStiffness {
  Index part = 0;         ///< index into the model's parts
  Real bulk_modulus = 0;  ///< of their material [M/LT2]
};

/// Adds the faces of a part's elements that no other of its elements has to world.segments, with normals that
/// point outwards, in the order of elements and faces. A part whose skin is there already gets no second one.
/// Returns the segments of its skin; none where the part has no solids.
std::vector<Index> add_skin(World& world, const SkinStiffness& stiffness);

}  // namespace courant
