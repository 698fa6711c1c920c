// Solids of *MAT_HONEYCOMB against their curves, in each direction, and compacted against plasticity.
#include <gtest/gtest.h>

#include <cmath>

#include "cube_decks.hpp"
#include "pressure_decks.hpp"
#include "same_bits.hpp"
#include "solid_decks.hpp"

using namespace courant;
using test::pull_of_cube;
using test::simulation_of;
using test::SolidDeck;

namespace {

constexpr Real crush_speed = 0.005;

/// Directions of the cards, and what else the material has.
struct HoneycombCard {
  std::string aopt = "0.0", a = "0.0,0.0,0.0", d = "0.0,0.0,0.0", v = "0.0,0.0,0.0";
  Real tsef = 0, ssef = 0, vf = 0.2;
  int lcsr = 0, bulk = 0;
  std::string text() const {
    return fmt::format(
        "*MAT_HONEYCOMB\n1,1.0,400.0,0.25,5.0,{},0.05,{}\n11,12,13,0,14,15,16,{}\n50.0,40.0,60.0,20.0,30.0,"
        "40.0,{}\n"
        "0.0,0.0,0.0,{}\n{},{},{},{}\n"
        "*DEFINE_CURVE\n11\n0.0,1.0\n0.5,2.0\n0.8,8.0\n*DEFINE_CURVE\n12\n-0.5,0.5\n0.5,0.7\n0.8,4.0\n"
        "*DEFINE_CURVE\n13\n0.2,9.0\n0.5,4.0\n1.0,3.0\n*DEFINE_CURVE\n14\n0.0,0.4\n0.8,4.0\n"
        "*DEFINE_CURVE\n15\n0.0,0.5\n0.8,4.0\n*DEFINE_CURVE\n16\n0.0,0.6\n0.8,4.0\n"
        "*DEFINE_CURVE\n17\n0.0,1.0\n0.01,2.0\n*DEFINE_COORDINATE_VECTOR\n5,1.0,0.0,0.0,0.0,1.0,0.0\n",
        vf, bulk, lcsr, aopt, a, d, tsef, ssef, v);
  }
};

/// Moved at that speed.
SolidDeck honeycomb_cube(int n, const std::string& material, Real speed, bool confined, int elform = 1) {
  return test::driven_cube(n, material, fmt::format("0.0,{0}\n1e9,{0}\n", speed), confined, elform);
}

}  // namespace

// a, b or c along the push: each follows its own curve of V, over 1 - V or over V, with areas as they were.
TEST(Honeycombs, AreCrushedByTheCurveOfEachDirection) {
  const std::string x = "1.0,0.0,0.0", y = "0.0,1.0,0.0", z = "0.0,0.0,1.0";
  struct Case {
    std::string a, d;
    Real at_half, at_03;
  };
  for (const Case& c : {Case{x, y, 2, 6}, Case{z, x, 0.7, 2.9}, Case{y, z, 4, 4 + 5 * 2.0 / 3}})
    for (const auto& [n, elform] : {std::pair(1, 1), {2, 1}, {1, 2}}) {
      HoneycombCard card;
      card.aopt = "2.0", card.a = c.a, card.d = c.d;
      auto s = simulation_of(honeycomb_cube(n, card.text(), -crush_speed, false, elform).text(1e9));
      test::start_ledger(*s);
      for (const auto& [crushed, stress] : {std::pair(0.5, c.at_half), {0.7, c.at_03}}) {
        test::run_until(*s, crushed / crush_speed);
        EXPECT_NEAR(pull_of_cube(*s, n), stress, 0.01 * stress) << n << c.a;
      }
      EXPECT_LT(test::energy_error(*s), 0.01);
    }
}

// At a hundred times that speed the curve alone pushes, with BULK 1 also 0.06 rho c v, c sqrt(400) at least.
TEST(Honeycombs, BulkViscosityActsWithBulk1Only) {
  for (const int bulk : {0, 1}) {
    HoneycombCard card;
    card.aopt = "2.0", card.a = "1.0,0.0,0.0", card.d = "0.0,1.0,0.0", card.bulk = bulk;
    constexpr Real v = 100 * crush_speed;
    auto s = simulation_of(honeycomb_cube(1, card.text(), -v, false).text(1e9));
    test::run_until(*s, 0.5 / v);
    const Real beyond_curve = pull_of_cube(*s, 1) - 2;
    if (bulk == 0)
      EXPECT_NEAR(beyond_curve, 0, 0.02);
    else
      EXPECT_GT(beyond_curve, 0.06 * 20 * v);
  }
}

// Held on all sides beyond VF: the deviator is SIGY, so that the push grows by K ln of the length.
TEST(Honeycombs, ThatAreCompactedAreElasticAndPerfectlyPlastic) {
  const Real K = 400 / 1.5;
  for (const auto& [n, elform] : {std::pair(1, 1), {2, 1}, {2, 2}}) {
    HoneycombCard card;
    card.vf = 0.5;
    auto s = simulation_of(honeycomb_cube(n, card.text(), -crush_speed, true, elform).text(1e9));
    test::run_until(*s, 0.56 / crush_speed);
    const Real early = pull_of_cube(*s, n);
    test::run_until(*s, 0.6 / crush_speed);
    const Real late = pull_of_cube(*s, n), grown = K * std::log(0.44 / 0.4);
    EXPECT_NEAR(late - early, grown, 0.01 * grown) << n;
    // and what it had when it was compacted is its mean and 2/3 SIGY more
    EXPECT_GT(late, K * std::log(0.5 / 0.4) + 2.0 / 3 * 5);
  }
}

// LAMBDA = 1 + 100 times the norm of the deviator of D, sqrt(2/3) v/l.
TEST(Honeycombs, AreStrongerAtHigherRates) {
  HoneycombCard card;
  card.lcsr = 17;
  for (const Real speed : {crush_speed, 3 * crush_speed}) {
    auto s = simulation_of(honeycomb_cube(1, card.text(), -speed, false).text(1e9));
    for (const Real l : {0.8, 0.5}) {
      test::run_until(*s, (1 - l) / speed);
      const Real force = (1 + 2 * (1 - l)) * (1 + 100 * std::sqrt(2.0 / 3) * speed / l);
      EXPECT_NEAR(pull_of_cube(*s, 1), force, 0.01 * force) << speed << " " << l;
    }
  }
}

// Nodes 1, 2, 4, vectors a and d, v x n, and a system: all have a along x. An angle of 90 degrees has b
// there.
TEST(Honeycombs, DirectionsSayTheSame) {
  std::vector<HoneycombCard> cards(5);
  cards[1].aopt = "2.0", cards[1].a = "1.0,0.0,0.0", cards[1].d = "0.3,1.0,0.0";
  cards[2].aopt = "3.0", cards[2].v = "0.0,1.0,0.0";
  cards[3].aopt = "-5.0";
  cards[4].aopt = "3.0", cards[4].v = "1.0,0.0,0.0";
  for (std::size_t k = 0; k < cards.size(); ++k) {
    auto s = simulation_of(honeycomb_cube(2, cards[k].text(), -crush_speed, false).text(1e9));
    test::run_until(*s, 0.5 / crush_speed);
    EXPECT_NEAR(pull_of_cube(*s, 2), k < 4 ? 2 : 0.7, 0.02) << k;
  }
}

// A cube sheared between held faces z = 0 and 1: GCAU gamma, then the stress of LCCA at V = 1.
TEST(Honeycombs, AreShearedByTheCurveOfShear) {
  for (const int elform : {1, 2}) {
    SolidDeck deck;
    deck.block(Vec(1, 1, 1), 1, 1, 1, 1);
    deck.cards = fmt::format("*PART\ncube\n1,1,1\n*SECTION_SOLID\n1,{}\n{}", elform, HoneycombCard().text());
    deck.node_set(1, [](const Vec& x) { return x[2] < 0.5; });
    deck.node_set(2, [](const Vec& x) { return x[2] > 0.5; });
    deck.cards +=
        "*BOUNDARY_SPC_SET\n1,0,1,1,1\n2,0,0,1,1\n*BOUNDARY_PRESCRIBED_MOTION_SET\n2,1,0,1\n"
        "*DEFINE_CURVE\n1\n0.0,0.001\n1e9,0.001\n";
    auto s = simulation_of(deck.text(1e9));
    for (const auto& [gamma, tau] : {std::pair(0.01, 0.4), {0.04, 0.6}}) {
      test::run_until(*s, gamma / 0.001);
      Real sum = 0;
      for (const int corner : {4, 5, 6, 7}) sum -= s->world().groups[0]->corner_force->data(3 * corner)[0];
      EXPECT_NEAR(sum, tau, 0.01 * tau) << gamma;
    }
  }
}

// Pulled along a it goes at ln l = TSEF.
TEST(Honeycombs, FailByTensileStrain) {
  for (const auto& [n, elform] : {std::pair(1, 1), {1, 2}}) {
    HoneycombCard card;
    card.tsef = 0.1;
    auto s = simulation_of(honeycomb_cube(n, card.text(), crush_speed, false, elform).text(1e9));
    test::start_ledger(*s);
    while (s->world().counters["deleted_elements"] == 0 && s->clock().t < 40) s->step(test::do_nothing);
    EXPECT_NEAR(std::log(1 + crush_speed * s->clock().t), 0.1, 0.003) << n;
  }
}

TEST(Honeycombs, HaveTheSameBitsOnAnyNumberOfThreadsAndAfterARestart) {
  for (const int elform : {1, 2}) {
    SolidDeck deck;
    deck.block(Vec(4, 3, 2), 8, 6, 4, 1);
    HoneycombCard card;
    card.aopt = "2.0", card.a = "1.0,0.5,0.2", card.d = "0.0,1.0,0.3", card.ssef = 0.2;
    deck.cards = fmt::format("*PART\nblock\n1,1,1\n*SECTION_SOLID\n1,{}\n{}", elform, card.text());
    deck.cards += "*INITIAL_VELOCITY\n0\n-2.0,0.5,-1.0\n*RIGIDWALL_PLANAR\n0\n-0.01,0.0,0.0,1.0,0.0,0.0\n";
    test::expect_same_bits(deck.text(100), 60, 25);
  }
}
