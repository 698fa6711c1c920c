#pragma once
// Decks of solids with nodes on their edges, of both shapes.
#include "solid_decks.hpp"

namespace courant::test {

inline SolidDeck quadratic(CellShape shape, const std::string& material) {
  SolidDeck deck;
  deck.cells = shape, deck.on_edges = true;
  deck.cards = fmt::format("*PART\nblock\n1,1,1\n*SECTION_SOLID\n1,{}\n*{}\n",
                           shape == CellShape::tetrahedra ? 16 : 23, material);
  return deck;
}

class QuadraticSolids : public ::testing::TestWithParam<CellShape> {
 protected:
  static bool tetrahedra() { return GetParam() == CellShape::tetrahedra; }
  static SolidDeck solids(const std::string& material) { return quadratic(GetParam(), material); }
};

}  // namespace courant::test
