#include "rigid/bodies/rigid.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>

#include "parallel/parallel.hpp"
#include "rigid/bodies/body_mass.hpp"
#include "state/shared_fields.hpp"

namespace courant {
namespace {

bool all(const std::array<bool, 3>& a) {
  return a[0] && a[1] && a[2];
}

/// Body loads are linear in the position: a(x) = a(centre) + A (x - centre). The columns of A. [1/T2]
Matrix gradient_of(const BodyAcceleration::At& now, const RigidBody& b) {
  const Real size = std::sqrt(b.J0.trace() / b.m);
  Matrix A;
  for (int k = 0; k < 3; ++k)
    A.col(k) = (now(b.x + size * Vec::Unit(k), b.part_index) - now(b.x - size * Vec::Unit(k), b.part_index)) /
               (2 * size);
  return A;
}

/// Integral of r x A r dm over a body: its mass need not be where its nodes are.
Vec moment_of(const BodyAcceleration::At& now, const RigidBody& b) {
  const Matrix A = gradient_of(now, b), S = b.second_moments();
  Vec sum = Vec::Zero();
  for (int k = 0; k < 3; ++k) sum += Vec(S.col(k)).cross(Vec(A.col(k)));
  return sum;
}

/// Calls `work(body, piece)` for nodes [piece.begin, piece.end) of bodies, on all threads.
template <class Work>
void for_each_piece(std::vector<RigidBody>& bodies, std::vector<RigidBodies::Piece>& pieces,
                    const Work& work) {
  for_each_block(static_cast<Index>(pieces.size()) * block_size, [&](Index begin, Index) {
    RigidBodies::Piece& piece = pieces[begin / block_size];
    work(bodies[piece.body], piece);
  });
}

}  // namespace

bool RigidBody::fixed() const {
  return all(held) && all(no_turn);
}

std::array<Vec, 2> RigidBody::load_at(Real t) const {
  std::array<Vec, 2> out = program;
  for (const BodyForceLoad& load : loads) out[load.turns] += load.sf * load.curve(t) * load.direction;
  for (int k = 0; k < 3; ++k) {
    if (held[k]) out[0][k] = 0;
    if (no_turn[k]) out[1][k] = 0;
  }
  return out;
}

Matrix RigidBody::second_moments() const {
  const Matrix R = q.toRotationMatrix(), J = R * J0 * R.transpose();
  return 0.5 * J.trace() * Matrix::Identity() - J;
}

// With some rotations held only the rows of L = J omega along the free axes count; the others hold the
// reaction.
Vec RigidBody::omega_of(const Eigen::Quaterniond& orientation) const {
  return turning_by(L, orientation);
}
Vec RigidBody::turning_by(const Vec& angular_momentum, const Eigen::Quaterniond& orientation) const {
  const Matrix R = orientation.toRotationMatrix();
  Matrix J = R * J0 * R.transpose();
  Vec rhs = angular_momentum;
  for (int k = 0; k < 3; ++k) {
    if (!no_turn[k]) continue;
    J.row(k).setZero();
    J.col(k).setZero();
    J(k, k) = 1;
    rhs[k] = 0;
  }
  return J.inverse() * rhs;
}

// omega of the half step belongs to the orientation in the middle of the step, which depends on omega.
Vec turning_over(const RigidBody& b, const Vec& L, Real dt) {
  Vec omega = b.turning_by(L, b.q);
  for (int it = 0; it < 20; ++it) {
    const Vec next = b.turning_by(L, turned_by(0.5 * dt * omega, b.q));
    const bool done = (next - omega).norm() <= 1e-15 * next.norm();
    omega = next;
    if (done) break;
  }
  return omega;
}

BodyPose pose_after(const RigidBody& b, const HalfStep& next, Real dt) {
  if (b.fixed()) return {b.x, b.q};
  return {b.x + next.v * dt, turned_by(dt * turning_over(b, next.L, dt), b.q)};
}

bool RigidBodies::any_moves() const {
  return std::any_of(bodies_.begin(), bodies_.end(), [](const RigidBody& b) { return !b.fixed(); });
}

std::vector<Index> RigidBodies::unweighed_nodes() const {
  std::vector<Index> out;
  for (const RigidBody& b : bodies_) out.insert(out.end(), b.unweighed.begin(), b.unweighed.end());
  return out;
}

bool RigidBodies::add_mass_at(Index node, const Vec& place, Real mass, Real inertia, World& world) {
  for (RigidBody& b : bodies_) {
    const auto among = [&](const std::vector<Index>& nodes) {
      return std::find(nodes.begin(), nodes.end(), node) != nodes.end();
    };
    if (!among(b.nodes) || !(mass > 0)) continue;
    if (b.fixed()) {
      b.m += mass;  // which nothing moves
      continue;
    }
    if (among(b.unweighed)) return false;
    RigidBody more;
    more.m = mass, more.x = place, more.v = b.v + b.omega.cross(more.x - b.x);
    more.J0 = inertia * Matrix::Identity(), more.L = more.J0 * b.omega;
    join_mass(b, more);
    for (std::size_t k = 0; k < b.nodes.size(); ++k) b.X[k] = world.nodes.x.vec(b.nodes[k]) - b.x;
    b.x0 = b.x;
    start_velocities(b, world);
  }
  return true;
}

RigidBodies::RigidBodies(std::vector<RigidBody> bodies, Real step_share)
    : bodies_(std::move(bodies)), step_share_(step_share) {
  for (std::size_t k = 0; k < bodies_.size(); ++k) {
    RigidBody& body = bodies_[k];
    body.x0 = body.x;
    const auto nodes = static_cast<Index>(body.nodes.size());
    if (body.fixed()) continue;
    for (Index begin = 0; begin < nodes; begin += block_size)
      pieces_.push_back({.body = k, .begin = begin, .end = std::min(nodes, begin + block_size)});
  }
}

void RigidBodies::apply(World& world, const Clock& clock) {
  const BodyAcceleration::At now = loads_.at(clock.t);
  const Field<Real>* moment = shared_fields::moment.find(world.nodes.fields);  // of shells that deform
  for_each_piece(bodies_, pieces_, [&](const RigidBody& b, Piece& piece) {
    piece.force.setZero(), piece.moment.setZero();
    for (Index k = piece.begin; k < piece.end; ++k) {
      const Index n = b.nodes[k];
      const Vec f = world.nodes.f.vec(n);
      piece.force += f;
      piece.moment += (world.nodes.x.vec(n) - b.x).cross(f);
      if (moment) piece.moment += moment->vec(n);
    }
  });
  for (RigidBody& b : bodies_) {
    if (b.fixed()) continue;
    b.program = b.wanted;
    const auto [force, moment] = b.load_at(clock.t);
    b.force = b.m * now(b.x, b.part_index) + force;
    b.moment = moment;
    if (!loads_.uniform()) b.moment += moment_of(now, b);
  }
  for (const Piece& piece : pieces_) {
    bodies_[piece.body].force += piece.force;
    bodies_[piece.body].moment += piece.moment;
  }
  damp(clock);
  for (RigidBody& b : bodies_)
    for (int k = 0; k < 3; ++k) {
      if (b.held[k]) b.force[k] = 0;
      if (b.no_turn[k]) b.moment[k] = 0;
    }
}

void RigidBodies::kick(World&, const Clock& clock) {
  for (RigidBody& b : bodies_) {
    if (b.fixed()) continue;
    const HalfStep next = next_half_step(b, clock);
    b.v = next.v;
    b.L = next.L;
    b.omega = turning_over(b, next.L, clock.dt);
  }
}

void RigidBodies::drift(World& world, const Clock& clock) {
  for (RigidBody& b : bodies_) {
    if (b.fixed()) continue;
    b.x += b.v * clock.dt;
    b.q = turned_by(clock.dt * b.omega, b.q);
  }
  Field<Real>* turning = shared_fields::angular_velocity.find(world.nodes.fields);
  for_each_piece(bodies_, pieces_, [&](const RigidBody& b, const Piece& piece) {
    const Matrix R = b.q.toRotationMatrix();
    for (Index k = piece.begin; k < piece.end; ++k) {
      const Index n = b.nodes[k];
      const Vec old = world.nodes.x.vec(n), now = b.x + R * b.X[k];
      // The chord of the step: contact finds where the node was from x - v dt.
      if (clock.dt > 0) world.nodes.v.set(n, (now - old) / clock.dt);
      world.nodes.x.set(n, now);
      if (turning) turning->set(n, b.omega);
    }
  });
}

namespace {

class BodyForces : public Constraint {
 public:
  explicit BodyForces(std::shared_ptr<RigidBodies> bodies) : bodies_(std::move(bodies)) {}
  std::string name() const override { return bodies_->name(); }
  const FieldSet& over(const World& world) const override { return world.nodes.fields; }
  void declare(const World& world, Accesses& a) const override {
    a.in_finish().reads(world.nodes.f).reads(world.nodes.x);
    if (const auto* moment = shared_fields::moment.find(world.nodes.fields)) a.reads(*moment);
  }
  void block(World&, const Clock&, Index, Index) override {}
  void finish(World& world, const Clock& clock) override { bodies_->apply(world, clock); }

 private:
  std::shared_ptr<RigidBodies> bodies_;
};

class BodyMotion : public Motion {
 public:
  explicit BodyMotion(std::shared_ptr<RigidBodies> bodies) : bodies_(std::move(bodies)) {}
  std::string name() const override { return bodies_->name() + " (motion)"; }
  const FieldSet& over(const World& world) const override { return world.nodes.fields; }
  void declare(const World& world, Accesses& a) const override {
    a.in_finish().updates(world.nodes.x).updates(world.nodes.v);
    if (const auto* turning = shared_fields::angular_velocity.find(world.nodes.fields)) a.updates(*turning);
  }
  void block(World&, const Clock&, Index, Index) override {}
  void finish(World& world, const Clock& clock) override {
    bodies_->kick(world, clock);
    bodies_->drift(world, clock);
  }

 private:
  std::shared_ptr<RigidBodies> bodies_;
};

}  // namespace

void add_body_passes(World& world, std::shared_ptr<RigidBodies> bodies) {
  world.passes.add(std::make_shared<BodyForces>(bodies));
  world.passes.add(std::make_shared<BodyMotion>(bodies));
  world.passes.add(bodies);
}

Real RigidBodies::kinetic_energy() const {
  Real e = 0;
  for (const RigidBody& b : bodies_)
    if (!b.fixed()) e += b.kinetic_energy();
  return e;
}

// The largest eigenvalue of (mass of the body)^-1 (mass of its nodes), both of v and omega, by power
// iteration.
Real lightness(const RigidBody& b, const Nodes& nodes, const std::function<Real(Index node)>& mass) {
  if (b.fixed()) return 1;
  Vec v(0.31, 0.47, 0.83), omega = Vec(0.59, 0.67, 0.43) / std::sqrt(b.J0.trace() / b.m);
  Real out = 0;
  for (int it = 0; it < 60; ++it) {
    Vec p = Vec::Zero(), L = Vec::Zero();
    for (const Index n : b.nodes) {
      const Vec r = nodes.x.vec(n) - b.x, of_node = mass(n) * (v + omega.cross(r));
      p += of_node, L += r.cross(of_node);
    }
    Vec next = p / b.m;
    for (int k = 0; k < 3; ++k)
      if (b.held[static_cast<std::size_t>(k)]) next[k] = 0;
    const Vec turn = b.turning_by(L, b.q);
    const Real before = b.m * v.squaredNorm() + omega.dot(b.J0 * omega),
               after = b.m * next.squaredNorm() + turn.dot(b.J0 * turn);
    if (!(after > 0)) return 1;
    out = std::sqrt(after / before);
    const Real unit = std::sqrt(b.m / after);
    v = unit * next, omega = unit * turn;
  }
  return out;
}

WallBodies RigidBodies::wall_bodies(World& world) {
  WallBodies out;
  out.of_node.assign(static_cast<std::size_t>(world.nodes.size()), -1);
  for (std::size_t k = 0; k < bodies_.size(); ++k)
    for (const Index n : bodies_[k].nodes) out.of_node[static_cast<std::size_t>(n)] = static_cast<Index>(k);
  out.answer_alone = [this](Index body, const Vec& q, const Vec& impulse, const Vec& moment) -> Vec {
    const RigidBody& b = bodies_[static_cast<std::size_t>(body)];
    if (b.fixed()) return Vec::Zero();
    const Vec arm = q - b.x;
    Vec free = impulse, turn = moment + arm.cross(impulse);
    for (int k = 0; k < 3; ++k) {
      if (b.held[k]) free[k] = 0;
      if (b.no_turn[k]) turn[k] = 0;
    }
    for (const PrescribedMotion& motion : b.motions) {
      if (motion.turns) continue;
      const Vec d = b.direction_of(motion, b.q);
      free -= free.dot(d) * d;
    }
    return free / b.m + b.turning_beside_drives(turn, nullptr).cross(arm);
  };
  out.give = [this, alone = out.answer_alone](Index body, const Vec& q, const Vec& n) {
    const auto k = static_cast<std::size_t>(body);
    return ties_ && ties_->tied(k) ? ties_->give(k, q, n) : n.dot(alone(body, q, n, Vec::Zero()));
  };
  out.change = [this](Index body, const Vec& q, const Clock& clock) -> Vec {
    const RigidBody& b = bodies_[static_cast<std::size_t>(body)];
    if (b.fixed()) return Vec::Zero();
    if (ties_ && ties_->tied(static_cast<std::size_t>(body))) ties_->begin(clock);
    const HalfStep next = next_half_step(b, clock);
    return next.v - b.v + b.turning_by(next.L - b.L, b.q).cross(q - b.x);
  };
  out.push = [this](Index body, const Vec& q, const Vec& force) {
    const auto k = static_cast<std::size_t>(body);
    const Vec moment = (q - bodies_[k].x).cross(force);
    push(k, force, moment);
    if (ties_ && ties_->tied(k)) ties_->answer(k, force, moment);
  };
  out.lighter = [this, &world](Index body) {
    return lightness(bodies_[static_cast<std::size_t>(body)], world.nodes,
                     [&](Index n) { return world.nodes.m[n]; });
  };
  out.turn = [this](Index body, const Vec& axis) {
    const RigidBody& b = bodies_[static_cast<std::size_t>(body)];
    return axis.dot(b.turning_by(axis, b.q));
  };
  out.take_mass = [this, &world](Index node, const Vec& position, Real mass, Real inertia) {
    return add_mass_at(node, position, mass, inertia, world);
  };
  return out;
}

void RigidBodies::push(std::size_t body, const Vec& force, const Vec& moment) {
  RigidBody& b = bodies_[body];
  for (int k = 0; k < 3; ++k) {
    if (!b.held[k]) b.force[k] += force[k];
    if (!b.no_turn[k]) b.moment[k] += moment[k];
  }
}

void RigidBodies::strike_at_start(std::size_t body, const Vec& impulse, const Vec& turn, World& world) {
  RigidBody& b = bodies_[body];
  for (int k = 0; k < 3; ++k) {
    if (!b.held[k]) b.v[k] += impulse[k] / b.m;
    if (!b.no_turn[k]) b.L[k] += turn[k];
  }
  b.omega = b.omega_of(b.q);
  Field<Real>* turning = shared_fields::angular_velocity.find(world.nodes.fields);
  for (std::size_t k = 0; k < b.nodes.size(); ++k) {
    world.nodes.v.set(b.nodes[k], b.v + b.omega.cross(b.X[k]));
    if (turning) turning->set(b.nodes[k], b.omega);
  }
}

void RigidBodies::slow_down(Real factor) {
  for (RigidBody& b : bodies_) b.v *= factor, b.L *= factor, b.omega *= factor;
}

void RigidBodies::start_moving(const std::vector<std::array<Vec, 2>>& motion, World& world) {
  for (std::size_t k = 0; k < bodies_.size(); ++k) {
    RigidBody& b = bodies_[k];
    if (b.fixed()) continue;
    const Matrix R = b.q.toRotationMatrix();
    b.v = b.L = Vec::Zero(), b.drive_work = 0;
    strike_at_start(k, b.m * motion[k][0], R * b.J0 * R.transpose() * motion[k][1], world);
  }
}

Real RigidBodies::rest_energy() const {
  Real e = 0;
  for (const RigidBody& b : bodies_)
    if (!b.fixed()) e += b.m * b.c2;
  return e;
}

// Of each axis along which the body can move, and of what is not the same everywhere.
std::array<Real, 4> RigidBodies::potential(const RigidBody& b, const BodyAcceleration::At& now) const {
  std::array<Real, 4> sums{};
  if (b.fixed()) return sums;
  const Vec& g = now.everywhere();
  for (int k = 0; k < 3; ++k)
    if (!b.held[k]) sums[static_cast<std::size_t>(k)] = -b.m * g[k] * b.x[k];
  if (loads_.uniform()) return sums;
  const Matrix A = gradient_of(now, b);
  sums[3] = b.m * (now.potential(b.x, b.part_index) + g.dot(b.x)) - 0.5 * (A * b.second_moments()).trace();
  return sums;
}

namespace {

Real below_of(const RigidBody& b, Real dt) {
  return b.fixed() ? 0 : 0.125 * dt * dt / b.m * b.force.squaredNorm();
}

}  // namespace

void RigidBodies::record(World&, const Clock& clock, EnergyLedger& ledger) {
  ledger.external_work += program_work_, ledger.throughput += program_moved_;
  program_work_ = program_moved_ = 0;
  if (clock.cycle == 0)
    for (const RigidBody& b : bodies_) ledger.below_at_start += below_of(b, clock.dt);
  for (std::size_t k = 0; k < bodies_.size(); ++k) {
    const Real lost = lost_to_damping(k, clock);
    ledger.dissipated += lost, ledger.throughput += std::abs(lost);
  }
  for (RigidBody& b : bodies_) {
    const Real work = b.motions.empty() ? 0 : work_of_drives(b, clock);
    b.drive_work += work;
    ledger.external_work += work;
    ledger.throughput += std::abs(work);
  }
  for (const RigidBody& b : bodies_) {
    if (b.fixed() || (b.loads.empty() && !program_loads_)) continue;
    const Real half = 0.5 * clock.dt_mean();
    const auto [force, moment] = b.load_at(clock.t);
    Vec v = b.v + half / b.m * b.force, omega = b.omega + b.turning_by(half * b.moment, b.q);
    if (!b.motions.empty()) {
      const HalfStep next = next_half_step(b, clock);
      v = 0.5 * (b.v + next.v), omega = b.turning_by(0.5 * (b.L + next.L), b.q);
    }
    const Real work = clock.dt_mean() * (force.dot(v) + moment.dot(omega));
    ledger.external_work += work;
    ledger.throughput += std::abs(work);
  }
  // Potential energy is -m g(t).x: a change of g alone is work from outside.
  const BodyAcceleration::At change = loads_.change(clock.t, clock.t + clock.dt);
  if (change.zero()) return;
  for (const RigidBody& b : bodies_)
    for (const Real work : potential(b, change)) {
      ledger.external_work += work;
      ledger.throughput += std::abs(work);
    }
}

void RigidBodies::sample(const World&, const Clock& clock, EnergyLedger& ledger) const {
  ledger.kinetic += kinetic_energy();
  for (const RigidBody& b : bodies_) {
    ledger.below += below_of(b, clock.dt_old);
    if (!b.fixed())
      ledger.half_step += 0.5 * clock.dt_old *
                          (b.force.dot(b.v + 0.25 * clock.dt_old / b.m * b.force) + b.moment.dot(b.omega));
  }
  if (loads_.none()) return;
  const BodyAcceleration::At now = loads_.at(clock.t);
  for (const RigidBody& b : bodies_)
    for (const Real energy : potential(b, now)) ledger.potential += energy;
}

std::vector<RigidBodyReport> RigidBodies::reports() const {
  std::vector<RigidBodyReport> out;
  for (const RigidBody& b : bodies_)
    out.push_back({.part = b.part,
                   .mass = b.m,
                   .x = b.x,
                   .v = b.v,
                   .omega = b.omega,
                   .force = b.force,
                   .moment = b.moment,
                   .kinetic_energy = b.fixed() ? 0 : b.kinetic_energy()});
  return out;
}

void RigidBodies::keep(Archive& archive) {
  for (RigidBody& b : bodies_) {
    const Archive::Group inside(archive, "part " + std::to_string(b.part));
    archive("x", b.x);
    archive("v", b.v);
    archive("L", b.L);
    archive("omega", b.omega);
    archive.rows("q", std::vector<Real*>{b.q.coeffs().data()}, 4);
    archive("force", b.force);
    archive("moment", b.moment);
    archive("drive_work", b.drive_work);
  }
}

}  // namespace courant
