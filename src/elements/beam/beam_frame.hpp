#pragma once
// The axes of a beam, and the rotations of its ends against them.
#include <array>

#include <Eigen/Geometry>

#include "base/real.hpp"

namespace courant {

/// r from end to end, s halfway between those of the ends.
struct BeamFrame {
  Real length = 0;  ///< [L]
  Matrix axes = Matrix::Identity();
};

/// RT1 to RR2 of *ELEMENT_BEAM, along and about r, s, t of the beam.
struct BeamReleases {
  bool pull = false;                           ///< slides along r
  std::array<std::array<bool, 3>, 2> turns{};  ///< of end 1 and 2, about r, s, t: hinges
  bool twist() const { return turns[0][0] || turns[1][0]; }
  /// Whether bending is released about one of s and t alone, which then have to be known.
  bool tell_axes() const { return turns[0][1] != turns[0][2] || turns[1][1] != turns[1][2]; }
  bool any() const { return pull || turns != std::array<std::array<bool, 3>, 2>{}; }
};

struct TurnedEnds {
  BeamFrame frame;
  std::array<Vec, 2> turn{
      Vec::Zero(), Vec::Zero()};  ///< of the ends against the frame, axis times angle, along r, s, t [-]
  std::array<Vec, 2> leads{
      Vec::Zero(),
      Vec::Zero()};  ///< turn of the frame about r by that of each end: r . w = sum leads . w_end [-]
  Real lean = 0;     ///< and by end 2 that moves along t, times the length: - lean t . v/L [-]
};

/// Share of the step of a straight beam that a bent one allows: moments resist turns of the ends where it is
/// thick, and its frame turns faster than its ends about r where they lean far. `thickness2`: 12 I/(A L^2).
Real bent_step(const TurnedEnds& turned, Real thickness2);

/// On the nodes of a beam; end 2 feels -force.
struct NodalForces {
  Vec force = Vec::Zero();                              ///< on end 1 [ML/T2]
  std::array<Vec, 2> moment{Vec::Zero(), Vec::Zero()};  ///< [ML2/T2]
};

/// That do the work of `pull` on the length and of `moment` (along r, s, t) on the turns of the ends, however
/// far these are: what passes through hinges is left out.
NodalForces nodal_forces(const TurnedEnds& turned, const BeamReleases* releases, Real pull,
                         const std::array<Vec, 2>& moment);

/// `ends`: orientations at t^{n-1}, turned with their nodes by `angle` (global axes) on return. `between`:
/// from end to end now.
TurnedEnds turn_ends(const Vec& between, const std::array<Vec, 2>& angle,
                     std::array<Eigen::Quaterniond, 2>& ends);
/// The same where ends turn without their nodes: about released axes they stay with the beam, about r with
/// the other end. `between_before`: a step ago.
TurnedEnds turn_ends(const Vec& between, const Vec& between_before, const std::array<Vec, 2>& angle,
                     const BeamReleases& releases, std::array<Eigen::Quaterniond, 2>& ends);

}  // namespace courant
