#pragma once
// Sums by which fixed ghost particles take the state of the water in front of their wall; compiled once
// per instruction set, as pair_loops.hpp.
#include "sph/core/neighbour_lists.hpp"
#include "sph/kernel/kernel_choice.hpp"

namespace courant {

/// Input and output of these loops: arrays over all particles, then ghosts.
struct GhostArrays {
  const Real* x[3];
  const Real* v[3];
  const Real* V;    ///< m/rho, see PairVolumes
  const Real* p;    ///< pressure as pair forces take it
  const Real* m;    ///< of particles and their copies
  const Real* rho;  ///< of particles alone
  const Real* tau[6];
  Real* drhodt;  ///< of particles alone
  Real h;
  Real half_step;           ///< half of the last step: rates are those of its middle [T]
  const AnyKernel* kernel;  ///< that of the run
  // of ghost k = entity first + k alone, at index k
  Index first;
  const Real* g[3];   ///< acceleration that rests on the wall there: of body loads less that of the wall
  Real* squeeze;      ///< what it (or its copy behind a plane) hands on of its own rate, without the kernel's
                      ///< constant [L^dim/T]
  Real* volume_rate;  ///< how fast the water that it is for is compressed, > 0 [L^dim/T]
  Real* pressure;
  Real* excess;    ///< of the pressure, over the mean of that of the particles
  Real* force[3];  ///< of the water on the ghost
};

/// Over lists; those of ghosts are entities [begin, end) behind the particles.
using GhostLoop = void (*)(const GhostArrays&, const NeighbourLists&);

/// Of ghosts: volume_rate = V sum_j V_j v_gj . grad W, in the middle of the step as `rates_loop` does, and
/// squeeze, that over the sum of the weights V_j W by which it takes pressures.
GhostLoop ghost_rate_loop(KernelChoice kernel, int dim);
/// For particles, over ghosts in range: drhodt += rho sum_g W squeeze_g. The compression of the wall is
/// distributed by the weights of pressure, so the work of pressure equals the stored energy.
GhostLoop squeezed_by_ghosts_loop(KernelChoice kernel, int dim);
/// Of ghosts: pressure = sum_j V_j W (p_j + rho_j g.(x - x_j)) / sum_j V_j W, Adami, Hu and Adams
/// 2012, eq. 27; force = -V sum_j V_j (pressure + p_j) grad W, which is what `forces_loop` does to the
/// particles, with the other sign. `stress`: with the viscous stress of the particles.
GhostLoop ghost_pressure_loop(KernelChoice kernel, int dim, bool stress);

}  // namespace courant
