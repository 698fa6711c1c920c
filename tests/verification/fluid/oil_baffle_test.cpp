// Oil that sloshes on both sides of an elastic plate: tests/verification/scenes/oil_baffle.yaml.
#include <cmath>
#include <cstdio>

#include "same_bits.hpp"
#include "scenes.hpp"
#include "shell_decks.hpp"

using namespace courant;

// Linear potential flow in both basins with a beam between them (finite elements, 10 and 20 over the depth):
// under a steady push of 0.2 m/s2 the end swings about 3.38 mm with 0.884 s, of which 86 % is that mode. With
// a stiff plate the oil would slosh with 0.831 s, without oil the plate would swing with 0.1 s.
TEST(OilBaffle, SwingsWithTheOilThatSloshesBesideIt) {
  constexpr Real period = 0.884, still = 3.38e-3;
  const auto s = test::simulation_of(test::deck_of_scene("oil_baffle", {{"n", "8"}, {"endtim", "1.3"}}));
  test::start_ledger(*s);
  const Nodes& nodes = s->world().nodes;
  Index end = 0;
  for (Index n = 0; n < nodes.size(); ++n)
    if (nodes.id[n] == 1000001 + 2 * 12) end = n;
  const Real start = nodes.x.data(0)[end];
  Real sum = 0, before = 0;
  std::vector<Real> up;
  while (s->clock().t < 1.3) {
    const Real t = s->clock().t;
    s->step(test::do_nothing);
    const Real way = nodes.x.data(0)[end] - start;
    if (t < period) sum += way * s->clock().dt_old / period;
    if (before < still && way >= still && (up.empty() || t > 0.9)) up.push_back(t);
    before = way;
  }
  const Real error = test::energy_error_of_a_step(*s);
  ASSERT_GE(up.size(), 2u);
  std::printf("mean over a period %.3f of linear waves', period %.3f; energy %.1e\n", sum / 3.35e-3,
              (up[1] - up[0]) / period, error);
  EXPECT_NEAR(sum / 3.35e-3, 1, 0.06);
  EXPECT_NEAR((up[1] - up[0]) / period, 1, 0.05);
  EXPECT_LT(error, 0.01);
  EXPECT_EQ(s->world().counters.at("leaked_particles"), 0);
}

TEST(OilBaffle, SameBitsOnThreadsAndAfterARestart) {
  test::expect_same_bits(test::deck_of_scene("oil_baffle", {{"n", "8"}}), 60, 25);
}
