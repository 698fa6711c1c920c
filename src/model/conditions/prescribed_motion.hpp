#pragma once
// *BOUNDARY_PRESCRIBED_MOTION: velocities, accelerations or displacements over time that particles and rigid
// bodies follow.
#include <vector>

#include "keyword/deck.hpp"
#include "model/model.hpp"

namespace courant {

/// Velocities that the run itself finds for the coming step, for motions without a curve.
class MotionSource {
 public:
  virtual ~MotionSource() = default;
  /// 0 to 2: along x, y, z [L/T]; 3 to 5: about them [1/T]
  virtual Real velocity(int component) const = 0;
};

/// One direction of one card. The curve's abscissa is t - BIRTH.
struct PrescribedMotion {
  enum class Kind { velocity, acceleration, displacement };
  Kind kind = Kind::velocity;
  bool turns = false;           ///< about `direction`, with angles for displacements [-]
  Vec direction = Vec::Zero();  ///< unit; of `local` motions in the axes of the body, or, once it follows
                                ///< them, as it was at the start
  bool local = false;           ///< the direction turns with the body
  int around = -1;  ///< nodes go round an axis along x, y, z (0, 1, 2) through `centre`, of which this is
                    ///< the part along `direction`; the curve tells angles; -1: straight on
  Vec centre = Vec::Zero();      ///< [L]
  Curve curve;                   ///< of time; values [L/T], [L/T2] or [L], of rotations [1/T], [1/T2] or [-]
  Real sf = 1;                   ///< factor of the values
  Real birth = 0, death = 1e28;  ///< [T]
  Real jump = 0;                 ///< of displacements: the curve's value at BIRTH, made in the first step
  std::vector<Index> nodes;      ///< _NODE and _SET: indices into Model::nodes
  Id id = 0;                     ///< its number, by _ID; 0: none
  Id body = 0;                   ///< _RIGID: a part or a body of nodes; 0: none
  Index part = -1;               ///< index of that part into Model::parts; -1: a body of nodes, or not there
  Entry card;                    ///< for messages
  const MotionSource* source = nullptr;  ///< of the velocities instead of a curve; null: the curve
  int component = 0;                     ///< of `source`

  /// Whether the step from t to t + dt follows it: its middle is not before BIRTH and before DEATH.
  bool drives(Real t, Real dt) const {
    return !curve.silent && t + 0.5 * dt >= birth && t + 0.5 * dt < death;
  }
  /// Velocity over the step from t to t + dt, whose length gives the position at t + dt exactly: the mean of
  /// the curve over the step, or the rise of displacements over dt, in the first step from 0. Of
  /// accelerations: `before`, the velocity over the step before, plus the change of the mean velocity from
  /// one step (of length dt_old, 0: there is none) to the next.
  Real velocity(Real t, Real dt, Real dt_old, Real before) const;
};

/// Of a curve over time that drives, by VAD: 0 velocity, 1 acceleration, 2 displacement (else refused).
CurveOf curve_of_drive(int vad, bool turns);

/// Integral of a curve from a to b, exact for its straight pieces.
Real integral(const Curve& curve, Real a, Real b);
/// Integral of the curve's slope from a to b; what it jumps does not count.
Real rise(const Curve& curve, Real a, Real b);
/// Mean over [a, b] of the integral of the curve from 0 on; what is before 0 counts as 0.
Real mean_of_integral(const Curve& curve, Real a, Real b);

/// All prescribed motions of a deck. Refuses by name: missing curves, vectors and nodes, vectors that
/// turn with nodes, coordinate systems, displacements that jump; warns of those that are not 0 at BIRTH, but
/// not in a run behind a relaxation (`relaxed`), which has made that jump.
std::vector<PrescribedMotion> prescribed_motions(const Deck& deck, const Model& model,
                                                 Diagnostics& diagnostics, bool relaxed = false);

/// Why two motions of one node or body cannot both hold, else nothing: both drive one direction, or
/// directions that are not at right angles, at the same time.
std::string clash(const PrescribedMotion& a, const PrescribedMotion& b);

}  // namespace courant
