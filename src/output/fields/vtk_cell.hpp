#pragma once
// Elements as cells of VTK.
#include <cstdint>
#include <vector>

#include "state/entities.hpp"

namespace courant {

struct VtkCell {
  std::uint8_t type;  ///< VTK's number: 1 vertex, 3 line, 5 triangle, 9 quadrilateral, 10 tetrahedron, 12
                      ///< hexahedron, 13 wedge, 14 pyramid, 24 tetrahedron of ten nodes,
                      ///< 25 hexahedron of twenty nodes
  std::vector<int> corners;  ///< of the element, in VTK's order
};

/// LS-DYNA's order of corners is VTK's, but for hexahedra whose nodes stand several times: wedges, pyramids
/// and tetrahedra.
VtkCell vtk_cell(const ElementGroup& group, Index element);

}  // namespace courant
