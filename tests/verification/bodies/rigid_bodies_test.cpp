// Cards about rigid bodies as wholes: *PART_INERTIA, extra nodes, initial velocities, forces and moments.
#include <gtest/gtest.h>

#include "rigid/bodies/rigid.hpp"
#include "solid_decks.hpp"

using namespace courant;
using test::do_nothing;
using test::simulation_of;
using test::SolidDeck;

namespace {

const char* const rigid =
    "*SECTION_SOLID\n         1         1\n*MAT_RIGID\n         1    1000.0     1.0E9       0.3\n";
const char* const one =
    "*DEFINE_CURVE\n         1\n                 0.0                 1.0\n                10.0               "
    "  "
    "1.0\n";

/// A brick of 0.2 x 0.4 x 0.6, with the given cards.
std::unique_ptr<Simulation> brick(const std::string& part, const std::string& cards) {
  SolidDeck deck;
  deck.block(Vec(0.2, 0.4, 0.6), 2, 2, 2, 1);
  deck.cards = part + rigid + one + cards;
  return simulation_of(deck.text(1));
}
const std::string plain = "*PART\nbrick\n         1         1         1\n";

}  // namespace

TEST(RigidBodyCards, PartInertiaGivesMassCentreTensorAndVelocity) {
  // principal moments 2, 3, 4 along axes turned by 30 degrees about z
  const auto s = brick(
      "*PART_INERTIA\nbrick\n         1         1         1\n       0.1       0.2       0.3       7.0        "
      " 1\n"
      "       2.0       0.0       0.0       3.0       0.0       4.0\n       1.0       2.0       3.0       "
      "0.1     "
      "  0.2       0.3\n 0.8660254       0.5       0.0      -0.5       1.0       0.0\n",
      "");
  ASSERT_NE(s, nullptr);
  const RigidBody& b = s->bodies()->bodies().front();
  EXPECT_EQ(b.m, 7);
  EXPECT_EQ(b.x, Vec(0.1, 0.2, 0.3));
  EXPECT_EQ(b.v, Vec(1, 2, 3));
  EXPECT_NEAR((b.omega - Vec(0.1, 0.2, 0.3)).norm(), 0, 1e-12);
  Matrix expected;
  expected << 2.25, -0.25 * std::sqrt(3.0), 0, -0.25 * std::sqrt(3.0), 2.75, 0, 0, 0, 4;
  EXPECT_NEAR((b.J0 - expected).norm(), 0, 1e-7);  // eight figures of the cosine
  const Vec L = b.L;
  const Real energy = b.kinetic_energy();
  while (s->clock().t < 0.5) s->step(do_nothing);
  EXPECT_NEAR((b.L - L).norm(), 0, 1e-12 * L.norm());
  EXPECT_NEAR(b.kinetic_energy(), energy, 1e-4 * energy);
  EXPECT_NEAR((b.x - Vec(0.1, 0.2, 0.3) - s->clock().t * Vec(1, 2, 3)).norm(), 0, 1e-12);
}

TEST(RigidBodyCards, ForcesAndMomentsDoTheirWork) {
  const auto s =
      brick(plain,
            "*LOAD_RIGID_BODY\n         1         2         1      96.0\n         1         7         1   "
            "   16.0\n*INITIAL_VELOCITY_RIGID_BODY\n         1       1.0       0.0       0.0       0.0       "
            "0.0       0.5\n");
  const RigidBody& b = s->bodies()->bodies().front();
  EXPECT_NEAR((b.omega - Vec(0, 0, 0.5)).norm() + (b.v - Vec(1, 0, 0)).norm(), 0, 1e-12);
  std::string who;
  s->evaluate(who);
  sample_energy(s->world(), s->clock());
  EnergyLedger& e = s->world().energy;
  e.initial = e.total();
  Real kicked = 0, before = 0;
  while (s->clock().t < 0.5) {
    s->step(do_nothing);
    kicked += 0.5 * (before + s->clock().dt), before = s->clock().dt;
  }
  // m = 48, Jzz = 4 (0.2^2 + 0.4^2) = 0.8
  EXPECT_NEAR(b.v[1], 2 * kicked, 1e-11);
  EXPECT_NEAR(b.omega[2], 0.5 + 20 * kicked, 1e-10);
  EXPECT_EQ(b.v[0], 1);
  sample_energy(s->world(), s->clock());
  EXPECT_LT(std::abs(e.unexplained()), 1e-6 * e.kinetic);
}

// A deformable block hangs on a rigid one by the nodes of a face; a node of nothing goes along.
TEST(RigidBodyCards, ExtraNodesGoWithTheirBody) {
  SolidDeck deck;
  deck.block(Vec(0.2, 0.2, 0.2), 2, 2, 2, 1);
  deck.block(Vec(0.2, 0.2, 0.2), 2, 2, 2, 2, [](const Vec& x) { return Vec(x + Vec(0.2, 0, 0)); });
  deck.nodes.push_back(Vec(0.1, 0.1, 0.5));
  deck.cards =
      plain + rigid +
      "*PART\nsoft\n         2         1         2\n*MAT_ELASTIC\n         2    1000.0     1.0E6       0.3\n"
      "*CONSTRAINED_EXTRA_NODES_SET\n         1         1\n*CONSTRAINED_EXTRA_NODES_NODE\n         1        "
      "55\n*INITIAL_VELOCITY_RIGID_BODY\n         1       0.0       0.0       0.0       0.0       1.0       "
      "0.0\n";
  // of the soft block alone: those after the first 27
  std::size_t number = 0;
  deck.node_set(1, [&](const Vec& x) { return ++number > 27 && number < 55 && x[0] < 0.2 + 1e-9; });
  auto s = simulation_of(deck.text(1));
  ASSERT_NE(s, nullptr);
  const RigidBody& b = s->bodies()->bodies().front();
  EXPECT_EQ(b.nodes.size(), 27u + 9u + 1u);
  const Nodes& nodes = s->world().nodes;
  EXPECT_NEAR(b.m, 8 + 2, 1e-12);  // a quarter of the soft block is at those nodes
  const auto moments = [&] {
    Vec p = b.m * b.v, L = b.L + b.x.cross(b.m * b.v);
    for (Index n = 0; n < nodes.size(); ++n)
      if (!nodes.follow[n])
        p += nodes.m[n] * nodes.v.vec(n), L += nodes.m[n] * nodes.x.vec(n).cross(nodes.v.vec(n));
    return std::pair(p, L);
  };
  std::string who;
  s->evaluate(who);
  const auto [p0, L0] = moments();
  const Vec arm = nodes.x.vec(nodes.size() - 1) - b.x;
  while (s->clock().t < 0.2) s->step(do_nothing);
  const auto [p, L] = moments();
  EXPECT_NEAR((p - p0).norm(), 0, 1e-10);
  EXPECT_NEAR((L - L0).norm(), 0, 2e-3 * L0.norm());  // places and velocities are half a step apart
  EXPECT_NEAR((nodes.x.vec(nodes.size() - 1) - b.x - b.q * arm).norm(), 0, 1e-12);
}

namespace {

const char* const given =
    "*PART_INERTIA\nbrick\n         1         1         1\n       0.1       0.2       0.3       7.0\n"
    "       2.0       0.1       0.2       3.0       0.3       4.0\n\n";

}  // namespace

// Weight acts on the given mass, not on that of the elements, of which the part has 48.
TEST(RigidBodyCards, WeightOfAPartActsOnTheGivenMass) {
  for (const char* curve : {"1", "0"}) {  // without a curve at all times
    const auto s = brick(given, fmt::format("*LOAD_GRAVITY_PART\n1,3,{},2.0\n", curve));
    const RigidBody& b = s->bodies()->bodies().front();
    test::start_ledger(*s);
    while (s->clock().t < 0.5) s->step(do_nothing);
    EXPECT_NEAR(b.force[2], -14, 1e-12);
    EXPECT_NEAR(b.moment.norm(), 0, 1e-12);
    sample_energy(s->world(), s->clock());
    EXPECT_LT(std::abs(s->world().energy.unexplained()), 1e-9 * s->world().energy.kinetic);
  }
}

// In a frame that turns with w: force m w^2 r of the centre, moment -w x J w.
TEST(RigidBodyCards, ATurningFrameActsOnTheGivenInertia) {
  const auto s = brick(given, "*LOAD_BODY_RX\n         1       3.0\n");
  const RigidBody& b = s->bodies()->bodies().front();
  test::start_ledger(*s);
  const Vec w(3, 0, 0);
  EXPECT_NEAR((b.force - 7 * 9 * Vec(0, 0.2, 0.3)).norm(), 0, 1e-12);
  EXPECT_NEAR((b.moment + w.cross(Vec(b.J0 * w))).norm(), 0, 1e-11);
  while (s->clock().t < 0.5) s->step(do_nothing);
  sample_energy(s->world(), s->clock());
  EXPECT_LT(std::abs(s->world().energy.unexplained()), 1e-4 * s->world().energy.kinetic);
}

// A part of an elastic material that is switched moves as a rigid body of that mass and inertia.
TEST(RigidBodyCards, ADeformablePartMayBeRigidFromTheStart) {
  SolidDeck deck;
  deck.block(Vec(0.2, 0.4, 0.6), 2, 2, 2, 1);
  deck.cards =
      plain +
      "*SECTION_SOLID\n         1         1\n*MAT_ELASTIC\n         1    1000.0     1.0E9       0.3\n"
      "*DEFORMABLE_TO_RIGID\n         1         0PART\n"
      "*INITIAL_VELOCITY_RIGID_BODY\n         1       1.0       2.0       3.0       0.5       0.0       "
      "0.0\n";
  const auto s = simulation_of(deck.text(1));
  ASSERT_NE(s, nullptr);
  EXPECT_TRUE(s->world().groups.empty()) << "no element deforms";
  const RigidBody& b = s->bodies()->bodies().front();
  EXPECT_NEAR(b.m, 48, 1e-12);
  EXPECT_NEAR(b.J0(0, 0), 4 * (0.16 + 0.36), 1e-12);
  EXPECT_NEAR(b.c2, 1e6, 1e-6);
  while (s->clock().t < 0.5) s->step(do_nothing);
  EXPECT_NEAR((b.x - Vec(0.1, 0.2, 0.3) - s->clock().t * Vec(1, 2, 3)).norm(), 0, 1e-12);
  EXPECT_NEAR(b.omega[0], 0.5, 1e-12);
}

// Turns that SPC holds of a node are those of its body, also where no node of the scene turns by itself.
TEST(RigidBodies, ANodeHeldInItsTurnsHoldsThoseOfABodyOfSolids) {
  const std::string numbers = "\n         1    1000.0     1.0E9       0.3\n";
  for (const std::string& rigid :
       {"*MAT_RIGID" + numbers,
        "*MAT_ELASTIC" + numbers + "*DEFORMABLE_TO_RIGID\n         1         0PART\n"}) {
    SolidDeck deck;
    deck.block(Vec(0.2, 0.4, 0.6), 1, 1, 1, 1);
    deck.cards =
        plain + "*SECTION_SOLID\n         1         1\n" + rigid +
        "*INITIAL_VELOCITY_RIGID_BODY\n         1       1.0       2.0       3.0       0.5       0.7       "
        "0.9\n"
        "*BOUNDARY_SPC_NODE\n         1         0         0         0         0         1         0         "
        "1\n";
    const auto s = simulation_of(deck.text(1));
    ASSERT_NE(s, nullptr) << rigid;
    while (s->clock().t < 0.1) s->step(do_nothing);
    const RigidBody& b = s->bodies()->bodies().front();
    EXPECT_EQ(b.omega[0], 0) << rigid;
    EXPECT_NE(b.omega[1], 0) << rigid;
    EXPECT_EQ(b.omega[2], 0) << rigid;
    EXPECT_NEAR((b.x - Vec(0.1, 0.2, 0.3) - s->clock().t * Vec(1, 2, 3)).norm(), 0, 1e-12) << rigid;
  }
}

// CMO -1: along a system whose x is y, whose y is -x, and about whose z: the same as 4 (xy) and 3 (z) with
// CMO 1.
TEST(RigidBodies, HeldAlongASystem) {
  const auto places = [](const std::string& line) {
    auto s = test::simulation_of(
        "*KEYWORD\n*CONTROL_TERMINATION\n1.0\n*PART\nplate\n1,1,1\n*SECTION_SHELL\n1,2\n0.01\n*MAT_RIGID\n1,"
        "1000.0,"
        "1.0E9,0.3\n" +
        line +
        "*DEFINE_COORDINATE_SYSTEM\n4,0.0,0.0,0.0,0.0,1.0,0.0\n-1.0,0.0,0.0\n"
        "*NODE\n1,0.0,0.0,0.0\n2,1.0,0.0,0.0\n3,1.0,1.0,0.0\n4,0.0,1.0,0.0\n*ELEMENT_SHELL\n"
        "       1       1       1       2       3       "
        "4\n*INITIAL_VELOCITY_GENERATION\n1,2,3.0,1.0,2.0,3.0\n"
        "0.0,0.0,0.0,0.3,0.5,1.0\n*END\n");
    while (s->clock().t < 0.2) s->step(test::do_nothing);
    std::vector<Vec> out;
    for (Index n = 0; n < 4; ++n) out.push_back(s->world().nodes.x.vec(n));
    return out;
  };
  EXPECT_TRUE(places("-1.0,4.0,110001\n") == places("1.0,4.0,3.0\n"));
  EXPECT_TRUE(places("-1.0,4.0,010000\n") == places("1.0,1.0,0.0\n"));
  EXPECT_TRUE(places("-1.0,4.0,000100\n") == places("1.0,0.0,2.0\n"));
  EXPECT_FALSE(places("-1.0,4.0,000100\n") == places("1.0,0.0,1.0\n"));
}
