#pragma once
// Loops over single particles, executed in every step and compiled once for each instruction set. Arrays are
// those of fields; a loop works on entries [begin, end).
#include "base/real.hpp"

namespace courant {

struct ParticleLoops {
  /// v += dt f/m
  void (*kick)(Real* v, const Real* f, const Real* m, Real dt, Index begin, Index end);
  /// x += dt v
  void (*drift)(Real* x, const Real* v, Real dt, Index begin, Index end);

  /// Largest v.v; not a number counts as 0.
  Real (*fastest2)(const Real* const v[3], Index begin, Index end);
  /// Least h/(c + |v|); not a number where one of them is not. [T]
  Real (*least_crossing)(const Real* h, const Real* c, const Real* const v[3], Index begin, Index end);

  /// Displacement of particles since earlier positions: the largest square, and whether this and the growth
  /// of their support stay below `reach` for each.
  struct Moved {
    Real most2;
    bool within;  ///< false also where something is not a number
  };
  struct Places {
    const Real *x[3], *h, *x_before[3], *h_before;  ///< x_before[2], h_before: null where they are constant
    Real support;                                   ///< support radius of particles, in h
  };
  Moved (*moved)(const Places& places, Real reach, Index begin, Index end);
  /// Number of particles in a box, its faces included.
  Index (*inside)(const Real low[3], const Real high[3], const Real* const x[3], Index begin, Index end);

  /// The box around particles, their extreme h, the sum of m/rho, each rounded to a multiple of `unit` so
  /// that the sum is exact and does not depend on their order, and whether a position or h is no finite
  /// number.
  struct Bounds {
    Real low[3], high[3], h_min, h_max, volume;
    bool broken;
  };
  struct Bodies {
    const Real *x[3], *h, *m, *rho;
  };
  Bounds (*bounds)(const Bodies& particles, Real unit, Index begin, Index end);

  /// Advances densities by a step, for an equation of state whose pressure needs no energy: rho += dt drhodt;
  /// mu = rho/rho0 - 1 and half the change of the relative volume, by entry - begin.
  void (*compress)(const Real* drhodt, Real dt, Real rho0, Real* rho, Real* mu, Real* half_dv, Index begin,
                   Index end);
  /// Values from the pressure A(mu) of the law and its slope dA/dmu, by entry - begin: p, at least pc; the
  /// work that enters E; c.
  struct Law {
    const Real *A, *dA, *half_dv;
    Real rho0, pc;
  };
  void (*load)(const Law& law, Real* p, Real* E, Real* c, Index begin, Index end);
  /// Least and largest; `broken` where one is not a number.
  struct Range {
    Real least, most;
    bool broken;
  };
  Range (*range)(const Real* values, Index begin, Index end);
  /// The same of distances from a plane through `point`, in the direction of `normal` of length 1. [L]
  Range (*depths)(const Real normal[3], const Real point[3], const Real* const x[3], Index begin, Index end);
};

/// For the present processor.
ParticleLoops particle_loops();

}  // namespace courant
