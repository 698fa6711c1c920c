#pragma once
// Values that passes report for the histories, on request.
#include <functional>
#include <vector>

#include "state/world.hpp"

namespace courant {

/// Force of a boundary condition on the driven or fixed point or body, at t^n.
struct BoundaryForce {
  enum class Kind {
    driven_point,     ///< *BOUNDARY_PRESCRIBED_MOTION_NODE, _SET
    driven_body,      ///< *BOUNDARY_PRESCRIBED_MOTION_RIGID
    held_point,       ///< *BOUNDARY_SPC
    driven_rotation,  ///< as driven_point, of rotations: a moment
    held_rotation,    ///< as held_point, of rotations: a moment
  };
  Kind kind = Kind::driven_point;
  Id id = 0;                                      ///< of the particle or node, or the body's part
  Vec force = Vec::Zero(), moment = Vec::Zero();  ///< [ML/T2], [ML2/T2]
  Real work = 0;                                  ///< done so far [ML2/T2]
};

/// A pass that imposes motions.
struct BoundaryForceReporter {
  virtual ~BoundaryForceReporter() = default;
  /// Adds the forces once those at t^n and dt are known, before the kick.
  virtual void report_forces(const World& world, const Clock& clock,
                             std::vector<BoundaryForce>& out) const = 0;
};

/// Sums over a part.
struct PartSums {
  Real mass = 0;                                  ///< [M]
  Real internal = 0, kinetic = 0, hourglass = 0;  ///< [ML2/T2]
  Vec momentum = Vec::Zero();                     ///< [ML/T]
  Real added_mass = 0;                            ///< by mass scaling, part of `mass` [M]
  /// Of deleted elements, at the time of deletion; not in the sums above. [ML2/T2]
  Real eroded_internal = 0, eroded_hourglass = 0;
};
/// A pass over elements of parts.
struct PartReporter {
  virtual ~PartReporter() = default;
  /// Adds to the sums; one for each part of the model.
  virtual void report_part(const World& world, std::vector<PartSums>& parts) const = 0;
};

/// An element that is deleted.
struct ElementFailure {
  Id id = 0, part = 0;
  std::string kind;  ///< "solid", "shell", "beam"
  std::string why;   ///< "plastic strain 0.21"
};
/// A pass that deletes elements.
struct FailureReporter {
  virtual ~FailureReporter() = default;
  /// Elements that failed at t^n, in the order of groups and elements.
  virtual const std::vector<ElementFailure>& failures() const = 0;
};

/// A pass other than contact that exerts forces between particles and walls.
struct WallForceReporter {
  virtual ~WallForceReporter() = default;
  /// Force on all particles at t^n. Its number is 0.
  virtual InterfaceForce report(const World& world) const = 0;
  /// Adds the forces on the walls to nodes.f and segments.contact_force until the next step.
  virtual void show_forces(World& world) = 0;
};

/// A force of contact, or of a supporting wall, with its point of action at t^n.
struct PointForce {
  Index segment = -1;                            ///< segment that gets it; -1: a node
  Index node = -1;                               ///< of World::nodes
  Vec point = Vec::Zero(), force = Vec::Zero();  ///< [L], [ML/T2]
};
/// A pass with forces on faces and nodes, moving or fixed.
struct PointForceReporter {
  virtual ~PointForceReporter() = default;
  virtual void report_point_forces(const World& world,
                                   const std::function<void(const PointForce&)>& take) = 0;
};

/// An interface of nodes and faces.
struct InterfaceReporter {
  virtual ~InterfaceReporter() = default;
  /// At t^n.
  virtual InterfaceForce report() const = 0;
  /// Whether it has exerted a force so far.
  virtual bool has_acted() const { return true; }
};

/// A pass with fields for output only, filled before each output.
struct FieldFiller {
  virtual ~FieldFiller() = default;
  virtual void fill_fields(World& world) = 0;
};

/// A rigid wall (*RIGIDWALL) at t^n.
struct RigidWallForce {
  Id id = 0;
  std::string title;
  Real normal = 0;            ///< of all points on the wall along its normal: > 0 [ML/T2]
  Vec force = Vec::Zero();    ///< on the wall, friction included [ML/T2]
  Vec impulse = Vec::Zero();  ///< of that so far [ML/T]
  Vec v = Vec::Zero(), displacement = Vec::Zero();  ///< of the wall [L/T], [L]
  Real dissipated = 0;                              ///< energy lost at the wall so far [ML2/T2]
};
struct RigidWallReporter {
  virtual ~RigidWallReporter() = default;
  virtual RigidWallForce report_wall() const = 0;
};

/// Force and moment of a joint on its second body at t^n, at the joint position there, in global axes.
struct JointForce {
  Id id = 0;
  std::string title;
  Vec force = Vec::Zero(), moment = Vec::Zero();  ///< [ML/T2], [ML2/T2]
};
struct JointReporter {
  virtual ~JointReporter() = default;
  virtual void report_joints(std::vector<JointForce>& out) const = 0;
};

/// Motion of a rigid body at t^n; velocities are those of the last half step.
struct RigidBodyMotion {
  Id part = 0;
  Vec x = Vec::Zero(), displacement = Vec::Zero();   ///< of the centre [L]
  Vec v = Vec::Zero(), a = Vec::Zero();              ///< [L/T], [L/T2]
  Vec rotation = Vec::Zero();                        ///< from t = 0, axis times angle up to pi [-]
  Vec omega = Vec::Zero(), angular_a = Vec::Zero();  ///< [1/T], [1/T2]
  Matrix axes = Matrix::Identity();                  ///< principal directions as columns
};

}  // namespace courant
