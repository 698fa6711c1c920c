#include "rigid/switches/body_for_a_while.hpp"

#include "rigid/bodies/body_mass.hpp"
#include "state/shared_fields.hpp"

namespace courant {

NodalTurns::NodalTurns(const World& world)
    : moment(shared_fields::moment.find(world.nodes.fields)),
      omega(shared_fields::angular_velocity.find(world.nodes.fields)),
      inertia(shared_fields::rotary_inertia.find(world.nodes.fields)),
      none(shared_fields::no_rotation.find(world.nodes.fields)) {}

void BodyForAWhile::stiffen(World& world, const Clock& clock, const NodalTurns& turns) {
  const Nodes& nodes = world.nodes;
  const Real half = 0.5 * clock.dt_old;
  MassIntegrals sums{.origin = nodes.x.vec(b.nodes.front())};
  Vec spin = Vec::Zero();
  Real before = 0, inertia = 0;
  for (const Index n : b.nodes) {
    const Real m = nodes.m[n];
    const Vec v = nodes.v.vec(n) + half / m * nodes.f.vec(n);
    sums.add_point(m, nodes.x.vec(n), v);
    before += 0.5 * m * v.squaredNorm();
    if (!turns.turns(n)) continue;
    const Real I = (*turns.inertia)[n];
    const Vec w = turns.omega->vec(n) + half / I * turns.moment->vec(n);
    inertia += I, spin += I * w, before += 0.5 * I * w.squaredNorm();
  }
  take_mass(b, sums);
  b.J0 += inertia * Matrix::Identity(), b.L += spin;
  b.X.clear();
  for (const Index n : b.nodes) b.X.push_back(nodes.x.vec(n) - b.x);
  complete();
  b.q = Eigen::Quaterniond::Identity();
  b.omega = b.omega_of(b.q);
  const Real lost = before - b.kinetic_energy();
  world.energy.dissipated += lost, world.energy.throughput += std::abs(lost);
  sum_forces(world, turns);
  b.v -= half / b.m * b.force, b.L -= half * b.moment;
  active = 1;
  give_half_step(world, clock.dt_old, turns);
}

void BodyForAWhile::complete() {
  Real size = 0;
  for (const Vec& X : b.X) size = std::max(size, X.norm());
  complete_inertia(b, size);
}

/// Velocities of nodes as the step before would have left them.
void BodyForAWhile::give_half_step(World& world, Real dt_old, const NodalTurns& turns) {
  b.omega = turning_over(b, b.L, -dt_old);
  const Matrix back = turned_by(-dt_old * b.omega, b.q).toRotationMatrix();
  for (std::size_t k = 0; k < b.nodes.size(); ++k) {
    const Index n = b.nodes[k];
    const Vec v = dt_old > 0 ? Vec((b.X[k] - back * b.X[k]) / dt_old) : Vec(b.omega.cross(b.X[k]));
    world.nodes.v.set(n, b.v + v);
    if (turns.turns(n)) turns.omega->set(n, b.omega);
  }
}

bool BodyForAWhile::release(World& world, const Clock& clock, const NodalTurns& turns) {
  if (active == 0) return false;
  active = 0;
  Nodes& nodes = world.nodes;
  const Real half = 0.5 * clock.dt_old;
  sum_forces(world, turns);
  const Vec v = b.v + half / b.m * b.force, omega = b.turning_by(b.L + half * b.moment, b.q);
  for (const Index n : b.nodes) {
    nodes.v.set(n, v + omega.cross(nodes.x.vec(n) - b.x) - half / nodes.m[n] * nodes.f.vec(n));
    if (turns.turns(n)) turns.omega->set(n, omega - half / (*turns.inertia)[n] * turns.moment->vec(n));
  }
  return true;
}

void BodyForAWhile::sum_forces(const World& world, const NodalTurns& turns) {
  b.force.setZero(), b.moment.setZero();
  for (const Index n : b.nodes) {
    const Vec f = world.nodes.f.vec(n);
    b.force += f, b.moment += (world.nodes.x.vec(n) - b.x).cross(f);
    if (turns.turns(n)) b.moment += turns.moment->vec(n);
  }
}

void BodyForAWhile::move(World& world, const Clock& clock, const NodalTurns& turns) {
  Nodes& nodes = world.nodes;
  sum_forces(world, turns);
  next = next_half_step(b, clock);
  pose = pose_after(b, next, clock.dt);
  const Vec omega = turning_over(b, next.L, clock.dt);
  const Matrix R = pose.q.toRotationMatrix();
  for (std::size_t k = 0; k < b.nodes.size(); ++k) {
    const Index n = b.nodes[k];
    const Vec v = (pose.x + R * b.X[k] - nodes.x.vec(n)) / clock.dt;
    nodes.f.set(n, nodes.m[n] / clock.dt_mean() * (v - nodes.v.vec(n)));
    if (turns.turns(n))
      turns.moment->set(n, (*turns.inertia)[n] / clock.dt_mean() * (omega - turns.omega->vec(n)));
  }
}

void BodyForAWhile::advance(const Clock& clock) {
  if (active == 0) return;
  b.v = next.v, b.L = next.L, b.omega = turning_over(b, b.L, clock.dt);
  b.x = pose.x, b.q = pose.q;
}

void BodyForAWhile::keep(Archive& archive) {
  archive("active", active), archive("mass", b.m), archive("places", b.X);
  archive("x", b.x), archive("v", b.v), archive("L", b.L), archive("omega", b.omega);
  archive.rows("q", std::vector<Real*>{b.q.coeffs().data()}, 4);
  archive.rows("inertia", std::vector<Real*>{b.J0.data()}, 9);
  if (archive.loading() && active != 0) complete();
}

}  // namespace courant
