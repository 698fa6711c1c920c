#pragma once
// What particles get of pairs that the group of the other particle has worked out (see PairLists); compiled
// once for each instruction set, as pair_loops.hpp.
#include "sph/core/pair_loops.hpp"

namespace courant {

/// What the loops over pairs have left for particles [begin, end).
struct Contributions {
  struct Source {
    const Real* numbers;  ///< from particle `begin` on
    Index end;            ///< particles from here on got nothing
  };
  const Source* first;
  const Source* last;  ///< behind the last one
  Index begin, end;
};

/// Adds them to what the loops of the rates or of the forces have set. `norm`: gradient_norm of the h of all.
using ReductionLoop = void (*)(const PairArrays&, const Contributions&, Real norm);
/// `choice`: that of the loop over pairs; any kernel.
ReductionLoop rates_reduction_loop(const RatesChoice& choice);
ReductionLoop forces_reduction_loop(const ForcesChoice& choice);

}  // namespace courant
