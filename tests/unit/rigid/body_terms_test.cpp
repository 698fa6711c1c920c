// Each term of the motion of a rigid body, and of its energy, against closed forms.
#include <gtest/gtest.h>

#include <cmath>

#include "../../verification/bodies/joint_decks.hpp"
#include "../../verification/shells/shell_decks.hpp"
#include "rigid/bodies/body_mass.hpp"
#include "rigid/joints/joint_drive.hpp"
#include "rigid/joints/joint_springs.hpp"
#include "state/shared_fields.hpp"

using namespace courant;

namespace body_terms_test {
namespace {

using test::do_nothing;
using test::JointDeck;
using test::simulation_of;

const std::string constant = "*DEFINE_CURVE\n3\n0.0,1.0\n9.0,1.0\n";

/// A free body with a full tensor, away from the origin.
RigidBody made_body() {
  RigidBody b;
  b.m = 2, b.x = Vec(1, -2, 0.5), b.x0 = b.x;
  b.J0 << 0.4, 0.05, -0.02, 0.05, 0.3, 0.03, -0.02, 0.03, 0.5;
  return b;
}
Matrix about(const Vec& r) {
  return r.squaredNorm() * Matrix::Identity() - r * r.transpose();
}
/// What the ledger cannot explain at each of some steps, at most.
Real worst_unexplained(Simulation& s, int steps) {
  Real worst = 0;
  for (int k = 0; k < steps; ++k)
    s.step([&](World& world, const Clock& clock, const std::string&) {
      sample_energy(world, clock);
      worst = std::max(worst, std::abs(world.energy.unexplained()));
    });
  return worst;
}
Sample next_sample(Simulation& s) {
  Sample out;
  s.step([&](World&, const Clock&, const std::string& controlled_by) { out = s.sample(controlled_by); });
  return out;
}

}  // namespace

// With a rotation held, the rows of the others alone count: (J^-1 of the free block) L.
TEST(BodyTerms, HeldRotationsTakeNoPartInTheTurning) {
  RigidBody b = made_body();
  const Vec L(1, 2, 3);
  EXPECT_NEAR((b.J0 * b.turning_by(L, b.q) - L).norm(), 0, 1e-13);
  b.no_turn = {false, true, false};
  Eigen::Matrix2d free;
  free << b.J0(0, 0), b.J0(0, 2), b.J0(2, 0), b.J0(2, 2);
  const Eigen::Vector2d omega = free.inverse() * Eigen::Vector2d(L[0], L[2]);
  EXPECT_NEAR((b.turning_by(L, b.q) - Vec(omega[0], 0, omega[1])).norm(), 0, 1e-13);
}

// Two masses with spins: one body with their momentum, angular momentum and inertia about the common centre.
TEST(BodyTerms, JoinedMassesKeepAllMomenta) {
  RigidBody a = made_body(), b;
  a.v = Vec(1, 0.5, -1), a.L = Vec(0.1, -0.3, 0.2);
  b.m = 3, b.x = Vec(-1, 0, 2), b.v = Vec(0, 2, 1), b.L = Vec(-0.4, 0.6, 0.8);
  b.J0 = Vec(0.2, 0.3, 0.4).asDiagonal();
  const auto momentum = [](const RigidBody& one) { return Vec(one.m * one.v); };
  const auto spin = [&](const RigidBody& one) { return Vec(one.L + one.x.cross(momentum(one))); };
  const auto at_origin = [](const RigidBody& one) { return Matrix(one.J0 + one.m * about(one.x)); };
  const Vec p = momentum(a) + momentum(b), L = spin(a) + spin(b);
  const Matrix J = at_origin(a) + at_origin(b);
  join_mass(a, b);
  EXPECT_EQ(a.m, 5);
  EXPECT_NEAR((momentum(a) - p).norm(), 0, 1e-13);
  EXPECT_NEAR((spin(a) - L).norm(), 0, 1e-13);
  EXPECT_NEAR((at_origin(a) - J).norm(), 0, 1e-13);
}

// An impulse P at q changes the velocity of q by P/m + J^-1 (M + r x P) x r; a mass at a node joins with the
// inertia that it has about itself.
TEST(BodyTerms, BodiesAnswerContactAndTakeMassAsRigidOnes) {
  JointDeck deck;
  const Matrix J = Vec(0.1, 0.2, 0.25).asDiagonal();
  deck.body({.x = {1, 2, 3}, .m = 2, .J = J, .v = {1, 0, 2}, .omega = {0.5, -1, 2}});
  auto s = simulation_of(deck.text(1));
  auto& bodies = const_cast<RigidBodies&>(*s->bodies());
  WallBodies seen = bodies.wall_bodies(s->world());
  const Vec q(1.3, 1.8, 3.1), P(1, -2, 3), M(0.3, 0.4, -0.2), r = q - Vec(1, 2, 3);
  const Vec expected = P / 2 + Vec(J.inverse() * (M + r.cross(P))).cross(r);
  EXPECT_NEAR((seen.answer_alone(0, q, P, M) - expected).norm(), 0, 1e-12);
  EXPECT_NEAR(seen.give_alone(0, q, Vec::UnitX()),
              1 / 2.0 + Vec(Vec(J.inverse() * r.cross(Vec::UnitX())).cross(r))[0], 1e-12);
  EXPECT_NEAR(seen.turn(0, Vec::UnitY()), 1 / 0.2, 1e-12);
  seen.push(0, q, P);
  const RigidBody& b = bodies.bodies()[0];
  EXPECT_NEAR((b.force - P).norm() + (b.moment - r.cross(P)).norm(), 0, 1e-12);

  test::SolidDeck block;
  block.block(Vec(0.2, 0.4, 0.6), 1, 1, 1, 1);
  block.cards =
      "*SECTION_SOLID\n1,1\n*PART\nblock\n1,1,1\n*MAT_RIGID\n1,1000.0,1.0E9,0.3\n0\n0\n"
      "*INITIAL_VELOCITY_RIGID_BODY\n1,1.0,0.0,2.0,0.5,-1.0,2.0\n";
  auto t = simulation_of(block.text(1));
  auto& weighed = const_cast<RigidBodies&>(*t->bodies());
  const RigidBody before = weighed.bodies()[0];
  const Vec at(0.3, 0.1, 0.2);
  ASSERT_TRUE(weighed.add_mass_at(before.nodes[2], at, 12, 0.7, t->world()));
  const RigidBody& after = weighed.bodies()[0];
  const Vec c = (before.m * before.x + 12 * at) / (before.m + 12);
  EXPECT_NEAR(after.m, before.m + 12, 1e-12);
  EXPECT_NEAR((after.x - c).norm(), 0, 1e-13);
  const Matrix both =
      before.J0 + before.m * about(before.x - c) + 0.7 * Matrix::Identity() + 12 * about(at - c);
  EXPECT_NEAR((after.J0 - both).norm(), 0, 1e-12);
  EXPECT_NEAR((after.omega - before.omega).norm(), 0, 1e-12) << "it was at rest on the body";
  EXPECT_NEAR((after.v - (before.v + before.omega.cross(c - before.x))).norm(), 0, 1e-12);
  for (std::size_t k = 0; k < after.nodes.size(); ++k)
    EXPECT_NEAR((after.X[k] - (t->world().nodes.x.vec(after.nodes[k]) - c)).norm(), 0, 1e-13);
}

// A constant force and a constant moment about a principal axis from rest: all work is kinetic energy, at
// each step; half of a step is explained but for its square, (1/16 of the work of a step) at the fifth.
TEST(BodyTerms, WorkOfLoadsIsKineticEnergyInEachStep) {
  for (const std::string load : {"1,2,3,40.0\n", "1,6,3,0.3\n"}) {
    JointDeck deck;
    deck.body({.x = {1, 2, 3}, .m = 2, .J = Vec(0.1, 0.2, 0.25).asDiagonal()});
    deck.more = "*LOAD_RIGID_BODY\n" + load + constant + "*CONTROL_TIMESTEP\n0.0,0.9,0,0.0,0.0,4\n" +
                "*DEFINE_CURVE\n4\n0.0,0.001\n9.0,0.001\n";
    auto s = simulation_of(deck.text(1));
    test::start_ledger(*s);
    for (int k = 0; k < 5; ++k) s->step(do_nothing);
    const Real of_step = s->bodies()->bodies()[0].kinetic_energy();
    EXPECT_LT(worst_unexplained(*s, 20), 0.1 * of_step) << load;
    const RigidBody& b = s->bodies()->bodies()[0];
    EXPECT_NEAR(s->world().energy.external_work / b.kinetic_energy(), 1, 1e-9) << load;
  }
}

// A drive at a constant velocity against a load and gravity gives the opposite of both; with an acceleration
// m a more. Its work is that of what it pushes against.
TEST(BodyTerms, DrivesGiveTheForceThatOthersLack) {
  for (const bool faster : {false, true}) {
    JointDeck deck;
    deck.body({.m = 2, .J = Vec(0.1, 0.2, 0.4).asDiagonal(), .v = {0, 0, 1}});
    deck.more = "*BOUNDARY_PRESCRIBED_MOTION_RIGID\n1,3,0,8\n*LOAD_RIGID_BODY\n1,3,3,5.0\n" + constant +
                "*DEFINE_CURVE\n8\n0.0,1.0\n1.0," + (faster ? "4.0\n" : "1.0\n") +
                "*CONTROL_TIMESTEP\n0.0,0.9,0,0.0,0.0,4\n*DEFINE_CURVE\n4\n0.0,0.01\n9.0,0.01\n";
    deck.gravity(10);
    auto s = simulation_of(deck.text(1));
    test::start_ledger(*s);
    Sample last;
    while (s->clock().t < 0.1) last = next_sample(*s);
    last = next_sample(*s);
    ASSERT_EQ(last.boundary_forces.size(), 1u);
    EXPECT_NEAR(last.boundary_forces[0].force[2], (faster ? 6 : 0) + 20 - 5, 1e-9) << faster;
    EXPECT_LT(worst_unexplained(*s, 3), 1e-2 * (1 + s->world().energy.throughput));
  }
}

// Motors: how far from t = 0 to t and over a step, of curves of velocity, displacement and acceleration that
// do not begin with 0: what a curve of displacements has at t = 0 does not count.
TEST(BodyTerms, MotorsGoAsFarAsTheirCurves) {
  using Kind = PrescribedMotion::Kind;
  JointDrive drive;
  drive.curve = {.id = 1, .abscissa = {0, 2}, .ordinate = {3, 7}};  // 3 + 2 t
  drive.start_rate = 0.5;
  for (const Real sense : {1.0, -1.0}) {
    drive.sense = sense;
    const auto far = [&](Kind kind, Real t) -> Real {
      if (kind == Kind::velocity) return sense * (3 * t + t * t);
      if (kind == Kind::displacement) return sense * 2 * t;
      return 0.5 * t + sense * (1.5 * t * t + t * t * t / 3);
    };
    for (const Kind kind : {Kind::velocity, Kind::displacement, Kind::acceleration}) {
      drive.kind = kind;
      for (const Real t : {0.0, 0.4, 1.3}) EXPECT_NEAR(drive.until(t), far(kind, t), 1e-12) << int(kind);
      if (kind != Kind::acceleration)
        EXPECT_NEAR(drive.over(0.4, 0.3), far(kind, 0.7) - far(kind, 0.4), 1e-12) << int(kind);
    }
    drive.kind = Kind::acceleration;
    EXPECT_NEAR(drive.over(0, 0.3), far(Kind::acceleration, 0.3), 1e-12);
  }
}

// Springs of joints: lost is C rate^2 dt, stored K/2 of the mean elongation squared.
TEST(BodyTerms, SpringsOfJointsStoreAndLose) {
  JointSprings springs(1);
  springs.add(0, 40, 3, 0.1);
  Clock clock;
  clock.dt = clock.dt_old = 0.01;
  std::vector<JointRow> rows(1);
  rows[0].c = 0.3;
  springs.remember(rows, {0.02}, clock);
  EXPECT_NEAR(springs.stored(), 20 * 0.2 * 0.2, 1e-12);
  EXPECT_NEAR(springs.lost(), 3 * 1.0 * 1.0 * 0.01, 1e-12);  // the mean of rates 0 and 2
  rows[0].c = 0.32;
  springs.remember(rows, {0.02}, clock);
  EXPECT_NEAR(springs.stored(), 20 * 0.21 * 0.21, 1e-12);
  EXPECT_NEAR(springs.lost(), 3 * 2.0 * 2.0 * 0.01, 1e-12);
}

namespace {

/// The same body with its axes as the deck gives them; last card: XL to ZLIP and CID.
RigidBody given(const std::string& position, const std::string& axes, const std::string& more = "") {
  test::SolidDeck deck;
  deck.block(Vec(0.2, 0.4, 0.6), 1, 1, 1, 1);
  deck.cards = "*SECTION_SOLID\n1,1\n*PART_INERTIA\nbrick\n1,1,1\n" + position +
               "2.0,0.3,0.0,3.0,0.0,4.0\n1.0,2.0,3.0,0.5,-1.0,2.0\n" + axes +
               "*MAT_RIGID\n1,1000.0,1.0E9,0.3\n0\n0\n" + more;
  return simulation_of(deck.text(1))->bodies()->bodies().front();
}

}  // namespace

// IRIGID: the fields of *INITIAL_VELOCITY and its _GENERATION replace the velocity of *PART_INERTIA where
// they name the body: v + omega x (centre - XC), here (0, 0, 3) x (0.3, -0.8, 0.1) = (2.4, 0.9, 0). Else they
// do not.
TEST(BodyTerms, IrigidReplacesTheVelocityOfAGivenInertia) {
  const std::string at = "0.3,0.2,0.1,10.0,0,0\n",
                    sets =
                        "*SET_PART_LIST\n4\n1\n*SET_NODE_LIST\n5\n"
                        "1,2,3,4,5,6,7,8\n*SET_NODE_LIST\n6\n1,2,3\n*DEFINE_BOX\n7,0.0,0.4,0.0,0.4,0.0,0.4\n"
                        "*DEFINE_BOX\n8,0.4,1.0,0.0,0.4,0.0,0.4\n";
  const Vec own(1, 2, 3), own_omega(0.5, -1, 2), spun(7.4, 6.9, 7), omega(0, 0, 3), straight(5, 6, 7);
  const auto expect = [&](const std::string& cards, const Vec& v, const Vec& w) {
    const RigidBody b = given(at, "", sets + cards);
    EXPECT_NEAR((b.v - v).norm() + (b.omega - w).norm(), 0, 1e-12) << cards;
  };
  const auto generation = [](const std::string& id_styp, const std::string& irigid) {
    return "*INITIAL_VELOCITY_GENERATION\n" + id_styp + ",3.0,5.0,6.0,7.0\n0.0,1.0,0.0,0.0,0.0,2.0,0," +
           irigid + "\n";
  };
  for (const char* id : {"0,1", "4,1", "1,2", "5,3"}) {
    expect(generation(id, "1"), spun, omega);
    expect(generation(id, "0"), own, own_omega);
  }
  expect(generation("6,3", "1"), own, own_omega);  // some of its nodes
  const auto plain = [](const std::string& box, const std::string& irigid) {
    return "*INITIAL_VELOCITY\n0,0," + box + "," + irigid + "\n5.0,6.0,7.0\n";
  };
  for (const char* irigid : {"4", "-1", "-2"}) {
    expect(plain("0", irigid), straight, Vec::Zero());
    expect(plain("7", irigid), straight, Vec::Zero());
  }
  expect(plain("8", "4"), own, own_omega);  // its centre is not in the box
  expect(plain("8", "-1"), own, own_omega);
  expect(plain("8", "-2"), straight, Vec::Zero());
  expect(plain("0", "0"), own, own_omega);
  // ICID: x along y, y along z, z along x
  const std::string system = "*DEFINE_COORDINATE_SYSTEM\n9,0,0,0,0,1,0\n0,0,1\n";
  expect(plain("0", "-2,9") + system, Vec(7, 5, 6), Vec::Zero());
  expect(plain("0", "-2") + generation("0,1", "1"), spun, omega);
  expect(generation("0,1", "1") + "*INITIAL_VELOCITY_RIGID_BODY\n1,1.0,1.0,1.0\n", Vec(1, 1, 1), Vec::Zero());
}

// NODEID is the centre whatever XC to ZC; IRCS 1: x along XL, z along XL x XLIP, or the axes of CID.
TEST(BodyTerms, GivenInertiaIsWhereAndAlongWhatItsCardSays) {
  Matrix local;
  local << 2, 0.3, 0, 0.3, 3, 0, 0, 0, 4;
  const RigidBody plain = given("0.3,0.2,0.1,10.0,0,0\n", "");
  EXPECT_NEAR((plain.x - Vec(0.3, 0.2, 0.1)).norm() + (plain.J0 - local).norm(), 0, 1e-12);
  EXPECT_NEAR((plain.v - Vec(1, 2, 3)).norm() + (plain.omega - Vec(0.5, -1, 2)).norm(), 0, 1e-12);
  const RigidBody at_node = given("0.3,0.2,0.1,10.0,0,8\n", "");
  EXPECT_NEAR((at_node.x - Vec(0.2, 0.4, 0.6)).norm(), 0, 1e-12);
  // x' along y, and the other vector in the plane y, -x: z' = y x (-x) = z, y' = z' x x' = -x
  const RigidBody turned = given("0.3,0.2,0.1,10.0,1,0\n", "0.0,2.0,0.0,-1.0,1.0,0.0\n");
  Matrix axes;
  axes << 0, -1, 0, 1, 0, 0, 0, 0, 1;
  EXPECT_NEAR((turned.J0 - axes * local * axes.transpose()).norm(), 0, 1e-12);
  // in the plane y, z: z' = y x z = x, y' = z' x x' = x x y = z
  const RigidBody other = given("0.3,0.2,0.1,10.0,1,0\n", "0.0,2.0,0.0,0.0,1.0,3.0\n");
  axes << 0, 0, 1, 1, 0, 0, 0, 1, 0;
  EXPECT_NEAR((other.J0 - axes * local * axes.transpose()).norm(), 0, 1e-12);
  const RigidBody system = given("0.3,0.2,0.1,10.0,1,0\n", "0.0,0.0,0.0,0.0,0.0,0.0,7\n",
                                 "*DEFINE_COORDINATE_SYSTEM\n7,0.0,0.0,0.0,0.0,1.0,0.0\n0.0,0.0,1.0\n");
  EXPECT_NEAR((system.J0 - axes * local * axes.transpose()).norm(), 0, 1e-12);
}

// Two bricks of densities 1000 and 3000 as one body, and what holds nodes of it: RC about x of the centre.
TEST(BodyTerms, PartsOfABodyWeighByTheirOwnDensity) {
  for (const bool share_nodes : {false, true}) {
    const Real second = share_nodes ? 0.3 : 0.5;  // its centre
    test::SolidDeck deck;
    deck.block(Vec(share_nodes ? 0.4 : 0.2, 0.2, 0.2), share_nodes ? 2 : 1, 1, 1, 1);
    if (share_nodes)
      deck.elements.replace(deck.elements.find('\n') + 9, 8, "       2");
    else
      deck.block(Vec(0.2, 0.2, 0.2), 1, 1, 1, 2, [](const Vec& x) { return Vec(x + Vec(0.4, 0, 0)); });
    deck.cards =
        "*SECTION_SOLID\n1,1\n*PART\none\n1,1,1\n*PART\ntwo\n2,1,2\n*MAT_RIGID\n1,1000.0,1.0E9,0.3\n0\n0\n"
        "*MAT_RIGID\n2,3000.0,1.0E9,0.3\n0\n0\n*CONSTRAINED_RIGID_BODIES\n1,2\n";
    const RigidBody b = simulation_of(deck.text(1))->bodies()->bodies().front();
    EXPECT_NEAR(b.m, 32, 1e-12);
    EXPECT_NEAR((b.x - Vec(0.25 * 0.1 + 0.75 * second, 0.1, 0.1)).norm(), 0, 1e-12) << share_nodes;
    const Matrix J = (8 + 24) * 0.04 / 6 * Matrix::Identity() + 8 * about(Vec(0.1 - b.x[0], 0, 0)) +
                     24 * about(Vec(second - b.x[0], 0, 0));
    EXPECT_NEAR((b.J0 - J).norm(), 0, 1e-12) << share_nodes;
  }
}

TEST(BodyTerms, SpcOfRotationsOfANodeHoldThoseOfItsBody) {
  for (const int axis : {0, 1, 2}) {
    test::SolidDeck deck;
    deck.block(Vec(0.2, 0.2, 0.2), 1, 1, 1, 1);
    deck.cards = "*SECTION_SOLID\n1,1\n*PART\none\n1,1,1\n*MAT_RIGID\n1,1000.0,1.0E9,0.3\n0\n0\n";
    std::string axes = ",0,0,0";
    axes[static_cast<std::size_t>(2 * axis + 1)] = '1';
    deck.cards += "*BOUNDARY_SPC_NODE\n3,0,0,0,0" + axes + "\n";
    const RigidBody b = simulation_of(deck.text(1))->bodies()->bodies().front();
    for (std::size_t k = 0; k < 3; ++k) {
      EXPECT_EQ(b.no_turn[k], static_cast<int>(k) == axis) << axis;
      EXPECT_FALSE(b.held[k]);
    }
  }
}

// Half of a free plate that swings is one body of its nodes: moments go from its shells to the body and back,
// so angular momentum stays. The spins of a step before are off by the square of the turn in a step.
TEST(BodyTerms, MomentsOfShellsTurnTheBodyOfTheirNodes) {
  test::ShellDeck deck;
  deck.plate(0.4, 0.2, 4, 2, 1);
  deck.part(1, 0.01, "*MAT_ELASTIC\n1,1000.0,1.0E8,0.3\n");
  deck.node_set(1, [](const Vec& x) { return x[0] < 0.11; });
  deck.cards += "*CONSTRAINED_NODAL_RIGID_BODY\n9,0,1\n";
  deck.velocity([](const Vec& x) { return Vec(0, 0, x[0] > 0.11 ? 3 * (x[0] - 0.11) : 0); });
  auto s = simulation_of(deck.text(1));
  const auto spin = [&](const World& world) {
    const auto* w = shared_fields::angular_velocity.find(world.nodes.fields);
    const auto* I = shared_fields::rotary_inertia.find(world.nodes.fields);
    Vec L = Vec::Zero();
    for (const RigidBody& b : s->bodies()->bodies()) L += b.L + b.m * b.x.cross(b.v);
    for (Index n = 0; n < world.nodes.size(); ++n)
      if (world.nodes.follow[n] == 0)
        L += world.nodes.m[n] * world.nodes.x.vec(n).cross(world.nodes.v.vec(n)) + (*I)[n] * w->vec(n);
    return L;
  };
  const Vec start = spin(s->world());
  Real turned = 0;
  for (int k = 0; k < 300; ++k) {
    s->step(do_nothing);
    turned = std::max(turned, s->bodies()->bodies()[0].L.norm());
  }
  EXPECT_GT(turned, 0.03 * start.norm());
  EXPECT_NEAR((spin(s->world()) - start).norm(), 0, 1e-4 * start.norm());
}

// Along held axes nothing moves a body: forces and moments on it, impulses before the start, and the ledger.
TEST(BodyTerms, HeldAxesTakeNothingUp) {
  JointDeck deck;
  deck.body({.x = {1, 2, 3}, .m = 2, .J = Vec(0.1, 0.2, 0.25).asDiagonal(), .con1 = 1, .con2 = 2});
  deck.more = "*LOAD_NODE_POINT\n1,1,3,4.0\n1,2,3,5.0\n1,3,3,6.0\n" + constant;
  auto s = simulation_of(deck.text(1));
  s->step(do_nothing);
  const RigidBody& b = s->bodies()->bodies()[0];
  const Vec r = s->world().nodes.x.vec(0) - b.x, moment = r.cross(Vec(4, 5, 6));
  EXPECT_NEAR((b.force - Vec(0, 5, 6)).norm(), 0, 1e-12);
  EXPECT_NEAR((b.moment - Vec(moment[0], 0, moment[2])).norm(), 0, 1e-3 * moment.norm())
      << "r of the step before";
  EXPECT_EQ(b.moment[1], 0);
  auto& bodies = const_cast<RigidBodies&>(*s->bodies());
  const Vec v = b.v, L = b.L;
  bodies.strike_at_start(0, Vec(1, 1, 1), Vec(0.1, 0.1, 0.1), s->world());
  EXPECT_NEAR((b.v - v - Vec(0, 0.5, 0.5)).norm(), 0, 1e-12);
  EXPECT_NEAR((b.L - L - Vec(0.1, 0, 0.1)).norm(), 0, 1e-12);
  for (std::size_t k = 0; k < b.nodes.size(); ++k)
    EXPECT_NEAR((s->world().nodes.v.vec(b.nodes[k]) - b.v - b.omega.cross(b.X[k])).norm(), 0, 1e-12);
  EXPECT_GT(b.omega.norm(), 0.1);

  JointDeck at_rest;
  at_rest.ground();
  EXPECT_EQ(simulation_of(at_rest.text(1))->bodies()->kinetic_energy(), 0);
}

// Of the half step: F (v + dt F/4m) dt/2 and M omega dt/2; below what leapfrog keeps by (F dt)^2/8m.
TEST(BodyTerms, TheLedgerOfAHalfStepIsThatOfItsForces) {
  JointDeck deck;
  deck.body({.m = 2, .J = Vec(0.1, 0.2, 0.25).asDiagonal(), .v = {1, 2, 3}, .omega = {0.3, 0, 0}});
  deck.more = "*LOAD_RIGID_BODY\n1,1,3,40.0\n1,5,3,0.7\n" + constant +
              "*CONTROL_TIMESTEP\n0.0,0.9,0,0.0,0.0,4\n*DEFINE_CURVE\n4\n0.0,0.01\n9.0,0.01\n";
  auto s = simulation_of(deck.text(1));
  s->step(do_nothing);
  s->step([&](World& world, const Clock& clock, const std::string&) {
    EnergyLedger ledger;
    s->bodies()->sample(world, clock, ledger);
    const RigidBody& b = s->bodies()->bodies()[0];
    const Real dt = clock.dt_old;
    EXPECT_NEAR(ledger.below, 0.125 * dt * dt / 2 * 1600, 1e-12);
    EXPECT_NEAR(ledger.half_step, 0.5 * dt * (40 * (b.v[0] + 0.25 * dt / 2 * 40) + 0.7 * b.omega[0]), 1e-12);
    EXPECT_NEAR(ledger.kinetic, b.v.squaredNorm() + 0.5 * b.omega.dot(b.L), 1e-12);
  });
}

// D of the axes on the centre, of the scales for rotations on the turning: v+ = ((1 - D dt/2) v- + F dt/m)/(1
// + D dt/2), and all that is missing of the energy is heat.
TEST(BodyTerms, DampingTakesWhatItBooks) {
  JointDeck deck;
  deck.body({.m = 2, .J = Vec(0.1, 0.2, 0.25).asDiagonal(), .v = {1, 2, 3}, .omega = {3, 0, 0}});
  deck.more =
      "*DAMPING_GLOBAL\n0,20.0,1.0,0.5,2.0,0.25,1.0,1.0\n*CONTROL_TIMESTEP\n0.0,0.9,0,0.0,0.0,4\n"
      "*DEFINE_CURVE\n4\n0.0,0.01\n9.0,0.01\n";
  auto s = simulation_of(deck.text(1));
  for (int k = 0; k < 5; ++k) s->step(do_nothing);
  s->step(do_nothing);
  const RigidBody& b = s->bodies()->bodies()[0];
  const Real dissipated = s->world().energy.dissipated;
  const Vec v = b.v, omega = b.omega;
  const Real energy = b.kinetic_energy();
  s->step(do_nothing);
  const Real dt = s->clock().dt_old;
  const auto left = [dt](Real D) { return (1 - 0.5 * dt * D) / (1 + 0.5 * dt * D); };
  EXPECT_NEAR((b.v - Vec(left(20) * v[0], left(10) * v[1], left(40) * v[2])).norm(), 0, 1e-12);
  EXPECT_NEAR((b.omega - left(5) * omega).norm(), 0, 1e-12);
  EXPECT_NEAR(s->world().energy.dissipated - dissipated, energy - b.kinetic_energy(), 1e-12);
}

// Both axes of the cross stay at right angles, while the body turns about them.
TEST(BodyTerms, UniversalJointsHoldTheCrossAtRightAngles) {
  JointDeck deck;
  const int ground = deck.ground(), a = deck.body({.omega = {0.3, 0.2, 0.1}});
  deck.joint("UNIVERSAL", ground, a, {Vec(0, 0, 0), Vec(0, 1, 0), Vec(0, 0, 1)});
  auto s = simulation_of(deck.text(1));
  const Joint& joint = test::joints_of(*s).all().front();
  const auto cross = [&] {
    const auto& bodies = s->bodies()->bodies();
    const Vec first = bodies[joint.a].q * Vec(joint.axes_a.col(2)),
              second = bodies[joint.b].q * Vec(joint.axes_b.col(2));
    return first.dot(second);
  };
  EXPECT_NEAR(cross(), 0, 1e-12);
  for (int k = 0; k < 50; ++k) s->step(do_nothing);
  EXPECT_NEAR(cross(), 0, 1e-9);
  EXPECT_GT(s->bodies()->bodies()[joint.b].omega.norm(), 0.05);
}

// Along x and z of the card's axes, A = y and V = -x: y' = -x, z' = z.
TEST(BodyTerms, LocalDrivesGoAlongTheAxesOfTheCard) {
  JointDeck deck;
  deck.body({});
  deck.parts += "0.0,1.0,0.0,-1.0,0.0,0.0\n";
  deck.more =
      "*BOUNDARY_PRESCRIBED_MOTION_RIGID_LOCAL\n1,1,0,8\n*BOUNDARY_PRESCRIBED_MOTION_RIGID_LOCAL\n1,2,0,9\n"
      "*DEFINE_CURVE\n8\n0.0,2.0\n9.0,2.0\n*DEFINE_CURVE\n9\n0.0,3.0\n9.0,3.0\n"
      "*CONTROL_TIMESTEP\n0.0,0.9,0,0.0,0.0,4\n*DEFINE_CURVE\n4\n0.0,0.01\n9.0,0.01\n";
  auto s = simulation_of(deck.text(1));
  s->step(do_nothing);
  EXPECT_NEAR((s->bodies()->bodies()[0].v - Vec(-3, 2, 0)).norm(), 0, 1e-12);
}

// Two driven axes of a body that is 100 times as easy to turn about the line between them: each answers the
// moment about the other nearly as its own, 49.5 beside 50.5.
TEST(BodyTerms, DrivenTurnsAnswerEachOther) {
  const Matrix turn = Eigen::AngleAxisd(std::atan(1.0), Vec::UnitZ()).toRotationMatrix();
  JointDeck deck;
  deck.body({.J = turn * Vec(0.01, 1, 1).asDiagonal() * turn.transpose()});
  deck.more =
      "*BOUNDARY_PRESCRIBED_MOTION_RIGID\n1,5,0,8\n*BOUNDARY_PRESCRIBED_MOTION_RIGID\n1,6,0,9\n"
      "*DEFINE_CURVE\n8\n0.0,2.0\n9.0,2.0\n*DEFINE_CURVE\n9\n0.0,-1.0\n9.0,-1.0\n"
      "*CONTROL_TIMESTEP\n0.0,0.9,0,0.0,0.0,4\n*DEFINE_CURVE\n4\n0.0,0.01\n9.0,0.01\n";
  auto s = simulation_of(deck.text(1));
  for (int k = 0; k < 3; ++k) s->step(do_nothing);
  const RigidBody& b = s->bodies()->bodies()[0];
  EXPECT_NEAR(b.omega[0], 2, 1e-9);
  EXPECT_NEAR(b.omega[1], -1, 1e-9);
}

}  // namespace body_terms_test
