#pragma once
#include <vector>

#include "base/straight_pieces.hpp"
#include "keyword/deck.hpp"

namespace courant {

/// Yield stress over effective plastic strain, straight between points and beyond the last. [M/LT2]
struct Hardening {
  std::vector<Real> strain, stress;  ///< at least two points, strain from 0 on, strictly increasing

  Real slope(std::size_t k) const { return slope_of_piece(strain, stress, k); }
  std::size_t piece(Real e) const { return piece_of(strain, e); }
  Real at(Real e) const {
    Real unused;
    return at(e, unused);
  }
  Real at(Real e, Real& slope_there) const {
    const std::size_t k = piece(e);
    slope_there = slope(k);
    return stress[k] + slope_there * (e - strain[k]);
  }
  /// The plastic strain de at which q - 3 G de is `scale` times the yield stress at e + de; q is above that
  /// at e. Exact: the pieces are walked through, on each of which this is linear.
  Real increment(Real q, Real three_g, Real e, Real scale = 1) const {
    for (std::size_t k = piece(e);; ++k) {
      const Real h = scale * slope(k);
      const Real de = (q - scale * stress[k] - h * (e - strain[k])) / (three_g + h);
      if (k + 2 == strain.size() || e + de <= strain[k + 1]) return de;
    }
  }
};

inline constexpr const char* falls_too_fast =
    "the yield stress falls faster than 3 G: stress has no unique answer";

/// Takes away the blank fields behind the last point of a table of EPS and ES.
void drop_blank_points(Hardening& table);

/// Reports what is wrong with the points of such a table, of which there is at least one. G: shear modulus
/// [M/LT2].
void check_points(const Deck& deck, const Entry& card, const Hardening& points, Real G,
                  Diagnostics& diagnostics);

}  // namespace courant
