#pragma once
// What a step has to do, counted from the source by hand: the yardstick that measured times are held against.
// Whoever changes the pair loops or the passes counts again.
#include "base/real.hpp"

namespace courant::benchmarks {

struct PairWork {
  int rates, forces;
  int both() const { return rates + forces; }
};

/// Floating-point operations of src/sph/pair_sums.hpp per entry of a list and lane, for the cubic spline, one
/// h, Monaghan viscosity and no MU. Each + - * / and max is one; a reciprocal root is ten, what the avx512
/// variant spells it out as (the others take a root and a quotient, which keep the processor busy for
/// longer).
///
///                            2D  3D
///   x_i - x_j                 2   3   rates, forces
///   v_i - v_j                 2   3   rates
///   r2                        4   6   rates; forces only where gradients are worked out
///   u . d                     3   5   rates
///   w: 2 + 10 + 9 + 1        22  22   where gradients are worked out
///   div                       2   2   rates
///   viscosity: approach 3, D 1, numerator 6, denominator 5, quotient 1, times w 1
///                            17  17   rates
///   its force and power       6   8   rates
///   w (p_i + p_j)             2   2   forces
///   pressure force            4   6   forces
constexpr PairWork pair_work(int dim, bool kept) {
  const int d = dim == 2 ? 2 : 3, r2 = dim == 2 ? 4 : 6, dot = dim == 2 ? 3 : 5, add = 2 * d, gradient = 22;
  return {2 * d + r2 + dot + gradient + 2 + 17 + add + 2, d + (kept ? 0 : r2 + gradient) + 2 + add};
}

/// Operations of the other passes per particle: factors, equation of state, step size, motion, watch;
/// roughly.
constexpr int particle_work = 70;

/// Numbers of eight bytes that the passes of a step read or write per particle when neighbours' values come
/// from the cache; dim = 2 or 3. Sorting and building the lists are left out.
///   clear forces    3                    f
///   rates           4 dim + 6            x v, f twice; m V qc rho drhodt heat
///   material        8                    drhodt; rho p E twice; c
///   energy, dt      6                    heat; v h c
///   forces          3 dim + 2            x, f twice; V p
///   gravity         3                    m; f twice
///   motion          5 dim + 1            v x twice, f; m
///   factors         6                    m rho c part V qc
///   watch           8                    x h, now and when the lists were built
constexpr int numbers_streamed(int dim) {
  return 3 + (4 * dim + 6) + 8 + 6 + (3 * dim + 2) + 3 + (5 * dim + 1) + 6 + 8;
}

/// Bytes per particle and step: fields, lists (read by both pair loops), kept gradients (stored and loaded).
/// entries: of the lists, per group of eight and so also lanes looked at per particle.
constexpr Real bytes_streamed(int dim, Real entries, bool kept) {
  const Real per_particle = entries / 8;
  return 8.0 * numbers_streamed(dim) + per_particle * (2 * sizeof(Index) + (kept ? 2 * 64 : 0));
}

}  // namespace courant::benchmarks
