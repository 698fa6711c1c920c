#pragma once
// Eight numbers at once, for the few files that are compiled once for each instruction set (see
// docs/architecture.md). Everything here has the name of the instruction set in its name, so that code of
// different sets is never mixed up by the linker.
#if defined(__x86_64__)
#include <immintrin.h>
#endif

#include <bit>

#include "base/narrow.hpp"
#include "base/real.hpp"

#if defined(__AVX512F__) && defined(__AVX512DQ__) && defined(__AVX512VL__)
#define COURANT_SIMD avx512
#define COURANT_SIMD_BYTES 64
#elif defined(__AVX2__) && defined(__FMA__)
#define COURANT_SIMD avx2
#define COURANT_SIMD_BYTES 32
#else
#define COURANT_SIMD baseline
#define COURANT_SIMD_BYTES 16
#endif

#define COURANT_INLINE [[gnu::always_inline]] inline

namespace courant {
inline constexpr Index lanes = 8;

namespace COURANT_SIMD {

using Native = Real __attribute__((vector_size(COURANT_SIMD_BYTES)));
#ifdef __clang__  // takes a vector for aligned whatever its type says, but not within a packed struct
struct __attribute__((packed, may_alias)) NativeInMemory {
  Native value;
  COURANT_INLINE operator Native() const { return value; }
  COURANT_INLINE void operator=(Native a) { value = a; }
};
#else
using NativeInMemory = Real __attribute__((vector_size(COURANT_SIMD_BYTES), aligned(8), may_alias));
#endif
inline constexpr int native_lanes = COURANT_SIMD_BYTES / 8;
inline constexpr int parts = lanes / native_lanes;

COURANT_INLINE Native native_max(Native a, Native b) {
#if COURANT_SIMD_BYTES == 64
  return _mm512_max_pd(a, b);
#elif COURANT_SIMD_BYTES == 32
  return _mm256_max_pd(a, b);
#elif defined(__SSE2__)
  return _mm_max_pd(a, b);
#else
  return a > b ? a : b;
#endif
}

COURANT_INLINE Native native_min(Native a, Native b) {
#if COURANT_SIMD_BYTES == 64
  return _mm512_min_pd(a, b);
#elif COURANT_SIMD_BYTES == 32
  return _mm256_min_pd(a, b);
#elif defined(__SSE2__)
  return _mm_min_pd(a, b);
#else
  return a < b ? a : b;
#endif
}

/// 1/sqrt(x) for normal x > 0, within a few units of the last place.
COURANT_INLINE Native native_rsqrt(Native x) {
#if COURANT_SIMD_BYTES == 64
  // 14 bits, then one step of fourth order: dividing and taking roots would cost several times as much
  const Native y = _mm512_rsqrt14_pd(x), e = 1.0 - x * y * y;
  return y + y * e * (0.5 + e * (0.375 + e * 0.3125));
#elif COURANT_SIMD_BYTES == 32
  return 1.0 / Native(_mm256_sqrt_pd(x));
#elif defined(__SSE2__)
  return 1.0 / Native(_mm_sqrt_pd(x));
#else
  Native root;
  for (int k = 0; k < native_lanes; ++k) root[k] = __builtin_sqrt(x[k]);
  return 1.0 / root;
#endif
}

COURANT_INLINE Native native_from(const Fixed16* p) {
#if COURANT_SIMD_BYTES == 64
  return _mm512_cvtepi32_pd(_mm256_cvtepi16_epi32(_mm_loadu_si128(reinterpret_cast<const __m128i*>(p))));
#elif COURANT_SIMD_BYTES == 32
  return _mm256_cvtepi32_pd(_mm_cvtepi16_epi32(_mm_loadl_epi64(reinterpret_cast<const __m128i*>(p))));
#else
  Native out;
  for (int k = 0; k < native_lanes; ++k) out[k] = p[k];
  return out;
#endif
}
COURANT_INLINE Native native_from(const Float16* p) {
#if COURANT_SIMD_BYTES == 64
  const __m256i wide = _mm256_cvtepu16_epi32(_mm_loadu_si128(reinterpret_cast<const __m128i*>(p)));
  return _mm512_cvtps_pd(_mm256_castsi256_ps(_mm256_slli_epi32(wide, 16)));
#elif COURANT_SIMD_BYTES == 32
  const __m128i wide = _mm_cvtepu16_epi32(_mm_loadl_epi64(reinterpret_cast<const __m128i*>(p)));
  return _mm256_cvtps_pd(_mm_castsi128_ps(_mm_slli_epi32(wide, 16)));
#else
  Native out;
  for (int k = 0; k < native_lanes; ++k)
    out[k] = std::bit_cast<float>(static_cast<std::uint32_t>(p[k]) << 16);
  return out;
#endif
}
/// To the nearest. What is not a number becomes some integer.
COURANT_INLINE void native_to(Native x, Fixed16* p) {
#if COURANT_SIMD_BYTES == 64
  _mm_storeu_si128(reinterpret_cast<__m128i*>(p), _mm256_cvtsepi32_epi16(_mm512_cvtpd_epi32(x)));
#elif COURANT_SIMD_BYTES == 32
  const __m128i wide = _mm256_cvtpd_epi32(x);
  _mm_storel_epi64(reinterpret_cast<__m128i*>(p), _mm_packs_epi32(wide, wide));
#else
  for (int k = 0; k < native_lanes; ++k)
    p[k] = x[k] == x[k] ? static_cast<Fixed16>(x[k] < 0 ? x[k] - 0.5 : x[k] + 0.5) : Fixed16(0);
#endif
}
COURANT_INLINE void native_to(Native x, Float16* p) {
#if COURANT_SIMD_BYTES == 64
  const __m256i bits = _mm256_add_epi32(_mm256_castps_si256(_mm512_cvtpd_ps(x)), _mm256_set1_epi32(0x8000));
  _mm_storeu_si128(reinterpret_cast<__m128i*>(p), _mm256_cvtepi32_epi16(_mm256_srli_epi32(bits, 16)));
#elif COURANT_SIMD_BYTES == 32
  const __m128i bits = _mm_add_epi32(_mm_castps_si128(_mm256_cvtpd_ps(x)), _mm_set1_epi32(0x8000));
  const __m128i half = _mm_srli_epi32(bits, 16);
  _mm_storel_epi64(reinterpret_cast<__m128i*>(p), _mm_packus_epi32(half, half));
#else
  for (int k = 0; k < native_lanes; ++k)
    p[k] = static_cast<Float16>((std::bit_cast<std::uint32_t>(static_cast<float>(x[k])) + 0x8000u) >> 16);
#endif
}

/// Eight numbers, in as few registers as the instruction set allows.
struct Pack {
  Native part[parts];

  COURANT_INLINE static Pack of(Real a) {
    Pack out;
    for (int k = 0; k < parts; ++k) out.part[k] = a - Native{};
    return out;
  }
  COURANT_INLINE static Pack zero() { return of(0); }
  COURANT_INLINE static Pack load(const Real* p) {
    Pack out;
    for (int k = 0; k < parts; ++k)
      out.part[k] = *reinterpret_cast<const NativeInMemory*>(p + k * native_lanes);
    return out;
  }
  /// The first `n` numbers; the others repeat the last of them.
  COURANT_INLINE static Pack load(const Real* p, Index n) {
    if (n >= lanes) return load(p);
    Real copy[lanes];
    for (Index k = 0; k < lanes; ++k) copy[k] = p[k < n ? k : n - 1];
    return load(copy);
  }
  /// Every `stride`-th of the numbers from p on.
  COURANT_INLINE static Pack every(Index stride, const Real* p) {
    Pack out;
    for (int k = 0; k < parts; ++k, p += stride * (lanes / parts)) {
#if COURANT_SIMD_BYTES == 64
      out.part[k] = Native{p[0],          p[stride],     p[2 * stride], p[3 * stride],
                           p[4 * stride], p[5 * stride], p[6 * stride], p[7 * stride]};
#elif COURANT_SIMD_BYTES == 32
      out.part[k] = Native{p[0], p[stride], p[2 * stride], p[3 * stride]};
#else
      out.part[k] = Native{p[0], p[stride]};
#endif
    }
    return out;
  }
  /// From and to 16 bits: Fixed16 or Float16.
  template <class T>
  COURANT_INLINE static Pack widen(const T* p) {
    Pack out;
    for (int k = 0; k < parts; ++k) out.part[k] = native_from(p + k * native_lanes);
    return out;
  }
  template <class T>
  COURANT_INLINE void narrow(T* p) const {
    for (int k = 0; k < parts; ++k) native_to(part[k], p + k * native_lanes);
  }
  COURANT_INLINE void store(Real* p) const {
    for (int k = 0; k < parts; ++k) *reinterpret_cast<NativeInMemory*>(p + k * native_lanes) = part[k];
  }
  COURANT_INLINE void store(Real* p, Index n) const {
    if (n >= lanes) return store(p);
    Real copy[lanes];
    store(copy);
    for (Index k = 0; k < n; ++k) p[k] = copy[k];
  }
};

#define COURANT_PACK_OPERATOR(op)                                         \
  COURANT_INLINE Pack operator op(const Pack& a, const Pack& b) {         \
    Pack out;                                                             \
    for (int k = 0; k < parts; ++k) out.part[k] = a.part[k] op b.part[k]; \
    return out;                                                           \
  }                                                                       \
  COURANT_INLINE Pack operator op(const Pack& a, Real b) {                \
    Pack out;                                                             \
    for (int k = 0; k < parts; ++k) out.part[k] = a.part[k] op b;         \
    return out;                                                           \
  }                                                                       \
  COURANT_INLINE Pack operator op(Real a, const Pack& b) {                \
    Pack out;                                                             \
    for (int k = 0; k < parts; ++k) out.part[k] = a op b.part[k];         \
    return out;                                                           \
  }                                                                       \
  COURANT_INLINE Pack& operator op##=(Pack& a, const Pack& b) {           \
    return a = a op b;                                                    \
  }
COURANT_PACK_OPERATOR(+)
COURANT_PACK_OPERATOR(-)
COURANT_PACK_OPERATOR(*)
COURANT_PACK_OPERATOR(/)
#undef COURANT_PACK_OPERATOR

COURANT_INLINE Pack max(const Pack& a, const Pack& b) {
  Pack out;
  for (int k = 0; k < parts; ++k) out.part[k] = native_max(a.part[k], b.part[k]);
  return out;
}
COURANT_INLINE Pack min(const Pack& a, const Pack& b) {
  Pack out;
  for (int k = 0; k < parts; ++k) out.part[k] = native_min(a.part[k], b.part[k]);
  return out;
}
COURANT_INLINE Pack rsqrt(const Pack& a) {
  Pack out;
  for (int k = 0; k < parts; ++k) out.part[k] = native_rsqrt(a.part[k]);
  return out;
}
/// True if a < b in any lane.
COURANT_INLINE bool any_less(const Pack& a, const Pack& b) {
#if COURANT_SIMD_BYTES == 64
  return _mm512_cmp_pd_mask(a.part[0], b.part[0], _CMP_LT_OQ) != 0;
#elif COURANT_SIMD_BYTES == 32
  return _mm256_movemask_pd(_mm256_or_pd(_mm256_cmp_pd(a.part[0], b.part[0], _CMP_LT_OQ),
                                         _mm256_cmp_pd(a.part[1], b.part[1], _CMP_LT_OQ))) != 0;
#else
  bool any = false;
  for (int k = 0; k < parts; ++k)
    for (int l = 0; l < native_lanes; ++l) any |= a.part[k][l] < b.part[k][l];
  return any;
#endif
}

#if COURANT_SIMD_BYTES >= 32
/// Sums of the two halves, of the four quarters in pairs.
COURANT_INLINE __m256d halved(const Pack& a) {
#if COURANT_SIMD_BYTES == 64
  return _mm512_castpd512_pd256(a.part[0]) + _mm512_extractf64x4_pd(a.part[0], 1);
#else
  return a.part[0] + a.part[1];
#endif
}
COURANT_INLINE __m128d halved(const __m256d& a) {
  return _mm256_castpd256_pd128(a) + _mm256_extractf128_pd(a, 1);
}
COURANT_INLINE __m256d added_in_pairs(const __m256d& a, const __m256d& b) {
  return _mm256_unpacklo_pd(a, b) + _mm256_unpackhi_pd(a, b);
}
#endif

/// Adds the sum over the eight numbers of each pack to numbers in memory.
COURANT_INLINE void add_sum(const Pack& a, Real* to) {
#if COURANT_SIMD_BYTES >= 32
  const __m128d sums = halved(halved(a));
  *to += sums[0] + sums[1];
#else
  Native sum = a.part[0];
  for (int k = 1; k < parts; ++k) sum += a.part[k];
  *to += sum[0] + sum[1];
#endif
}
COURANT_INLINE void add_sums(const Pack& a, const Pack& b, Real* to) {
#if COURANT_SIMD_BYTES >= 32
  _mm_storeu_pd(to, _mm_loadu_pd(to) + halved(added_in_pairs(halved(a), halved(b))));
#else
  add_sum(a, to), add_sum(b, to + 1);
#endif
}
COURANT_INLINE void add_sums(const Pack& a, const Pack& b, const Pack& c, const Pack& d, Real* to) {
#if COURANT_SIMD_BYTES >= 32
  const __m256d ab = added_in_pairs(halved(a), halved(b)), cd = added_in_pairs(halved(c), halved(d));
  const __m256d sums = _mm256_permute2f128_pd(ab, cd, 0x20) + _mm256_permute2f128_pd(ab, cd, 0x31);
  _mm256_storeu_pd(to, _mm256_loadu_pd(to) + sums);
#else
  add_sums(a, b, to), add_sums(c, d, to + 2);
#endif
}

}  // namespace COURANT_SIMD
}  // namespace courant
