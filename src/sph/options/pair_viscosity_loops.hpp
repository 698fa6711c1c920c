#pragma once
// Viscosity between pairs; compiled once for each instruction set, as pair_loops.hpp.
#include "sph/core/neighbour_lists.hpp"
#include "sph/kernel/kernel_choice.hpp"

namespace courant {

/// What this loop reads and writes; arrays over all particles.
struct PairViscosityArrays {
  const Real* x[3];
  const Real* v[3];
  const Real* V;  ///< m/rho, see PairVolumes
  const Real* h;
  const Real* mu;           ///< [M/LT]
  Real* f[3];               ///< viscosity adds to it
  Real* heat;               ///< half of what each pair loses by it [ML2/T3]
  const AnyKernel* kernel;  ///< that of the run
};

using PairViscosityLoop = void (*)(const PairViscosityArrays&, const NeighbourLists&);

/// f_i = V_i sum_j V_j (mu_i + mu_j)(v_i - v_j) (dW/dr)/r (Morris, Fox and Zhu
/// 1997), as turbulence has it.
PairViscosityLoop pair_viscosity_loop(KernelChoice kernel, int dim, bool uniform_h);

}  // namespace courant
