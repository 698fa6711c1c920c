#pragma once
// Sums over the images of particles beside one edge (see WallEdge), and over what its walls hide; compiled
// once for each instruction set, as pair_loops.hpp.
#include "sph/walls/images/wall_mirror_loops.hpp"

namespace courant {

/// As WallPaths does, over images and, taken off, over what is hidden: drhodt_i += rho_i sum V_j dW_ij/dt,
/// that of the share among it.
WallMirrorLoop edge_rates_loop(KernelChoice kernel, int dim);
/// f_i -= V_i sum V_j (p_i + p_j) dW_ij/dx_i, and the diffusion of density.
WallMirrorLoop edge_forces_loop(KernelChoice kernel, int dim);

}  // namespace courant
