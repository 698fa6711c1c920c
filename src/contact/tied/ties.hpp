#pragma once
// Which nodes are tied to which faces.
#include <vector>

#include "contact/tied/face_point.hpp"

namespace courant {

/// A node that may be tied.
struct TieNode {
  struct OwnFace {
    Vec area = Vec::Zero();  ///< of a face of its own, along the normal [L2]
    int corners = 4;         ///< which share that
    Real stiffness = 0;      ///< of the face, per area [M/L2T2]
  };
  Index node = 0;              ///< index into World::nodes
  Real thickness = 0;          ///< of its shells, 0 without [L]
  std::vector<OwnFace> own{};  ///< faces that it is a corner of
};

/// A face to which nodes may be tied; ContactFace::r is half its thickness, ::k its stiffness per area
/// [M/L2T2].
using TieFace = ContactFace;

struct Tie {
  Index node = 0;     ///< index into World::nodes
  Index segment = 0;  ///< of the face, index into World::segments
  FacePoint at{};
  Real area = 0;    ///< of the node [L2]
  Real cell = 0;    ///< of one of the node's own faces there, on average; 0 without [L2]
  Real k = 0;       ///< of a penalty spring, before scales [M/T2]
  Real turn_k = 0;  ///< of a spring between its rotation and that of the face; 0: none [ML2/T2]
  Real side = 1;    ///< of the face that the node is on: of shells -1 where it is against the normal
};

/// Each node with the nearest face that it is over and no further from than the tolerance: `given` if > 0,
/// else the larger of 0.6 times the thicknesses of both and 0.05 times the shortest diagonal of the face
/// (of a triangle: side). In the order of nodes. Corners of faces are not tied; those next to faces that are
/// not their own go to `corners_near`.
std::vector<Tie> find_ties(const std::vector<TieNode>& nodes, const std::vector<TieFace>& faces, Real given,
                           const Field<Real>& x, std::vector<Index>* corners_near = nullptr);

/// Of a node at a position over a face.
Tie tie_at(const TieNode& node, const TieFace& face, const Projection& at, const Field<Real>& x);

/// The parts of ties in each node of the world, so that forces are gathered in a fixed order.
class TieShares {
 public:
  struct Share {
    Index tie = 0;
    int corner = -1;  ///< -1: the tied node itself
  };
  /// `of_nodes`: with the tied nodes themselves.
  TieShares(const std::vector<Tie>& ties, bool of_nodes, Index nodes);
  template <class Work>
  void for_each(Index node, const Work& work) const {
    for (Index k = first_[static_cast<std::size_t>(node)]; k < first_[static_cast<std::size_t>(node) + 1];
         ++k)
      work(shares_[static_cast<std::size_t>(k)]);
  }

 private:
  std::vector<Index> first_;
  std::vector<Share> shares_;
};

}  // namespace courant
