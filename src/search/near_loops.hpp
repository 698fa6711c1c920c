#pragma once
// The inner loops of the neighbour search, compiled once for each instruction set.
#include "base/real.hpp"

namespace courant {

/// Eight particles in a row (fewer at the end) and those that may be near them.
struct NearQuery {
  const Real *x, *y, *z, *h;  ///< of all particles; z: null in 2D
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

/// The first cell along each axis, counted from that at the origin, and how many there are.
struct CellFrame {
  Real origin[3], inverse_size[3], first[3];  ///< [L], [1/L], [-]
  Index cells[3];
};

struct NearLoops {
  /// Adds those of particles [begin, end) that are within support max(h_i, h_j) of any particle i of the
  /// group to `within`, those that are but within support max(h_i, h_j) + skin to `beyond`.
  void (*find)(const NearQuery& query, Index begin, Index end, NearFound& found);
  /// The cells of particles [begin, end), by their position in the snake (see CellGrid): cell[0] is that of
  /// particle `begin`. Points outside belong to the cell at the border.
  void (*cells)(const CellFrame& frame, const Real* const x[3], Index begin, Index end, Index* cell);
};

/// For the machine the program runs on.
NearLoops near_loops();

}  // namespace courant
