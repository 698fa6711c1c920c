// The energy ledger of particles that cross the computational box.
#include <cmath>

#include "../app/small_scene.hpp"

namespace courant {
namespace {

/// What the ledger does not account for at its worst, over a flight of particles too far apart to meet
/// through a box one wide. In columns of six they come in and leave.
struct Flight {
  Real worst = 0, column = 0;
  Index least = 1000, most = 0;  ///< active
};
Flight flight(const std::string& more) {
  test::SmallScene scene;
  scene.section = "1,1.2,1.,1.,0.02", scene.start = "2.,0.,0.", scene.box = "1";
  scene.extra = "*DEFINE_BOX\n1,0.5,1.5,-9.,9.,-9.,9.\n" + more;
  auto s = test::build(scene);
  Flight out{.column = 6 * 0.5 * 10 * 4};
  while (s->clock().t < 0.7)
    s->step([&](World& world, const Clock& clock, const std::string&) {
      sample_energy(world, clock);
      if (clock.cycle == 0) world.energy.initial = world.energy.total();
      out.worst = std::max(out.worst, std::abs(world.energy.residual()));
      out.least = std::min(out.least, world.particles.active);
      out.most = std::max(out.most, world.particles.active);
    });
  return out;
}

TEST(SphEnergy, OfWhatCrossesTheBoxCountsInTheStepInWhichItDoes) {
  const Flight free = flight("");
  EXPECT_EQ(free.most, 36);
  EXPECT_EQ(free.least, 6);
  EXPECT_LT(free.worst, 1e-9 * free.column);
  const Flight falling = flight(test::gravity_cards);  // velocities lag by half a step: m g v dt/2 for each
  EXPECT_LT(falling.worst, 0.05 * falling.column);
}

}  // namespace
}  // namespace courant
