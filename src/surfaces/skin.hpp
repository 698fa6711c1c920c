#pragma once
// The exterior faces of solids (their skin), as segments that contact can act on.
#include <array>
#include <vector>

#include "base/solid_faces.hpp"
#include "state/world.hpp"

namespace courant {

/// What contact needs to know of the solids of a part.
struct SkinStiffness {
  Index part = 0;         ///< index into the model's parts
  Real bulk_modulus = 0;  ///< of their material [M/LT2]
  bool inner = false;     ///< faces between elements, too, of each of the two, marked as hidden
};

/// A hexahedron, or what becomes of it where nodes stand several times; or a tetrahedron with nodes on its
/// edges, each face of which is four triangles, or a
/// hexahedron with nodes on its edges, each face of which is four triangles around a quadrilateral.
struct SkinCell {
  Id id = 0;
  int corners = 8;               ///< or 10, 20
  std::array<Index, 20> node{};  ///< of the world, in LS-DYNA's order
  Real volume = 0;               ///< [L3]
  /// Hexahedra (collapsed ones) that fill it: itself, the eight tetrahedra between nodes of ten, or
  /// tetrahedra and pyramids between those of twenty.
  std::vector<std::array<Index, 8>> pieces() const;
};

/// Adds the faces of cells that no other of them has to world.segments, with normals that point outwards, in
/// the order of cells and faces. Returns these segments. With `inner` the world needs shared_fields::eroded
/// of segments.
std::vector<Index> add_skin(World& world, const SkinStiffness& stiffness, const std::vector<SkinCell>& cells);

/// The same for the elements of a part in the world's groups. A part whose skin is there already gets no
/// second one. Returns the segments of its skin; none where the part has no solids.
std::vector<Index> add_skin(World& world, const SkinStiffness& stiffness);

}  // namespace courant
