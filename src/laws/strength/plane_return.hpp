#pragma once
// Return to the surface of J2 plasticity in plane stress, for laws with isotropic hardening that follow
// Hooke's law below it (Simo & Taylor 1986, with transverse shear). With
//   P = (xx + yy)^2/4,  S = 3 (xx - yy)^2/4 + 3 (xy^2 + yz^2 + zx^2)
// of the trial stress, q^2 = P/f^2 + S/g^2, f = 1 + E m/(3 (1 - nu)), g = 1 + 2 G m and de = 2/3 m q, m the
// multiplier at which q is the yield stress at e + de.
#include "laws/point_block.hpp"
#include "parallel/parallel.hpp"

namespace courant {

/// What the return knows of Hooke's law.
struct PlaneElasticity {
  Real lambda, G;  ///< [M/LT2]
  Real of_f() const { return G * (3 * lambda + 2 * G) / (3 * (lambda + 2 * G)) * 2; }
  Real of_g() const { return 2 * G; }
};

/// Points of a block on their way to the surface.
struct PlaneReturn {
  Real P[block_size], S[block_size];       ///< [M2/L2T4]
  Real m[block_size];                      ///< [LT2/M]
  Real low[block_size], high[block_size];  ///< m of a q above, below the yield stress
  Real least[block_size];  ///< beside which excesses are judged, as beside the yield stress [M/LT2]
  Real q[block_size], fall[block_size];       ///< at m; -dq/dm
  Real plastic[block_size];                   ///< at m [-]
  Real yield[block_size], slope[block_size];  ///< at that strain; d yield/d plastic [M/LT2]
};

/// The steps of it, compiled once for each instruction set.
struct PlaneReturnLoops {
  /// The trial stress, P and S; m, its bounds; `sum` is xx + yy before.
  void (*go)(const PlaneElasticity& law, const PointBlock& block, Real* sum, PlaneReturn& r);
  /// q, fall and plastic at m.
  void (*measure)(const PlaneElasticity& law, Index count, const Real* before, PlaneReturn& r);
  /// m by Newton's method between its bounds; the largest excess of q over the yield stress, of that, among
  /// points that are not there.
  Real (*approach)(Index count, PlaneReturn& r);
  /// Stress and plastic strain at m; `rate_zz` has the sum before, and gets the rate without which there
  /// would be a stress zz. [1/T]
  void (*settle)(const PlaneElasticity& law, const PointBlock& block, Real* rate_zz, const PlaneReturn& r);
};
/// For the machine the program runs on.
PlaneReturnLoops plane_return_loops();

/// Stress, plastic strain (history 0) and rate zz at the end of the step.
/// `harden(count, plastic, yield, slope)` fills the latter two.
template <class Harden>
void update_in_plane(const PlaneReturnLoops& loops, const PlaneElasticity& law, const PointBlock& block,
                     Real* rate_zz, const Harden& harden) {
  constexpr int rounds = 100;
  constexpr Real close = 1e-7;  // before the last step, which squares it where hardening has no bend
  PlaneReturn r;
  loops.go(law, block, rate_zz, r);
  for (int k = 0; k < rounds; ++k) {
    loops.measure(law, block.count, block.history[0], r);
    harden(block.count, r.plastic, r.yield, r.slope);
    if (!(loops.approach(block.count, r) > close)) break;
  }
  loops.settle(law, block, rate_zz, r);
}

}  // namespace courant
