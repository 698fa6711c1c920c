#pragma once
#include <algorithm>
#include <array>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include <Eigen/Geometry>

#include "base/rotation.hpp"
#include "extension/part_values.hpp"
#include "keyword/deck.hpp"
#include "loads/body_acceleration.hpp"
#include "loads/loads.hpp"
#include "model/conditions/prescribed_motion.hpp"
#include "model/model.hpp"
#include "rigid/bodies/body_cards.hpp"
#include "state/reports.hpp"
#include "state/restartable.hpp"
#include "state/wall_bodies.hpp"
#include "state/world.hpp"

namespace courant {

/// The *MAT_RIGID of a part (index into Model::parts); nothing if its material is another one or missing.
std::optional<RigidMaterial> rigid_material(const Deck& deck, const Model& model, Index part);

/// One rigid part.
struct RigidBody {
  Id part = 0;
  std::string name;                       ///< for messages: "rigid part 3"
  Index part_index = -1;                  ///< in Model::parts
  std::vector<Index> parts;               ///< that one first, and those merged into it
  std::vector<Index> nodes;               ///< indices into World::nodes
  std::vector<Index> unweighed{};         ///< of them, whose mass is no part of m: that is given by a card
  std::vector<Vec> X;                     ///< their positions about the centre at t = 0 [L]
  std::array<bool, 3> held{}, no_turn{};  ///< global axes without translation, rotation
  Index solids = 0;                       ///< how many of them it is made of
  Real volume = 0;                        ///< of these [L3]
  Real m = 0;                             ///< [M]
  Real c2 = 0;                            ///< E/RO of its material, of sound squared [L2/T2]
  Matrix J0 = Matrix::Zero();             ///< inertia about the centre at t = 0, global axes [ML2]
  Matrix J_lumped = Matrix::Zero();       ///< the same with all mass at the nodes, to compare
  Vec x = Vec::Zero(), v = Vec::Zero();   ///< centre [L], [L/T]
  Vec x0 = Vec::Zero();                   ///< centre at t = 0 [L]
  Vec L = Vec::Zero();                    ///< angular momentum about the centre [ML2/T]
  Vec omega = Vec::Zero();                ///< [1/T]
  Eigen::Quaterniond q = Eigen::Quaterniond::Identity();
  Vec force = Vec::Zero(), moment = Vec::Zero();         ///< at the last force evaluation [ML/T2], [ML2/T2]
  std::vector<BodyForceLoad> loads;                      ///< *LOAD_RIGID_BODY
  std::array<Vec, 2> program{Vec::Zero(), Vec::Zero()};  ///< force and moment of a program in this step
  std::array<Vec, 2> wanted{Vec::Zero(), Vec::Zero()};   ///< the same from the next step on
  std::vector<PrescribedMotion> motions;
  Real drive_work = 0;  ///< by `motions` so far [ML2/T2]

  bool fixed() const;  ///< nothing can move
  bool has_part(Index part) const { return std::find(parts.begin(), parts.end(), part) != parts.end(); }
  /// Sum of the forces and of the moments of `loads` and `program` at a time, as far as the body can follow.
  std::array<Vec, 2> load_at(Real t) const;
  Real kinetic_energy() const { return 0.5 * (m * v.squaredNorm() + omega.dot(L)); }
  /// Integral of r r^T dm over the body, r from the centre, as it is turned now. [ML2]
  Matrix second_moments() const;
  /// Angular velocity that belongs to L in orientation q, with rotations held about some axes.
  Vec omega_of(const Eigen::Quaterniond& orientation) const;
  /// The same of any angular momentum. [1/T]
  Vec turning_by(const Vec& angular_momentum, const Eigen::Quaterniond& orientation) const;
  /// Direction of one of `motions` in an orientation.
  Vec direction_of(const PrescribedMotion& motion, const Eigen::Quaterniond& orientation) const {
    return motion.local ? Vec(orientation * motion.direction) : motion.direction;
  }
  /// Change of the angular velocity by that of the angular momentum, where rotations that are driven do not
  /// change. `clock`: of those that drive in its step; null: all. [1/T]
  Vec turning_beside_drives(const Vec& change, const Clock* clock) const;
};

/// Velocity and angular momentum of the half step to come.
struct HalfStep {
  Vec v = Vec::Zero(), L = Vec::Zero();
};
/// From the forces on a body, and from its prescribed motions where there are any.
HalfStep next_half_step(const RigidBody& body, const Clock& clock);
/// From other forces than those that the body has now. Throws RunError where a body turns too far in a step
/// to follow its drives. [ML/T2], [ML2/T2]
HalfStep next_half_step(const RigidBody& body, const Vec& force, const Vec& moment, const Clock& clock);
/// How a body turns over a step that starts in its orientation q with the angular momentum L: omega of the
/// middle of the step. [1/T]
Vec turning_over(const RigidBody& body, const Vec& L, Real dt);
/// Place and orientation a step later.
struct BodyPose {
  Vec x = Vec::Zero();
  Eigen::Quaterniond q = Eigen::Quaterniond::Identity();
};
BodyPose pose_after(const RigidBody& body, const HalfStep& next, Real dt);
/// Work of the drives of a body over the coming step [ML2/T2].
Real work_of_drives(const RigidBody& body, const Clock& clock);
/// Force and moment of the drives at t^n.
BoundaryForce force_of_drives(const RigidBody& body, const Clock& clock);

/// Joints, as what strikes a body sees them: what they pass on to other bodies at once.
class BodyTies {
 public:
  virtual ~BodyTies() = default;
  virtual bool tied(std::size_t body) const = 0;
  /// Once in a step, before anything strikes: adds to the bodies what joints do in it without that.
  virtual void begin(const Clock& clock) = 0;
  /// By how much the velocity of position q of a body changes along n for an impulse along n there. [1/M]
  virtual Real give(std::size_t body, const Vec& q, const Vec& n) const = 0;
  /// Adds what joints do in answer to a force on a body, which it has got already. [ML/T2], [ML2/T2]
  virtual void answer(std::size_t body, const Vec& force, const Vec& moment) = 0;
};

/// All rigid bodies of a deck. Each is moved by the sums of its nodes' forces: m a = F, dL/dt = M, L = J
/// omega, which is J omega' = M - omega x J omega. Orientation by quaternion with the implicit midpoint rule,
/// which keeps |L| exactly; nodes follow exactly. Bodies that are held in all directions are left out of
/// every loop.
class RigidBodies : public EnergyTerm, public BoundaryForceReporter, public Restartable {
 public:
  /// `step_share`: what is left of the step of elements at their nodes. [-]
  explicit RigidBodies(std::vector<RigidBody> bodies, Real step_share = 1);
  Real step_share() const { return step_share_; }

  void set_loads(BodyAcceleration loads) { loads_ = std::move(loads); }
  /// -D m v at the centre and -D L about it, with the damping of a body's first part; as for nodes
  /// (loads/damping.cpp). Refuses other damping of parts that are merged into a body.
  void set_damping(std::vector<Damping> damping, const Model& model, Diagnostics& diagnostics);

  std::string name() const override { return "rigid bodies"; }
  /// Sums the forces on the bodies' nodes: each piece alone, then the pieces in order, so that any number of
  /// threads gives the same bits.
  void apply(World& world, const Clock& clock);
  void kick(World& world, const Clock& clock);
  void drift(World& world, const Clock& clock);
  Real kinetic_energy() const;  ///< of the bodies that can move [ML2/T2]
  Real rest_energy() const;     ///< m c^2 of those: a scale far above all that they may have [ML2/T2]
  void record(World& world, const Clock& clock, EnergyLedger& ledger) override;
  /// Adds kinetic and potential energy of the bodies that can move.
  void sample(const World& world, const Clock& clock, EnergyLedger& ledger) const override;

  /// One more load; a moment on a node of a body is a couple on the body.
  void add_load(std::size_t body, BodyForceLoad load) { bodies_[body].loads.push_back(std::move(load)); }
  /// Lets bodies follow *BOUNDARY_PRESCRIBED_MOTION_RIGID and _LOCAL. Refuses by name: parts that are no
  /// rigid bodies, directions that are held or driven twice, local ones of bodies that are held or have no
  /// axes.
  void follow(const std::vector<PrescribedMotion>& motions, const Deck& deck, const Model& model,
              Diagnostics& diagnostics);
  /// Lets a body take the velocities of `source`, which lives as long, in all directions that are not held.
  void drive(std::size_t body, const MotionSource& source);
  /// Prescribes the rotation of a body by `source`, between two times.
  void turn(std::size_t body, const MotionSource& source, Real birth, Real death, const Entry& card);
  /// For contact with their faces. Refers to this object.
  WallBodies wall_bodies(World& world);
  /// Adds to what moves a body in the coming step, after forces were summed; what holds the body takes its
  /// part. [ML/T2], [ML2/T2]
  void push(std::size_t body, const Vec& force, const Vec& moment);
  /// Lets contact see joints between bodies. Refers to `ties`.
  void tie(BodyTies* ties) { ties_ = ties; }
  /// Changes the velocity of the centre and the angular momentum before the first step. [ML/T], [ML2/T]
  void strike_at_start(std::size_t body, const Vec& impulse, const Vec& turn, World& world);
  /// Force and moment about the centre that a program sets, from the next step on until they are changed;
  /// along axes that are held they do nothing. [ML/T2], [ML2/T2]
  void set_program_load(std::size_t body, const Vec& force, const Vec& moment);
  /// The same of velocity and angular velocity, at a time level; the energy counts as work from outside.
  /// Returns why not, empty where it is done. [L/T], [1/T]
  std::string set_program_motion(std::size_t body, const Vec& v, const Vec& omega);
  /// Velocities and angular momenta times a factor, of bodies alone: their nodes get theirs with the next
  /// step.
  void slow_down(Real factor);
  /// Sets velocity and angular velocity of each body, and of its nodes, independent of the old ones.
  void start_moving(const std::vector<std::array<Vec, 2>>& motion, World& world);
  bool any_moves() const;  ///< false: the passes have nothing to do and need not be listed
  const std::vector<RigidBody>& bodies() const { return bodies_; }
  /// Before the first step: the body of a node gets more mass, at a position; false where its inertia is
  /// given. [L], [M], [ML2]
  bool add_mass_at(Index node, const Vec& place, Real mass, Real inertia, World& world);
  std::vector<Index> unweighed_nodes() const;  ///< of all bodies, indices into World::nodes
  /// Force and moment are those on the free body; zero for bodies that are fixed.
  std::vector<RigidBodyReport> reports() const;
  /// Accelerations are those of the coming kick: for this the forces at t^n and dt must be known.
  std::vector<RigidBodyMotion> motions(const Clock& clock) const;
  void report_forces(const World& world, const Clock& clock, std::vector<BoundaryForce>& out) const override;

  /// Place, motion and orientation of each body, and the forces of the last step, which reports show.
  void keep(Archive& archive) override;

  struct Piece {  ///< some of the nodes of a body that can move
    std::size_t body = 0;
    Index begin = 0, end = 0;  ///< in RigidBody::nodes
    Vec force = Vec::Zero(), moment = Vec::Zero();
  };

 private:
  std::array<Real, 4> potential(const RigidBody& body, const BodyAcceleration::At& now) const;
  void damp(const Clock& clock);
  Real lost_to_damping(std::size_t body, const Clock& clock) const;
  std::vector<RigidBody> bodies_;
  std::vector<Piece> pieces_;
  Real step_share_;
  BodyAcceleration loads_;
  std::vector<Damping> damping_;
  std::vector<std::array<Vec, 2>> damped_;  ///< force and moment that damping takes, of each body
  BodyTies* ties_ = nullptr;
  Real program_work_ = 0,
       program_moved_ = 0;      ///< by changes of motion since the last entry of the ledger [ML2/T2]
  bool program_loads_ = false;  ///< a program has set some
};

/// The largest that the kinetic energy of masses at the nodes of a body can be over its own, however it
/// moves: above 1 where mass or inertia of the body are given, and smaller. `mass`: of a node. [-]
Real lightness(const RigidBody& body, const Nodes& nodes, const std::function<Real(Index node)>& mass);

/// Puts the bodies into the lists of `world`: their forces among the constraints, their motion and energy.
void add_body_passes(World& world, std::shared_ptr<RigidBodies> bodies);

/// One body per part of *MAT_RIGID, or per parts that *CONSTRAINED_RIGID_BODIES merges, with mass, centre and
/// inertia from the nodal masses that build_segments gave (call that first). Sets Nodes::held and
/// Nodes::follow. nullptr if there is none. Refuses by name: local and point constraints, SPC on nodes of
/// rigid bodies, nodes shared by two bodies of which one can move, inertia that does not allow a free
/// rotation.
std::shared_ptr<RigidBodies> build_rigid_bodies(const Deck& deck, const Model& model, World& world,
                                                Diagnostics& diagnostics);

}  // namespace courant
