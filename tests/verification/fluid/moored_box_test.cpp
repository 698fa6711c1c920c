// A box that floats on two ropes: tests/verification/scenes/moored_box.yaml.
#include <cmath>
#include <cstdio>

#include "same_bits.hpp"
#include "scenes.hpp"
#include "shell_decks.hpp"

using namespace courant;

namespace moored_box_test {
namespace {

using Parameters = std::map<std::string, std::string>;

constexpr Real g = 9.81, displaced = 1000 * 0.2 * 0.08, weight = 0.5, ropes = 0.05, stretch = 0.002;
/// Of both ropes, by Archimedes; half of each rope hangs on the box.
constexpr Real excess = g * ((1 - weight) * displaced - ropes);

/// A run in the ledger of energies, and what its ropes pull.
struct Moored {
  std::unique_ptr<Simulation> s;
  explicit Moored(const Parameters& parameters)
      : s(test::simulation_of(test::deck_of_scene("moored_box", parameters))) {
    test::start_ledger(*s);
  }
  Vec place() const { return s->bodies()->bodies().back().x; }
  Real pull(Index rope) const {
    const auto* force = dynamic_cast<const Field<Real>*>(s->world().groups.at(0)->fields.find("axial_force"));
    return force ? (*force)[rope] : 0;
  }
  void expect_sound() {
    EXPECT_LT(test::energy_error_of_a_step(*s), 0.01);
    EXPECT_EQ(s->world().counters.at("leaked_particles"), 0);
  }
};

}  // namespace

// Linear potential flow in this tank, by finite elements of 5 mm, with the ropes as an upright pendulum,
// T/L = 487.4 N/m: after a push of 10 N the box turns back at 0.283 s, 7.34 mm off.
TEST(MooredBox, SwaysOnRopesThatBearTheExcessOfBuoyancy) {
  Moored run({{"n", "4"}, {"push", "10"}});
  const Vec start = run.place();
  Real most = 0, when = 0, sum = 0, time = 0;
  while (run.s->clock().t < 0.32) {
    run.s->step(test::do_nothing);
    const Vec way = run.place() - start;
    if (way[0] > most) most = way[0], when = run.s->clock().t;
    if (run.s->clock().t < 0.1) continue;
    sum += run.s->clock().dt_old * (run.pull(0) + run.pull(1)), time += run.s->clock().dt_old;
  }
  std::printf("turns back at %.3f s, %.2f mm off; ropes pull with %.4f of the excess\n", when, 1e3 * most,
              sum / time / excess);
  EXPECT_NEAR(sum / time / excess, 1, 0.03);
  EXPECT_NEAR(when / 0.283, 1, 0.07);
  EXPECT_LT(most, 7.34e-3);
  EXPECT_GT(most, 0.88 * 7.34e-3);
  run.expect_sound();
}

// Pushed down it hangs on nothing; as it comes up again the ropes stop it.
TEST(MooredBox, FloatsFreelyWhileItsRopesAreSlack) {
  Moored run({{"n", "4"}, {"push", "-150"}, {"push_along", "2"}});
  const Real start = run.place()[1], k = 0.5 * excess / stretch;
  Real slack = 0, largest = 0;
  while (run.s->clock().t < 0.36) {
    const Real up = run.place()[1] - start;
    run.s->step(test::do_nothing);
    const Real both = run.pull(0) + run.pull(1);
    if (up < -1.2 * stretch) {
      slack += run.s->clock().dt_old;
      EXPECT_EQ(both, 0);
    }
    if (up > -0.8 * stretch) EXPECT_NEAR(both, 2 * k * (up + stretch), 0.02 * excess);
    largest = std::max(largest, both);
  }
  std::printf("slack for %.3f s, then up to %.2f of the excess\n", slack, largest / excess);
  EXPECT_GT(slack, 0.15);
  EXPECT_GT(largest, 3 * excess);
  run.expect_sound();
}

TEST(MooredBox, SameBitsOnThreadsAndAfterARestart) {
  test::expect_same_bits(
      test::deck_of_scene("moored_box", {{"n", "4"}, {"push", "-300"}, {"push_along", "2"}}), 120, 60);
}

}  // namespace moored_box_test
