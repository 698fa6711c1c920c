#include "time/step.hpp"

#include <gtest/gtest.h>

#include "../sph/cloud.hpp"
#include "base/run_error.hpp"
#include "loads/loads.hpp"
#include "loads/point_motion.hpp"

using namespace courant;
using courant::test::Cloud;

namespace {

/// Steps whose size changes every time.
struct ChangingSteps : TimeLimit {
  std::string name() const override { return "changing"; }
  bool rings() const override { return false; }
  Limit limit(const World&, const Clock& clock) override {
    return {0.001 * (1 + (clock.cycle * 7) % 5), "test"};
  }
};

Curve constant(Real value) {
  return {.id = 1, .abscissa = {0, 1}, .ordinate = {value, value}};
}

}  // namespace

TEST(Step, FreeFallIsExactWithChangingSteps) {
  Cloud cloud(2, 1, 0.01, 0);
  Model model;
  model.body_loads.push_back({.direction = Vec::UnitY(), .curve = constant(9.81)});
  cloud.world.passes.add(make_body_load(acceleration_of_particles(model), points_of(cloud.world.particles),
                                        cloud.world, cloud.neighbours));
  cloud.world.passes.add(make_clear_forces(points_of(cloud.world.particles)));
  cloud.world.passes.add(make_point_motion(points_of(cloud.world.particles)));
  cloud.world.passes.add(std::make_shared<ChangingSteps>());
  cloud.world.particles.v.set(0, {1, 2, 0});
  PassTimer timer;
  Stepper stepper(cloud.world, cloud.neighbours.get(), {}, timer);
  for (int k = 0; k < 100; ++k) stepper.step(cloud.clock, [](World&, const Clock&, const std::string&) {});
  const Real t = cloud.clock.t;
  EXPECT_NEAR(cloud.world.particles.x.vec(0)[0], t, 1e-12);
  EXPECT_NEAR(cloud.world.particles.x.vec(0)[1], 2 * t - 0.5 * 9.81 * t * t, 1e-12);
}

TEST(Step, StopsWhereTheStepSizeIsNotANumber) {
  struct Broken : TimeLimit {
    std::string name() const override { return "broken"; }
    Limit limit(const World&, const Clock&) override { return {std::nan(""), "sph 1 of part 1"}; }
  };
  Cloud cloud(2, 2, 0.01, 0);
  cloud.world.passes.add(std::make_shared<Broken>());
  cloud.world.passes.add(std::make_shared<ChangingSteps>());
  PassTimer timer;
  Stepper stepper(cloud.world, cloud.neighbours.get(), {}, timer);
  EXPECT_THROW(stepper.step(cloud.clock, [](World&, const Clock&, const std::string&) {}), RunError);
}
