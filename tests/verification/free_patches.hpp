#pragma once
// Patches of shells that nothing holds, with noise.
#include <algorithm>
#include <random>

#include "solid_decks.hpp"
#include "state/shared_fields.hpp"

namespace courant::test {

/// Largest speed of a node, or of its turning, in the first and in the last of three thousand steps from
/// noise.
struct Growth {
  Real early = 0, late = 0;
};

template <class Random>
Growth growth_of_noise(Simulation& s, Random& random, std::uniform_real_distribution<Real>& number) {
  World& world = s.world();
  Field<Real>& turning = *shared_fields::angular_velocity.find(world.nodes.fields);
  for (Index i = 0; i < world.nodes.size(); ++i) {
    world.nodes.v.set(i, 1e-9 * Vec(number(random), number(random), number(random)));
    turning.set(i, 1e-9 * Vec(number(random), number(random), number(random)));
  }
  const auto fastest = [&] {
    Real most = 0;
    for (Index i = 0; i < world.nodes.size(); ++i)
      most = std::max({most, world.nodes.v.vec(i).norm(), turning.vec(i).norm()});
    return most;
  };
  Growth out;
  for (int k = 0; k < 3000; ++k) {
    s.step(do_nothing);
    if (k < 1000) out.early = std::max(out.early, fastest());
    if (k >= 2000) out.late = std::max(out.late, fastest());
  }
  return out;
}

}  // namespace courant::test
