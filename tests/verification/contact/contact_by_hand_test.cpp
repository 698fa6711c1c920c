// Ties and edges against hand calculation.
#include <gtest/gtest.h>

#include <cmath>

#include "beam_decks.hpp"
#include "solid_decks.hpp"
#include "state/reports.hpp"

using namespace courant;
using test::do_nothing;
using test::simulation_of;
using test::SolidDeck;
using test::beams::BeamDeck;

namespace contact_by_hand_test {
namespace {

InterfaceForce interface_of(const Simulation& s) {
  return s.world().passes.all<const InterfaceReporter>().front()->report();
}

/// Two rods of one element each, of length 0.2, that cross in their middles, the upper one of another
/// density. It comes down at 1, and moves along itself at `along`.
BeamDeck two_rods(Real density, Real along, const std::string& contact) {
  BeamDeck deck;
  const Real r = std::sqrt(1e-4 / pi);
  deck.part(1, test::beams::square_1, test::beams::steel_of_beams);
  deck.cards += "*PART\nupper\n2,1,2\n" + fmt::format("*MAT_ELASTIC\n2,{},2.1E+11,0.3\n", density);
  for (const Real side : {-0.1, 0.1}) deck.at({side, 0, 2 * r + 1e-5});
  for (const Real side : {-0.1, 0.1}) deck.at({0, side, 0});
  deck.at({0, 0, 1}, ",7,7");
  deck.beam(2, 1, 2, 5), deck.beam(1, 3, 4, 5);
  deck.velocity([&](int n) { return n < 3 ? Vec(along, 0, -1) : Vec(Vec::Zero()); });
  deck.cards += contact;
  return deck;
}
/// All that acts on the upper rod: contact, as its own forces sum up to 0.
Vec on_upper(const World& world) {
  return world.nodes.f.vec(0) + world.nodes.f.vec(1);
}
/// Of the first step that finds them in touch: force on the upper rod, and how fast it comes and slides.
struct FirstTouch {
  Vec force = Vec::Zero(), v = Vec::Zero();
  Real dt = 0, stored = 0;
};
FirstTouch first_touch(const std::string& deck) {
  auto s = simulation_of(deck);
  FirstTouch out;
  for (int k = 0; k < 1000 && out.stored == 0; ++k)
    s->step([&](World& world, const Clock& clock, const std::string&) {
      const InterfaceForce one = interface_of(*s);
      out.stored = one.energy_stored;
      if (out.stored == 0) return;
      out.force = on_upper(world), out.dt = clock.dt_old;
      const auto v = [&](Index n) { return world.nodes.v.vec(n); };
      out.v = 0.5 * (v(0) + v(1)) - 0.5 * (v(2) + v(3));
    });
  return out;
}

}  // namespace

// The step, and so all up to the first touch, is the same with damping and without: the forces differ by
// 2 xi m omega v, m the lighter of the two, omega of the spring 0.1 K A/L between both.
TEST(ContactByHand, EdgesAreDampedByTheLighterAtTheFrequencyOfBoth) {
  for (const Real density : {7850.0, 800.0, 40000.0}) {
    const auto touch = [&](Real vdc) {
      return first_touch(
          two_rods(density, 0,
                   fmt::format(
                       "*CONTROL_TIMESTEP\n0.0,0.1\n*CONTACT_AUTOMATIC_GENERAL\n0\n0.0,0.0,,,{}\n1.0\n", vdc))
              .text(1));
    };
    const FirstTouch plain = touch(0), damped = touch(20);
    ASSERT_GT(plain.stored, 0);
    const Real k = 0.1 * 1.75e11 * 1e-4 / 0.2, upper = density * 1e-4 * 0.2, lower = 7850 * 1e-4 * 0.2;
    const Real omega = std::sqrt(k * (1 / upper + 1 / lower));
    const Real expected = 2 * 0.2 * std::min(upper, lower) * omega * std::abs(damped.v[2]);
    EXPECT_NEAR((damped.force[2] - plain.force[2]) / expected, damped.force[2] > 0 ? 1 : -1, 1e-6) << density;
  }
}

// A stress VC on what edges show of themselves, 2 r L of a rod, bounds their friction.
TEST(ContactByHand, FrictionOfEdgesIsBoundedByAStress) {
  const auto slid = [](Real vc) {
    auto s = simulation_of(
        two_rods(7850, 5, fmt::format("*CONTACT_AUTOMATIC_GENERAL\n0\n0.9,0.9,0.0,{},0.0\n1.0\n", vc))
            .text(1));
    Real most = 0;
    for (int k = 0; k < 40; ++k) {
      s->step([&](World& world, const Clock&, const std::string&) {
        most = std::max(most, std::hypot(on_upper(world)[0], on_upper(world)[1]));
      });
    }
    return most;
  };
  const Real area = 2 * std::sqrt(1e-4 / pi) * 0.2;
  const Real free = slid(0);
  EXPECT_NEAR(slid(0.3 * free / area) / (0.3 * free), 1, 1e-6);
}

// At its death what edges store is lost.
TEST(ContactByHand, EdgesLoseWhatTheyStoreAtTheirDeath) {
  auto s = simulation_of(
      two_rods(7850, 0,
               "*CONTROL_TIMESTEP\n0.0,0.1\n*CONTACT_AUTOMATIC_GENERAL\n0\n0.0,0.0,,,0.0,,0.0,6.0e-5\n1.0\n")
          .text(1));
  test::start_ledger(*s);
  Real stored = 0;
  while (s->clock().t < 6e-5) {
    s->step(do_nothing);
    if (s->clock().t < 6e-5) stored = interface_of(*s).energy_stored;
  }
  ASSERT_GT(stored, 0);
  s->step(do_nothing);
  EXPECT_EQ(interface_of(*s).energy_stored, 0);
  EXPECT_NEAR(s->world().energy.dissipated / stored, 1, 0.3);  // it grew for one more step
  EXPECT_EQ(interface_of(*s).energy_damping, s->world().energy.dissipated);
  EXPECT_LT(test::energy_error_of_a_step(*s), 0.02);
}

// Each of four nodes of a cube that is led off along x and z alike has the force F on each axis: it breaks
// where F/600 + (F/300)^3 is 1. Led back into the face, at (F/300)^3 alone.
TEST(ContactByHand, TiesBreakByTheirExponents) {
  for (const Real side : {1.0, -1.0}) {
    SolidDeck deck;
    deck.block(Vec(1, 1, 1), 1, 1, 1, 1);
    deck.block(Vec(1, 1, 1), 1, 1, 1, 2, [](const Vec& x) { return Vec(x + Vec(0, 0, 1)); });
    deck.cards =
        "*SECTION_SOLID\n1,1\n*PART\nbelow\n1,1,1\n*PART\nabove\n2,1,1\n*MAT_ELASTIC\n1,1000.0,1.0E6,0.0\n"
        "*CONTACT_TIEBREAK_NODES_TO_SURFACE_ID\n7,glue\n2,1,3,3\n\n\n600.0,300.0,1.0,3.0\n"
        "*CONTROL_TIMESTEP\n0.0,0.2\n*DEFINE_CURVE\n1\n0.0,1.0\n9.0,1.0\n"
        "*BOUNDARY_SPC_SET\n1,0,1,1,1\n"
        "*BOUNDARY_PRESCRIBED_MOTION_SET\n2,1,0,1,0.01\n" +
        fmt::format("2,3,0,1,{}\n", 0.01 * side);
    for (const int set : {1, 2}) {
      deck.cards += fmt::format("*SET_NODE_LIST\n{}\n", set);
      for (int n = 1; n <= 8; ++n) deck.cards += fmt::format("{}{}", 8 * (set - 1) + n, n == 8 ? "\n" : ",");
    }
    deck.cards += "*BOUNDARY_SPC_SET\n2,0,0,1,0\n";
    auto s = simulation_of(deck.text(10));
    Vec last = Vec::Zero();
    for (int k = 0; k < 20000 && s->world().counters["broken_ties"] == 0; ++k) {
      s->step(do_nothing);
      for (const auto* reporter : s->world().passes.all<const InterfaceReporter>())
        if (const Vec f = reporter->report().on_surfa; f[0] != 0 && s->world().counters["broken_ties"] == 0)
          last = f;
    }
    ASSERT_EQ(s->world().counters["broken_ties"], 4) << side;
    const Real F = std::abs(last[0]) / 4;
    EXPECT_NEAR((side > 0 ? F / 600 : 0) + std::pow(F / 300, 3), 1, 0.02) << side;
  }
}

}  // namespace contact_by_hand_test
