#include "contact/nodes/face_edges.hpp"

#include <algorithm>
#include <utility>

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
  std::vector<std::pair<Index, Index>> corners;  // node, face
  for (std::size_t f = 0; f < faces.size(); ++f)
    for (const Index n : faces[f].node) corners.emplace_back(n, static_cast<Index>(f));
  std::sort(corners.begin(), corners.end());
  for (const ContactFace& face : faces) {
    const std::size_t begin = around_.size();
    first_around_.push_back(begin);
    for (const Index n : face.node)
      for (auto at = std::lower_bound(corners.begin(), corners.end(), std::pair<Index, Index>(n, 0));
           at != corners.end() && at->first == n; ++at)
        around_.push_back(at->second);
    const auto from = around_.begin() + static_cast<std::ptrdiff_t>(begin);
    std::sort(from, around_.end());
    around_.erase(std::unique(from, around_.end()), around_.end());
  }
  first_around_.push_back(around_.size());
}

}  // namespace courant
