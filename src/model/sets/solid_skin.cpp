// Segments on the faces of solids: _GENERAL rows of *SET_SEGMENT.
#include <algorithm>
#include <map>
#include <utility>

#include "base/solid_faces.hpp"
#include "model/sets/sets.hpp"

namespace courant {

SetResolver::Found SetResolver::skin(const SetCard& card, const Members& solids,
                                     const std::function<bool(Index)>& inside) {
  using Face = std::pair<Index, std::array<Index, 4>>;  // of a part; corners sorted
  std::map<Face, int> count;
  std::array<Index, 4> corner{};
  const auto key = [&](Index part) { return Face{part, sorted_corners(corner)}; };
  const auto for_faces = [&](const auto& act) {
    for (const Index k : solids) {
      const ModelSolid& solid = model_.solids[static_cast<std::size_t>(k)];
      const std::array<Index, 8> corners = solid.corners();
      for (const auto& face : hexahedron_faces)
        if (nodes_of_face(corners, face, corner)) act(solid.part);
    }
  };
  for (const Index k : solids) {
    const ModelSolid& solid = model_.solids[static_cast<std::size_t>(k)];
    if (!solid.has_nodes_on_edges()) continue;
    error(card, "E1", 0, "segments on the faces of solids with nodes on edges are not supported",
          "name the segments by *SET_SEGMENT");
    return std::nullopt;
  }
  for_faces([&](Index part) { ++count[key(part)]; });
  Members out;
  for_faces([&](Index part) {
    if (count[key(part)] == 1 && std::all_of(corner.begin(), corner.end(), inside))
      out.push_back(segment(corner));
  });
  sort_unique(out);
  return out;
}

}  // namespace courant
