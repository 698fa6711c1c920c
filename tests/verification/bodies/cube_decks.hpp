#pragma once
// Cubes of solids between planes of symmetry, one of whose sides is driven.
#include <string>

#include "solid_decks.hpp"

namespace courant::test {

/// A cube of n^3 elements, its end at x = 1 moved with the velocity of curve 1; `confined`: no other side
/// moves.
inline SolidDeck driven_cube(int n, const std::string& material, const std::string& motion, bool confined,
                             int elform = 1) {
  SolidDeck deck;
  deck.block(Vec(1, 1, 1), n, n, n, 1);
  deck.cards = fmt::format("*PART\ncube\n1,1,1\n*SECTION_SOLID\n1,{}\n{}", elform, material);
  for (const int axis : {0, 1, 2}) {
    deck.node_set(axis + 1, [&](const Vec& x) {
      return x[axis] < 1e-9 || (confined && axis > 0 && x[axis] > 1 - 1e-9);
    });
    deck.cards += fmt::format("*BOUNDARY_SPC_SET\n{},0,{},{},{}\n", axis + 1, int(axis == 0), int(axis == 1),
                              int(axis == 2));
  }
  deck.node_set(4, [](const Vec& x) { return x[0] > 1 - 1e-9; });
  deck.cards += "*BOUNDARY_PRESCRIBED_MOTION_SET\n4,1,0,1\n*DEFINE_CURVE\n1\n" + motion;
  return deck;
}

/// What the elements pull at the nodes x = 1 of the block with n^3 elements.
inline Real pull_of_cube(Simulation& s, int n) {
  const ElementGroup& group = *s.world().groups[0];
  Real sum = 0;
  for (Index e = n - 1; e < group.size(); e += n)
    for (const int corner : {1, 2, 5, 6}) sum += group.corner_force->data(3 * corner)[e];
  return std::abs(sum);
}

}  // namespace courant::test
