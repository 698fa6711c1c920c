// A run may go on with another number of threads at any step: no bit depends on it.
#include "parallel/parallel.hpp"
#include "small_scene.hpp"

namespace courant {

namespace {

using test::SmallScene;

/// Places and velocities after 60 steps; `threads` of a step by its number.
template <class Threads>
std::vector<Real> state_after_steps(const Threads& threads) {
  SmallScene scene;
  scene.n = 24;  // nine blocks of particles
  scene.start = "0.5,-1.,0.";
  scene.extra = "*LOAD_BODY_Y\n1,1.\n*DEFINE_CURVE\n1\n0.,9.81\n1000.,9.81\n";
  set_threads(threads(0));
  const auto s = test::build(scene);
  std::vector<Real> out;
  if (!s) return out;
  for (int k = 0; k < 60; ++k) {
    set_threads(threads(k));
    s->step([](World&, const Clock&, const std::string&) {});
  }
  set_threads(1);
  const Particles& p = s->world().particles;
  for (Index i = 0; i < p.size(); ++i)
    for (int c = 0; c < 2; ++c) out.push_back(p.x.vec(i)[c]), out.push_back(p.v.vec(i)[c]);
  return out;
}

TEST(ThreadsChange, BetweenStepsWithoutATrace) {
  const std::vector<Real> alone = state_after_steps([](int) { return 1; });
  ASSERT_EQ(alone.size(), 4u * 24 * 24);
  EXPECT_EQ(alone, state_after_steps([](int step) { return 1 + step % 4; }));
  EXPECT_EQ(alone, state_after_steps([](int step) { return step < 30 ? 4 : 1; }));
  EXPECT_EQ(alone, state_after_steps([](int step) { return step < 30 ? 1 : 4; }));
}

}  // namespace

}  // namespace courant
