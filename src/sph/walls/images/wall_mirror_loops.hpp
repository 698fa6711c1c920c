#pragma once
// Sums over the images of particles in sub-domains (see WallRoom); compiled once for each instruction set, as
// pair_loops.hpp.
#include <cstdint>

#include "sph/core/neighbour_lists.hpp"
#include "sph/kernel/kernel_choice.hpp"
#include "sph/walls/images/wall_room.hpp"

namespace courant {

/// What these loops read and write; arrays over all particles, null where a scene lacks them.
struct WallMirrorArrays {
  const Real* x[3];
  const Real* v[3];
  const Real* V;  ///< m/rho, see PairVolumes
  const Real* rho;
  const Real* p;  ///< pressure, plus bulk viscosity where there is any
  Real* drhodt;
  Real* f[3];
  Real* wall_force[3];  ///< set: what `f` gets
  const Real* c;
  const Real* potential;  ///< -g.x [L2/T2]
  Real* diffusion;        ///< rate of rho by diffusion [M/L3T]; null: none
  Real h, delta;
  Real half_step;         ///< rates are those of positions half a step ago [T]
  Real aside[3];          ///< so far aside of their positions particles are looked at [L]
  Real width;             ///< of edges [L]
  const Real* edge_loss;  ///< sph_fields::edge_loss
  /// Of each particle beside an edge, added: sums of V W and the slope of the share over ways that walls
  /// throw back, and over straight ones to the other side of a wall's plane [1/L]
  Real* edge_sum[2];
  const WallRoom* const* room;  ///< of each particle; null: none
  const WallEdge* const* edge;  ///< the same, of those that have no space
  /// Of each particle of the lists that is beside an edge that moves; null: none does.
  WallEdgePull* pull;
  /// Of each entry of the lists, four bits for each of eight i beside such an edge: whether a way passes the
  /// edge near by in the middle of the step, where forces look at all ways at its end; if not, which ways
  /// there are, by the first wall, by the second one, and one that is hidden. Rates set them, forces read
  /// them.
  std::uint32_t* ways;
  /// Of each particle: 1 where it is not in its sub-domain or beside its edge, so that nothing is added here.
  /// Rates set it, forces read it.
  char* strange;
  /// Pairs that may see each other by other ways than those of the sub-domain, of which nothing is added
  /// here: entries of the lists, ascending, and by bits which of the eight i. Rates set them, forces read
  /// them; there is space for all entries.
  Index* doubt;
  unsigned char* doubt_lanes;
  Index* doubts;            ///< how many
  const AnyKernel* kernel;  ///< that of the run
};

using WallMirrorLoop = void (*)(const WallMirrorArrays&, const NeighbourLists&);

/// drhodt_i += rho_i sum V_j (v_i - v_j') . grad W, over all images j' in the walls of the sub-domain of i.
WallMirrorLoop mirror_rates_loop(KernelChoice kernel, int dim);
/// f_i -= V_i sum V_j (p_i + p_j) grad W, and the diffusion of density as in forces_loop, whose pressure
/// behind a wall is that of rest.
WallMirrorLoop mirror_forces_loop(KernelChoice kernel, int dim);

}  // namespace courant
