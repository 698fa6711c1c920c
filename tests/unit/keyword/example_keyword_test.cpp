// The worked example of docs/contributing.md, compiled and read. tests/architecture/docs_example.py proves
// that the page shows the lines between the markers.
#include <gtest/gtest.h>

#include "decks_in_memory.hpp"

// [example: keyword]
#include "keyword/registry.hpp"

namespace courant {

namespace {

/// One set of cards: every field is a member.
struct SpongeLayer : Entry {
  std::string title;
  Id boxid;
  Real tau;
  int shape;
};

using S = SpongeLayer;
const RegisterKeyword<S> sponge_layer{
    {.names = {"COURANT_SPONGE_LAYER"},
     .purpose = "slows particles in a box, so that waves leave without a reflection",
     .title_option = true,
     .title = &S::title,
     .cards = {
         {.fields = {
              {"BOXID", &S::boxid, "-", "box of the layer", {.required = true, .refers = IdSpace::box}},
              {"TAU", &S::tau, "T", "time constant", {.required = true, .check = Check::positive}},
              {"SHAPE", &S::shape, "-", "0 constant, 1 growing from the edge", {.allowed = {0, 1}}}}}}}};

}  // namespace

/// Whoever computes with it asks the deck for all of them.
std::vector<Real> sponge_times(const Deck& deck) {
  std::vector<Real> times;
  for (const SpongeLayer& layer : deck.all<SpongeLayer>()) times.push_back(layer.tau);
  return times;
}

}  // namespace courant
// [example: keyword]

namespace courant {

namespace {

Deck read_text(const std::string& text, Diagnostics& diagnostics) {
  return read_deck("deck.k", in_memory(text), diagnostics);
}

TEST(ExampleKeyword, IsReadWithItsTitle) {
  Diagnostics diagnostics;
  const Deck deck = read_text(
      "*KEYWORD\n*COURANT_SPONGE_LAYER_TITLE\nwest\n$ box, tau, shape\n         3    1.5-2         1\n*END\n",
      diagnostics);
  EXPECT_EQ(diagnostics.text(), "");
  EXPECT_EQ(sponge_times(deck), std::vector<Real>{0.015});
  EXPECT_EQ(deck.all<SpongeLayer>()[0].title, "west");
  EXPECT_EQ(deck.all<SpongeLayer>()[0].boxid, 3);
  EXPECT_EQ(deck.keywords.at("COURANT_SPONGE_LAYER_TITLE").entries, 1u);
}

TEST(ExampleKeyword, FaultsAreToldWithPlaceFieldAndHint) {
  Diagnostics diagnostics;
  read_text("*KEYWORD\n*COURANT_SPONGE_LAYER\n         3        -1         2\n*END\n", diagnostics);
  EXPECT_EQ(
      diagnostics.text(),
      "deck.k:3:19: error: *COURANT_SPONGE_LAYER field 2 (TAU, time constant [T]): expected a number > 0, "
      "got '-1'\n"
      "deck.k:3:30: error: *COURANT_SPONGE_LAYER field 3 (SHAPE, 0 constant, 1 growing from the edge [-]): "
      "'2' is not supported\n  hint: supported values: 0, 1\n");
}

TEST(ExampleKeyword, IsDocumented) {
  EXPECT_NE(keyword_help("COURANT_SPONGE_LAYER").find("time constant [T] (> 0)"), std::string::npos);
  EXPECT_TRUE(find_keywords("sponge").found);
}

}  // namespace

}  // namespace courant
