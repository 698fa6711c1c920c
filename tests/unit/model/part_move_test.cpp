// *PART_MOVE.
#include <gtest/gtest.h>

#include <string>

#include "../keyword/decks_in_memory.hpp"
#include "model/transforms/included_entries.hpp"
#include "small_deck.hpp"

namespace courant {

namespace {

const std::string cubes =
    "*NODE\n21,0.,0.,3.\n22,1.,0.,3.\n23,1.,1.,3.\n24,0.,1.,3.\n25,0.,0.,4.\n26,1.,0.,4.\n27,1.,1.,4.\n"
    "28,0.,1.,4.\n31,0.,0.,5.\n32,1.,0.,5.\n33,1.,1.,5.\n34,0.,1.,5.\n*PART\nlower\n4,4,4\n*PART\nupper\n5,4,"
    "4\n"
    "*ELEMENT_SOLID\n1,4,21,22,23,24,25,26,27,28\n2,5,25,26,27,28,31,32,33,34\n";

Vec position_of(const Model& model, Id id) {
  for (const ModelNode& n : model.nodes)
    if (n.id == id) return n.x;
  return Vec::Constant(-1e9);
}

}  // namespace

TEST(PartMove, MovesAllNodesOfAPart) {
  const SmallModel m = small_model(cubes + "*PART_MOVE\n5,0.5,0.25,2.0\n");
  EXPECT_EQ(m.messages, "");
  EXPECT_EQ(position_of(m.model, 21), Vec(0, 0, 3));
  EXPECT_EQ(position_of(m.model, 25), Vec(0.5, 0.25, 6)) << "shared";
  EXPECT_EQ(position_of(m.model, 33), Vec(1.5, 1.25, 7));
}

TEST(PartMove, MovesSharedNodesOfASetOnce) {
  const SmallModel m = small_model(cubes +
                                   "*SET_PART\n7\n4,5\n*PART_MOVE\n       7             0.5            0.25  "
                                   "           2.0       0       1\n");
  EXPECT_EQ(m.messages, "");
  EXPECT_EQ(position_of(m.model, 21), Vec(0.5, 0.25, 5));
  EXPECT_EQ(position_of(m.model, 25), Vec(0.5, 0.25, 6));
}

// The translation turns with a file that is turned.
TEST(PartMove, OfAnIncludedFileTurnsWithIt) {
  Diagnostics diagnostics;
  DecksInMemory decks{
      {{"main.k", std::string(small_mesh) + "*DEFINE_TRANSFORMATION\n1\nROTATE,0.,0.,1.,0.,0.,0.,90.\n"
                                            "*INCLUDE_TRANSFORM\ncubes.k\n\n\n\n1\n*END\n"},
       {"cubes.k", cubes + "*PART_MOVE\n5,0.5,0.25,2.0\n*END\n"}}};
  Deck deck = read_deck("main.k", decks.options(), diagnostics);
  move_included_entries(deck, diagnostics);
  const Model model = build_model(deck, diagnostics);
  EXPECT_EQ(diagnostics.text(), "");
  EXPECT_LT((position_of(model, 31) - Vec(-0.25, 0.5, 7)).norm(), 1e-12);
}

}  // namespace courant
