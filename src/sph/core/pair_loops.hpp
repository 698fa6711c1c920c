#pragma once
// The loops over pairs, compiled once for each instruction set. A loop takes eight particles i at once and
// one neighbour j after the other; see docs/architecture.md.
#include "base/real.hpp"
#include "search/list_sections.hpp"
#include "sph/core/kernel_choice.hpp"

namespace courant {

/// What pair loops read and write; arrays over all particles, null where a scene lacks them.
struct PairArrays {
  const Real* x[3];
  const Real* v[3];
  const Real* m;
  const Real* V;    ///< m/rho, see PairVolumes
  const Real* h;    ///< where it differs
  const Real* rho;  ///< of particle i alone; of j, too, for diffusion
  const Real* qc;   ///< q1 c, for Monaghan viscosity
  const Real* p;    ///< pressure, plus bulk viscosity where there is any
  const Real* tau[6];
  Real* drhodt;
  Real* strain[6];
  Real* f[3];
  const Real* c;          ///< of particle i alone
  Real* diffusion;        ///< rate of rho by diffusion [M/L3T]
  const Real* potential;  ///< -g.x [L2/T2]
  Real* heat;             ///< power that artificial viscosity turns into heat [ML2/T3]
  Real h0, q2, delta;  ///< h0: the h of all where it does not differ; q2: 0 where viscosity has no quadratic
                       ///< part; delta: strength of the diffusion
  Real half_step;      ///< half of the step that led here: continuity holds in its middle [T]
  const AnyKernel* kernel;  ///< that of the run
};

/// The lists of particles [begin, end); end - begin <= block_size.
///
/// Where all have one h, a pair is worked out once, by the group that stands earlier, and what the particle j
/// of the later group (the partner) gets is added to `shares`: as many numbers for each particle from the
/// begin of the strip on as rates_shares or forces_shares say. They still lack the factors of the partner
/// alone; see partner_loops.hpp.
struct PairLists {
  const Index* list;
  const Index* start;  ///< of each group of eight, and the end
  const ListSections* sections;
  Index begin, end;
  Index strip_begin = 0;
  Real* shares = nullptr;
  // What the loop that stores works on, ~j for a partner j, and with it eight numbers for each; else null.
  Index* kept = nullptr;
  Index* kept_start = nullptr;
  Real* g = nullptr;
};

/// What partners get of the rates: sum of the rate of volume, of the force (dim), of the power, of the
/// velocity gradient (xx yy xy or xx yy zz xy yz zx).
constexpr int rates_shares(int dim, bool viscous, bool gradient) {
  return 1 + (viscous ? dim + 1 : 0) + (gradient ? dim * (dim + 1) / 2 : 0);
}
/// What partners get of the forces: force (dim), diffusion.
constexpr int forces_shares(int dim, bool diffusion) {
  return dim + (diffusion ? 1 : 0);
}

/// Whether the forces work out (dW/dr)/r of the pairs (but for a constant), or take it from where the rates
/// stored it, which they do where lists have room for it.
enum class Geometry { compute, load };

using PairLoop = void (*)(const PairArrays&, const PairLists&);

/// Eq. 6: drho_i/dt = rho_i sum_j V_j v_ij . grad_i W_ij (with h_i, FORM 0), in the middle of the step, to
/// which the velocities belong: less half_step v_ij . (grad grad W) . v_ij. With the places at its end, noise
/// would seem to compress, and energy come from nowhere, in proportion to the step. `viscous`: eqs 15-16,
/// Monaghan's viscosity, adds to f and sets heat. `gradient`: sets the symmetric velocity gradient, -1/2
/// sum_j V_j (v_ij,a grad_b W + v_ij,b grad_a W), components xx yy zz xy yz zx.
struct RatesChoice {
  int dim;
  bool uniform_h, viscous, gradient;
  KernelChoice kernel = KernelChoice::cubic_spline;
};
PairLoop rates_loop(const RatesChoice& choice);

/// Eq. 17 without Pi: f_i -= V_i sum_j V_j (p_i grad W(h_i) + p_j grad W(h_j)), which conserves momentum.
/// `stress`: adds the viscous stress tau in the same way, with the other sign.
/// `diffusion`: sets -2 delta h_i/c_i sum_j V_j (p_j - p_i + rho_i (phi_j - phi_i)) (dW/dr)/r, phi the
/// potential of gravity (Fourtakas et al. 2019 with dp = c^2 drho).
struct ForcesChoice {
  int dim;
  bool uniform_h, stress, diffusion;
  Geometry geometry;
  KernelChoice kernel = KernelChoice::cubic_spline;
};
PairLoop forces_loop(const ForcesChoice& choice);

struct KeptLists;
/// Of particles of one h.
using KeptLoop = void (*)(const PairArrays&, const KeptLists&);

/// The loops of one kernel; the last one is fix_loop of kept_loops.hpp.
struct PairLoops {
  PairLoop (*rates)(const RatesChoice&);
  PairLoop (*forces)(const ForcesChoice&);
  KeptLoop (*fix)(int dim);
};

}  // namespace courant
