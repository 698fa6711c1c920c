#include "surfaces/skin.hpp"

#include <algorithm>
#include <map>
#include <utility>

#include "state/shared_fields.hpp"

namespace courant {

namespace {

/// Corners of the faces of a hexahedron, counter-clockwise seen from outside.
constexpr int faces[6][4] = {{0, 3, 2, 1}, {4, 5, 6, 7}, {0, 1, 5, 4},
                             {1, 2, 6, 5}, {2, 3, 7, 6}, {3, 0, 4, 7}};

using Face = std::array<Index, 4>;

/// The nodes of a face, each once; of a triangle the third again. Less than three are no face: false.
bool nodes_of_face(const SkinCell& cell, const int (&corners)[4], Face& out) {
  std::size_t count = 0;
  for (const int c : corners) {
    const Index n = cell.node[static_cast<std::size_t>(c)];
    if (std::find(out.begin(), out.begin() + count, n) == out.begin() + count) out[count++] = n;
  }
  if (count == 3) out[3] = out[2];
  return count >= 3;
}

}  // namespace

std::array<Index, 4> sorted_corners(std::array<Index, 4> corner) {
  std::sort(corner.begin(), corner.end());
  const auto end = std::unique(corner.begin(), corner.end());
  std::fill(end, corner.end(), *(end - 1));
  return corner;
}

std::vector<Index> add_skin(World& world, const SkinStiffness& stiffness,
                            const std::vector<SkinCell>& cells) {
  std::map<Face, int> count;
  Face face;
  for (const SkinCell& cell : cells)
    for (const auto& corners : faces)
      if (nodes_of_face(cell, corners, face)) ++count[sorted_corners(face)];
  std::vector<std::pair<const SkinCell*, Face>> outer;
  for (const SkinCell& cell : cells)
    for (const auto& corners : faces)
      if (nodes_of_face(cell, corners, face) && (stiffness.inner || count[sorted_corners(face)] == 1))
        outer.emplace_back(&cell, face);
  Segments& s = world.segments;
  std::vector<Index> out;
  Index at = s.size();
  s.fields.resize(at + static_cast<Index>(outer.size()));
  for (const auto& [cell, of_cell] : outer) {
    face = of_cell;
    s.node0[at] = face[0], s.node1[at] = face[1], s.node2[at] = face[2], s.node3[at] = face[3];
    s.K[at] = stiffness.bulk_modulus;
    s.volume[at] = cell->volume;
    s.part[at] = stiffness.part;
    s.id[at] = cell->id;
    if (stiffness.inner && count[sorted_corners(face)] > 1)
      (*shared_fields::eroded.find(s.fields))[at] = shared_fields::hidden;
    out.push_back(at++);
  }
  return out;
}

std::vector<Index> add_skin(World& world, const SkinStiffness& stiffness) {
  const Segments& s = world.segments;
  std::vector<Index> out;
  for (Index k = 0; k < s.size(); ++k)
    if (s.part[k] == stiffness.part && s.volume[k] > 0) out.push_back(k);
  if (!out.empty()) return out;
  std::vector<SkinCell> cells;
  for (const auto& group : world.groups) {
    if (group->part != stiffness.part || group->corners() != 8) continue;
    for (Index e = 0; e < group->size(); ++e) {
      SkinCell& cell = cells.emplace_back(SkinCell{group->id[e], {}, group->V0[e]});
      for (int c = 0; c < 8; ++c) cell.node[static_cast<std::size_t>(c)] = group->node.data(c)[e];
    }
  }
  return add_skin(world, stiffness, cells);
}

}  // namespace courant
