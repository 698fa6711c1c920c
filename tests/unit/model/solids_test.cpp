// Solids and loads of the model. Faults: tests/decks/reject/solid_*.k, body_loads_*.k.
#include <gtest/gtest.h>

#include <string>

#include "../keyword/decks_in_memory.hpp"
#include "model/transforms/included_entries.hpp"
#include "small_deck.hpp"

namespace courant {

namespace {

const std::string cube =
    "*NODE\n21,0.,0.,3.\n22,1.,0.,3.\n23,1.,1.,3.\n24,0.,1.,3.\n25,0.,0.,4.\n26,1.,0.,4.\n27,1.,1.,4.\n"
    "28,0.,1.,4.\n"
    "*PART\nblock\n4,4,4\n*ELEMENT_SOLID\n1,4,21,22,23,24,25,26,27,28\n";
const std::string ramp = "*DEFINE_CURVE\n1\n0.,0.\n1.,3.\n";

}  // namespace

TEST(Solids, StandInTheModel) {
  const SmallModel m = small_model(cube);
  EXPECT_EQ(m.messages, "");
  ASSERT_EQ(m.model.solids.size(), 1u);
  EXPECT_EQ(m.model.solids[0].part, 3);
  for (std::size_t k = 0; k < 8; ++k) EXPECT_EQ(m.model.nodes[m.model.solids[0].node[k]].id, Id(21 + k));
  EXPECT_EQ(m.model.solids[0].node[8], -1);
  EXPECT_TRUE(m.model.parts[3].has_solid);
  EXPECT_FALSE(m.model.parts[0].has_solid || m.model.parts[1].has_solid || m.model.parts[2].has_solid);
}

TEST(Solids, GetTheVelocityOfTheirPart) {
  const SmallModel m = small_model(cube + "*INITIAL_VELOCITY_GENERATION\n4,2,0.,1.,2.,3.\n\n");
  EXPECT_EQ(m.messages, "");
  for (const ModelNode& n : m.model.nodes) EXPECT_EQ(n.v, n.id > 20 ? Vec(1, 2, 3) : Vec(0, 0, 0)) << n.id;
}

TEST(Solids, InAMirrorStayTheRightWayOut) {
  Diagnostics diagnostics;
  const std::string main = std::string(small_mesh) +
                           "*DEFINE_TRANSFORMATION\n1\nMIRROR,1.5,0.,0.,4.,0.,0.\n"
                           "*INCLUDE_TRANSFORM\ncube.k\n\n\n\n1\n*END\n";
  DecksInMemory decks{{{"main.k", main}, {"cube.k", cube + "*END\n"}}};
  Deck deck = read_deck("main.k", decks.options(), diagnostics);
  move_included_entries(deck, diagnostics);
  const Model model = build_model(deck, diagnostics);
  EXPECT_EQ(diagnostics.text(), "");  // no solid is inside out
  ASSERT_EQ(model.solids.size(), 1u);
  EXPECT_EQ(model.nodes[model.solids[0].node[0]].id, 25);
  EXPECT_EQ(model.nodes[model.solids[0].node[0]].x, Vec(3, 0, 4));
}

// N1 to N8 are in the table of the one-line and of the two-line form: an offset counts once.
TEST(Solids, OfAnIncludeGetTheOffsetsOnce) {
  const std::string one_line = cube, nodes = "21,22,23,24,25,26,27,28";
  const auto at = one_line.find("," + nodes);
  ASSERT_NE(at, std::string::npos);
  std::string two_lines = one_line;
  two_lines.replace(at, 1, "\n");
  for (const std::string& included : {one_line, two_lines}) {
    Diagnostics diagnostics;
    const std::string main = std::string(small_mesh) + "*INCLUDE_TRANSFORM\ncube.k\n100,1000\n\n\n\n*END\n";
    DecksInMemory decks{{{"main.k", main}, {"cube.k", included + "*END\n"}}};
    Deck deck = read_deck("main.k", decks.options(), diagnostics);
    const Model model = build_model(deck, diagnostics);
    EXPECT_EQ(diagnostics.text(), "") << included;
    ASSERT_EQ(model.solids.size(), 1u);
    for (std::size_t k = 0; k < 8; ++k) EXPECT_EQ(model.nodes[model.solids[0].node[k]].id, Id(121 + k));
  }
}

TEST(Solids, ControlWithoutAnyIsANote) {
  EXPECT_EQ(small_model("*CONTROL_SOLID\n1,1\n").messages,
            "deck.k:34:1: note: *CONTROL_SOLID: the deck has no solids: no effect\n");
  EXPECT_EQ(small_model(cube + "*CONTROL_SOLID\n0,0,5,1,0,0.1,1,1\n").messages, "");
}

TEST(BodyLoads, AreReadWithDirectionCentreAndParts) {
  const SmallModel m =
      small_model(ramp +
                  "*LOAD_BODY_Y\n1,2.\n*LOAD_BODY_VECTOR\n1,-4.\n0.,3.,4.\n*LOAD_BODY_RZ\n1,5.,,1.,2.,3.\n"
                  "*LOAD_BODY_PARTS\n1\n*SET_PART\n1\n1,3\n*SET_PART\n2\n3,2\n"
                  "*LOAD_GRAVITY_PART\n2,3,1,9.81\n*LOAD_GRAVITY_PART_SET\n2,1,1,-2.\n");
  const auto& loads = m.model.body_loads;
  ASSERT_EQ(loads.size(), 5u);
  const Index all_load_body[] = {0, 2};
  for (std::size_t k = 0; k < 3; ++k)
    EXPECT_TRUE(std::equal(loads[k].parts.begin(), loads[k].parts.end(), all_load_body, all_load_body + 2))
        << k;
  EXPECT_EQ(loads[0].direction, Vec::UnitY());
  EXPECT_EQ(loads[0].sf * loads[0].curve(1), 6);
  EXPECT_NEAR((loads[1].direction - Vec(0, 0.6, 0.8)).norm(), 0, 1e-15);
  EXPECT_EQ(loads[1].sf, -4);
  EXPECT_EQ(loads[2].kind, BodyLoad::Kind::rotation);
  EXPECT_EQ(loads[2].direction, Vec::UnitZ());
  EXPECT_EQ(loads[2].centre, Vec(1, 2, 3));
  EXPECT_EQ(loads[2].sf, 5);
  EXPECT_EQ(loads[3].kind, BodyLoad::Kind::translation);
  EXPECT_EQ(loads[3].direction, Vec::UnitZ());
  EXPECT_EQ(loads[3].sf, 9.81);
  EXPECT_EQ(loads[3].parts, std::vector<Index>{1});
  EXPECT_EQ(loads[4].direction, Vec::UnitX());
  EXPECT_EQ(loads[4].parts, (std::vector<Index>{1, 2}));
}

TEST(BodyLoads, HaveTheAxesOfTheirSystem) {
  const SmallModel m = small_model(ramp +
                                   "*DEFINE_COORDINATE_SYSTEM\n23,0,0,0,0,1,0\n-1,0,0\n"
                                   "*LOAD_BODY_X\n1,2.,,,,,23\n"
                                   "*LOAD_BODY_VECTOR\n1,-4.,,,,,23\n0.,3.,4.\n");
  const auto& loads = m.model.body_loads;
  ASSERT_EQ(loads.size(), 2u) << m.messages;
  EXPECT_NEAR((loads[0].direction - Vec::UnitY()).norm(), 0, 1e-15);
  EXPECT_NEAR((loads[1].direction - Vec(-0.6, 0, 0.8)).norm(), 0, 1e-15);
}

TEST(BodyLoads, MoveWithTheirFile) {
  Diagnostics diagnostics;
  const std::string main = std::string(small_mesh) + ramp +
                           "*DEFINE_TRANSFORMATION\n1\nROTATE,0.,0.,1.,0.,0.,0.,90.\nTRANSL,10.,0.,0.\n"
                           "*INCLUDE_TRANSFORM\nloads.k\n\n\n\n1\n*END\n";
  const std::string loads =
      "*LOAD_BODY_VECTOR\n1\n1.,0.,0.\n*LOAD_BODY_RZ\n1,5.,,1.,2.,3.\n*LOAD_BODY_X\n1,,,7.\n*END\n";
  DecksInMemory decks{{{"main.k", main}, {"loads.k", loads}}};
  Deck deck = read_deck("main.k", decks.options(), diagnostics);
  move_included_entries(deck, diagnostics);
  const Model model = build_model(deck, diagnostics);
  ASSERT_EQ(model.body_loads.size(), 3u);
  EXPECT_EQ(model.body_loads[0].direction, Vec::UnitX());  // gravity has one direction
  EXPECT_NEAR((model.body_loads[1].direction - Vec::UnitY()).norm(), 0, 1e-15);
  EXPECT_NEAR((model.body_loads[2].centre - Vec(8, 1, 3)).norm(), 0, 1e-14);
}

}  // namespace courant
