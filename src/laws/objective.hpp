#pragma once
// Turning of symmetric tensors with a body (Hughes & Winget 1980): sigma -> R sigma R^T with R = (1 - W
// dt/2)^-1 (1 + W dt/2), which is a rotation for any W and the exact one of a body that turns rigidly, with W
// of the middle of the step. The spin is given as the vector w with W x = w cross x: w = ((L_zy - L_yz)/2,
// (L_xz - L_zx)/2, (L_yx - L_xy)/2), L_ij = dv_i/dx_j. Files that are compiled for several instruction sets
// use this, so nothing here may be left to the linker: all is inlined.
#include "base/real.hpp"

namespace courant {

/// One tensor xx yy zz xy yz zx, or a register full of them; hx, hy, hz: w dt/2 [-].
template <class T>
[[gnu::always_inline]] inline void turn_tensor(const T& hx, const T& hy, const T& hz, T& xx, T& yy, T& zz,
                                               T& xy, T& yz, T& zx) {
  // R = ((1 - h.h) 1 + 2 h h^T + 2 [h x]) / (1 + h.h)
  const T f = 2.0 / (1.0 + hx * hx + hy * hy + hz * hz), d = f - 1.0;
  const T fx = f * hx, fy = f * hy, fz = f * hz, pxy = fx * hy, pyz = fy * hz, pzx = fz * hx;
  const T a0 = fx * hx + d, a1 = pxy - fz, a2 = pzx + fy;
  const T b0 = pxy + fz, b1 = fy * hy + d, b2 = pyz - fx;
  const T c0 = pzx - fy, c1 = pyz + fx, c2 = fz * hz + d;
  const T ax = a0 * xx + a1 * xy + a2 * zx, ay = a0 * xy + a1 * yy + a2 * yz,
          az = a0 * zx + a1 * yz + a2 * zz;
  const T bx = b0 * xx + b1 * xy + b2 * zx, by = b0 * xy + b1 * yy + b2 * yz,
          bz = b0 * zx + b1 * yz + b2 * zz;
  const T cx = c0 * xx + c1 * xy + c2 * zx, cy = c0 * xy + c1 * yy + c2 * yz,
          cz = c0 * zx + c1 * yz + c2 * zz;
  xx = ax * a0 + ay * a1 + az * a2;
  yy = bx * b0 + by * b1 + bz * b2;
  zz = cx * c0 + cy * c1 + cz * c2;
  xy = ax * b0 + ay * b1 + az * b2;
  yz = bx * c0 + by * c1 + bz * c2;
  zx = cx * a0 + cy * a1 + cz * a2;
}

/// A vector with the body: R a. hx, hy, hz as above.
template <class T>
[[gnu::always_inline]] inline void turn_vector(const T& hx, const T& hy, const T& hz, T& x, T& y, T& z) {
  const T f = 2.0 / (1.0 + hx * hx + hy * hy + hz * hz);
  // a + f h x (a + h x a)
  const T ax = x + hy * z - hz * y, ay = y + hz * x - hx * z, az = z + hx * y - hy * x;
  x += f * (hy * az - hz * ay), y += f * (hz * ax - hx * az), z += f * (hx * ay - hy * ax);
}

/// A rate D of the middle of a step, in the axes at its end: D + (W D - D W) dt/2, exact to second order.
/// Where it is left out, stress and its work are right to first order only. hx, hy, hz as above.
template <class T>
[[gnu::always_inline]] inline void turn_rate(const T& hx, const T& hy, const T& hz, T& xx, T& yy, T& zz,
                                             T& xy, T& yz, T& zx) {
  const T x = hx * yz, y = hy * zx, z = hz * xy;
  const T pxy = hy * yz - hx * zx + hz * (xx - yy), pyz = hz * zx - hy * xy + hx * (yy - zz);
  zx += hx * xy - hz * yz + hy * (zz - xx);
  xx += 2.0 * (y - z), yy += 2.0 * (z - x), zz += 2.0 * (x - y);
  xy += pxy, yz += pyz;
}

/// A block of tensors by the spin of each over dt. `spin` [1/T]
[[gnu::always_inline]] inline void turn_stress(const Real* const spin[3], Real dt, Real* const stress[6],
                                               Index count) {
  const Real *wx = spin[0], *wy = spin[1], *wz = spin[2], half = 0.5 * dt;
  Real *xx = stress[0], *yy = stress[1], *zz = stress[2], *xy = stress[3], *yz = stress[4], *zx = stress[5];
#pragma omp simd
  for (Index i = 0; i < count; ++i) {
    Real s[6] = {xx[i], yy[i], zz[i], xy[i], yz[i], zx[i]};
    turn_tensor(half * wx[i], half * wy[i], half * wz[i], s[0], s[1], s[2], s[3], s[4], s[5]);
    xx[i] = s[0], yy[i] = s[1], zz[i] = s[2], xy[i] = s[3], yz[i] = s[4], zx[i] = s[5];
  }
}

}  // namespace courant
