#pragma once
// What the rate of strain makes of yield stresses, for the points of a block.
#include "laws/strength/yield_points.hpp"

namespace courant {

/// u = (rate/C)^(1/P): Cowper & Symonds 1957. [-]
struct CowperSymonds {
  Real C = 0, P = 1;  ///< [1/T], [-]; C = 0: none
  bool counts() const { return C > 0; }
};

/// A + B e^n, not above `most`. [M/LT2]
struct PowerHardening {
  Real A = 0, B = 0, n = 1, most = 0;
};

/// Compiled once for each instruction set.
struct RateLoops {
  /// Yield stresses and their slopes over plastic strain are there: times 1 + u.
  void (*scale)(const CowperSymonds& by, YieldPoints& points);
  /// The same plus stress u. [M/LT2]
  void (*add)(const CowperSymonds& by, Real stress, YieldPoints& points);
  /// Yield stresses without influence of the rate: K (e0 + e)^N; A + B e^n.
  void (*power_law)(Real K, Real e0, Real N, YieldPoints& points);
  void (*power_hardening)(const PowerHardening& of, YieldPoints& points);
  /// Times 1 + (C + C2 ln x) ln x, x = max(rate/rate0, 1); times x^C.
  void (*logarithmic)(Real rate0, Real C, Real C2, YieldPoints& points);
  void (*power_of_rate)(Real rate0, Real C, YieldPoints& points);
  void (*power_above_1)(Real rate0, Real C, YieldPoints& points);  ///< times (1 + rate/rate0)^C
  /// Plus Q (1 - e^(-C e)).
  void (*voce)(Real Q, Real C, YieldPoints& points);
  /// ln of rates; of rate 0 that of a tiny one.
  void (*logarithm)(Index count, const Real* rate, Real* out);
  /// Not above `most`, then times `factor` of each point; null: 1.
  void (*limit)(Real most, const Real* factor, YieldPoints& points);
};
/// For the machine the program runs on.
RateLoops rate_loops();

}  // namespace courant
