// Compiled once for each instruction set; see docs/architecture.md.
#include "contact/nodes/face_bound_loops.hpp"
#include "base/simd.hpp"

namespace courant::COURANT_SIMD {

namespace {

struct Vec8 {
  Pack x, y, z;
};

COURANT_INLINE Vec8 operator+(const Vec8& a, const Vec8& b) {
  return {a.x + b.x, a.y + b.y, a.z + b.z};
}
COURANT_INLINE Vec8 operator-(const Vec8& a, const Vec8& b) {
  return {a.x - b.x, a.y - b.y, a.z - b.z};
}
COURANT_INLINE Vec8 operator*(const Pack& a, const Vec8& b) {
  return {a * b.x, a * b.y, a * b.z};
}
COURANT_INLINE Pack dot(const Vec8& a, const Vec8& b) {
  return a.x * b.x + a.y * b.y + a.z * b.z;
}
COURANT_INLINE Vec8 cross(const Vec8& a, const Vec8& b) {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}

/// 1/sqrt(a), of 0 finite.
COURANT_INLINE Pack inverse_root(const Pack& a) {
  return rsqrt(max(a, Pack::of(1e-280)));
}
COURANT_INLINE Pack root(const Pack& a) {
  return a * inverse_root(a);
}
COURANT_INLINE Pack magnitude(const Pack& a) {
  return max(a, 0 - a);
}

// A face reaches beyond its corners by `edge_slack` and is off their mean plane there by `off_plane`, of its
// radius, at most.
constexpr Real edge_slack = 0.05, off_plane = 0.005;

// The distance is at least that from a box around the corners along the mean plane, and from their sphere.
//
// A foot q with normal n(q) obeys y = q + d n(q). With corners that left the mean plane by warp and moved by
// m, h the least height of the face: the sine of the angle between n(q) and the normal n of the mean plane
// before is at most tilt (warp + m)/h while (warp + m)/h < steep, and |d| at most 1.15 of the distance from
// the mean plane with all that. y is then within |d| of that sine, and the motion, of the face along n.
void bounds(const Real* const at[3], const Index* const* corners, Index count, const Real to[3], Real* clear,
            Real* beside) {
  constexpr Real tilt = 7, steep = 0.08;
  for (Index from = 0; from < count; from += lanes) {
    alignas(64) Real gathered[4][3][lanes], triangle[lanes];
    for (Index l = 0; l < lanes; ++l) {
      const Index* const node = corners[from + l < count ? from + l : count - 1];
      for (int e = 0; e < 4; ++e)
        for (int k = 0; k < 3; ++k) gathered[e][k][l] = at[k][node[e]] - to[k];
      triangle[l] = node[2] == node[3] ? 1e300 : 0;
    }
    Vec8 r[4];
    for (int e = 0; e < 4; ++e)
      r[e] = {Pack::load(gathered[e][0]), Pack::load(gathered[e][1]), Pack::load(gathered[e][2])};
    const Vec8 centre = Pack::of(0.25) * (r[0] + r[1] + r[2] + r[3]);
    const Vec8 normal = cross(r[2] - r[0], r[3] - r[1]), n = inverse_root(dot(normal, normal)) * normal;
    const Vec8 side = r[1] - r[0] + r[2] - r[3], in_plane = side - dot(side, n) * n;
    const Vec8 along = inverse_root(dot(in_plane, in_plane)) * in_plane, across = cross(n, along);
    Pack low_u = Pack::zero(), high_u = low_u, low_v = low_u, high_v = low_u, radius2 = low_u, warp = low_u,
         edge2 = low_u;
    Pack area = Pack::of(1e300);
    for (int e = 0; e < 4; ++e) {
      const Vec8 d = r[e] - centre, on = r[(e + 1) % 4] - r[e], back = r[(e + 3) % 4] - r[e];
      const Pack u = dot(d, along), v = dot(d, across), here = dot(cross(on, back), n);
      low_u = min(low_u, u), high_u = max(high_u, u), low_v = min(low_v, v), high_v = max(high_v, v);
      radius2 = max(radius2, dot(d, d)), warp = max(warp, magnitude(dot(d, n)));
      edge2 = max(edge2, dot(on, on));
      area = min(area, e < 2 ? here : here + Pack::load(triangle));
    }
    const Pack radius = root(radius2), slack = edge_slack * radius;
    const Pack u = 0 - dot(centre, along), v = 0 - dot(centre, across), above = magnitude(dot(centre, n));
    const Pack off_u = max(max(low_u - u, u - high_u), slack) - slack,
               off_v = max(max(low_v - v, v - high_v), slack) - slack,
               off_n = max(above - warp, Pack::zero());
    const Pack off2 = off_u * off_u + off_v * off_v;
    max(root(off2 + off_n * off_n) - off_plane * radius - edge_slack * warp,
        root(dot(centre, centre)) - 1.05 * radius)
        .store(clear + from, count - from);
    // in units of h, of a face without area far on the safe side
    const Pack per_h = root(edge2) / max(area, 1e-12 * edge2 + 1e-280), bent = warp * per_h;
    const Pack slope = tilt * (1.15 * (above + warp) * per_h + 1.15 * 0.17);
    const Pack free = (root(off2) - slope * warp) / (1.03 + 0.5 * slope);
    min(free, 2 * (steep - bent) / per_h).store(beside + from, count - from);
  }
}

}  // namespace

FaceBoundLoops face_bound_loops() {
  return {&bounds};
}

}  // namespace courant::COURANT_SIMD
