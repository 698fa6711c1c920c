#pragma once
// Which faces of an interface meet at an edge, and at corners.
#include <array>
#include <span>
#include <vector>

#include "contact/nodes/face.hpp"

namespace courant {

/// Edge e of a face leads from its corner e to the next one.
class FaceEdges {
 public:
  explicit FaceEdges(const std::vector<ContactFace>& faces);
  /// Calls `what(g)` for each other face at edge e of face f, until it returns true; whether it did.
  template <class What>
  bool any_at(Index f, unsigned e, const What& what) const {
    const auto edge = static_cast<std::size_t>(edge_[static_cast<std::size_t>(f)][e]);
    for (auto k = first_[edge]; k < first_[edge + 1]; ++k)
      if (at_[k] != f && what(at_[k])) return true;
    return false;
  }
  /// Faces that share a corner with face f, itself included; ascending.
  std::span<const Index> around(Index f) const {
    const auto k = static_cast<std::size_t>(f);
    return {around_.data() + first_around_[k], first_around_[k + 1] - first_around_[k]};
  }

 private:
  std::vector<std::array<Index, 4>> edge_;  ///< of each face
  std::vector<std::size_t> first_;          ///< of each edge, into at_
  std::vector<Index> at_;                   ///< faces, ascending
  std::vector<std::size_t> first_around_;   ///< of each face, into around_
  std::vector<Index> around_;
};

/// The corners of edge e.
inline std::array<std::size_t, 2> ends_of_edge(const ContactFace& f, unsigned e) {
  return {e, (e + 1) % static_cast<unsigned>(f.corners)};
}

}  // namespace courant
