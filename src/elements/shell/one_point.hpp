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

/// What a section that has flowed bears of hourglass forces: a fourth of those at which its modes alone would
/// be fully plastic, as the rest of its strength goes into what one point sees. Without end before. [M/T2
/// ...]
COURANT_INLINE void bound_hourglass(Index first, Index n, Native t, Native A, const ShellState& state,
                                    Native bound[3]) {
  constexpr Real share = 0.25, endless = 1e300, root_three = 1.7320508075688772;
  const Native flow = load(state.flow_stress + first, n), side = root(A), yields = share * t * flow;
  bound[0] = flow > 0.0 ? 0.25 * yields * side : all(endless);
  bound[1] = flow > 0.0 ? (0.5 / root_three) * yields * t : all(endless);
  bound[2] = flow > 0.0 ? 0.0625 * yields * t * side : all(endless);
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
  const bool bounded = control.stiffness && state.flow_stress;
  Native bound[3];
  if (bounded) bound_hourglass(first, n, t, f.A, state, bound);
  Native taken = all(0);
  for (int m = 0; m < 5; ++m) {
    const Native rate = load(s.hourglass_rate[m] + k), old = load(state.hourglass[m] + first, n);
    Q[m] = control.stiffness ? old + dt * a[m] * rate : a[m] * rate;
    if (bounded) {
      const Native most = bound[m < 2 ? 0 : m > 2 ? 2 : 1];
      Q[m] = native_max(-most, native_min(most, Q[m]));
    }
    store(state.hourglass[m] + first, Q[m], n);
    taken += 0.5 * (old + Q[m]) * rate;  // each pushes through half a step
  }
  add_to(state.hourglass_energy + first, dt * taken, n);
}

}  // namespace courant::COURANT_SIMD
