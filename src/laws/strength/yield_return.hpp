#pragma once
// Return to the surface of J2 plasticity, for laws that follow Hooke's law below it. Each point has one
// unknown x, at which its effective stress q(x) is the yield stress at the plastic strain and rate of x.
//
// In space (radial return, Krieg & Key 1976) x is the increment of plastic strain and q = q_tr - (3 G + H) x,
// H the kinematic modulus. In plane stress (Simo & Taylor 1986, with transverse shear) x is the multiplier m
// and de = 2/3 m q. With
//   P = (xx + yy)^2/4,  S = 3 (xx - yy)^2/4 + 3 (xy^2 + yz^2 + zx^2)
// of the trial stress less the back stress, q^2 = P/f^2 + S/g^2, f = 1 + (E/(3 (1 - nu)) + 2/3 H) m,
// g = 1 + (2 G + 2/3 H) m. The rate zz, a part of the rate of volume, follows from m as well.
#include <limits>

#include "laws/point_block.hpp"
#include "laws/strength/radial_return.hpp"
#include "laws/strength/yield_points.hpp"

namespace courant {

/// Hooke's law and what the yield stress depends on.
struct ReturnLaw {
  Real lambda = 0, G = 0;  ///< [M/LT2]
  Real kinematic = 0;      ///< the back stress moves by kinematic (de/q) xi; 0: there is none [M/LT2]
  YieldRate rate = YieldRate::none;
  /// The yield stress rises from its first value with an infinite slope, by a small power of plastic strain:
  /// Newton's method then is one for the fourth root of x, in which such powers are nearly straight. So it is
  /// where a rate counts.
  bool steep = false;
  bool smooth = false;  ///< the yield stress has no bend, over plastic strain or rate
  Real elastic_f() const { return G * (3 * lambda + 2 * G) / (3 * (lambda + 2 * G)) * 2; }
  Real of_f() const { return elastic_f() + 2.0 / 3 * kinematic; }
  Real of_g() const { return 2 * G + 2.0 / 3 * kinematic; }
};

/// Points of a block on their path to the surface.
struct ReturnPoints {
  YieldPoints at;                          ///< at x
  Real x[block_size];                      ///< [-] in space, [LT2/M] in the plane
  Real low[block_size], high[block_size];  ///< x of a q above, below the yield stress
  Real excess[block_size];                 ///< of q over the yield stress at `low` [M/LT2]
  Real first[block_size];                  ///< the first try is not above this
  Real volume[block_size];                 ///< tr(D), in the plane at x = 0 [1/T]
  Real least[block_size];  ///< beside which excesses are judged, as beside the yield stress [M/LT2]
  Real q[block_size], fall[block_size];       ///< at x [M/LT2]; -dq/dx
  Real grow[block_size], faster[block_size];  ///< d plastic/dx; d rate/dx
  Real trial_q[block_size];                   ///< in space [M/LT2]
  // in the plane
  Real P[block_size], S[block_size];  ///< [M2/L2T4]
  Real per_q[block_size];             ///< 1/q at x [LT2/M]
  Real sum[block_size];               ///< xx + yy of the trial stress less the back stress [M/LT2]
};

/// The steps of it, compiled once for each instruction set.
struct ReturnLoops {
  /// In space: x, its bounds and the rate of all strain. `trial_q` of r is there.
  void (*go)(const ReturnLaw& law, const PointBlock& block, ReturnPoints& r);
  /// q, plastic strain, rate and their slopes at x; `before`: plastic strain before the step.
  void (*measure)(const ReturnLaw& law, Real dt, const Real* before, ReturnPoints& r);
  /// x by Newton's method between its bounds; whether there are points that were not close. `round` counts
  /// from 0, where x is 0.
  bool (*approach)(const ReturnLaw& law, int round, ReturnPoints& r);
  /// In the plane, the trial stress as well; `sum` is xx + yy of the stress before. `alpha`: the back stress
  /// by component, null where it stays 0.
  void (*go_in_plane)(const ReturnLaw& law, const PointBlock& block, Real* const* alpha, Real* sum,
                      ReturnPoints& r);
  void (*measure_in_plane)(const ReturnLaw& law, Real dt, const Real* before, ReturnPoints& r);
  bool (*approach_in_plane)(const ReturnLaw& law, int round, ReturnPoints& r);
  /// Stress, back stress and plastic strain at m; `rate_zz` has the sum before, and gets the rate without
  /// which there would be a stress zz. [1/T]
  void (*settle)(const ReturnLaw& law, const PointBlock& block, Real* const* alpha, Real* rate_zz,
                 const ReturnPoints& r);
};
/// For the machine the program runs on.
ReturnLoops return_loops();

/// x of all points, by functions that go through a round: `measure()`, `yield(points)`, which fills in what
/// YieldPoints declares, and `approach(round)`. x without an answer becomes NaN, with which the run ends.
template <class Measure, class Yield, class Approach>
void find_return(const Measure& measure, const Yield& yield, const Approach& approach, ReturnPoints& r) {
  constexpr int rounds = 100;
  for (int k = 0; k < rounds; ++k) {
    measure();
    r.at.still = k == 0;
    yield(r.at);
    if (!approach(k)) return;
  }
  constexpr Real close = 1e-6;  // of a yield stress that jumps the bounds alone are
  for (Index i = 0; i < r.at.count; ++i) {
    const bool on_it = std::abs(r.q[i] - r.at.stress[i]) <= close * (r.at.stress[i] + r.least[i]);
    if (!on_it && r.high[i] - r.low[i] > close * r.high[i]) r.x[i] = std::numeric_limits<Real>::quiet_NaN();
  }
}

/// The increments of plastic strain of trial states; `before`: plastic strain before the step. [-]
template <class Yield>
void find_increments(const ReturnLoops& loops, const ReturnLaw& law, const PointBlock& block,
                     const Real* before, PlasticTrial& trial, const Yield& yield) {
  if (law.rate != YieldRate::none && !(block.dt > 0)) {
    std::fill_n(trial.plastic, block.count, 0.0);
    return;
  }
  ReturnPoints r;
  r.at.count = block.count;
  std::copy_n(trial.q, block.count, r.trial_q);
  loops.go(law, block, r);
  find_return([&] { loops.measure(law, block.dt, before, r); }, yield,
              [&](int round) { return loops.approach(law, round, r); }, r);
  std::copy_n(r.x, block.count, trial.plastic);
}

/// Stress, plastic strain (history 0), back stress and rate zz at the end of the step.
template <class Yield>
void update_in_plane(const ReturnLoops& loops, const ReturnLaw& law, const PointBlock& block,
                     Real* const* alpha, Real* rate_zz, const Yield& yield) {
  ReturnPoints r;
  r.at.count = block.count;
  loops.go_in_plane(law, block, alpha, rate_zz, r);
  find_return([&] { loops.measure_in_plane(law, block.dt, block.history[0], r); }, yield,
              [&](int round) { return loops.approach_in_plane(law, round, r); }, r);
  loops.settle(law, block, alpha, rate_zz, r);
}

}  // namespace courant
