#pragma once
// The inner loop of the neighbour search, compiled once for each instruction set.
#include "base/real.hpp"

namespace courant {

/// Eight particles in a row (fewer at the end) and those that may be near them.
struct NearQuery {
  const Real *x, *y, *z, *h;  ///< of all particles
  Index first, count;         ///< the group: particles [first, first + count), 1 <= count <= 8
  Real skin;                  ///< [L]
  Real support;               ///< of the kernel, in h
  bool uniform_h;             ///< all h are that of particle `first`
};

/// What was found so far, behind which there is room for all that is looked at next.
struct NearFound {
  Index *within, *beyond;
  Index within_count = 0, beyond_count = 0;
};

/// Adds those of particles [begin, end) that are within support max(h_i, h_j) of any particle i of the group
/// to `within`, those that are but within support max(h_i, h_j) + skin to `beyond`.
using FindNear = void (*)(const NearQuery& query, Index begin, Index end, NearFound& found);

/// For the machine the program runs on.
FindNear find_near();

}  // namespace courant
