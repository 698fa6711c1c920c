#pragma once
#include <vector>

#include "base/straight_pieces.hpp"
#include "keyword/deck.hpp"
#include "model/model.hpp"

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

/// How steep the yield stress may fall over plastic strain so that stress has one answer.
struct SteepestFall {
  Real slope;            ///< < 0: not reached [M/LT2]
  const char* too_fast;  ///< why a steeper one is refused
};
/// In solids and particles 3 G. Where stresses vanish, what is left answers more softly: in shells E/(2 (1 -
/// nu)), of equal pulls along two axes (plane_return.hpp: dq/dm against dq/de), in beams E.
SteepestFall steepest_fall_in_solids(Real G);
SteepestFall steepest_fall(const Model& model, Id mid, Real E, Real nu);

/// Takes away the blank fields behind the last point of a table of EPS and ES.
void drop_blank_points(Hardening& table);

/// Reports what is wrong with the points of such a table, of which there is at least one.
void check_points(const Deck& deck, const Entry& card, const Hardening& points, const SteepestFall& fall,
                  Diagnostics& diagnostics);

}  // namespace courant
