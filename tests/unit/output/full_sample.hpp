#pragma once
// A sample with all that histories print.
#include "output/sample.hpp"

namespace courant::test {

/// Each number another one, from 1 to 9.
class DifferentNumbers {
 public:
  Real operator()() {
    last_ += 0.01;
    return last_;
  }
  Vec vec() {
    const Real x = (*this)(), y = (*this)();
    return {x, y, (*this)()};
  }

 private:
  Real last_ = 1;
};

/// A sample of two parts, contacts and walls, one body, node and particle, and a boundary force of each kind.
inline Sample sample_of_all() {
  DifferentNumbers n;
  using Kind = BoundaryForce::Kind;
  Sample s;
  s.t = n(), s.dt = n(), s.mass = 20 + n(), s.velocity = n.vec();
  EnergyLedger& e = s.energy;
  for (Real* one : {&e.kinetic, &e.internal, &e.discrete, &e.potential, &e.contact, &e.hourglass,
                    &e.bulk_viscosity, &e.dissipated, &e.external_work, &e.throughput, &e.initial})
    *one = n();
  e.dissipated += 20;
  for (const Id id : {5, 6}) {
    PartSample p{.id = id};
    for (Real* one : {&p.mass, &p.internal, &p.kinetic, &p.hourglass, &p.added_mass, &p.eroded_internal,
                      &p.eroded_hourglass})
      *one = n();
    p.momentum = n.vec(), p.rigid_velocity = n.vec();
    s.parts.push_back(p);
    InterfaceForce c;
    c.id = id, c.energy_stored = n(), c.energy_damping = n(), c.energy_friction = n(), c.on_surfa = n.vec();
    s.interfaces.push_back(c);
    s.rigid_walls.push_back({id, "", n(), n.vec(), n.vec(), n.vec(), n.vec(), n()});
  }
  s.bodies.push_back({.part = 7,
                      .x = n.vec(),
                      .v = n.vec(),
                      .omega = n.vec(),
                      .force = n.vec(),
                      .moment = n.vec(),
                      .kinetic_energy = n()});
  RigidBodyMotion m{.part = 7};
  for (Vec* one : {&m.x, &m.displacement, &m.v, &m.a, &m.rotation, &m.omega, &m.angular_a}) *one = n.vec();
  m.axes = Eigen::AngleAxisd(0.7, Vec(1, 2, 3).normalized()).toRotationMatrix();
  s.body_motions.push_back(m);
  NodeSample node{.id = 3, .turns = true};
  for (Vec* one :
       {&node.displacement, &node.x, &node.v, &node.a, &node.rotation, &node.omega, &node.angular_a})
    *one = n.vec();
  s.nodes.push_back(node);
  for (const Kind kind :
       {Kind::driven_point, Kind::driven_body, Kind::held_point, Kind::driven_rotation, Kind::held_rotation})
    s.boundary_forces.push_back({kind, 30 + static_cast<Id>(kind), n.vec(), n.vec(), n()});
  ParticleSample p{.id = 17, .p = n(), .rho = n(), .part = 5, .h = n()};
  for (Real& tau : p.tau) tau = n();
  s.particles.push_back(p);
  return s;
}

}  // namespace courant::test
