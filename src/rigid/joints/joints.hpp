#pragma once
#include <memory>
#include <optional>
#include <vector>

#include "rigid/joints/joint_matrix.hpp"
#include "rigid/joints/joint_rows.hpp"
#include "rigid/joints/joint_springs.hpp"
#include "state/reports.hpp"
#include "state/restartable.hpp"

namespace courant {

/// What a row adds to others, of what free bodies would give, below which it is left out.
inline constexpr Real follows_from_others = 1e-9;
/// Whether its equations may become springs.
constexpr bool can_yield(const Joint& joint) {
  return !is_motor(joint.kind) && !is_gear(joint.kind);
}

/// Joints between rigid bodies. Once dt is chosen and all other forces are known, forces along the gradients
/// of their equations at t^n are found with which the equations hold at t^(n+1): Lagrange multipliers on
/// positions (Ryckaert, Ciccotti and Berendsen 1977), so that places do not drift apart and no stiffness but
/// that of what hangs in a joint limits the step. Where joints say the same twice, as in closed loops, some
/// equations are left out, and their forces are 0. Where they contradict each other, as the positions of a
/// deck may in closed loops, all joints but motors and gears become penalty springs.
class Joints : public BodyTies,
               public Impact,
               public TimeLimit,
               public Restartable,
               public JointReporter,
               public EnergyTerm {
 public:
  /// Refers to `bodies`. `exact`: none becomes a spring. `tssfac`: of the elements beside them.
  Joints(std::vector<Joint> joints, std::shared_ptr<RigidBodies> bodies, bool exact, Real tssfac);
  std::string name() const override { return "joints"; }
  const std::vector<Joint>& all() const { return joints_; }

  bool tied(std::size_t body) const override { return joined_[body] && !bodies_->bodies()[body].fixed(); }
  void begin(const Clock& clock) override;
  Real give(std::size_t body, const Vec& q, const Vec& n) const override;
  void answer(std::size_t body, const Vec& force, const Vec& moment) override;

  struct Start {
    Real before = 0, after = 0;  ///< kinetic energy [ML2/T2]
    std::size_t worst = 0;       ///< the joint that velocities fitted least
    /// Joints of loops whose equations almost follow from others: their mechanisms became springs.
    std::vector<std::size_t> misfits{};
  };
  /// Takes from the velocities at the start what the joints do not allow, as a plastic impact does, once
  /// bodies that are driven have the velocities of their drives, which they keep.
  Start make_start_consistent(World& world);
  /// Throws RunError where the equations cannot be met.
  void strike(World& world, const Clock& clock) override;
  bool rings() const override { return false; }
  /// Half of what is stable: joints that pull at their arms by the forces of the step before let a body swing
  /// with the frequency of a string.
  Limit limit(const World& world, const Clock& clock) override;
  void report_joints(std::vector<JointForce>& out) const override;
  /// What motors do comes from outside; other joints do no work.
  void record(World& world, const Clock& clock, EnergyLedger& ledger) override;
  void sample(const World&, const Clock&, EnergyLedger& ledger) const override {
    ledger.internal += springs_.stored();
  }
  void keep(Archive& archive) override;

 private:
  /// A row and the body of one of its sides that can move.
  struct Side {
    Index row = 0;
    bool of_b = false;
  };
  /// Where two rows meet in a body: an entry of the matrix.
  struct Meeting {
    Index row = 0, column = 0;
    std::size_t body = 0;
    bool row_of_b = false, column_of_b = false;
  };
  /// What an impulse and a turn change: inverse mass and inertia along what is free.
  struct Inverse {
    Matrix mass = Matrix::Zero(), inertia = Matrix::Zero();
    Real free_mass = 0, free_inertia = 0;  ///< of the body if nothing held or drove it, about a mean axis
  };

  void find_meetings();
  void start_drives(const Clock& clock, World& world);
  /// The rate at which a motor shall run at the start, which for accelerations is what it has. [1/T], [L/T]
  Real start_rate_of(Joint& joint, Real now, const Clock& clock) const;
  /// How fast c changes by the motion of its bodies.
  static Real rate_of(const JointRow& row, const RigidBody& a, const RigidBody& b);
  std::vector<JointRow> rows_at(const std::vector<BodyPose>& poses) const;
  std::vector<BodyPose> poses_now() const;
  /// By how much each equation changes over the coming step under these forces.
  std::vector<Real> changes_of(const std::vector<BodyPose>& poses, const std::vector<JointRow>& rows,
                               const Eigen::VectorXd& force, const Clock& clock) const;
  /// Force and moment about the centre on each body. [ML/T2], [ML2/T2]
  std::vector<std::array<Vec, 2>> on_bodies(const std::vector<JointRow>& rows,
                                            const Eigen::VectorXd& force) const;
  /// Leaves out rows that add less than `least` to others.
  void factorise(const std::vector<JointRow>& rows, const Clock* clock, Real least);
  /// Gives springs to the rows of joints that yield and have none yet.
  void add_springs(const std::vector<JointRow>& rows, const Clock& clock);
  Real allowed_by_others(const World& world, const Clock& clock) const;
  /// All joints of the mechanism of joint `at`, but motors and gears, yield from the next step on.
  void soften(std::size_t at);
  /// Joints of closed loops with a row that adds almost nothing to others.
  std::vector<std::size_t> find_misfits() const;
  /// Sizes against which lengths of a joint count: of coordinates, whose round-off is unavoidable, and of
  /// the smaller of the bodies that can move [L].
  std::array<Real, 2> sizes(const Joint& joint) const;
  void find_rooms(const std::vector<JointRow>& rows);
  /// What the coming step should change: gaps within round-off are repaired slowly, as their noise would be
  /// all of the force where steps are short.
  Eigen::VectorXd wanted(const std::vector<JointRow>& rows) const;
  /// Force with which the coming step changes equations as wanted, as far as they can be met.
  Eigen::VectorXd find_force(const std::vector<BodyPose>& poses, const std::vector<JointRow>& rows,
                             const Clock& clock) const;
  /// Throws where joints are too far open after the step.
  void look_at_gaps(const std::vector<JointRow>& rows, const std::vector<Real>& changes, World& world,
                    const Clock& clock);
  /// Adds forces along the rows to the bodies and to those of the step.
  void push(const Eigen::VectorXd& force);
  /// Forces along the rows that answer a force and a moment on a body.
  Eigen::VectorXd answer_to(std::size_t body, const Vec& force, const Vec& moment) const;
  /// `changes`: of the rows over the step, as it is now.
  void remember(const std::vector<JointRow>& rows, const Eigen::VectorXd& force,
                const std::vector<Real>& changes);

  std::vector<Joint> joints_;
  std::shared_ptr<RigidBodies> bodies_;
  bool exact_;
  Real tssfac_;
  /// What other passes allowed at first, whatever DTINIT and LCTM say: springs are stiff by this step, so
  /// that shorter ones change nothing. 0: not known yet; infinite: nothing limits the step. [T]
  Real first_allowed_ = 0;
  JointSprings springs_;
  std::vector<char> joined_;      ///< of each body, whether a joint holds it
  std::vector<Index> first_row_;  ///< of each joint, and the end
  std::vector<Meeting> meetings_;
  JointMatrix matrix_;
  std::vector<Inverse> inverse_;  ///< of each body
  std::vector<BodyPose> poses_;   ///< of this step, and what follows from them
  std::vector<JointRow> rows_;
  Eigen::VectorXd sum_;              ///< forces along the rows in this step so far
  std::optional<Real> begun_at_;     ///< the time of this step [T]
  Eigen::VectorXd free_;             ///< of each row: what it would give if nothing held or drove its bodies
  std::vector<Real> room_;           ///< of each row: what round-off may leave
  std::vector<Real> too_far_;        ///< of each row: a gap that is no joint any more
  std::vector<Vec> force_, moment_;  ///< of the last step, on B at its position [ML/T2], [ML2/T2]
};

}  // namespace courant
