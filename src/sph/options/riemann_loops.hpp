#pragma once
// The sums over pairs by which a Riemann flux differs from plain sums; compiled once for each instruction
// set, as pair_loops.hpp. Where h differs, gradients are the means of those with h_i and with h_j.
#include "sph/core/neighbour_lists.hpp"
#include "sph/kernel/kernel_choice.hpp"

namespace courant {

/// What these loops read and write; arrays over all particles.
struct RiemannArrays {
  const Real* x[3];
  const Real* v[3];
  const Real* m;
  const Real* V;          ///< m/rho, see PairVolumes
  const Real* c;          ///< of the last motion [L/T]
  const Real* p;          ///< [M/LT2]
  const Real* potential;  ///< -g.x [L2/T2]
  Real* f[3];
  Real* heat;               ///< power that the flux of momentum turns into heat [ML2/T3]
  Real* rate;               ///< of rho, by the flux of mass [M/L3T]
  Real* decay;              ///< of a pressure that neighbours do not share, by the flux of mass [1/T]
  const Real* h;            ///< where it differs
  Real h0;                  ///< the h of all where it does not
  Real eta;                 ///< of the limiter; huge: none
  Real pc;                  ///< tensile cut-off of pressures [M/LT2]
  const AnyKernel* kernel;  ///< that of the run
};

using RiemannLoop = void (*)(const RiemannArrays&, const NeighbourLists&);

/// Adds to f_i, with w = -v_ij . x_ij / r > 0 where a pair approaches and bars for means of i and j,
///   -V_i sum_j V_j rho_bar w min(eta w, c_bar) grad W_ij,
/// which is what p* has beyond the mean of both pressures, and sets heat: half of what each pair loses.
RiemannLoop riemann_momentum_loop(KernelChoice kernel, int dim, bool uniform_h);
/// Sets rate_i = rho_i sum_j V_j (p_i - p_j + rho_bar (phi_i - phi_j)) / (rho_bar c_bar) dW/dr, which is what
/// u* has beyond the mean of both velocities, less what gravity makes of p; phi its potential. And
///   decay_i = -rho_i c_i^2 sum_j V_j/(rho_bar c_bar) dW/dr.
/// Pairs of which one has parted (p is the cut-off) are left out: a void rests on nothing, and the water
/// beside it would lose its pressure into it.
RiemannLoop riemann_mass_loop(KernelChoice kernel, int dim, bool uniform_h);

}  // namespace courant
