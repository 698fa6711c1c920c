#pragma once
// The loops over pairs where kernel gradients are kept over several steps (*COURANT_PAIR_GEOMETRY): each pair
// has its gradient as a vector, so that a step needs neither places nor kernels. Compiled once for each
// instruction set, as pair_loops.hpp; the loop that works gradients out is compiled with its kernel.
#include "sph/pair_loops.hpp"

namespace courant {

/// The lists of particles [begin, end), without the entries that are out of reach of all eight, and for each
/// entry eight times these numbers, in single precision:
///   gradients: grad W but for the constant of the kernel [-], `dim` components
///   factors, what else is asked for, in this order:
///     if `viscous`: -h r / (|grad W| (r^2 + 0.01 h^2)) [-], which times v_ij.grad W is Monaghan's mu, and
///       m V / (m_i V_j + m_j V_i), m and V those of some particle [-]
///     if `diffusion`: (h/r) |grad W| [-]
/// Opposite gradients of i and j stay opposite: rounding is symmetric. Two arrays, since forces rarely need
/// more than gradients and wait for memory.
struct KeptLists {
  const Index* all;        ///< entries of the search, of which a window keeps some
  const Index* all_start;  ///< of each group of eight, and the end
  Index* list;
  Index* start;
  float* gradients;
  float* factors;
  int factor_count;  ///< of an entry
  bool viscous, diffusion;
  Real norm;   ///< the constant of the kernel [1/L^(dim + 1)]
  Real mV;     ///< as above; keeps factors within single precision in any units [ML3]
  Real ahead;  ///< gradients are those of places v `ahead` from now [T]
  Index begin, end;
};

/// Fills list, start, gradients and factors, which have room for all.
KeptLoop fix_loop(KernelChoice kernel, int dim);

/// As rates_loop and forces_loop of pair_loops.hpp, but for gradients, which are those of the window.
struct KeptChoice {
  int dim;
  bool viscous, gradient;  ///< of the rates, as in RatesChoice
  bool stress, diffusion;  ///< of the forces, as in ForcesChoice
};
KeptLoop kept_rates_loop(const KeptChoice& choice);
KeptLoop kept_forces_loop(const KeptChoice& choice);

}  // namespace courant
