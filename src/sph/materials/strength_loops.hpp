#pragma once
// The sums over pairs that only particles with strength need; compiled once for each instruction set, as
// pair_loops.hpp.
#include "sph/core/neighbour_lists.hpp"
#include "sph/kernel/kernel_choice.hpp"

namespace courant {

/// What these loops read and write; arrays over all particles, null where a loop does not use them.
struct StrengthArrays {
  const Real* x[3];
  const Real* v[3];
  const Real* h;
  const Real* V;            ///< m/rho, see PairVolumes
  Real* spin[3];            ///< half of the curl of the velocity, of particles with strength [1/T]
  const Real* R[6];         ///< artificial stress: xx yy zz xy yz zx [M/LT2]
  Real* f[3];               ///< [ML/T2]
  const Real* at_spacing;   ///< 1/theta(dx/h), theta without its constant [-]
  int n;                    ///< exponent of W/W(dx)
  const AnyKernel* kernel;  ///< that of the run
};

using StrengthLoop = void (*)(const StrengthArrays&, const NeighbourLists&);

/// Sets w_i = -1/2 sum_j V_j v_ij x grad W_ij with h_i: the antisymmetric part of the velocity gradient of
/// which pair loops give the symmetric part.
StrengthLoop spin_loop(KernelChoice kernel, int dim);
/// Sets f_i = V_i sum_j V_j (W_ij/W(dx))^n (R_i + R_j) . grad W_ij, W that of the mean h of a pair,
/// 1/W(dx) the mean of both.
StrengthLoop artificial_stress_loop(KernelChoice kernel, int dim);

}  // namespace courant
