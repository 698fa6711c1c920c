#pragma once
// What loops over hexahedra share, one point or eight: modes of positions and velocities, and volumes. For
// files that are compiled once for each instruction set: all is inlined there.
#include "elements/solid/solid_math.hpp"

namespace courant::COURANT_SIMD {

/// Modes 1 to 7 of eight numbers, one for each corner: xi, eta, zeta, eta zeta, zeta xi, xi eta, xi eta zeta.
COURANT_INLINE void modes_of(const Native p[8], Native out[7]) {
  const Native s01 = p[1] + p[0], d01 = p[1] - p[0], s32 = p[2] + p[3], d32 = p[2] - p[3];
  const Native s45 = p[5] + p[4], d45 = p[5] - p[4], s76 = p[6] + p[7], d76 = p[6] - p[7];
  const Native ss0 = s32 + s01, sd0 = s32 - s01, ds0 = d32 + d01, dd0 = d32 - d01;
  const Native ss1 = s76 + s45, sd1 = s76 - s45, ds1 = d76 + d45, dd1 = d76 - d45;
  out[0] = ds1 + ds0, out[1] = sd1 + sd0, out[2] = ss1 - ss0;
  out[3] = sd1 - sd0, out[4] = ds1 - ds0, out[5] = dd1 + dd0, out[6] = dd1 - dd0;
}

/// The numbers at the corners that have these modes, and no mode 0.
COURANT_INLINE void corners_of(const Native m[7], Native out[8]) {
  const Native d0 = m[5] - m[6], d1 = m[5] + m[6], c0 = m[0] - m[4], c1 = m[0] + m[4];
  const Native b0 = m[1] - m[3], b1 = m[1] + m[3];
  const Native low0 = -m[2] - b0, low1 = m[2] - b1, high0 = b0 - m[2], high1 = b1 + m[2];
  out[0] = low0 - (c0 - d0), out[1] = low0 + (c0 - d0);
  out[3] = high0 - (c0 + d0), out[2] = high0 + (c0 + d0);
  out[4] = low1 - (c1 - d1), out[5] = low1 + (c1 - d1);
  out[7] = high1 - (c1 + d1), out[6] = high1 + (c1 + d1);
}

/// 64 dV/da_k of modes 1 to 6, and 64 V.
struct Geometry {
  Triple g[6];
  Native V64;
};
COURANT_INLINE Geometry geometry(const Triple a[7]) {
  constexpr Real third = 1.0 / 3;
  Geometry out;
  out.g[0] = cross(a[1], a[2]) + third * cross(a[5], a[4]);
  out.g[1] = cross(a[2], a[0]) + third * cross(a[3], a[5]);
  out.g[2] = cross(a[0], a[1]) + third * cross(a[4], a[3]);
  out.g[3] = third * (cross(a[2], a[4]) + cross(a[5], a[1]));
  out.g[4] = third * (cross(a[3], a[2]) + cross(a[0], a[5]));
  out.g[5] = third * (cross(a[1], a[3]) + cross(a[4], a[0]));
  out.V64 = dot(a[0], out.g[0]) + dot(a[3], out.g[3]);
  return out;
}
COURANT_INLINE Native volume64(const Triple a[7]) {
  return dot(a[0], cross(a[1], a[2])) +
         (1.0 / 3) * (dot(a[0], cross(a[5], a[4])) + dot(a[3], cross(a[2], a[4]) + cross(a[5], a[1])));
}

/// Squares of the vectors of two opposite faces, (b +- f) x (c +- e)/16, times 256: the larger one.
COURANT_INLINE Native larger_face2(const Triple& b, const Triple& f, const Triple& c, const Triple& e) {
  const Triple even = cross(b, c) + cross(f, e), odd = cross(b, e) + cross(f, c);
  const Native twice = 2.0 * dot(even, odd);
  return dot(even, even) + dot(odd, odd) + native_max(twice, -twice);
}
COURANT_INLINE Native largest_face(const Triple a[7]) {
  return 0.0625 * root(native_max(larger_face2(a[1], a[5], a[2], a[4]),
                                  native_max(larger_face2(a[2], a[3], a[0], a[5]),
                                             larger_face2(a[0], a[4], a[1], a[3]))));
}

/// Volume over the largest face.
COURANT_INLINE Native thickness(const Triple a[7], Native V64) {
  return 0.015625 * V64 / largest_face(a);
}

/// Modes of positions and velocities, kept for the forces, too.
COURANT_INLINE void gather_modes(const SolidMesh& mesh, Index first, Index n, Index k, SolidScratch& scratch,
                                 Native x[3][7], Native v[3][7]) {
  Native px[3][8], pv[3][8];
  gather_corners(mesh, first, n, px, pv);
  for (int d = 0; d < 3; ++d) {
    modes_of(px[d], x[d]), modes_of(pv[d], v[d]);
    for (int m = 0; m < 7; ++m)
      store(scratch.position[3 * m + d] + k, x[d][m]), store(scratch.speed[3 * m + d] + k, v[d][m]);
  }
}

}  // namespace courant::COURANT_SIMD
