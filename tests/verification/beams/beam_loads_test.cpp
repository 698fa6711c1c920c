// *LOAD_BEAM_ELEMENT and _SET: forces per length on beams.
#include <gtest/gtest.h>

#include <cmath>

#include "beam_decks.hpp"
#include "same_bits.hpp"
#include "solid_decks.hpp"

using namespace courant;
using test::do_nothing;
using test::simulation_of;
using test::start_ledger;
using test::beams::BeamDeck;

namespace {

/// A cantilever of length 1, EI 175, EA 2.1e7, loaded along an axis by 8 per length.
BeamDeck loaded_cantilever(int n, const std::string& section, int axis, bool by_set,
                           const std::string& more) {
  BeamDeck deck;
  deck.line(n, 1, [](int k) { return k == 0 ? ",7,7" : ""; });
  deck.part(1, section, test::beams::steel_of_beams);
  deck.cards += "*DEFINE_CURVE\n1\n0.0,4.0\n9.0,4.0\n" + more;
  if (by_set) {
    deck.cards += fmt::format("*LOAD_BEAM_SET\n3,{},1,2.0\n*SET_BEAM\n3\n", axis);
    for (int k = 1; k <= n; ++k) deck.cards += fmt::format("{:10}{}", k, k % 8 == 0 || k == n ? "\n" : "");
  } else {
    deck.cards += "*LOAD_BEAM_ELEMENT\n";
    for (int k = 1; k <= n; ++k) deck.cards += fmt::format("{},{},1,2.0\n", k, axis);
  }
  return deck;
}

}  // namespace

// At rest the end has moved by q L^4/(8 EI) along s or t, or by q L^2/(2 EA) along r, as at every node.
TEST(BeamLoads, BendAndPullACantilever) {
  for (const bool resultants : {false, true})
    for (const int axis : {1, 2, 3})
      for (const auto& [n, bound] : {std::pair(5, 0.02), {10, 0.005}}) {
        if (n == 10 && axis != 2) continue;
        const std::string& section = resultants ? test::beams::square_2 : test::beams::square_1;
        const std::string damping = axis == 1 ? "*DAMPING_GLOBAL\n0,9000.0\n" : "*DAMPING_GLOBAL\n0,105.0\n";
        auto s = simulation_of(loaded_cantilever(n, section, axis, axis == 3, damping).text(1));
        start_ledger(*s);
        while (s->clock().t < (axis == 1 ? 2e-3 : 0.3)) s->step(do_nothing);
        const Vec u = s->world().nodes.x.vec(n) - Vec(1, 0, 0);
        const Real theory = axis == 1 ? 8 / (2 * 2.1e7) : 8 / (8 * 175.0);
        EXPECT_NEAR(u[axis - 1] / theory, 1, axis == 1 ? 1e-3 : bound) << resultants << axis << n;
        EXPECT_LT(test::energy_error_of_a_step(*s), 1e-3) << resultants << axis;
      }
}

// The load turns with the beam: a free one that is turned by 90 degrees is pushed along -x by what pushed it
// along y.
TEST(BeamLoads, TurnWithTheBeam) {
  BeamDeck deck;
  deck.line(4, 1, [](int) { return ""; });
  deck.part(1, test::beams::square_1, test::beams::steel_of_beams);
  deck.cards +=
      "*DEFINE_CURVE\n1\n0.0,0.0\n0.01,0.0\n0.0101,1.0\n9.0,1.0\n*LOAD_BEAM_ELEMENT\n1,2,1\n2,2,1\n3,2,1\n4,"
      "2,1\n";
  const Real w = 0.5 * pi / 0.01;  // a quarter of a turn by then
  deck.cards += fmt::format("*INITIAL_VELOCITY_GENERATION\n1,2,{:.12g}\n0.5,0.0,0.0,0.0,0.0,1.0\n", w);
  auto s = simulation_of(deck.text(1));
  start_ledger(*s);
  Vec pushed = Vec::Zero(), before = Vec::Zero();
  const auto momentum = [&] {
    Vec p = Vec::Zero();
    for (Index n = 0; n < 5; ++n) p += s->world().nodes.m[n] * s->world().nodes.v.vec(n);
    return p;
  };
  while (s->clock().t < 0.01) s->step(do_nothing);
  before = momentum();
  while (s->clock().t < 0.0103) s->step(do_nothing);
  pushed = momentum() - before;
  EXPECT_NEAR(pushed[1] / pushed[0], 0.035, 0.02);  // it turns on
  EXPECT_LT(pushed[0], 0);
  const Real impulse =
      s->clock().t - 0.5 * s->clock().dt_old - 0.01005;  // 1 per length, from the middle of its rise
  EXPECT_NEAR(pushed[0] / -impulse, 1, 0.01);
}

TEST(BeamLoads, SameBitsWithThreadsAndRestart) {
  test::expect_same_bits(loaded_cantilever(7, test::beams::square_1, 2, true, "").text(1), 60, 30);
}
