// What a program changes of rigid bodies while the run goes on.
#include <cmath>

#include "rigid/bodies/rigid.hpp"

namespace courant {

void RigidBodies::set_program_load(std::size_t body, const Vec& force, const Vec& moment) {
  bodies_[body].wanted = {force, moment};
  program_loads_ = true;
}

std::string RigidBodies::set_program_motion(std::size_t body, const Vec& v, const Vec& omega) {
  RigidBody& b = bodies_[body];
  if (b.fixed()) return b.name + " is held in all directions";
  if (!b.motions.empty()) return "the motion of " + b.name + " is prescribed";
  if (ties_ && ties_->tied(body)) return b.name + " has joints, which other bodies would have to follow";
  const Real before = b.kinetic_energy();
  const Matrix R = b.q.toRotationMatrix();
  Vec turn = omega;
  for (int k = 0; k < 3; ++k) {
    if (!b.held[k]) b.v[k] = v[k];
    if (b.no_turn[k]) turn[k] = 0;
  }
  b.L = R * b.J0 * R.transpose() * turn;
  b.omega = b.omega_of(b.q);
  const Real gained = b.kinetic_energy() - before;
  program_work_ += gained, program_moved_ += std::abs(gained);
  return {};
}

}  // namespace courant
