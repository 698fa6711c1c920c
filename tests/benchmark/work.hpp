#pragma once
// What a step has to do, counted from the source by hand: the yardstick that measured times are held against.
// Whoever changes the pair loops or the passes counts again.
#include "base/real.hpp"

namespace courant::benchmarks {

struct PairWork {
  int rates, forces;
  int both() const { return rates + forces; }
};

/// Where forces have gradients from: worked out again, kept from the rates, or rates and forces from a window
/// of steps.
enum class Gradients { again, kept, window };

/// Floating-point operations of src/sph/core/pair_sums.hpp per entry in reach of its eight and lane, for the
/// cubic spline, one h, Monaghan viscosity and no MU. Each + - * / and max is one; a reciprocal root is ten,
/// what the avx512 variant spells it out as (the others take a root and a quotient, which keep the processor
/// busy for longer).
///
///                            2D  3D
///   x_i - x_j                 2   3   rates, forces
///   v_i - v_j                 2   3   rates
///   r2                        4   6   rates; forces only where gradients are worked out
///   u . d                     3   5   rates
///   w: 2 + 10 + 9 + 1        22  22   where gradients are worked out
///   in the middle of the step: curvature 2, u . u, q 2, sum 5, half step 2
///                            14  16   rates
///   div                       3   3   rates
///   viscosity, linear: approach 1, D 1, speed of sound 1, denominator 4, the rest 6
///                            13  13   rates (18 with its quadratic part, which no benchmark has)
///   its force and power       6   8   rates
///   V_i V_j w (p_i + p_j)     4   4   forces
///   pressure force            4   6   forces
/// Left out: entries out of reach, 6 or 9 operations to see that they are, and the sums over lanes for
/// partners, the price of working out a pair once.
///
/// And of src/sph/options/frozen_loops.hpp:
///   v_i - v_j, u . G          5   8   rates
///   div                       2   2   rates
///   viscosity, linear         2   2   rates (4 with its quadratic part, which no benchmark has)
///   its force and power       6   8   rates
///   V (p_i + p_j)             2   2   forces
///   pressure force            4   6   forces
/// Opening a window costs some 70 operations for each entry, which are left out.
constexpr PairWork pair_work(int dim, Gradients gradients) {
  const int d = dim == 2 ? 2 : 3, r2 = dim == 2 ? 4 : 6, dot = dim == 2 ? 3 : 5, add = 2 * d, gradient = 22;
  if (gradients == Gradients::window) return {d + dot + 2 + 2 + add + 2, 2 + add};
  const int forces = d + (gradients == Gradients::kept ? 0 : r2 + gradient) + 4 + add;
  return {2 * d + r2 + dot + gradient + 11 + dot + 3 + 13 + add + 2, forces};
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
///   watch           2 dim                x now and when the lists were built
constexpr int numbers_streamed(int dim) {
  return 3 + (4 * dim + 6) + 8 + 6 + (3 * dim + 2) + 3 + (5 * dim + 1) + 6 + 2 * dim;
}
/// The same where pairs are worked out once: numbers of partners set to 0, added to, and read by the
/// reductions, with f, drhodt, heat twice and rho. Those beyond the end of a task are left out.
constexpr int numbers_of_partners(int dim) {
  return 3 * (dim + 2) + (2 * dim + 5) + 3 * dim + 2 * dim;
}

/// Bytes per particle and step: fields, lists (read by both pair loops), kept gradients (stored and loaded;
/// with their entry; in windows loaded twice, and one factor once, two bytes each). entries: in reach, per
/// group of eight and so also lanes looked at per particle. In windows pair loops read no positions, no m and
/// no qc, which nobody works out between them: 2 dim + 5 numbers less.
constexpr Real bytes_streamed(int dim, Real entries, Gradients gradients) {
  const Real of_pairs = gradients == Gradients::window ? (2 * dim + 1) * 16
                        : gradients == Gradients::kept ? 2 * 64 + sizeof(Index)
                                                       : 0;
  const int numbers =
      numbers_streamed(dim) + (gradients == Gradients::window ? -(2 * dim + 5) : numbers_of_partners(dim));
  return 8.0 * numbers + entries / 8 * (2 * sizeof(Index) + of_pairs);
}

}  // namespace courant::benchmarks
