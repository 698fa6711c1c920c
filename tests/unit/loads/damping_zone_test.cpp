// *COURANT_DAMPING_ZONE: how it grows, what it takes, and that the ledger knows.
#include <cmath>

#include "../app/small_scene.hpp"

namespace courant {
namespace {

std::unique_ptr<Simulation> block_in_zone(const std::string& card, const std::string& start = "1.,0.,0.") {
  test::SmallScene scene;
  scene.start = start, scene.extra = "*COURANT_DAMPING_ZONE\n" + card + "\n";
  return test::build_deck(scene.text());
}

TEST(DampingZone, GrowsFromItsStartToItsEnd) {
  auto s = block_in_zone("0.1,0.,0.,0.4,0.,0.,20.\n3.");
  std::string dt_set_by;
  s->evaluate(dt_set_by);
  const Particles& p = s->world().particles;
  for (Index i = 0; i < p.size(); ++i) {
    const Real along = std::clamp((p.x.vec(i).x() - 0.1) / 0.3, 0.0, 1.0);
    EXPECT_NEAR(p.f.vec(i).x(), -p.m[i] * 20 * along * along * along, 1e-9) << p.x.vec(i).x();
    EXPECT_NEAR(p.f.vec(i).y(), 0, 1e-9);
  }
}

TEST(DampingZone, BringsWhatIsBeyondToRestAndKeepsTheBooks) {
  auto s = block_in_zone("-3.,0.,0.,-2.,0.,0.,10.", "1.,-0.5,0.");
  test::run(*s, 0.1);
  const Particles& p = s->world().particles;
  const Real left = std::exp(-10 * s->clock().t);
  for (Index i = 0; i < p.size(); ++i) {
    EXPECT_NEAR(p.v.vec(i).x(), left, 0.02 * left);
    EXPECT_NEAR(p.v.vec(i).y(), -0.5 * left, 0.02 * left);
  }
  s->sample("");
  const EnergyLedger& energy = s->world().energy;
  EXPECT_NEAR(energy.dissipated, 0.5 * 360 * 1.25 * (1 - left * left), 0.02 * 225);
  EXPECT_LT(std::abs(energy.residual()), 1e-3 * 225);
}

std::string refusal(const std::string& card) {
  Diagnostics diagnostics;
  test::SmallScene scene;
  scene.extra = "*COURANT_DAMPING_ZONE\n" + card + "\n";
  EXPECT_EQ(Simulation::build("deck.k", in_memory(scene.text()), diagnostics), nullptr);
  return diagnostics.text();
}

TEST(DampingZone, WithoutLengthOrRateIsRefused) {
  EXPECT_NE(refusal("1.,0.,0.,1.,0.,0.,1.").find("the damping zone has no length"), std::string::npos);
  EXPECT_NE(refusal("1.,0.,0.,2.,0.,0.,-1.").find("(RATE,"), std::string::npos);
}

}  // namespace
}  // namespace courant
