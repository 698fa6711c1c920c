#pragma once
// Water depth from particles.
#include <vector>

#include "post/results.hpp"

namespace courant {

/// Cubic spline kernel with support 2h, normalised to 1. r: distance [L], h: smoothing length [L], dim: 2
/// or 3. dimension: 1/L^dim. Source: Monaghan, Annu. Rev. Astron. Astrophys. 30 (1992), eq. 2.6 (there for
/// all dimensions).
Real cubic_spline(Real r, Real h, int dim);

/// Finds the free surface of one state on vertical lines (y is up). Shepard's colour C(y) = sum_j V_j W(|r -
/// r_j|, h_j) is 1 inside water, 0 outside and 1/2 on a flat surface. The surface is where C first falls
/// below 1/2 above the bed: spray above a gap does not count. Nor does water whose underside is more than 2h
/// above the bed: the bed is dry there.
class FreeSurface {
 public:
  /// Looks at particles within reach of lines with x in [x_from, x_to] [L]. The frame must outlive the
  /// object.
  FreeSurface(const ParticleFrame& frame, Real x_from, Real x_to);

  /// Depth over the bed at (x, z), 0 where it is dry. Resolution h/16, linear in between. [L]
  Real depth(Real x, Real bed, Real z = 0) const;

 private:
  const ParticleFrame& frame_;
  Real h_max_ = 0;
  std::vector<std::size_t> by_x_;  // particles near the range, in order of x
};

}  // namespace courant
