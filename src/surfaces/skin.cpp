#include "surfaces/skin.hpp"

#include <algorithm>
#include <array>
#include <map>

namespace courant {

namespace {

/// Corners of the faces of a hexahedron, counter-clockwise seen from outside.
constexpr int faces[6][4] = {{0, 3, 2, 1}, {4, 5, 6, 7}, {0, 1, 5, 4},
                             {1, 2, 6, 5}, {2, 3, 7, 6}, {3, 0, 4, 7}};

struct Face {
  Index element;
  std::array<Index, 4> node;
};

std::vector<Face> outer_faces(const ElementGroup& group) {
  std::map<std::array<Index, 4>, int> count;
  const auto key = [](std::array<Index, 4> node) {
    std::sort(node.begin(), node.end());
    return node;
  };
  const auto nodes = [&](Index e, const int(&face)[4]) {
    std::array<Index, 4> out;
    for (std::size_t c = 0; c < 4; ++c) out[c] = group.node.data(face[c])[e];
    return out;
  };
  for (Index e = 0; e < group.size(); ++e)
    for (const auto& face : faces) ++count[key(nodes(e, face))];
  std::vector<Face> out;
  for (Index e = 0; e < group.size(); ++e)
    for (const auto& face : faces)
      if (count[key(nodes(e, face))] == 1) out.push_back({e, nodes(e, face)});
  return out;
}

}  // namespace

std::vector<Index> add_skin(World& world, const SkinStiffness& stiffness) {
  Segments& s = world.segments;
  std::vector<Index> out;
  for (Index k = 0; k < s.size(); ++k)
    if (s.part[k] == stiffness.part && s.volume[k] > 0) out.push_back(k);
  if (!out.empty()) return out;
  for (const auto& group : world.groups) {
    if (group->part != stiffness.part) continue;
    const std::vector<Face> skin = outer_faces(*group);
    const Index first = s.size();
    s.fields.resize(first + static_cast<Index>(skin.size()));
    for (std::size_t k = 0; k < skin.size(); ++k) {
      const Index at = first + static_cast<Index>(k);
      s.node0[at] = skin[k].node[0], s.node1[at] = skin[k].node[1];
      s.node2[at] = skin[k].node[2], s.node3[at] = skin[k].node[3];
      s.K[at] = stiffness.bulk_modulus;
      s.volume[at] = group->V0[skin[k].element];
      s.part[at] = stiffness.part;
      s.id[at] = group->id[skin[k].element];
      out.push_back(at);
    }
  }
  return out;
}

}  // namespace courant
