#pragma once
#include <algorithm>

#include "state/world.hpp"

namespace courant::test {

/// One pass alone, as a stage would run it.
inline void run(BlockPass& pass, World& world, const Clock& clock) {
  const Index n = dynamic_cast<Motion*>(&pass) ? world.particles.moving : world.particles.active;
  pass.start(world, clock);
  for_each_block(n, [&](Index begin, Index end) { pass.block(world, clock, begin, end); });
  pass.finish(world, clock);
}

}  // namespace courant::test
