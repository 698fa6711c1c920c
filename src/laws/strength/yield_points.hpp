#pragma once
// What a law of J2 plasticity declares: its yield stress, with the slopes that the return to it needs.
#include "laws/point_block.hpp"
#include "parallel/parallel.hpp"

namespace courant {

/// The rate on which a yield stress depends: of all strain less the elastic part of the deviator. With the
/// rate of all strain of half a step ago the yield stress would be a viscosity that an explicit step does not
/// bear (docs/theory_materials.md, viscoplasticity).
enum class YieldRate {
  none,
  of_flow,            ///< increment of plastic strain over the step, per its length
  of_flow_and_volume  ///< r with r^2 = that^2 + min(2/9 tr(D)^2, that^2/2), the cap being uniaxial strain
};

/// Points of a block. In: plastic strain [-] and, where it counts, the rate [1/T]. Out: the yield stress >= 0
/// [M/LT2], its slope over plastic strain [M/LT2] and, where rates count, over the rate [M/LT]. A slope that
/// is infinite where its argument is 0 is given as 0 there.
struct YieldPoints {
  Index count = 0;
  bool still = false;  ///< all rates are 0
  Real plastic[block_size], rate[block_size];
  Real stress[block_size], by_strain[block_size], by_rate[block_size];
};

}  // namespace courant
