#pragma once
// Sums over the images of particles in sub-domains (see WallSubDomain); compiled once for each instruction
// set, as pair_loops.hpp.
#include <cstdint>

#include "sph/core/neighbour_lists.hpp"
#include "sph/kernel/kernel_choice.hpp"
#include "sph/walls/images/wall_sub_domain.hpp"

namespace courant {

/// Input and output of these loops: arrays over all particles; null if the scene lacks them.
struct WallMirrorArrays {
  const Real* x[3];
  const Real* v[3];
  const Real* V;  ///< m/rho, see PairVolumes
  const Real* rho;
  const Real* p;  ///< pressure, plus bulk viscosity where there is any
  Real* drhodt;
  Real* f[3];
  Real* wall_force[3];  ///< set: the contribution to `f`
  const Real* c;
  const Real* potential;  ///< -g.x [L2/T2]
  Real* diffusion;        ///< rate of rho by diffusion [M/L3T]; null: none
  Real h, delta;
  Real half_step;         ///< rates are those of positions half a step ago [T]
  Real aside[3];          ///< offset of positions for visibility tests (see WallPaths) [L]
  Real width;             ///< of edges [L]
  const Real* edge_loss;  ///< sph_fields::edge_loss
  /// Sums for each particle beside an edge: V W |dw/dx| over reflected paths, and over straight paths to
  /// the other side of the plane of a wall [1/L].
  Real* edge_sum[2];
  const WallSubDomain* const* domain;  ///< of each particle; null: none
  const WallEdge* const* edge;         ///< of particles without a sub-domain; null: none
  /// For each listed particle beside a moving edge; null if no edge moves.
  WallEdgeReaction* reaction;
  /// Four bits for each of eight particles i, for each list entry: bit 0: a path passes near the edge in
  /// the middle of the step, so forces evaluate all paths at the end of the step; else bits 1 to 3: a path
  /// by the first wall, by the second wall, a hidden straight path. Set by rates, read by forces.
  std::uint32_t* edge_paths;
  /// 1 for a particle that is not in front of all walls of its sub-domain or edge: these loops skip it.
  /// Set by rates, read by forces.
  char* skipped;
  /// List entries of pairs with possible paths other than those of the sub-domain, ascending, and the
  /// lanes concerned: skipped here and computed by path. Set by rates, read by forces; sized for all
  /// entries.
  Index* doubt;
  unsigned char* doubt_lanes;
  Index* doubts;            ///< number of these
  const AnyKernel* kernel;  ///< that of the run
};

using WallMirrorLoop = void (*)(const WallMirrorArrays&, const NeighbourLists&);

/// drhodt_i += rho_i sum V_j (v_i - v_j') . grad W, over all images j' in the walls of the sub-domain of i.
WallMirrorLoop mirror_rates_loop(KernelChoice kernel, int dim);
/// f_i -= V_i sum V_j (p_i + p_j) grad W, and the diffusion of density as in forces_loop, whose pressure
/// behind a wall is that of rest.
WallMirrorLoop mirror_forces_loop(KernelChoice kernel, int dim);

}  // namespace courant
