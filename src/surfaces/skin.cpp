#include "surfaces/skin.hpp"

#include <algorithm>
#include <map>
#include <span>
#include <utility>

#include "state/shared_fields.hpp"

namespace courant {

namespace {

using Face = std::array<Index, 4>;
using FaceCorners = std::array<int, 4>;

/// Corners of the faces, counter-clockwise seen from outside.
constexpr FaceCorners of_tetrahedron10[] = {{0, 6, 4, 4}, {6, 2, 5, 5}, {4, 5, 1, 1}, {6, 5, 4, 4},
                                            {0, 4, 7, 7}, {4, 1, 8, 8}, {7, 8, 3, 3}, {4, 8, 7, 7},
                                            {1, 5, 8, 8}, {5, 2, 9, 9}, {8, 9, 3, 3}, {5, 9, 8, 8},
                                            {2, 6, 9, 9}, {6, 0, 7, 7}, {9, 7, 3, 3}, {6, 7, 9, 9}};

/// Nodes around the faces of a hexahedron of twenty: corners, then those on the edges behind each.
constexpr int around[6][8] = {{0, 3, 2, 1, 11, 10, 9, 8},   {4, 5, 6, 7, 12, 13, 14, 15},
                              {0, 1, 5, 4, 8, 17, 12, 16},  {1, 2, 6, 5, 9, 18, 13, 17},
                              {2, 3, 7, 6, 10, 19, 14, 18}, {3, 0, 4, 7, 11, 16, 15, 19}};
constexpr std::array<FaceCorners, 30> of_hexahedron20 = [] {
  std::array<FaceCorners, 30> out{};
  std::size_t at = 0;
  for (const auto& f : around) {
    out[at++] = {f[4], f[5], f[6], f[7]};
    for (int c = 0; c < 4; ++c) out[at++] = {f[c], f[4 + c], f[4 + (c + 3) % 4], f[4 + (c + 3) % 4]};
  }
  return out;
}();
/// The three nodes next to each corner, counter-clockwise seen from it.
constexpr int beside_corner[8][3] = {{8, 16, 11},  {8, 9, 17},   {10, 18, 9},  {10, 11, 19},
                                     {12, 15, 16}, {12, 17, 13}, {14, 13, 18}, {14, 19, 15}};

std::span<const FaceCorners> faces_of(const SkinCell& cell) {
  if (cell.corners == 10) return of_tetrahedron10;
  if (cell.corners == 20) return of_hexahedron20;
  return hexahedron_faces;
}

}  // namespace

std::vector<std::array<Index, 8>> SkinCell::pieces() const {
  const auto at = [this](int c) { return node[static_cast<std::size_t>(c)]; };
  if (corners == 8) return {{at(0), at(1), at(2), at(3), at(4), at(5), at(6), at(7)}};
  std::vector<std::array<Index, 8>> out;
  const auto add = [&](int a, int b, int c, int d) {
    out.push_back({at(a), at(b), at(c), at(c), at(d), at(d), at(d), at(d)});
  };
  if (corners ==
      20) {  // tetrahedra at the corners; what is left is convex, and all of it is seen from a node
    static constexpr int from = 8;
    const auto has = [](const auto& nodes) {
      return std::find(nodes.begin(), nodes.end(), from) != nodes.end();
    };
    for (int corner = 0; corner < 8; ++corner) {
      const auto& [a, b, c] = beside_corner[corner];
      add(a, b, c, corner);
      if (!has(std::array{a, b, c})) add(c, b, a, from);
    }
    for (const auto& f : around)
      if (!has(std::array{f[4], f[5], f[6], f[7]}))
        out.push_back({at(f[7]), at(f[6]), at(f[5]), at(f[4]), at(from), at(from), at(from), at(from)});
    return out;
  }
  constexpr int tetrahedra[8][4] = {{0, 4, 6, 7}, {4, 1, 5, 8}, {6, 5, 2, 9}, {7, 8, 9, 3},
                                    {4, 9, 8, 5}, {4, 9, 7, 8}, {4, 9, 6, 7}, {4, 9, 5, 6}};
  for (const auto& [a, b, c, d] : tetrahedra) add(a, b, c, d);
  return out;
}

std::vector<Index> add_skin(World& world, const SkinStiffness& stiffness,
                            const std::vector<SkinCell>& cells) {
  std::map<Face, int> count;
  Face face;
  for (const SkinCell& cell : cells)
    for (const FaceCorners& corners : faces_of(cell))
      if (nodes_of_face(cell.node, corners, face)) ++count[sorted_corners(face)];
  std::vector<std::pair<const SkinCell*, Face>> outer;
  for (const SkinCell& cell : cells)
    for (const FaceCorners& corners : faces_of(cell))
      if (nodes_of_face(cell.node, corners, face) && (stiffness.inner || count[sorted_corners(face)] == 1))
        outer.emplace_back(&cell, face);
  Segments& s = world.segments;
  std::vector<Index> out;
  Index at = s.size();
  s.fields.resize(at + static_cast<Index>(outer.size()));
  for (const auto& [cell, of_cell] : outer) {
    face = of_cell;
    s.node0[at] = face[0], s.node1[at] = face[1], s.node2[at] = face[2], s.node3[at] = face[3];
    s.K[at] = stiffness.bulk_modulus;
    s.volume[at] = cell->corners == 8 ? cell->volume : cell->volume / 8;  // half as far apart
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
    if (group->part != stiffness.part || group->segment || group->corners() < 4) continue;
    const bool on_edges = group->corners() >= 10;
    const std::array<int, 8> corners = group->hexahedron();
    for (Index e = 0; e < group->size(); ++e) {
      SkinCell& cell =
          cells.emplace_back(SkinCell{group->id[e], on_edges ? group->corners() : 8, {}, group->V0[e]});
      for (std::size_t c = 0; c < static_cast<std::size_t>(cell.corners); ++c)
        cell.node[c] = group->node.data(on_edges ? static_cast<int>(c) : corners[c])[e];
    }
  }
  return add_skin(world, stiffness, cells);
}

}  // namespace courant
