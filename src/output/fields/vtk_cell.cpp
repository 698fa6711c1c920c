#include "output/fields/vtk_cell.hpp"

namespace courant {

VtkCell vtk_cell(const ElementGroup& group, Index e) {
  constexpr std::uint8_t vertex = 1, line = 3, triangle = 5, quadrilateral = 9, tetrahedron = 10,
                         hexahedron = 12, wedge = 13, pyramid = 14, quadratic_tetrahedron = 24,
                         quadratic_hexahedron = 25;
  if (group.corners() == 1) return {vertex, {0}};
  if (group.corners() == 3) return {triangle, {0, 1, 2}};
  if (group.corners() == 4 && group.segment) return {quadrilateral, {0, 1, 2, 3}};
  if (group.corners() == 2) return {line, {0, 1}};
  if (group.corners() == 4) return {tetrahedron, {0, 1, 2, 3}};
  if (group.corners() == 10) return {quadratic_tetrahedron, {0, 1, 2, 3, 4, 5, 6, 7, 8, 9}};
  if (group.corners() == 20) {
    VtkCell out{quadratic_hexahedron, {}};
    for (int c = 0; c < 20; ++c) out.corners.push_back(c);
    return out;
  }
  const auto same = [&](int a, int b) { return group.node.data(a)[e] == group.node.data(b)[e]; };
  const bool to_a_point = same(4, 5) && same(4, 6) && same(4, 7);
  if (to_a_point) return same(2, 3) ? VtkCell{tetrahedron, {0, 1, 2, 4}} : VtkCell{pyramid, {0, 1, 2, 3, 4}};
  if (same(4, 5) && same(6, 7)) return {wedge, {0, 1, 4, 3, 2, 6}};
  if (same(2, 3) && same(6, 7)) return {wedge, {0, 2, 1, 4, 6, 5}};
  return {hexahedron, {0, 1, 2, 3, 4, 5, 6, 7}};
}

}  // namespace courant
