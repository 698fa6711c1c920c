#pragma once
// How far nodes are from faces, at least: eight faces at once, compiled once for each instruction set.
#include "base/real.hpp"

namespace courant {

struct FaceBoundLoops {
  /// Of position y [L] and faces, each with the indices of its corners (a triangle repeats its third) into x:
  /// `clear`, at most the distance; `beside`, a motion of y and the corners, relative to each other, short of
  /// which y has no foot on the face, `edge_margin` beyond its edges included. [L]
  void (*bounds)(const Real* const x[3], const Index* const* corners, Index count, const Real y[3],
                 Real* clear, Real* beside);
};

/// For the present processor.
FaceBoundLoops face_bound_loops();

}  // namespace courant
