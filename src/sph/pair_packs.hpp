#pragma once
// Places and vectors of eight particles at once, for the loops over pairs (files *_loops.cpp).
#include "base/simd.hpp"

namespace courant::COURANT_SIMD {

/// Eight particles i.
template <int Dim>
struct Places {
  Pack x, y, z;
  COURANT_INLINE Places(const Real* const p[3], Index i, Index count)
      : x(Pack::load(p[0] + i, count)), y(Pack::load(p[1] + i, count)), z(Pack::zero()) {
    if constexpr (Dim == 3) z = Pack::load(p[2] + i, count);
  }
};
/// x_i - x_j, or another vector of a pair
template <int Dim>
struct Difference {
  Pack x, y, z;
  Difference() = default;
  COURANT_INLINE Difference(const Places<Dim>& i, const Real* const p[3], std::ptrdiff_t j)
      : x(i.x - p[0][j]), y(i.y - p[1][j]), z(Pack::zero()) {
    if constexpr (Dim == 3) z = i.z - p[2][j];
  }
  COURANT_INLINE void advance(Real time, const Difference& velocity) {
    x += time * velocity.x;
    y += time * velocity.y;
    if constexpr (Dim == 3) z += time * velocity.z;
  }
};
template <int Dim>
COURANT_INLINE Pack dot(const Difference<Dim>& a, const Difference<Dim>& b) {
  const Pack two = a.x * b.x + a.y * b.y;
  if constexpr (Dim == 3) return two + a.z * b.z;
  return two;
}

template <int Dim>
struct Sum {
  Pack x = Pack::zero(), y = Pack::zero(), z = Pack::zero();
  COURANT_INLINE void add(const Pack& w, const Difference<Dim>& d) {
    x += w * d.x;
    y += w * d.y;
    if constexpr (Dim == 3) z += w * d.z;
  }
  COURANT_INLINE void add_to(Real* const f[3], Index i, Index count, const Pack& factor) const {
    (Pack::load(f[0] + i, count) + factor * x).store(f[0] + i, count);
    (Pack::load(f[1] + i, count) + factor * y).store(f[1] + i, count);
    if constexpr (Dim == 3) (Pack::load(f[2] + i, count) + factor * z).store(f[2] + i, count);
  }
};

}  // namespace courant::COURANT_SIMD
