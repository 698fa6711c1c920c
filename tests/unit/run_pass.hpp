#pragma once
#include <algorithm>

#include "state/world.hpp"

namespace courant::test {

/// One pass alone, as a stage would run it.
inline void run(BlockPass& pass, World& world, const Clock& clock) {
  const bool moving = pass.phase() >= Phase::drive;
  const Index n = moving ? world.particles.moving : world.particles.active;
  Shares shares = moving ? world.moving_shares : world.shares;
  if (shares.first.back() != block_count(n)) shares = Shares::even(block_count(n));  // nobody has built lists
  pass.start(world, clock);
  on_threads(shares.threads(), [&](int t) {
    for (Index b = shares.first[t]; b < shares.first[t + 1]; ++b)
      pass.block(world, clock, b * block_size, std::min(n, (b + 1) * block_size));
  });
  pass.finish(world, clock);
}

}  // namespace courant::test
