#pragma once
#include "state/points.hpp"
#include "state/shared_fields.hpp"

namespace courant {

/// The part of a vector along the directions in which prescribed motions drive a point in the coming step.
/// `projector`: shared_fields::driven_projector.
inline Vec driven_part(const Field<Real>& projector, Index i, const Vec& a) {
  const auto P = [&](int k) { return projector.data(k)[i]; };
  return {P(0) * a[0] + P(3) * a[1] + P(5) * a[2], P(3) * a[0] + P(1) * a[1] + P(4) * a[2],
          P(5) * a[0] + P(4) * a[1] + P(2) * a[2]};
}

}  // namespace courant
