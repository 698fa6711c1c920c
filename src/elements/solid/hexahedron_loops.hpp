#pragma once
// The hexahedron with one point (ELFORM 1) on a block of elements, compiled once for each instruction set.
//
// Places and velocities of an element are taken as eight modes: a_k = sum_I H_Ik x_I, with H the signs of 1,
// xi, eta, zeta, eta zeta, zeta xi, xi eta, xi eta zeta at corner I. The volume of a hexahedron with bilinear
// faces is a polynomial in them,
//   64 V = a1.(a2 x a3) + (a5.(a4 x a3) + a6.(a2 x a4) + a1.(a6 x a5))/3,
// so its derivatives by the corners, b_I = dV/dx_I = sum_k H_Ik dV/da_k, are exact and cost a few cross
// products, and the modes of hourglass control (Flanagan & Belytschko 1981) are those from a4 on.
#include "base/real.hpp"
#include "parallel/parallel.hpp"

namespace courant {

/// Corners of the elements of a group, and the nodes they stand at.
struct HexahedronMesh {
  const Real *x[3], *v[3];  ///< of nodes: place at the end of the step [L], velocity through it [L/T]
  const Index* corner[8];   ///< by element: its nodes in LS-DYNA's order
};

/// Arrays over the elements of a group. The loops touch the entries of their block alone.
struct HexahedronState {
  static constexpr int most_tensors = 3;
  Real* stress[6];  ///< Cauchy, xx yy zz xy yz zx [M/LT2]
  int tensors = 0;  ///< how many tensors of the law are turned with the stress
  Real* tensor[most_tensors][6];
  /// q of bulk viscosity; null: not asked for, nor what it takes [M/LT2]
  Real* viscous_pressure = nullptr;
  /// An equation of state takes the work: `viscosity` has worked q out, and what it does is in that of
  /// stress. Else `forces` does, and counts it apart.
  bool heats = false;
  const Real *V0, *rho0;  ///< reference volume and density [L3], [M/L3]
  Real* internal_energy;  ///< the work of stress is added; null: not asked for [ML2/T2]
  Real *hourglass_energy, *bulk_viscosity_energy;  ///< what they took is added [ML2/T2]
  /// Of mode m in direction k at [3 m + k]; null: QM is 0, or elements have eight points. [ML/T2]
  Real* hourglass_force[12]{};
  Real* corner_force[24];  ///< out: of corner c in direction k at [3 c + k], on the node [ML/T2]
};

/// *CONTROL_HOURGLASS or *HOURGLASS, and *CONTROL_BULK_VISCOSITY.
struct HexahedronControl {
  /// IHQ: 1 viscous on the plain modes Gamma, else on those orthogonal to linear fields, viscous (2, 3) or
  /// a stiffness (4, 5), or that of assumed strains (6).
  int hourglass = 2;
  bool stiff() const { return hourglass >= 4; }
  Real QM = 0.1, Q1 = 1.5, Q2 = 0.06;
  Real MU = 0;  ///< dynamic viscosity of a fluid, which the stable step heeds [M/LT]
  /// Of the material at rest, for IHQ 6: Young's modulus, shear modulus, E/(1 - nu^2) [M/LT2]; nu [-]
  Real E = 0, G = 0, plate_modulus = 0, nu = 0;
};

/// What a thread keeps of the block it works on, from one loop to the next.
struct HexahedronScratch {
  alignas(64) Real rate[6][block_size];  ///< D of mid-step in the axes at its end: xx yy zz xy yz zx [1/T]
  Real place[21][block_size];            ///< modes 1 to 7 of x, three components each [L]
  /// The same of v; with one point those from 4 on without linear fields, but for IHQ 1. [L/T]
  Real speed[21][block_size];
  Real half_turn[3][block_size];   ///< of the step, as in objective.hpp [-]
  Real compression[block_size];    ///< rho/rho0 - 1 at the end of the step [-]
  Real middle_volume[block_size];  ///< at mid-step [L3]
  /// With `heats`: sum b_I.v_I dt/2 with the b_I = dV/dx_I of the start and of the end of the step,
  /// through which the pressures there push corners: the gas gives to the last bit what the nodes get. [L3]
  Real opened[2][block_size];
  Real work[block_size];             ///< of stress over the step, once `work` was called [ML2/T2]
  Real sound_speed[block_size];      ///< the law writes it before `forces` [L/T]
  Real step_limit[block_size];       ///< out: stable step [T]
  Real wave_time[block_size];        ///< out: the same without viscosity [T]
  Real relative_volume[block_size];  ///< out: V/V0 [-]
};

struct HexahedronLoops {
  /// Elements [begin, begin + count) of the group, count <= block_size.
  struct Block {
    Index begin, count;
    Real dt;  ///< of the step that led here; 0: none yet [T]
  };
  /// Gathers corners; D, rates of hourglass control, and stress and tensors of the law turned by the spin
  /// (Hughes-Winget), with the geometry in the middle of the step.
  void (*strain)(const Block& block, const HexahedronMesh& mesh, const HexahedronControl& control,
                 const HexahedronState& state, HexahedronScratch& scratch);
  /// Bulk viscosity of an equation of state, with the sound speed in `scratch`:
  /// q at the end of the step in the place of that at its start, and the work of both through `opened` added
  /// to that of stress.
  void (*viscosity)(const Block& block, const HexahedronControl& control, const HexahedronState& state,
                    HexahedronScratch& scratch);
  /// Behind the law: completes the work of stress, (old turned + new stress)/2
  /// : D V dt of the middle; with `heats` the mean stress through `opened`.
  void (*work)(const Block& block, const HexahedronState& state, HexahedronScratch& scratch);
  /// Corner forces with the geometry at the end of the step, energies, stable step.
  struct StableStep {
    Real step;          ///< least stable step; not a number where that of an element is [T]
    Index shortest;     ///< whose it is, of the group
    Real least_volume;  ///< least V/V0; not a number where one is
    Index smallest;     ///< whose it is
  };
  StableStep (*forces)(const Block& block, const HexahedronControl& control, const HexahedronState& state,
                       HexahedronScratch& scratch);
};

/// For the machine the program runs on.
HexahedronLoops hexahedron_loops();

}  // namespace courant
