#pragma once
// The shell of Belytschko, Lin & Tsay (1984) with one point in its plane (ELFORM 2), and the flat triangle
// (ELFORM 4), the quadrilateral of 2 x 2 points in its plane (16, full_shell_loops.cpp), and that of one
// point which respects its warp (BWC 1, warped_shell_loops.cpp), on a block of elements, compiled once for
// each instruction set.
//
// Quadrilateral: d0 = x1 - x3, d1 = x2 - x4 and h = x1 - x2 + x3 - x4 tell all that does not depend on where
// it is; triangle: d0 = x2 - x1, d1 = x3 - x1. The normal e3 is along d0 x d1, A = |d0 x d1|/2, and of any
// nodal value v, with its differences v0, v1 taken as d0, d1,
//   A dv/dx = (y1 v0 - y0 v1)/2,   A dv/dy = (x0 v1 - x1 v0)/2
// in the plane of the element. Theory, with the signs of moments: docs/theory_structures.md.
#include "base/real.hpp"
#include "parallel/parallel.hpp"

namespace courant {

/// Corners of the elements of a group, and the nodes they are at.
struct ShellMesh {
  const Real *x[3], *v[3], *w[3];  ///< of nodes: place at the end of the step [L], velocity and angular
                                   ///< velocity through it [L/T], [1/T]
  const Index* corner[4];          ///< by element: its nodes; of triangles the last is ignored
};

/// Arrays over the elements of a group, in the axes of each element, which turn with it. The loops touch the
/// entries of their block alone.
struct ShellState {
  static constexpr int most_points = 40, most_in_plane = 4;
  /// Through the thickness; with 2 x 2 points in the plane those of the first, of the second, ... place
  /// there.
  int points = 2;
  /// Of each: height over half the thickness, weight (sum 1).
  Real zeta[most_in_plane * most_points], share[most_in_plane * most_points];
  /// Of point p: xx yy zz xy yz zx at 6 p; zz, which is 0, is ignored. [M/LT2]
  Real* stress[6 * most_in_plane * most_points];
  /// Generalised forces on vx vy vz wx wy, null for triangles, behind them, of shells with warp,
  /// moments against drilling, of each corner; with 2 x 2 points these alone.
  static constexpr int hourglass_modes = 5, most_generalised = 9;
  Real* hourglass[most_generalised];
  static int generalised(int places, bool warps) {
    return places == 1 && warps ? most_generalised : hourglass_modes;
  }
  /// von Mises stress at which the section flowed last, 0: it never did; null: hourglass forces have no
  /// bound. [M/LT2]
  const Real* flow_stress = nullptr;
  Real* viscous_force = nullptr;  ///< q times the thickness; null: no bulk viscosity [M/T2]
  Real* thickness;                ///< [L]
  const Real* offset = nullptr;   ///< of the middle over the nodes, over half the thickness; null: 0
  const Real* mass;               ///< [M]
  Real *internal_energy, *hourglass_energy, *bulk_viscosity_energy;  ///< what they took is added [ML2/T2]
};

/// What holds for all elements of a group.
struct ShellControl {
  bool stiffness = false;             ///< hourglass control by stiffness, else viscous
  Real QM = 0.1, QB = 0.1, QW = 0.1;  ///< of membrane, bending, warping
  Real Q1 = 0, Q2 = 0;                ///< bulk viscosity
  Real drilling = 0;   ///< 2 x 2 points, and those with warp: stiffness against drilling over G t A/4
  bool warps = false;  ///< BWC 1: one point in the plane respects the warp of the element
  Real E = 0, G = 0, plate_modulus = 0;  ///< E/(1 - nu^2) [M/LT2]
  Real shear_factor = 1;                 ///< SHRF
  int length_rule = 0;                   ///< ISDO
  bool thins = false;                    ///< ISTUPD 1
  bool invariant_axes = false;           ///< INN 2, 4
};

/// What a thread keeps of the block it works on, from one loop to the next.
struct ShellScratch {
  Real place[9][block_size];      ///< d0, d1, h of the end of the step [L]
  Real membrane[3][block_size];   ///< D xx yy xy of the middle surface, of the middle of the step [1/T]
  Real curvature[3][block_size];  ///< the same per height [1/LT]
  Real shear[2][block_size];      ///< D zx yz, of the tensor [1/T]
  Real hourglass_rate[ShellState::most_generalised][block_size];  ///< of what `hourglass` are the forces
  /// 2 x 2 points: D xx yy, curvature xx yy xy, D zx yz at each position, and the area there at mid-step.
  Real quarter[4][7][block_size], quarter_area[4][block_size];
  Real middle_area[block_size];  ///< at mid-step [L2]
  /// N xx yy xy [M/T2], M xx yy xy [ML/T2], Q xz yz [M/T2], of position q in the plane at 8 q: `strain`
  /// leaves those of the stress so far, `forces` those of the new one.
  Real resultant[8 * ShellState::most_in_plane][block_size];
  alignas(64) Real rate[6][block_size];  ///< of a point, `at_point` writes it; zz is left alone [1/T]
  Real thickening[block_size];           ///< in: mean of D zz over the points [1/T]
  Real step_limit[block_size];           ///< out: stable step [T]
  Real wave_time[block_size];            ///< out: the same without viscosity [T]
  /// Out: of corner c in direction k at 3 c + k, on the node. [ML/T2], [ML2/T2]
  Real corner_force[12][block_size], corner_moment[12][block_size];
};

struct ShellLoops {
  /// Elements [begin, begin + count) of the group, count <= block_size.
  struct Block {
    Index begin, count;
    Real dt;  ///< of the step that led here; 0: none yet [T]
  };
  struct StableStep {
    Real step;       ///< least stable step; not a number where that of an element is [T]
    Index shortest;  ///< whose it is, of the group
  };
  void (*strain)(const Block& block, const ShellControl& control, const ShellMesh& mesh,
                 const ShellState& state, ShellScratch& scratch);
  void (*at_point)(const Block& block, int point, const ShellState& state, ShellScratch& scratch);
  /// Behind the law: resultants and their work, corner forces and moments with the geometry at the end of the
  /// step, energies, thickness, stable step.
  StableStep (*forces)(const Block& block, const ShellControl& control, const ShellState& state,
                       ShellScratch& scratch);
};

/// For the machine the program runs on.
ShellLoops quadrilateral_loops();
ShellLoops triangle_loops();
ShellLoops full_quadrilateral_loops();
/// One point in the plane, for those with warp (BWC 1).
ShellLoops warped_quadrilateral_loops();
/// `places`: points in the plane, 1 or 4.
ShellLoops shell_loops(int corners, int places, const ShellControl& control);

}  // namespace courant
