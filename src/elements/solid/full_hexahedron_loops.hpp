#pragma once
// The hexahedron with 2 x 2 x 2 points (ELFORM 2) on a block of elements, compiled once for each instruction
// set.
//
// The trace of D at each point is the mean over the element, dV/dt/V, and the force of pressure is that of
// the mean pressure, p dV/dx_I: elements that keep their volume do not lock (selective reduced integration:
// Hughes 1980, Int. J. Numer. Meth. Eng. 15). The deviator is integrated in full, so that no mode has zero
// energy.
#include "elements/solid/hexahedron_loops.hpp"

namespace courant {

/// Of a block; `rate`, `half_turn` and `sound_speed` are those of the point at work, all of which have the
/// trace of the mean.
struct FullHexahedronScratch : HexahedronScratch {
  Real mean_trace[block_size];  ///< of D at mid-step [1/T]
  Real weight[block_size];      ///< volume of the point at work at mid-step [L3]
  Real force[21][block_size];   ///< of the deviators of the points so far, by modes of the corners [ML/T2]
  Real pressure[block_size];    ///< times volume, of the points so far [ML2/T2]
  Real fastest[block_size];     ///< sound speed of the points so far [L/T]
};

struct FullHexahedronLoops {
  static constexpr int points = 8;
  using Block = HexahedronLoops::Block;
  /// Gathers corners, and the compression.
  void (*gather)(const Block& block, const HexahedronMesh& mesh, const HexahedronState& state,
                 FullHexahedronScratch& scratch);
  /// Volume and mean of tr D at mid-step; sums are 0. With `heats` also `opened`.
  void (*begin)(const Block& block, bool heats, FullHexahedronScratch& scratch);
  /// Of a point, whose stress and tensors `state` has: D; stress and tensors turned by the spin there; half
  /// of the work of stress.
  void (*strain)(const Block& block, int point, const HexahedronState& state, FullHexahedronScratch& scratch);
  /// Behind the law: the other half, and what the stress does to the corners at the end of the step.
  void (*add)(const Block& block, int point, const HexahedronState& state, FullHexahedronScratch& scratch);
  /// Corner forces, energies, stable step.
  HexahedronLoops::StableStep (*forces)(const Block& block, const HexahedronControl& control,
                                        const HexahedronState& state, FullHexahedronScratch& scratch);
};

/// For the machine the program runs on.
FullHexahedronLoops full_hexahedron_loops();

}  // namespace courant
