#pragma once
// What a law of J2 plasticity declares: its yield stress, with the slopes that the return to it needs.
#include "laws/point_block.hpp"
#include "parallel/parallel.hpp"

namespace courant {

/// The rate on which a yield stress depends.
enum class YieldRate {
  none,
  of_strain,          ///< sqrt(2/3 D:D)
  of_deviator,        ///< the same of the deviator of D
  of_plastic_strain,  ///< increment of plastic strain over the step
};

/// Points of a block. In: plastic strain [-] and, where it counts, the rate [1/T]. Out: the yield stress >= 0
/// [M/LT2], its slope over plastic strain [M/LT2] and, where rates count, over the rate [M/LT]. A slope that
/// is infinite where its argument is 0 is given as 0 there.
struct YieldPoints {
  Index count = 0;
  Real plastic[block_size], rate[block_size];
  Real stress[block_size], by_strain[block_size], by_rate[block_size];
};

}  // namespace courant
