// What drives of rigid bodies do of work, against the balance of each body.
#include <gtest/gtest.h>

#include "rigid/bodies/rigid.hpp"

using namespace courant;

namespace {

PrescribedMotion constant(bool turns, const Vec& direction, Real value, int kind) {
  PrescribedMotion m;
  m.kind = static_cast<PrescribedMotion::Kind>(kind);
  m.turns = turns;
  m.direction = direction;
  m.curve.abscissa = {0};
  m.curve.ordinate = {value};
  return m;
}

/// 2 kg with J = (1, 2, 4) that moves at (1, 0, 0), turns about z at 3 and feels a force and a moment.
RigidBody body() {
  RigidBody b;
  b.m = 2;
  b.J0.diagonal() = Vec(1, 2, 4);
  b.no_turn = {true, true, false};
  b.v = Vec(1, 0, 0);
  b.L = Vec(0, 0, 12), b.omega = Vec(0, 0, 3);
  b.force = Vec(10, 20, 0);
  b.moment = Vec(0, 0, 50);
  return b;
}

Clock steps() {
  Clock clock;
  clock.t = 1, clock.dt = 0.03, clock.dt_old = 0.01;
  return clock;
}

}  // namespace

TEST(PrescribedBody, WorkOfTheDriveIsWhatForcesDoNotExplain) {
  const Clock clock = steps();
  const Real dt = clock.dt_mean();
  for (const int kind : {0, 1}) {
    RigidBody b = body();
    b.motions = {constant(false, Vec(0.6, 0.8, 0), 5, kind), constant(true, Vec(0, 0, 1), 7, kind)};
    const HalfStep next = next_half_step(b, clock);
    // along the direction and about z as asked for
    EXPECT_NEAR(next.v.dot(Vec(0.6, 0.8, 0)), kind == 0 ? 5 : 0.6 + 5 * dt, 1e-14);
    EXPECT_NEAR(next.L[2], 4 * (kind == 0 ? 7 : 3 + 7 * dt), 1e-13);
    // across the direction as if free
    const Vec across(-0.8, 0.6, 0);
    EXPECT_NEAR(next.v.dot(across), (b.v + b.force / 2 * dt).dot(across), 1e-14);
    const Real before = 0.5 * 2 * b.v.squaredNorm() + 0.5 * b.L[2] * b.L[2] / 4;
    const Real after = 0.5 * 2 * next.v.squaredNorm() + 0.5 * next.L[2] * next.L[2] / 4;
    const Real by_forces = b.force.dot(b.v + next.v) / 2 * dt + b.moment[2] * (b.L[2] + next.L[2]) / 8 * dt;
    EXPECT_NEAR(work_of_drives(b, clock), after - before - by_forces, 1e-12);
  }
}

TEST(PrescribedBody, IsFreeBeforeBirthAndAfterDeath) {
  RigidBody b = body();
  b.motions = {constant(false, Vec(1, 0, 0), 5, 0)};
  b.motions[0].birth = 1.02;  // the middle of the step is 1.015
  EXPECT_EQ(work_of_drives(b, steps()), 0);
  EXPECT_NEAR(next_half_step(b, steps()).v[0], 1 + 5 * 0.02, 1e-14);
  b.motions[0].birth = 0;
  b.motions[0].death = 1.01;
  EXPECT_EQ(work_of_drives(b, steps()), 0);
  b.motions[0].death = 2;
  EXPECT_NE(work_of_drives(b, steps()), 0);
}
