#include "surfaces/face_forces.hpp"

#include <gtest/gtest.h>

namespace courant {
namespace {

TEST(FaceForces, BeginEachStepAtZeroInEveryDirection) {
  World world;
  world.segments.fields.resize(3);
  for (Index s = 0; s < 3; ++s) world.segments.keep_contact_force().set(s, Vec(1, 2, 3));
  add_clear_face_forces(world);
  add_clear_face_forces(world);
  ASSERT_EQ(world.passes.all<Rate>().size(), 1u) << "once, whoever asks";
  world.passes.all<Rate>()[0]->block(world, Clock{}, 0, 3);
  for (Index s = 0; s < 3; ++s) EXPECT_EQ(world.segments.contact_force->vec(s), Vec(0, 0, 0)) << s;
}

}  // namespace
}  // namespace courant
