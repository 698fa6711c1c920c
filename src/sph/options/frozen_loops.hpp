#pragma once
// The loops over pairs where kernel gradients are kept over several steps (*COURANT_PAIR_GEOMETRY): each pair
// has its gradient as a vector, so that a step needs neither places nor kernels. Compiled once for each
// instruction set, as pair_loops.hpp; the loop that works gradients out is compiled with its kernel.
#include "base/narrow.hpp"
#include "sph/core/pair_loops.hpp"

namespace courant {

/// The lists of particles [begin, end), without the entries that are out of reach of all eight, and for each
/// entry eight times these numbers, of 16 bits:
///   gradients: G = grad W / norm [-], `dim` components, rounded to integers: by 1.5e-5 of the steepest
///   factors, rounded by up to 0.4 % of themselves, what else is asked for, in this order:
///     if `viscous`: Q [L/T], and if `quadratic` P [-]; Monaghan's m_i m_j Pi / mV is s (Q + P s) for
///       s = v_ij.G > 0, two particles that approach, else 0 (eqs 15-16)
///     if `diffusion`: h |G| / r [-]
/// Of a pair of particles and the same pair the other way round, G are opposite and factors equal to the last
/// bit, so that momentum and energy are kept. Two arrays, since forces rarely need more than gradients and
/// wait for memory.
struct FrozenLists {
  const Index* all;        ///< entries of the search, of which a window keeps some
  const Index* all_start;  ///< of each group of eight, and the end
  Index* list;
  Index* start;
  Fixed16* gradients;
  Float16* factors;
  int factor_count;  ///< of an entry
  bool viscous, quadratic, diffusion;
  Real scale;  ///< turns the kernel's `gradient` into |G|: its largest is the largest integer
  Real norm;   ///< [1/L^(dim + 1)]
  Real mV;     ///< m V of some particle: keeps factors within their range in any units [ML3]
  Real ahead;  ///< gradients are those of places v `ahead` from now [T]
  Index begin, end;
};

/// Fills list, start, gradients and factors, which have room for all.
FrozenLoop fix_loop(KernelChoice kernel, int dim);

/// As rates_loop and forces_loop of pair_loops.hpp, but for gradients, which are those of the window.
struct FrozenChoice {
  int dim;
  bool viscous, gradient;  ///< of the rates, as in RatesChoice
  bool stress, diffusion;  ///< of the forces, as in ForcesChoice
  bool quadratic;          ///< of the rates: viscosity has its quadratic part
};
FrozenLoop frozen_rates_loop(const FrozenChoice& choice);
FrozenLoop frozen_forces_loop(const FrozenChoice& choice);

}  // namespace courant
