#pragma once
#include <algorithm>
#include <cmath>

#include "sph/core/view.hpp"
#include "sph/kernel/kernel.hpp"

namespace courant {

/// One pair of the momentum equation, eq. 17 (with h per particle: FORM 0, p_i with h_i and p_j with h_j, so
/// that pair forces cancel), for the energy that crosses the box. The pair loops hold the same in packs.
template <class Kernel, int Dim, bool UniformH, bool Monaghan>
struct MomentumPair {
  // of particle i
  Real h, hinv, norm, tiny, p, rho, qc, q2, inverse_rho;

  /// `pressure`: factor of r_ij in -a_i from p alone; `viscous`: same from Pi, both without V_j.
  struct Result {
    Real pressure_i, pressure_j, viscous;
  };

  Result operator()(Real r2, Real v_dot_r, Real pj, Real rhoj, Real qcj, Real hj) const {
    const Real rinv = 1 / std::sqrt(r2);
    const Real gi = norm * Kernel::slope(r2 * rinv * hinv) * rinv;
    Real gj = gi, hbar = h;
    if constexpr (!UniformH) {
      const Real hjinv = 1 / hj;
      gj = Kernel::C(Dim) * power<Dim + 1>(hjinv) * Kernel::slope(r2 * rinv * hjinv) * rinv;
      hbar = 0.5 * (h + hj);
    }
    Result out{p * inverse_rho * gi, pj * inverse_rho * gj, 0};
    if constexpr (Monaghan) {
      const Real phi = hbar * std::min(v_dot_r, Real(0)) / (r2 + 0.01 * hbar * hbar);  // eq. 16
      const Real Pi = 2 * phi * (q2 * phi - 0.5 * (qc + qcj)) / (rho + rhoj);          // eq. 15
      out.viscous = rhoj * Pi * (UniformH ? gi : 0.5 * (gi + gj));
    }
    return out;
  }
};

}  // namespace courant
