// What rigid bodies tell the histories.
#include <Eigen/Eigenvalues>

#include "rigid/bodies/rigid.hpp"

namespace courant {

namespace {

/// Principal directions at t = 0, right-handed; the global axes where these are principal.
Matrix principal_axes(const Matrix& J) {
  constexpr Real round_off = 1e-9;
  const Matrix off = J - Matrix(J.diagonal().asDiagonal());
  if (off.cwiseAbs().maxCoeff() <= round_off * J.trace()) return Matrix::Identity();
  Matrix axes = Eigen::SelfAdjointEigenSolver<Matrix>(J).eigenvectors();
  if (axes.determinant() < 0) axes.col(2) = -axes.col(2);
  return axes;
}

Vec rotation_of(const Eigen::Quaterniond& q) {
  const Eigen::AngleAxisd turn(q);
  return turn.angle() * turn.axis();
}

}  // namespace

std::vector<RigidBodyMotion> RigidBodies::motions(const Clock& clock) const {
  std::vector<RigidBodyMotion> out;
  for (const RigidBody& b : bodies_) {
    RigidBodyMotion m{.part = b.part, .x = b.x, .displacement = b.x - b.x0};
    m.axes = b.q.toRotationMatrix() * principal_axes(b.J0);
    if (!b.fixed()) {
      const HalfStep next = next_half_step(b, clock);
      RigidBody later = b;
      later.L = next.L;
      m.v = b.v;
      m.a = (next.v - b.v) / clock.dt_mean();
      m.rotation = rotation_of(b.q);
      m.omega = b.omega;
      m.angular_a = (later.omega_of(b.q) - b.omega_of(b.q)) / clock.dt_mean();
    }
    out.push_back(m);
  }
  return out;
}

void RigidBodies::report_forces(const World&, const Clock& clock, std::vector<BoundaryForce>& out) const {
  for (const RigidBody& b : bodies_)
    if (!b.motions.empty()) out.push_back(force_of_drives(b, clock));
}

}  // namespace courant
