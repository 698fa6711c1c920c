#pragma once
#include <memory>
#include <vector>

#include <Eigen/SparseCholesky>
#include <Eigen/SparseCore>

#include "rigid/joint_rows.hpp"
#include "state/reports.hpp"
#include "state/restartable.hpp"

namespace courant {

/// Joints between rigid bodies. Once dt is chosen and all other forces are known, forces along the gradients
/// of their equations at t^n are found with which the equations hold at t^(n+1): Lagrange multipliers on
/// positions (Ryckaert, Ciccotti and Berendsen 1977), so that places do not drift apart and no stiffness
/// limits the step. Joints that say the same twice, as in closed loops, share the force in a way of no
/// meaning.
class Joints : public Impact, public Restartable, public JointReporter {
 public:
  /// Refers to `bodies`.
  Joints(std::vector<Joint> joints, std::shared_ptr<RigidBodies> bodies);
  std::string name() const override { return "joints"; }
  const std::vector<Joint>& all() const { return joints_; }

  /// Takes from the velocities at the start what the joints do not allow, as a plastic impact does; returns
  /// the kinetic energy before and after it. [ML2/T2]
  std::array<Real, 2> make_start_consistent(World& world);
  /// Throws RunError where the equations cannot be met.
  void strike(World& world, const Clock& clock) override;
  void report_joints(std::vector<JointForce>& out) const override;
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
  std::vector<JointRow> rows_at(const std::vector<BodyPose>& poses) const;
  std::vector<BodyPose> poses_now() const;
  std::vector<BodyPose> poses_after(const std::vector<JointRow>& rows, const Eigen::VectorXd& force,
                                    const Clock& clock) const;
  /// Force and moment about the centre on each body. [ML/T2], [ML2/T2]
  std::vector<std::array<Vec, 2>> on_bodies(const std::vector<JointRow>& rows,
                                            const Eigen::VectorXd& force) const;
  void factorise(const std::vector<JointRow>& rows, const Clock* clock);
  /// The largest share of what round-off may leave; more than 1: not met.
  Real worst(const std::vector<JointRow>& rows, std::size_t& joint) const;
  void tell_gap(const std::vector<JointRow>& rows, World& world) const;
  void remember(const std::vector<JointRow>& rows, const Eigen::VectorXd& force);

  std::vector<Joint> joints_;
  std::shared_ptr<RigidBodies> bodies_;
  std::vector<char> joined_;      ///< of each body, whether a joint holds it
  std::vector<Index> first_row_;  ///< of each joint, and the end
  std::vector<Meeting> meetings_;
  Eigen::SparseMatrix<double> matrix_;
  Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>> solver_;
  std::vector<Vec> force_, moment_;  ///< of the last step, on B at its place [ML/T2], [ML2/T2]
};

}  // namespace courant
