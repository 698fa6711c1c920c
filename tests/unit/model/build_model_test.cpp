// The decks of tests/decks/accept all describe one scene in different formats; the model must be the same
// each time.
#include <gtest/gtest.h>

#include <algorithm>
#include <vector>

#include "../keyword/read_and_check.hpp"
#include "model/build_model.hpp"

namespace courant {

namespace {

const std::string folder = SOURCE_DIR "/tests/decks/accept";

Model model_of(const std::string& name, const ReadOptions& options = {}) {
  Diagnostics diagnostics;
  const Deck deck = read_deck(folder + "/" + name, options, diagnostics);
  Model model = build_model(deck, diagnostics);
  EXPECT_EQ(diagnostics.text(), "");
  return model;
}

class AcceptDeck : public testing::TestWithParam<std::string> {
 protected:
  const Model m = model_of(GetParam());
};

TEST_P(AcceptDeck, GivesTheMesh) {
  EXPECT_EQ(m.title, "one particle over a plate");
  ASSERT_EQ(m.nodes.size(), 5u);
  EXPECT_EQ(m.nodes[3].x, Vec(0, 1, 0));
  EXPECT_EQ(m.nodes[4].x, Vec(0.5, 0.5, 0.25));
  ASSERT_EQ(m.parts.size(), 2u);
  EXPECT_EQ(m.parts[1].title, "water, the only particle");
  EXPECT_EQ(m.parts[1].eosid, 3);
  EXPECT_TRUE(m.parts[0].has_shell && !m.parts[0].has_sph);
  EXPECT_TRUE(!m.parts[1].has_shell && m.parts[1].has_sph);
  ASSERT_EQ(m.shells.size(), 1u);
  EXPECT_EQ(m.shells[0].node, (std::array<Index, 4>{0, 1, 2, 3}));
  ASSERT_EQ(m.sph.size(), 1u);
  EXPECT_EQ(m.sph[0].node, 4);
  EXPECT_EQ(m.sph[0].mass, -8e-3);
}

TEST_P(AcceptDeck, GivesSetsCurvesAndBoxes) {
  EXPECT_EQ(m.node_sets.at(1), (std::vector<Index>{0, 1, 2, 3}));
  EXPECT_EQ(m.node_sets.at(2), (std::vector<Index>{3, 4}));
  EXPECT_EQ(m.part_sets.at(3), std::vector<Index>{1});
  const Curve& curve = m.curves.at(9);
  EXPECT_EQ(curve.abscissa, (std::vector<Real>{2, 4}));
  EXPECT_EQ(curve.ordinate, (std::vector<Real>{4.5, 7.5}));
  EXPECT_EQ(curve(0), 4.5);
  EXPECT_EQ(curve(3), 6);
  EXPECT_EQ(curve(9), 7.5);
  EXPECT_EQ(m.boxes.at(4).low, Vec(-1, -1, -1));
  EXPECT_EQ(m.boxes.at(4).high, Vec(2, 2, 0.1));
}

TEST_P(AcceptDeck, GivesConditions) {
  EXPECT_EQ(m.nodes[0].v, Vec(1, 0, 0));    // INITIAL_VELOCITY, inside the box
  EXPECT_EQ(m.nodes[3].v, Vec(0, 7, 0));    // _NODE is above it
  EXPECT_EQ(m.nodes[4].v, Vec(-1, 1, -3));  // _GENERATION: V + omega x r
  EXPECT_FALSE(m.parts[0].velocity_given);
  EXPECT_TRUE(m.parts[1].velocity_given);
  EXPECT_EQ(m.nodes[0].fixed, (std::array<bool, 3>{true, true, true}));
  EXPECT_EQ(m.nodes[1].fixed, (std::array<bool, 3>{false, false, false}));
  EXPECT_EQ(m.nodes[4].fixed, (std::array<bool, 3>{false, true, false}));
  ASSERT_EQ(m.body_loads.size(), 1u);
  EXPECT_EQ(m.body_loads[0].direction, Vec::UnitZ());
  EXPECT_EQ(m.body_loads[0].sf, 9.81);
  EXPECT_EQ(m.body_loads[0].curve.id, 9);
}

TEST_P(AcceptDeck, GivesControlAndOutput) {
  EXPECT_EQ(m.endtim, 2.5);
  EXPECT_EQ(m.endcyc, 100);
  EXPECT_EQ(m.tssfac, 0.9);  // from a blank card
  EXPECT_FALSE(m.dt_max_given);
  EXPECT_EQ(m.output.d3plot_count, 5);
  EXPECT_EQ(m.output.d3plot.interval, 0.5);
  EXPECT_EQ(m.output.history("glstat").interval, 0.01);
  EXPECT_EQ(m.output.history("sphout").interval, 0.02);
  EXPECT_EQ(m.output.history("rcforc").interval, 0);
  EXPECT_EQ(m.output.history_sph, std::vector<Id>{5});
}

INSTANTIATE_TEST_SUITE_P(Formats, AcceptDeck,
                         testing::Values("fixed.k", "crlf_tabs_case.k", "comma.k", "long.k", "i10.k",
                                         "suffixes.k", "parameters.k", "includes.k", "param_fields.k",
                                         "param_comma.k", "param_long.k", "param_texts.k", "param_scopes.k",
                                         "param_mutable.k",

                                         "lexer_beyond_last_column.k", "lexer_carriage_returns.k",
                                         "lexer_comments_everywhere.k", "lexer_formats_per_file.k",
                                         "lexer_keyword_words.k", "lexer_latin1.k",
                                         "lexer_long_with_suffixes.k", "lexer_no_last_line_end.k",
                                         "lexer_numbers.k", "lexer_options_order.k", "lexer_repeated_sets.k",
                                         "lexer_two_returns.k", "lexer_utf8_with_mark.k"),
                         [](const auto& test) {
                           std::string name = test.param;
                           name.resize(name.size() - 2);
                           return name;
                         });

TEST(Parameters, AreOverridden) {
  const Model m = model_of("parameters.k", {.parameters = {{"high", "3.5"}, {"MASS", "1.0"}}});
  EXPECT_EQ(m.boxes.at(4).high.x(), 3.5);
  EXPECT_EQ(m.sph[0].mass, -1);
}

TEST(Parameters, OverrideOfNoneIsAnError) {
  Diagnostics diagnostics;
  const WorkingDirectory there(folder);
  read_deck("parameters.k", {.parameters = {{"hihg", "3.5"}, {"water", "two"}}}, diagnostics);
  EXPECT_EQ(diagnostics.text(),
            "parameters.k:6:12: error: *PARAMETER water: expected an integer, got 'two' from --param\n"
            "  hint: the deck declares it with the type letter I\n"
            "parameters.k: error: --param hihg: the deck has no *PARAMETER of that name\n"
            "  hint: did you mean high?\n");
}

TEST(Curve, OfNoPointsIsZero) {
  EXPECT_EQ(Curve{}(1.0), 0);
}

TEST(BuildModel, RangesOfParticlesAndTriangles) {
  Diagnostics diagnostics;
  const Deck deck = read_deck(folder + "/ranges.k", {}, diagnostics);
  const Model m = build_model(deck, diagnostics);
  EXPECT_EQ(diagnostics.text(), "");
  ASSERT_EQ(m.sph.size(), 3u);
  EXPECT_EQ(m.nodes[static_cast<std::size_t>(m.sph[2].node)].id, 13);
  EXPECT_EQ(m.sph[2].mass, 0.5);
  ASSERT_EQ(m.shells.size(), 3u);
  for (const ModelShell& shell : m.shells) EXPECT_EQ(shell.node[3], shell.node[2]) << shell.id;
}

}  // namespace

}  // namespace courant
