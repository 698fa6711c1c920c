#pragma once
// The sums over pairs for turbulence models; compiled once for each instruction set, as pair_loops.hpp.
#include "sph/core/neighbour_lists.hpp"
#include "sph/kernel/kernel_choice.hpp"

namespace courant {

/// What these loops read and write; arrays over all particles.
struct TurbulenceArrays {
  const Real* x[3];
  const Real* v[3];
  const Real* V;  ///< m/rho, see PairVolumes
  const Real* h;
  Real h0;               ///< that of all, where it is uniform [L]
  const Real* mu;        ///< MU and that of eddies [M/LT]
  Real* f[3];            ///< viscosity adds to it
  Real* heat;            ///< half of what each pair loses by it [ML2/T3]
  Real* gradient[3][3];  ///< of each component: sum_j V_j (v_j - v_i) grad W_ij [1/T]
  Real* moment[6];       ///< sum_j V_j (x_j - x_i) (x) grad W_ij: xx yy zz xy yz zx [-]
  Real* slope[3];        ///< sum_j V_j grad W_ij [1/L]
  // k-epsilon alone:
  const Real* k;
  const Real* epsilon;
  const Real* eddy;           ///< nu_t [L2/T]
  Real nu, sigma_k, sigma_e;  ///< diffusivities are nu + nu_t/sigma
  Real* k_flow;               ///< what diffusion brings [L2/T3]
  Real* epsilon_flow;         ///< [L2/T4]
  const AnyKernel* kernel;    ///< that of the run
};

using TurbulenceLoop = void (*)(const TurbulenceArrays&, const NeighbourLists&);

/// Diffusion of f = v, k, epsilon with D = mu, nu + nu_t/sigma after Morris, Fox and Zhu 1997 (Violeau and
/// Issa 2007, eqs 21-22):
///   V_i sum_j V_j (D_i + D_j)(f_i - f_j) (dW/dr)/r
/// On lattices whose rows slide it is within 2 % of D lap f from h/dx 1.0 on, where what acts along the
/// distance of pairs alone (Cleary 1998) lacks 5 to 25 % of it or has as much too much.
TurbulenceLoop turbulence_loop(KernelChoice kernel, int dim, bool uniform_h, bool k_epsilon);

}  // namespace courant
