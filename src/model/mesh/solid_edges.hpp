#pragma once
// Edges of solids by their corners, in LS-DYNA's order.
#include <array>

namespace courant {

using SolidEdge = std::array<int, 2>;
/// Also in the order of the nodes 9 to 20 on them: those of the lower face, of the upper face, between them.
constexpr SolidEdge edges_of_hexahedron[]{{0, 1}, {1, 2}, {2, 3}, {3, 0}, {4, 5}, {5, 6},
                                          {6, 7}, {7, 4}, {0, 4}, {1, 5}, {2, 6}, {3, 7}};
/// Of tetrahedra of ten nodes, in the order of the nodes 5 to 10 on them.
constexpr SolidEdge edges_of_tetrahedron[]{{0, 1}, {1, 2}, {2, 0}, {0, 3}, {1, 3}, {2, 3}};

}  // namespace courant
