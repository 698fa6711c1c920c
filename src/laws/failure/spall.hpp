#pragma once
// What tension a material with an equation of state bears (SPALL and PC of its card).
#include <limits>

#include "laws/point_block.hpp"

namespace courant {

struct Spall {
  /// 1: pressure does not fall below PC. Else a point spalls, for good: it has no deviator and bears no
  /// tension; 2: where the largest principal stress is above -PC, 3: where the pressure is below PC.
  int option = 1;
  Real limit = -std::numeric_limits<Real>::infinity();  ///< PC, < 0; infinite: all tension is borne [M/LT2]

  /// Points keep whether they have spalled: one number of the law's history.
  bool keeps() const { return option != 1 && limit > -std::numeric_limits<Real>::infinity(); }
  Real cutoff() const { return option == 1 ? limit : -std::numeric_limits<Real>::infinity(); }
  /// Behind the return of the deviator and its share of the sound speed, which is 0 then. `spalled`: 0 or 1
  /// of each point.
  void look(const PointBlock& block, Real* spalled) const;

  /// PC of a card, on which 0 is none.
  static Real limit_of(Real pc) { return pc < 0 ? pc : -std::numeric_limits<Real>::infinity(); }
};

}  // namespace courant
