#include "contact/nodes/face_edges.hpp"

#include <algorithm>

namespace courant {

FaceEdges::FaceEdges(const std::vector<ContactFace>& faces) : edge_(faces.size()) {
  struct Side {
    std::array<Index, 2> node;
    Index face;
    unsigned e;
    auto operator<=>(const Side&) const = default;
  };
  std::vector<Side> sides;
  for (std::size_t f = 0; f < faces.size(); ++f)
    for (unsigned e = 0; e < static_cast<unsigned>(faces[f].corners); ++e) {
      const auto ends = ends_of_edge(faces[f], e);
      const auto [low, high] = std::minmax(faces[f].node[ends[0]], faces[f].node[ends[1]]);
      sides.push_back({{low, high}, static_cast<Index>(f), e});
    }
  std::sort(sides.begin(), sides.end());
  for (std::size_t k = 0; k < sides.size(); ++k) {
    if (k == 0 || sides[k].node != sides[k - 1].node) first_.push_back(k);
    edge_[static_cast<std::size_t>(sides[k].face)][sides[k].e] = static_cast<Index>(first_.size()) - 1;
    at_.push_back(sides[k].face);
  }
  first_.push_back(at_.size());
}

}  // namespace courant
