#pragma once
// How far nodes are from faces, at least: eight faces at once, compiled once for each instruction set.
#include "base/real.hpp"

namespace courant {

struct FaceBoundLoops {
  /// Of position y [L] and faces, each with the indices of its corners (a triangle repeats its third) into x:
  /// `clear`, at most the distance; `beside`: while y and each corner have moved by less than half of it, y
  /// has no foot on the face, `edge_margin` beyond its edges included. [L]
  void (*bounds)(const Real* const x[3], const Index* const* corners, Index count, const Real y[3],
                 Real* clear, Real* beside);
};

/// For the present processor.
FaceBoundLoops face_bound_loops();

}  // namespace courant
