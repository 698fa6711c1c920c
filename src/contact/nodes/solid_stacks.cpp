#include "contact/nodes/solid_stacks.hpp"

#include <algorithm>
#include <numeric>

#include "contact/nodes/face.hpp"
#include "state/shared_fields.hpp"

namespace courant {

SolidStacks::SolidStacks(const World& world)
    : world_(world), erodes_(shared_fields::eroded.find(world.segments.fields) != nullptr) {
  constexpr int corners = 8;
  for (const auto& group : world.groups) {
    if (group->corners() != corners || erodes_) continue;
    for (Index e = 0; e < group->size(); ++e) {
      Solid& solid = solids_.emplace_back();
      for (int c = 0; c < corners; ++c) solid.node[static_cast<std::size_t>(c)] = group->node.data(c)[e];
      solid.volume = group->V0[e];
    }
  }
  first_.assign(static_cast<std::size_t>(world.nodes.size()) + 1, 0);
  for (const Solid& solid : solids_)
    for (const Index n : solid.node) ++first_[static_cast<std::size_t>(n) + 1];
  std::partial_sum(first_.begin(), first_.end(), first_.begin());
  of_node_.resize(static_cast<std::size_t>(first_.back()));
  std::vector<Index> next(first_.begin(), first_.end() - 1);
  for (std::size_t k = 0; k < solids_.size(); ++k)
    for (const Index n : solids_[k].node)
      of_node_[static_cast<std::size_t>(next[static_cast<std::size_t>(n)]++)] = static_cast<Index>(k);
}

Index SolidStacks::with(const std::array<Index, 4>& face, Index not_this) const {
  const auto at = static_cast<std::size_t>(face[0]);
  for (Index k = first_[at]; k < first_[at + 1]; ++k) {
    const Index s = of_node_[static_cast<std::size_t>(k)];
    const auto& node = solids_[static_cast<std::size_t>(s)].node;
    if (s != not_this && std::all_of(face.begin(), face.end(), [&](Index n) {
          return std::find(node.begin(), node.end(), n) != node.end();
        }))
      return s;
  }
  return -1;
}

Real SolidStacks::behind(Index segment, Real area, Real enough) const {
  const Segments& g = world_.segments;
  Real sum = g.volume[segment] / area;
  std::array<Index, 4> front = g.nodes(segment);
  for (Index s = with(front, -1); s >= 0 && sum < enough;) {
    const auto& node = solids_[static_cast<std::size_t>(s)].node;
    std::array<Index, 4> back{};
    std::size_t count = 0;
    for (std::size_t c = 0; c < node.size(); ++c) {
      const Index n = node[c];
      if (std::find(front.begin(), front.end(), n) != front.end() ||
          std::find(node.begin(), node.begin() + static_cast<std::ptrdiff_t>(c), n) !=
              node.begin() + static_cast<std::ptrdiff_t>(c))
        continue;
      if (count < back.size()) back[count] = n;
      ++count;
    }
    if (count != back.size()) break;  // it has no face opposite its front
    // nodes 1 to 4 run around one face, 5 to 8 around the other; between sides they may stand crosswise
    const Index next = with(back, s);
    if (next < 0) break;
    FaceCorners x;
    for (std::size_t c = 0; c < x.size(); ++c) x[c] = world_.nodes.x.vec(back[c]);
    const Real crossed = area_of({x[0], x[1], x[3], x[2]});
    sum += solids_[static_cast<std::size_t>(next)].volume / std::max(area_of(x), crossed);
    s = next, front = back;
  }
  return sum;
}

}  // namespace courant
