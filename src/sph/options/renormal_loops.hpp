#pragma once
// The sums over pairs of renormalised forms: gradients corrected by the inverse of the moment matrix;
// compiled once for each instruction set, as pair_loops.hpp.
#include "sph/core/neighbour_lists.hpp"
#include "sph/kernel/kernel_choice.hpp"

namespace courant {

/// What these loops read and write; arrays over all particles. Symmetric tensors: xx yy zz xy yz zx.
struct RenormalArrays {
  const Real* x[3];
  const Real* v[3];
  const Real* V;          ///< m/rho, see PairVolumes
  Real* moment[6];        ///< sum_j V_j (x_j - x_i) (x) grad W_ij [-]
  Real* gradient[6];      ///< sum_j V_j v_ij (x) grad W_ij, symmetric part, in the middle of the step [1/T]
  const Real* excess[6];  ///< B - 1, B the inverse of `moment` or 1 [-]
  const Real* p;          ///< pressure, plus bulk viscosity where there is any
  const Real* tau[6];     ///< stress beside the pressure, for `stress`
  Real* f[3];
  const Real* h;
  Real half_step;           ///< [T]
  const AnyKernel* kernel;  ///< that of the run
};

using RenormalLoop = void (*)(const RenormalArrays&, const NeighbourLists&);

/// Sets moment and gradient.
RenormalLoop renormal_rates_loop(KernelChoice kernel, int dim);
/// f_i -= V_i sum_j V_j (p_i (B_i - 1) grad W(h_i) + p_j (B_j - 1) grad W(h_j)): what the corrected force has
/// beyond the plain one; `reverse`: with p_j instead of p_i and p_i in that of p_j;
/// `stress`: with p - tau instead of p.
enum class RenormalForce { pressure, reverse, stress };
RenormalLoop renormal_forces_loop(KernelChoice kernel, int dim, bool uniform_h, RenormalForce what);

}  // namespace courant
