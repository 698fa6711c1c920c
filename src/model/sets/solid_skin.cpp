// Segments on the faces of solids: _GENERAL rows of *SET_SEGMENT.
#include <algorithm>
#include <map>
#include <utility>

#include "model/sets/sets.hpp"

namespace courant {

namespace {

/// Corners of the faces of a hexahedron, counter-clockwise seen from outside.
constexpr std::size_t faces_of_hexahedron[6][4] = {{0, 3, 2, 1}, {4, 5, 6, 7}, {0, 1, 5, 4},
                                                   {1, 2, 6, 5}, {2, 3, 7, 6}, {3, 0, 4, 7}};

/// The nodes of a face, each once, of a triangle the last one again; false: fewer than three.
bool corners_of_face(const std::array<Index, 8>& solid, const std::size_t (&face)[4],
                     std::array<Index, 4>& out) {
  std::size_t count = 0;
  for (const std::size_t c : face)
    if (std::find(out.begin(), out.begin() + count, solid[c]) == out.begin() + count) out[count++] = solid[c];
  if (count == 3) out[3] = out[2];
  return count >= 3;
}

}  // namespace

SetResolver::Found SetResolver::skin(const SetCard& card, const Members& solids,
                                     const std::function<bool(Index)>& inside) {
  using Face = std::pair<Index, std::array<Index, 4>>;  // of a part; corners sorted
  std::map<Face, int> count;
  std::array<Index, 4> corner{};
  const auto sorted = [](Index part, std::array<Index, 4> corners) {
    std::sort(corners.begin(), corners.begin() + (corners[3] == corners[2] ? 3 : 4));
    if (corners[3] == corners[2] || corners[3] < corners[2]) corners[3] = corners[2];
    return Face{part, corners};
  };
  const auto for_faces = [&](const auto& act) {
    for (const Index k : solids) {
      const ModelSolid& solid = model_.solids[static_cast<std::size_t>(k)];
      const std::array<Index, 8> corners = solid.corners();
      for (const auto& face : faces_of_hexahedron)
        if (corners_of_face(corners, face, corner)) act(solid.part);
    }
  };
  for (const Index k : solids) {
    const ModelSolid& solid = model_.solids[static_cast<std::size_t>(k)];
    if (!solid.has_nodes_on_edges()) continue;
    error(card, "E1", 0, "segments on the faces of solids with nodes on edges are not supported",
          "name the segments by *SET_SEGMENT");
    return std::nullopt;
  }
  for_faces([&](Index part) { ++count[sorted(part, corner)]; });
  Members out;
  for_faces([&](Index part) {
    if (count[sorted(part, corner)] == 1 && std::all_of(corner.begin(), corner.end(), inside))
      out.push_back(segment(corner));
  });
  sort_unique(out);
  return out;
}

}  // namespace courant
