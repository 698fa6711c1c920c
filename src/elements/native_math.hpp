#pragma once
// Registers of several elements, for the loops of elements that are compiled once for each instruction set:
// everything is inlined there, and has the name of the instruction set in its name.
#include "base/simd.hpp"

#if COURANT_SIMD_BYTES == 16
#define COURANT_ONCE  // what a file of loops has besides them, such as a registration
#endif

namespace courant::COURANT_SIMD {

struct Triple {
  Native x, y, z;
};
COURANT_INLINE Triple operator+(const Triple& a, const Triple& b) {
  return {a.x + b.x, a.y + b.y, a.z + b.z};
}
COURANT_INLINE Triple operator-(const Triple& a, const Triple& b) {
  return {a.x - b.x, a.y - b.y, a.z - b.z};
}
COURANT_INLINE Triple operator*(const Native& f, const Triple& a) {
  return {f * a.x, f * a.y, f * a.z};
}
COURANT_INLINE Triple operator*(Real f, const Triple& a) {
  return {f * a.x, f * a.y, f * a.z};
}
COURANT_INLINE Native dot(const Triple& a, const Triple& b) {
  return a.x * b.x + a.y * b.y + a.z * b.z;
}
COURANT_INLINE Triple cross(const Triple& a, const Triple& b) {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}

COURANT_INLINE Native all(Real a) {
  return a - Native{};
}
COURANT_INLINE Native load(const Real* p) {
  return *reinterpret_cast<const NativeInMemory*>(p);
}
COURANT_INLINE Native load(const Real* p, Index n) {
  if (n >= native_lanes) return load(p);
  Real copy[native_lanes];
  for (Index k = 0; k < native_lanes; ++k) copy[k] = p[k < n ? k : n - 1];
  return load(copy);
}
COURANT_INLINE void store(Real* p, Native a) {
  *reinterpret_cast<NativeInMemory*>(p) = a;
}
COURANT_INLINE void store(Real* p, Native a, Index n) {
  if (n >= native_lanes) return store(p, a);
  Real copy[native_lanes];
  store(copy, a);
  for (Index k = 0; k < n; ++k) p[k] = copy[k];
}
COURANT_INLINE Native root(Native a) {
#if COURANT_SIMD_BYTES == 64
  return _mm512_sqrt_pd(a);
#elif COURANT_SIMD_BYTES == 32
  return _mm256_sqrt_pd(a);
#elif defined(__SSE2__)
  return _mm_sqrt_pd(a);
#else
  return Native{__builtin_sqrt(a[0]), __builtin_sqrt(a[1])};
#endif
}
COURANT_INLINE Native gather(const Real* p, const Index* n) {
#if COURANT_SIMD_BYTES == 64
  return Native{p[n[0]], p[n[1]], p[n[2]], p[n[3]], p[n[4]], p[n[5]], p[n[6]], p[n[7]]};
#elif COURANT_SIMD_BYTES == 32
  return Native{p[n[0]], p[n[1]], p[n[2]], p[n[3]]};
#else
  return Native{p[n[0]], p[n[1]]};
#endif
}

}  // namespace courant::COURANT_SIMD
