#pragma once
// What loops over shells with one point in their plane have alike, in the files that are compiled once for
// each instruction set.
#include "elements/shell/shell_geometry.hpp"

namespace courant::COURANT_SIMD {

inline void at_point(const ShellLoops::Block& block, int point, const ShellState& state, ShellScratch& s) {
  Real z[block_size];
  heights_at(block, point, state, z);
#pragma omp simd
  for (Index i = 0; i < block.count; ++i) {
    s.rate[0][i] = s.membrane[0][i] + z[i] * s.curvature[0][i];
    s.rate[1][i] = s.membrane[1][i] + z[i] * s.curvature[1][i];
    s.rate[3][i] = s.membrane[2][i] + z[i] * s.curvature[2][i];
    s.rate[4][i] = s.shear[1][i];
    s.rate[5][i] = s.shear[0][i];
  }
}

/// N, M and Q from the stress of the points; their work over the step joins the internal energy.
COURANT_INLINE void integrate(Index first, Index n, Index k, Real dt, Real factor, Native t,
                              const ShellState& state, ShellScratch& s, Native R[8]) {
  Native both[8];
  integrate_layers(first, n, k, 0, 1, factor, t, state, s, R, both);
  const Native power = both[0] * load(s.membrane[0] + k) + both[1] * load(s.membrane[1] + k) +
                       both[3] * load(s.curvature[0] + k) + both[4] * load(s.curvature[1] + k) +
                       2.0 * (both[2] * load(s.membrane[2] + k) + both[5] * load(s.curvature[2] + k) +
                              both[6] * load(s.shear[0] + k) + both[7] * load(s.shear[1] + k));
  add_to(state.internal_energy + first, 0.5 * dt * load(s.middle_area + k) * power, n);
}

/// Generalised forces of hourglass control; what they take is counted.
COURANT_INLINE void hourglass_forces(Index first, Index n, Index k, Real dt, Native t, const Flat& f,
                                     Native rho, const ShellControl& control, const ShellState& state,
                                     const ShellScratch& s, Native Q[5]) {
  Native membrane, warping, bending;
  if (control.stiffness) {
    const Native BB = 0.5 * f.inverse_A * (f.x0 * f.x0 + f.y0 * f.y0 + f.x1 * f.x1 + f.y1 * f.y1);  // times A
    membrane = (control.QM * control.E / 8) * t * BB;
    warping = (control.QW * control.shear_factor * control.G / 12) * t * t * t * BB * f.inverse_A;
    bending = (control.QB * control.E / 192) * t * t * t * BB;
  } else {
    const Native impedance = 0.25 * root(control.plate_modulus * rho) * t;
    membrane = control.QM * impedance * root(f.A);
    warping = control.QW * impedance * t;
    bending = (0.0722 * control.QB) * impedance * t * f.A;
  }
  const Native a[5] = {membrane, membrane, warping, bending, bending};
  Native taken = all(0);
  for (int m = 0; m < 5; ++m) {
    const Native rate = load(s.hourglass_rate[m] + k), old = load(state.hourglass[m] + first, n);
    Q[m] = control.stiffness ? old + dt * a[m] * rate : a[m] * rate;
    store(state.hourglass[m] + first, Q[m], n);
    taken += 0.5 * (old + Q[m]) * rate;  // each pushes through half a step
  }
  add_to(state.hourglass_energy + first, dt * taken, n);
}

}  // namespace courant::COURANT_SIMD
