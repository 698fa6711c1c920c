#pragma once
// The sums over pairs by which particles move besides their velocity (shifting, XSPH); compiled once for each
// instruction set, as pair_loops.hpp.
#include "sph/core/neighbour_lists.hpp"
#include "sph/kernel/kernel_choice.hpp"

namespace courant {

/// What these loops read and write; arrays over all particles, null where a scene lacks them.
struct DriftArrays {
  const Real* x[3];
  const Real* v[3];
  const Real* m;
  const Real* V;  ///< m/rho, see PairVolumes
  const Real* h;
  const Real* spread;             ///< of neighbours: sum_j V_j (x_j - x_i).grad W of the step before [-]
  const Real* at_spacing;         ///< 1/theta(dx/h), theta without its constant [-]
  Real pairing;                   ///< R: weight of the term against pairs [-]
  Real surface;                   ///< spread below which a particle is at a surface [-]
  Real* gradient[3];              ///< sum_j V_j (1 + R (W_ij/W(dx))^4) grad W_ij [1/L]
  Real* normal[3];                ///< sum_j V_j (spread_j - spread_i) grad W_ij [1/L]
  Real* new_spread;               ///< sum_j V_j (x_j - x_i).grad W_ij: 2 or 3 inside [-]
  Real* edge;                     ///< > 0 where a neighbour, or the particle itself, is at a surface [-]
  Real* filling;                  ///< sum_j V_j W_ij [-]
  Real* velocity_gradient[3][3];  ///< of each component: sum_j V_j (v_j - v_i) grad W_ij [1/T]
  Real* drift[3];                 ///< XSPH: sum_j m_j/rho_ij (v_j - v_i) W_ij [L/T]
  const Real* drifted[3];         ///< change of positions besides the velocity in the last step [L/T]
  const Real* rho;                ///< of particle i alone
  Real* drhodt;
  Real* drift_rate;         ///< of the density [M/L3T]
  Real half_step;           ///< [T]
  const AnyKernel* kernel;  ///< that of the run
};

using DriftLoop = void (*)(const DriftArrays&, const NeighbourLists&);

/// Gradient of the concentration with h_i, Skillen, Lind, Stansby and Rogers 2013, eqs 14-16; what tells
/// surfaces; the gradient of the velocity where `correct`;
/// and what `drift_rate_loop` does.
DriftLoop shifting_loop(KernelChoice kernel, int dim, bool correct);
/// Monaghan 1989: rho_ij the mean of both densities, W_ij that of the kernels with h_i and with h_j.
/// `normed`: over sum_j m_j/rho_ij W_ij.
DriftLoop xsph_loop(KernelChoice kernel, int dim, bool uniform_h, bool normed);
/// Density after a drift u beside the velocity v, both in the middle of the step as in `rates_loop`:
/// drhodt_i -= rho_i half_step sum_j V_j v_ij . (grad grad W) . u_ij brings eq. 6 there;
/// drift_rate_i = rho_i sum_j V_j (u_ij . grad W - half_step u_ij . (grad grad W) . (v_ij + u_ij)) is eq. 6
/// of the drift.
DriftLoop drift_rate_loop(KernelChoice kernel, int dim);

}  // namespace courant
