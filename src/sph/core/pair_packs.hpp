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
  COURANT_INLINE void list(Pack* to) const {
    to[0] = x, to[1] = y;
    if constexpr (Dim == 3) to[2] = z;
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

/// The same plus a number; one instruction less.
template <int Dim>
COURANT_INLINE Pack dot_plus(const Difference<Dim>& a, const Difference<Dim>& b, const Pack& c) {
  const Pack two = a.y * b.y + (a.x * b.x + c);
  if constexpr (Dim == 3) return a.z * b.z + two;
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
  COURANT_INLINE void add(const Difference<Dim>& d) {
    x += d.x;
    y += d.y;
    if constexpr (Dim == 3) z += d.z;
  }
  COURANT_INLINE void add_to(Real* const f[3], Index i, Index count, const Pack& factor) const {
    (Pack::load(f[0] + i, count) + factor * x).store(f[0] + i, count);
    (Pack::load(f[1] + i, count) + factor * y).store(f[1] + i, count);
    if constexpr (Dim == 3) (Pack::load(f[2] + i, count) + factor * z).store(f[2] + i, count);
  }
};

template <int Dim>
COURANT_INLINE Difference<Dim> times(const Pack& w, const Difference<Dim>& d) {
  Difference<Dim> out = d;
  out.x = w * d.x, out.y = w * d.y;
  if constexpr (Dim == 3) out.z = w * d.z;
  return out;
}

/// Packs of which a partner gets the sums over the lanes.
template <int N>
struct SharePacks {
  Pack of[N]{};
  /// Adds from the K-th on to numbers one after the other in memory.
  template <int K = 0>
  COURANT_INLINE void add_to(Real* to) const {
    if constexpr (N - K >= 4) {
      add_sums(of[K], of[K + 1], of[K + 2], of[K + 3], to + K);
      add_to<K + 4>(to);
    } else if constexpr (N - K >= 2) {
      add_sums(of[K], of[K + 1], to + K);
      add_to<K + 2>(to);
    } else if constexpr (N - K == 1) {
      add_sum(of[K], to + K);
    }
  }
};

/// Symmetric part of a sum of dyads: xx yy zz xy yz zx.
template <int Dim>
struct Dyads {
  Pack xx = Pack::zero(), yy = xx, zz = xx, xy = xx, yz = xx, zx = xx;
  COURANT_INLINE void add(const Difference<Dim>& a, const Difference<Dim>& b) {
    xx += a.x * b.x;
    yy += a.y * b.y;
    xy += a.x * b.y + a.y * b.x;
    if constexpr (Dim == 3) {
      zz += a.z * b.z;
      yz += a.y * b.z + a.z * b.y;
      zx += a.z * b.x + a.x * b.z;
    }
  }
  /// Components that are not 0 in this dimension.
  COURANT_INLINE void list(Pack* to) const {
    *to++ = xx, *to++ = yy;
    if constexpr (Dim == 3) *to++ = zz;
    *to++ = xy;
    if constexpr (Dim == 3) *to++ = yz, *to++ = zx;
  }
  /// `factor`: a number, or one for each i.
  template <class Factor>
  COURANT_INLINE void store(Real* const to[6], Index i, Index count, const Factor& factor) const {
    const Factor half = 0.5 * factor;
    (factor * xx).store(to[0] + i, count);
    (factor * yy).store(to[1] + i, count);
    (factor * zz).store(to[2] + i, count);
    (half * xy).store(to[3] + i, count);
    (half * yz).store(to[4] + i, count);
    (half * zx).store(to[5] + i, count);
  }
};

/// Adds B . a, B(k) the components of a symmetric tensor: xx yy zz xy yz zx.
template <int Dim, template <int> class To, class Tensor, class Vector>
COURANT_INLINE void add_product(To<Dim>& to, const Tensor& B, const Vector& a) {
  to.x += B(0) * a.x + B(3) * a.y;
  to.y += B(3) * a.x + B(1) * a.y;
  if constexpr (Dim == 3) {
    to.x += B(5) * a.z;
    to.y += B(4) * a.z;
    to.z += B(5) * a.x + B(4) * a.y + B(2) * a.z;
  }
}

/// Adds what a partner gets one entry late: then no later entry waits for the sums over the lanes.
template <int N>
class PendingShares {
 public:
  /// `nowhere`: N numbers that nobody reads.
  COURANT_INLINE explicit PendingShares(Real* nowhere) : to_(nowhere) {}
  COURANT_INLINE void add() const { shares_.add_to(to_); }
  COURANT_INLINE void take(const SharePacks<N>& shares, Real* to) {
    add();
    shares_ = shares;
    to_ = to;
  }

 private:
  SharePacks<N> shares_;
  Real* to_;
};

}  // namespace courant::COURANT_SIMD
