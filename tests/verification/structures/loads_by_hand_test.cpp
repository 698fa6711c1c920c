// Loads, damping and supports of nodes against sums by hand.
#include <gtest/gtest.h>

#include <cmath>

#include "beam_decks.hpp"
#include "shell_decks.hpp"
#include "solid_decks.hpp"
#include "state/shared_fields.hpp"

using namespace courant;
using test::do_nothing;
using test::ShellDeck;
using test::simulation_of;
using test::SolidDeck;
using test::start_ledger;

namespace loads_by_hand_test {
namespace {

const std::string block = "*SECTION_SOLID\n1,1\n*PART\nblock\n1,1,1\n*MAT_ELASTIC\n1,1000.0,1.0E7,0.3\n";
const std::string turned = "*DEFINE_COORDINATE_SYSTEM\n7,0.0,0.0,0.0,0.0,1.0,0.0\n0.0,0.0,1.0\n";
const std::string constant = "*DEFINE_CURVE\n1\n0.0,1.0\n9.0,1.0\n";

Vec momentum_of(const World& world) {
  Vec p = Vec::Zero();
  for (Index n = 0; n < world.nodes.size(); ++n) p += world.nodes.m[n] * world.nodes.v.vec(n);
  return p;
}

}  // namespace

// Axes of the system: x' = y, y' = z, z' = x. Before anything yields, only along that of the load.
TEST(LoadsByHand, ForcesAndMomentsAreAlongTheAxesOfTheirSystem) {
  for (const int axis : {0, 1, 2})
    for (const bool moment : {false, true}) {
      ShellDeck deck;
      deck.plate(1, 1, 2, 2, 1);
      deck.part(1, 0.1, "*MAT_ELASTIC\n1,1000.0,1.0E9,0.3\n");
      deck.cards +=
          fmt::format("*LOAD_NODE_POINT\n5,{},1,3.0,7\n", axis + (moment ? 5 : 1)) + turned + constant;
      auto s = simulation_of(deck.text(1));
      s->step(do_nothing);
      const Field<Real>& rate =
          moment ? *shared_fields::angular_velocity.find(s->world().nodes.fields) : s->world().nodes.v;
      const Vec v = rate.vec(4);
      EXPECT_GT(v[(axis + 1) % 3], 0) << axis << moment;
      EXPECT_NEAR(v[(axis + 2) % 3], 0, 1e-15) << axis << moment;
      EXPECT_NEAR(v[axis], 0, 1e-15) << axis << moment;
    }
}

// A plate turns by a quarter about x before a moment about its normal begins, which then is along -y or y.
TEST(LoadsByHand, AFollowerMomentTurnsWithItsNodes) {
  const auto plate = [](const std::string& load) {
    ShellDeck deck;
    deck.plate(1, 1, 2, 2, 1);
    deck.part(1, 0.1, "*MAT_ELASTIC\n1,1000.0,1.0E9,0.3\n");
    const Real omega = 0.5 * M_PI / 0.05;
    deck.cards += fmt::format("*INITIAL_VELOCITY_GENERATION\n1,2,{:.10g}\n0.0,0.5,0.0,1.0,0.0,0.0\n", omega) +
                  load + "*DEFINE_CURVE\n1\n0.0,0.0\n0.05,0.0\n0.0501,1.0\n9.0,1.0\n";
    return simulation_of(deck.text(1));
  };
  const auto with = plate("*LOAD_NODE_POINT\n5,8,1,3.0,0,1,3,7\n"), without = plate("");
  const auto rate = [](Simulation& s) {
    return Vec(shared_fields::angular_velocity.find(s.world().nodes.fields)->vec(4));
  };
  while (with->clock().t < 0.05) with->step(do_nothing), without->step(do_nothing);
  EXPECT_EQ(rate(*with), rate(*without)) << "no moment yet";
  const Nodes& nodes = with->world().nodes;
  const Vec normal = (nodes.x.vec(2) - nodes.x.vec(0)).cross(nodes.x.vec(6) - nodes.x.vec(0)).normalized();
  ASSERT_LT(std::abs(normal[2]), 0.1) << "it has turned";
  with->step(do_nothing), without->step(do_nothing);
  with->step(do_nothing), without->step(do_nothing);
  const Vec change = rate(*with) - rate(*without);
  EXPECT_GT(change.dot(normal), 0);
  EXPECT_LT(change.cross(normal).norm(), 0.02 * change.norm());
}

// A pressure of 2 (t - AT) from AT on presses on 0.04: the momentum of the free block is 0.04 (t - AT)^2.
TEST(LoadsByHand, PressureBeginsWithItsCurveAtItsTime) {
  SolidDeck deck;
  deck.block(Vec(0.2, 0.2, 0.2), 1, 1, 1, 1);
  deck.cards = block + "*LOAD_SEGMENT\n3,2.0,0.01,1,2,4,3\n*DEFINE_CURVE\n3\n0.0,0.0\n9.0,9.0\n";
  auto s = simulation_of(deck.text(1));
  start_ledger(*s);
  while (s->clock().t < 0.01) {
    EXPECT_EQ(momentum_of(s->world()).norm(), 0) << s->clock().t;
    s->step(do_nothing);
  }
  while (s->clock().t < 0.05) s->step(do_nothing);
  const Real t = s->clock().t - 0.5 * s->clock().dt_old - 0.01;
  EXPECT_NEAR(momentum_of(s->world()).norm(), 0.04 * t * t, 2e-3 * 0.04 * t * t);
  EXPECT_LT(test::energy_error_of_a_step(*s), 1e-3);
}

// Damping takes nothing from what supports hold: they carry the weight.
TEST(LoadsByHand, SupportsCarryTheWholeWeightUnderDamping) {
  SolidDeck deck;
  deck.block(Vec(0.2, 0.2, 0.2), 1, 1, 1, 1);
  deck.node_set(1, [](const Vec&) { return true; });
  deck.cards += block + "*LOAD_BODY_Z\n1,9.81\n" + constant +
                "*BOUNDARY_SPC_SET\n1,0,0,0,1\n*DAMPING_GLOBAL\n0,400.0\n*DATABASE_SPCFORC\n1.0e-3\n"
                "*INITIAL_VELOCITY\n0\n1.0\n";
  auto s = simulation_of(deck.text(1));
  for (int k = 0; k < 5; ++k) {
    Vec sum = Vec::Zero();
    s->step([&](World&, const Clock&, const std::string& who) {
      for (const BoundaryForce& one : s->sample(who).boundary_forces) sum += one.force;
    });
    EXPECT_NEAR((sum - Vec(0, 0, 1000 * 0.008 * 9.81)).norm(), 0, 1e-10) << k;
  }
  EXPECT_LT(s->world().nodes.v.data(0)[0], 0.99) << "along x it is damped";
}

// A beam that spins about itself without a strain: exp(-D SRX t) of its rate is left, whatever STX is.
TEST(LoadsByHand, RotationsAreDampedByTheirOwnScale) {
  test::beams::BeamDeck deck;
  deck.part(1, test::beams::square_1, test::beams::steel_of_beams);
  deck.line(2, 0.2, [](int) { return ""; });
  deck.cards += "*DAMPING_GLOBAL\n0,1000.0,0.0,0.0,0.0,0.5,0.0,0.0\n";
  auto s = simulation_of(deck.text(1));
  Field<Real>& spin = *shared_fields::angular_velocity.find(s->world().nodes.fields);
  for (Index n = 0; n < 3; ++n) spin.set(n, Vec(10, 0, 0)), s->world().nodes.v.set(n, Vec(0, 0, 1));
  start_ledger(*s);
  while (s->clock().t < 2e-3) s->step(do_nothing);
  EXPECT_NEAR(spin.data(0)[0], 10 * std::exp(-500 * (s->clock().t - 0.5 * s->clock().dt_old)), 0.002);
  EXPECT_NEAR(s->world().nodes.v.data(2)[1], 1, 1e-12);
  EXPECT_LT(test::energy_error_of_a_step(*s), 1e-3);
}

}  // namespace loads_by_hand_test
