// What cards and programs do to rigid bodies, each degree of freedom, system and time of its own; what joints
// add to a body that is pushed, and to its step.
#include <gtest/gtest.h>

#include <cmath>

#include "../../verification/bodies/joint_decks.hpp"
#include "rigid/bodies/rigid.hpp"
#include "rigid/joints/joints.hpp"
#include "state/shared_fields.hpp"

namespace courant::body_cards_test {
namespace {

using test::do_nothing;
using test::JointDeck;
using test::simulation_of;

/// Steps of 0.01, which bodies alone allow where the run is 100 long.
const std::string even_steps =
    "*CONTROL_TIMESTEP\n0.0,0.9,0,0.0,0.0,4\n*DEFINE_CURVE\n4\n0.0,0.01\n99.0,0.01\n";
/// x' = y, y' = z, z' = x.
const std::string system_7 = "*DEFINE_COORDINATE_SYSTEM\n7,0.0,0.0,0.0,0.0,1.0,0.0\n0.0,0.0,1.0\n";
Vec along(int axis, bool of_system) {
  return Vec::Unit(of_system ? (axis + 1) % 3 : axis);
}
const Matrix inertia = Vec(0.1, 0.2, 0.25).asDiagonal();
RigidBodies& bodies_of(Simulation& s) {
  return const_cast<RigidBodies&>(*s.bodies());
}
const RigidBody& body_of(const Simulation& s, std::size_t k = 0) {
  return s.bodies()->bodies()[k];
}

}  // namespace

// DOF 1 to 3 are forces, 5 to 7 moments, SF times the curve, along global axes or those of CID.
TEST(BodyCards, LoadsActAlongTheirDegreeOfFreedom) {
  for (const bool of_system : {false, true})
    for (const int dof : {1, 2, 3, 5, 6, 7}) {
      JointDeck deck;
      deck.body({.m = 2, .J = inertia}), deck.body({.x = {3, 0, 0}});
      deck.more = fmt::format("*LOAD_RIGID_BODY\n1,{},8,3.0,{}\n", dof, of_system ? 7 : 0) + system_7;
      deck.curve(8, "0.0,2.0\n2.0,10.0\n");
      const auto s = simulation_of(deck.text(1));
      const auto load = body_of(*s).load_at(0.5);
      const Vec expected = 3 * 4 * along((dof - 1) % 4, of_system);
      EXPECT_NEAR((load[dof > 4] - expected).norm(), 0, 1e-12) << dof;
      EXPECT_EQ(load[dof <= 4], Vec::Zero()) << dof;
      EXPECT_EQ(body_of(*s, 1).loads.size(), 0u) << "of the other body";
    }
}

TEST(BodyCards, StartsAreAlongTheirSystem) {
  for (const bool of_system : {false, true}) {
    JointDeck deck;
    deck.body({.x = {1, 2, 3}, .m = 2, .J = inertia, .v = {9, 9, 9}, .omega = {9, 9, 9}});
    deck.more =
        fmt::format("*INITIAL_VELOCITY_RIGID_BODY\n1,1.0,2.0,3.0,4.0,5.0,6.0,{}\n", of_system ? 7 : 0) +
        system_7;
    const auto s = simulation_of(deck.text(1));
    const Vec v = of_system ? Vec(3, 1, 2) : Vec(1, 2, 3), omega = of_system ? Vec(6, 4, 5) : Vec(4, 5, 6);
    EXPECT_NEAR((body_of(*s).v - v).norm(), 0, 1e-12);
    EXPECT_NEAR((body_of(*s).omega - omega).norm(), 0, 1e-12);
    EXPECT_NEAR((body_of(*s).L - inertia * omega).norm(), 0, 1e-12);
    const Nodes& nodes = s->world().nodes;
    for (const Index n : body_of(*s).nodes)
      EXPECT_NEAR((nodes.v.vec(n) - v - omega.cross(nodes.x.vec(n) - Vec(1, 2, 3))).norm(), 0, 1e-12);
  }
}

// Each degree of freedom of a drive from BIRTH to DEATH: SF times the curve over the time since BIRTH, as a
// velocity, an acceleration or a displacement; the others go on, and the force of the drive is reported while
// it drives.
TEST(BodyCards, DrivesMoveTheirDegreeOfFreedomInTheirTime) {
  for (const int dof : {1, 2, 3, 5, 6, 7})
    for (const int vad : {0, 1, 2}) {
      JointDeck deck;
      deck.body({.m = 2, .J = 0.3 * Matrix::Identity(), .v = {1, 2, 3}, .omega = {0.1, 0.2, 0.05}});
      deck.more =
          fmt::format("*BOUNDARY_PRESCRIBED_MOTION_RIGID\n1,{},{},8,2.0,0,0.2,0.11\n", dof, vad) + even_steps;
      deck.curve(8, vad == 1 ? "0.0,0.5\n9.0,0.5\n" : "0.0,0.0\n1.0,0.4\n");
      const auto s = simulation_of(deck.text(100));
      const bool turns = dof > 4;
      const int axis = (dof - 1) % 4;
      const auto rate = [&] { return turns ? body_of(*s).omega : body_of(*s).v; };
      const Vec start = rate(), other = turns ? body_of(*s).v : body_of(*s).omega;
      Real last = 0;
      for (int k = 0; k < 30; ++k) {
        const Real before = rate()[axis], t = s->clock().t;
        Vec force = Vec::Zero();
        s->step([&](World& world, const Clock& clock, const std::string&) {
          std::vector<BoundaryForce> out;
          s->bodies()->report_forces(world, clock, out);
          force = turns ? out.at(0).moment : out.at(0).force;
          EXPECT_EQ(out[0].kind, BoundaryForce::Kind::driven_body);
          EXPECT_EQ(out[0].id, 1);
        });
        const Real now = rate()[axis];
        // times of steps: 0, 0.01, ...; the first that drives begins at 0.11, the last at 0.19
        if (t < 0.105) {
          EXPECT_NEAR(now, start[axis], 1e-12) << dof << vad << " before BIRTH";
        } else if (t > 0.195) {
          EXPECT_NEAR(now, last, 1e-12) << dof << vad << " behind DEATH";
        } else {
          const Real since = t - 0.11;
          // the middle of the step, of the curve 0.4 t; 0.5 from middle to middle, at first from the start;
          // the slope
          const Real expected = vad == 0   ? 2 * 0.4 * (since + 0.005)
                                : vad == 1 ? before + 2 * 0.5 * (since < 0.005 ? 0.005 : 0.01)
                                           : 2 * 0.4;
          EXPECT_NEAR(now, expected, 1e-9) << dof << " " << vad << " " << t;
          last = now;
        }
        EXPECT_NEAR(force[axis], (turns ? 0.3 : 2) * (now - before) / 0.01, 1e-8) << dof << vad << t;
        for (int k2 = 0; k2 < 3; ++k2)
          if (k2 != axis) EXPECT_NEAR(rate()[k2], start[k2], 1e-9) << dof << vad;
        EXPECT_NEAR(((turns ? body_of(*s).v : body_of(*s).omega) - other).norm(), 0, 1e-9);
      }
      EXPECT_GT(std::abs(last - start[axis]), 0.01) << "it has driven";
    }
}

// Force and moment of a program act from the next step until they are changed, along free axes alone, and do
// the work that the body gets; velocities change at once, and what the body gains is work from outside.
TEST(BodyCards, ProgramsPushAndMoveBodies) {
  JointDeck deck;
  deck.body({.m = 2, .J = inertia, .v = {1, 0, 0}, .con1 = 2, .con2 = 3});
  deck.ground();
  deck.more = even_steps;
  auto s = simulation_of(deck.text(100));
  test::start_ledger(*s);
  RigidBodies& bodies = bodies_of(*s);
  s->step(do_nothing);
  bodies.set_program_load(0, Vec(4, 5, 6), Vec(0.3, 0.4, 0.5));
  const Vec v = body_of(*s).v;
  for (int k = 0; k < 5; ++k) s->step(do_nothing);
  EXPECT_NEAR((body_of(*s).v - v - 0.05 / 2 * Vec(4, 0, 6)).norm(), 0, 1e-12) << "y is held";
  EXPECT_NEAR((body_of(*s).L - 0.05 * Vec(0.3, 0.4, 0)).norm(), 0, 1e-6) << "and turns about z";
  EXPECT_NEAR(s->world().energy.external_work, body_of(*s).kinetic_energy() - 1, 1e-6);
  bodies.set_program_load(0, Vec::Zero(), Vec::Zero());
  const Vec then = body_of(*s).v;
  s->step(do_nothing);
  EXPECT_NEAR((body_of(*s).v - then).norm(), 0, 1e-12);
  const Real work = s->world().energy.external_work, before = body_of(*s).kinetic_energy(),
             passed = s->world().energy.throughput;
  EXPECT_EQ(bodies.set_program_motion(0, Vec(0.1, 7, 0.2), Vec(0.1, 0.2, 7)), "");
  EXPECT_NEAR((body_of(*s).v - Vec(0.1, 0, 0.2)).norm(), 0, 1e-12);
  EXPECT_NEAR((body_of(*s).omega - Vec(0.1, 0.2, 0)).norm(), 0, 1e-2) << "the body has turned a little";
  EXPECT_EQ(body_of(*s).omega[2], 0);
  const Real gained = body_of(*s).kinetic_energy() - before;
  s->step(do_nothing);
  EXPECT_NEAR(s->world().energy.external_work - work, gained, 1e-12);
  EXPECT_NEAR(s->world().energy.throughput - passed, std::abs(gained), 1e-12);
  EXPECT_NE(bodies.set_program_motion(1, Vec::Zero(), Vec::Zero()).find("is held"), std::string::npos);
}

TEST(BodyCards, ProgramsDoNotMoveWhatOthersMove) {
  JointDeck deck;
  const int ground = deck.ground(), a = deck.body({}), b = deck.body({.x = {2, 0, 0}});
  deck.joint("SPHERICAL", ground, a, {Vec(0, 0, 1)});
  deck.more = fmt::format("*BOUNDARY_PRESCRIBED_MOTION_RIGID\n{},1,0,8\n", b);
  deck.curve(8, "0.0,1.0\n9.0,1.0\n");
  auto s = simulation_of(deck.text(1));
  EXPECT_NE(bodies_of(*s).set_program_motion(1, Vec::Zero(), Vec::Zero()).find("joints"), std::string::npos);
  EXPECT_NE(bodies_of(*s).set_program_motion(2, Vec::Zero(), Vec::Zero()).find("prescribed"),
            std::string::npos);
}

// Of bodies alone: a thousandth of the time of the run, or a hundredth of a radian.
TEST(BodyCards, StepsOfBodiesAlone) {
  for (const Real omega : {0.0, 50.0}) {
    JointDeck deck;
    deck.body({.J = 0.3 * Matrix::Identity(), .omega = {0, 0, omega}});
    auto s = simulation_of(deck.text(2));
    s->step(do_nothing);
    s->step(do_nothing);
    EXPECT_NEAR(s->clock().dt_old, omega > 0 ? 0.01 / omega : 2.0 / 1000, 1e-12);
  }
}

TEST(BodyCards, MotionsAreScaledAndStarted) {
  JointDeck deck;
  deck.body({.x = {1, 2, 3}, .m = 2, .J = inertia, .v = {1, 2, 3}, .omega = {4, 5, 6}});
  auto s = simulation_of(deck.text(1));
  RigidBodies& bodies = bodies_of(*s);
  bodies.slow_down(0.25);
  EXPECT_NEAR((body_of(*s).v - 0.25 * Vec(1, 2, 3)).norm() + (body_of(*s).omega - Vec(1, 1.25, 1.5)).norm(),
              0, 1e-12);
  EXPECT_NEAR((body_of(*s).L - inertia * Vec(1, 1.25, 1.5)).norm(), 0, 1e-12);
  bodies.start_moving({{Vec(3, 4, 5), Vec(0.1, 0.2, 0.3)}}, s->world());
  EXPECT_NEAR((body_of(*s).v - Vec(3, 4, 5)).norm() + (body_of(*s).omega - Vec(0.1, 0.2, 0.3)).norm(), 0,
              1e-12);
  const Index n = body_of(*s).nodes[5];
  EXPECT_NEAR((s->world().nodes.v.vec(n) - Vec(3, 4, 5) - Vec(0.1, 0.2, 0.3).cross(body_of(*s).X[5])).norm(),
              0, 1e-12);
}

// A body on a pivot yields to a push as one that turns about it, (r x n) . J^-1 (r x n) about the pivot,
// and what answers the push leaves the pivot at rest.
TEST(BodyCards, JointsAnswerPushes) {
  JointDeck deck;
  const int ground = deck.ground(), rod = deck.body({.x = {1, 0.5, 0.2}, .m = 2, .J = inertia});
  const Vec pivot(0.2, -0.3, 0.1), centre(1, 0.5, 0.2);
  deck.joint("SPHERICAL", ground, rod, {pivot});
  auto s = simulation_of(deck.text(1));
  WallBodies seen = bodies_of(*s).wall_bodies(s->world());
  Clock clock;
  clock.dt = clock.dt_old = 1e-4;
  const Vec q(1.4, 0.2, 0.5), n = Vec(1, 2, -2) / 3;
  seen.change(1, q, clock);  // the step begins
  const Vec arm = centre - pivot, r = (q - pivot).cross(n);
  const Matrix J = inertia + 2 * (arm.squaredNorm() * Matrix::Identity() - arm * arm.transpose());
  EXPECT_NEAR(seen.give(1, q, n), r.dot(J.inverse() * r), 1e-12);
  EXPECT_NEAR(seen.give_alone(1, q, n),
              0.5 + (q - centre).cross(n).dot(inertia.inverse() * (q - centre).cross(n)), 1e-12);
  seen.push(1, q, 5 * n);
  const RigidBody& b = body_of(*s, 1);
  const Vec turn = inertia.inverse() * b.moment;
  EXPECT_NEAR((b.force / 2 + turn.cross(pivot - centre)).norm(), 0, 1e-12);
  EXPECT_NEAR((turn - J.inverse() * (5 * r)).norm(), 0, 1e-12);
}

// A bob that hangs at a pivot swings with sqrt(F arm J^-1) as a string does: half of what is stable.
TEST(BodyCards, ForcesAtArmsLimitTheStep) {
  JointDeck deck;
  const int ground = deck.ground(), bob = deck.body({.m = 2, .J = inertia});
  deck.joint("SPHERICAL", ground, bob, {Vec(0, 0, 0.5)});
  deck.gravity(10);
  deck.more += even_steps;
  auto s = simulation_of(deck.text(1));
  s->step(do_nothing);
  std::vector<JointForce> forces;
  for (auto* joints : s->world().passes.all<Joints>()) {
    joints->report_joints(forces);
    ASSERT_EQ(forces.size(), 1u);
    EXPECT_NEAR((forces[0].force - Vec(0, 0, 20)).norm(), 0, 1e-9) << "the weight";
    // across the arm it gives about x and y: 1/0.1 + 1/0.2
    EXPECT_NEAR(joints->limit(s->world(), s->clock()).dt, 1 / std::sqrt(20 * 0.5 * 15), 1e-9);
  }
}

// At the start a motor runs as its curve begins, or as it was with accelerations; the impulse is the bodies'.
TEST(BodyCards, MotorsStartAsTheirCurvesDo) {
  for (const bool turns : {true, false})
    for (const int type : {0, 1, 2}) {
      JointDeck deck;
      const int ground = deck.ground();
      const int wheel = deck.body({.m = 2, .J = inertia, .v = {0, 0, 0.3}, .omega = {0, 0, 0.3}});
      deck.motor(turns ? "ROTATIONAL" : "TRANSLATIONAL", ground, wheel, Vec::Zero(), Vec::UnitZ(), 8, type);
      deck.curve(8, "0.0,2.0\n9.0,29.0\n");  // 2 + 3 t
      const auto s = simulation_of(deck.text(1));
      const Real expected = type == 0 ? 2 : type == 1 ? 0.3 : 3;
      // slopes are differences over 1e-9, with the round-off of 2 in them
      EXPECT_NEAR((turns ? body_of(*s, 1).omega : body_of(*s, 1).v)[2], expected, 1e-6) << turns << type;
      EXPECT_NEAR((turns ? body_of(*s, 1).v : body_of(*s, 1).omega)[2], 0.3, 1e-12) << turns << type;
    }
}

namespace {

/// What a restart keeps of the springs of two hinges that do not fit.
SavedState springs_of(const std::string& penalty) {
  JointDeck deck;
  const int ground = deck.ground();
  const int door =
      deck.body({.x = {0.4, 0, 1}, .m = 20, .J = Vec(7, 8, 1.2).asDiagonal(), .omega = {0, 0, 1}});
  deck.joint("REVOLUTE", ground, door, {Vec(0, 0, 0.2), Vec(0, 0, 0.3)}, 0, penalty);
  deck.joint("REVOLUTE", ground, door, {Vec(0, 0, 1.8), Vec(0.001, 0, 1.9)}, 0, penalty);
  deck.more = even_steps;
  auto s = simulation_of(deck.text(6));
  s->step(do_nothing);
  SavedState out;
  Archive archive = Archive::saver(out);
  for (auto* joints : s->world().passes.all<Joints>()) joints->keep(archive);
  return out;
}
std::vector<Real> numbers(const SavedState& state, const std::string& name) {
  for (const auto& [path, array] : state)
    if (path.size() >= name.size() && path.compare(path.size() - name.size(), name.size(), name) == 0) {
      std::vector<Real> out(array.bytes.size() / sizeof(Real));
      std::memcpy(out.data(), array.bytes.data(), array.bytes.size());
      return out;
    }
  return {};
}

}  // namespace

// RPS scales the stiffness of joints that become springs, DAMP their damping, which goes with the root of the
// stiffness; up to 0.01 there is none, and 0 is 1.
TEST(BodyCards, PenaltiesOfJointsHaveTheirScales) {
  const SavedState usual = springs_of("");
  const std::vector<Real> k = numbers(usual, "stiffness"), d = numbers(usual, "damping");
  ASSERT_EQ(k.size(), 10u);
  Real most = 0;
  for (const Real one : k) most = std::max(most, one);
  ASSERT_GT(most, 0) << "the hinges are askew, and became springs";
  const std::tuple<std::string, Real, Real> cases[] = {{"       4.0       0.5", 4, 0.5 * 2},
                                                       {"       0.0       0.0", 1, 1},
                                                       {"       1.0      0.01", 1, 0},
                                                       {"      0.25       3.0", 0.25, 3 * 0.5}};
  for (const auto& [fields, stiffness, damping] : cases) {
    const SavedState other = springs_of(fields);
    const std::vector<Real> k2 = numbers(other, "stiffness"), d2 = numbers(other, "damping");
    for (std::size_t row = 0; row < k.size(); ++row) {
      EXPECT_NEAR(k2[row], stiffness * k[row], 1e-9 * most) << fields << row;
      EXPECT_NEAR(d2[row], damping * d[row], 1e-9 * most) << fields << row;
    }
  }
}

}  // namespace courant::body_cards_test
