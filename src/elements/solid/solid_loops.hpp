#pragma once
// What the loops of solid formulations have in common: arrays over a block of elements, and the functions
// that each formulation has, compiled once for each instruction set.
#include "base/real.hpp"
#include "parallel/parallel.hpp"

namespace courant {

/// Corners of the elements of a group, and their nodes.
struct SolidMesh {
  const Real *x[3], *v[3];  ///< of nodes: position at the end of the step [L], velocity through it [L/T]
  static constexpr int most_corners = 20;
  const Index* corner[most_corners];  ///< by element: its nodes in LS-DYNA's order
};

/// Arrays over the elements of a group. The loops touch the entries of their block alone.
struct SolidState {
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
  Real* internal_energy;  ///< the work of stress is added; null: not requested [ML2/T2]
  Real *hourglass_energy, *bulk_viscosity_energy;  ///< what they took is added [ML2/T2]
  /// Of mode m in direction k at [3 m + k]; null: QM is 0, or elements have several points. [ML/T2]
  Real* hourglass_force[12]{};
  /// Out: of corner c in direction k at [3 c + k], on the node. [ML/T2]
  Real* corner_force[3 * SolidMesh::most_corners];
};

/// *CONTROL_HOURGLASS or *HOURGLASS, and *CONTROL_BULK_VISCOSITY.
struct SolidControl {
  /// IHQ: 1 viscous on the plain modes Gamma, else on those orthogonal to linear fields, viscous (2, 3) or
  /// a stiffness (4, 5), or that of assumed strains (6).
  int hourglass = 2;
  bool stiff() const { return hourglass >= 4; }
  Real QM = 0.1, Q1 = 1.5, Q2 = 0.06;
  Real MU = 0;  ///< dynamic viscosity of a fluid, which limits the stable step [M/LT]
  /// Of the material at rest, for IHQ 6: Young's modulus, shear modulus, E/(1 - nu^2) [M/LT2]; nu [-]
  Real E = 0, G = 0, plate_modulus = 0, nu = 0;
  /// Of the deviation of tr D at a point from its mean over the element, what the law sees, in formulations
  /// whose strains vary enough for bodies that keep their volume to lock. [-]
  Real dilatation = 0;
  /// Of forces that are those of the strain alone.
  SolidControl without_viscosity() const {
    SolidControl out = *this;
    out.Q1 = out.Q2 = out.MU = 0;
    if (!out.stiff()) out.QM = 0;
    return out;
  }
};

/// What a thread keeps of the block it works on, from one loop to the next.
struct SolidScratch {
  /// Of nineteen vectors and four more. An even number would let arrays meet in the same lines of the cache.
  static constexpr int rows = 61;
  alignas(64) Real rate[6][block_size];  ///< D of mid-step in the axes at its end: xx yy zz xy yz zx [1/T]
  /// Of hexahedra modes 1 to 7 of x, of others vectors of their own; the first three are 1 and all others 0
  /// in an element that is taken for one at rest. [L]
  Real position[rows][block_size];
  /// The same of v; with one point those from 4 on without linear fields, but for IHQ 1. [L/T]
  Real speed[rows][block_size];
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

/// Elements [begin, begin + count) of a group, count <= block_size.
struct ElementBlock {
  Index begin, count;
  Real dt;  ///< of the step that led here; 0: none yet [T]
};
struct StableStep {
  Real step;          ///< least stable step; not a number where that of an element is [T]
  Index shortest;     ///< whose it is, of the group
  Real least_volume;  ///< least V/V0; not a number where one is
  Index smallest;     ///< whose it is
};

/// A formulation with one point.
struct OnePointLoops {
  /// Gathers corners; D, rates of hourglass control, and stress and tensors of the law turned by the spin
  /// (Hughes-Winget), with the geometry in the middle of the step.
  void (*strain)(const ElementBlock& block, const SolidMesh& mesh, const SolidControl& control,
                 const SolidState& state, SolidScratch& scratch);
  /// Bulk viscosity of an equation of state, with the sound speed in `scratch`:
  /// q at the end of the step instead of that at its start, and the work of both through `opened` added
  /// to that of stress.
  void (*viscosity)(const ElementBlock& block, const SolidControl& control, const SolidState& state,
                    SolidScratch& scratch);
  /// Behind the law: completes the work of stress, (old turned + new stress)/2
  /// : D V dt of the middle; with `heats` the mean stress through `opened`.
  void (*work)(const ElementBlock& block, const SolidState& state, SolidScratch& scratch);
  /// Corner forces with the geometry at the end of the step, energies, stable step.
  StableStep (*forces)(const ElementBlock& block, const SolidControl& control, const SolidState& state,
                       SolidScratch& scratch);
};

/// The hexahedron with one point, for the machine the program runs on; its `viscosity` serves all.
OnePointLoops hexahedron_loops();

/// Of a block of elements with several points; `rate`, `half_turn` and `sound_speed` are those of the point
/// at work.
struct PointScratch : SolidScratch {
  Real mean_trace[block_size];    ///< of D at mid-step, mean over the element [1/T]
  Real weight[block_size];        ///< volume of the point at work at mid-step [L3]
  Real force[rows][block_size];   ///< of the points so far, by what `position` has [ML/T2]
  Real pressure[block_size];      ///< times volume, of the points so far [ML2/T2]
  Real fastest[block_size];       ///< sound speed of the points so far [L/T]
  Real least_weight[block_size];  ///< of the points so far, at the end of the step [L3]
};

/// A formulation with several points.
struct PointLoops {
  static constexpr int most_points = 27;
  /// Gathers corners, and the compression.
  void (*gather)(const ElementBlock& block, const SolidMesh& mesh, const SolidState& state,
                 PointScratch& scratch);
  /// Volume and mean of tr D at mid-step; sums are 0. With `heats` also `opened`.
  void (*begin)(const ElementBlock& block, bool heats, PointScratch& scratch);
  /// Of a point, whose stress and tensors `state` has: D; stress and tensors turned by the spin there; half
  /// of the work of stress.
  void (*strain)(const ElementBlock& block, int point, const SolidControl& control, const SolidState& state,
                 PointScratch& scratch);
  /// Behind the law: the other half, and what the stress does to the corners at the end of the step.
  void (*add)(const ElementBlock& block, int point, const SolidControl& control, const SolidState& state,
              PointScratch& scratch);
  /// Corner forces, energies, stable step.
  StableStep (*forces)(const ElementBlock& block, const SolidControl& control, const SolidState& state,
                       PointScratch& scratch);
};

}  // namespace courant
