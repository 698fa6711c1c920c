#pragma once
#include "base/real.hpp"

namespace courant {

/// The lists of particles [begin, end), as in PairLists but without kept gradients.
struct NeighbourLists {
  const Index* list;
  const Index* start;
  Index begin, end;
};

}  // namespace courant
