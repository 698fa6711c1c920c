#pragma once
// The two sides of a tied contact, as its card has them.
#include <vector>

#include "contact/cards.hpp"
#include "contact/tied/ties.hpp"
#include "state/world.hpp"

namespace courant {

class TieSides {
 public:
  explicit TieSides(const World& world) : world_(world) {}
  /// Segments of SURFB.
  std::vector<TieFace> faces(const ContactCard& c, const std::vector<Index>& segments) const;
  /// Nodes of SURFA. `around`: faces that they may belong to.
  std::vector<TieNode> nodes(const ContactCard& c, const std::vector<Index>& nodes,
                             const std::vector<Index>& around) const;
  Real area(Index segment) const { return area_of(corners_at(segment)); }
  /// The largest distance that the card gives; 0: none. [L]
  static Real tolerance(const ContactCard& c) {
    return c.sast < 0 || c.sbst < 0 ? 0.6 * (std::abs(c.sast) + std::abs(c.sbst)) : 0;
  }

 private:
  Real thickness(Index s, Real given, Real scale) const;
  Real stiffness(Index s, Real area) const;
  FaceCorners corners_at(Index s) const;

  const World& world_;
};

}  // namespace courant
