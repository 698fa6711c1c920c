// What the parts of solids take from *HOURGLASS and its kin. Faults:
// tests/decks/reject/solid_hourglass_kind.k.
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "../keyword/decks_in_memory.hpp"
#include "elements/solid/hourglass.hpp"
#include "elements/solid/section_solid.hpp"
#include "model/build_model.hpp"

namespace courant {

namespace {

/// Parts 1 to 4 with a solid each, which name hourglass 0 to 3; part 5 has none and names hourglass 9.
std::vector<SolidViscosity> viscosity(const std::string& keywords, std::string& messages) {
  std::string text =
      "*KEYWORD\n*CONTROL_TERMINATION\n1.\n*NODE\n1,0.,0.,0.\n2,1.,0.,0.\n3,1.,1.,0.\n4,0.,1.,0.\n"
      "5,0.,0.,1.\n6,1.,0.,1.\n7,1.,1.,1.\n8,0.,1.,1.\n";
  for (int k = 1; k <= 4; ++k) {
    const std::string p = std::to_string(k);
    text += "*PART\nblock\n" + p + ",1,1,0," + std::to_string(k - 1) + "\n*ELEMENT_SOLID\n" + p + "," + p +
            ",1,2,3,4,5,6,7,8\n";
  }
  text += "*PART\nnone\n5,1,1,0,9\n" + keywords + "*END\n";
  Diagnostics diagnostics;
  const Deck deck = read_deck("deck.k", in_memory(text), diagnostics);
  const Model model = build_model(deck, diagnostics);
  const auto out = read_solid_viscosity(deck, model, diagnostics);
  messages = diagnostics.text();
  return out;
}

void expect_values(const SolidViscosity& v, int ihq, Real qm, Real q1, Real q2) {
  EXPECT_EQ(v.ihq, ihq);
  EXPECT_EQ(v.qm, qm);
  EXPECT_EQ(v.q1, q1);
  EXPECT_EQ(v.q2, q2);
}

const std::string cards = "*HOURGLASS\n1\n2,2,0.05,,2.,0.1\n3,0,0.03,,1e-20\n9,6,5.\n";

}  // namespace

TEST(SolidViscosity, HasDefaults) {
  std::string messages;
  const auto v = viscosity(cards, messages);
  EXPECT_EQ(messages, "");
  ASSERT_EQ(v.size(), 5u);
  expect_values(v[0], 1, 0.1, 1.5, 0.06);
  expect_values(v[1], 1, 0.1, 1.5, 0.06);
  expect_values(v[2], 2, 0.05, 2, 0.1);
  expect_values(v[3], 1, 0.03, 1e-20, 0.06);
}

TEST(SolidViscosity, TakesWhatHoldsForAllParts) {
  std::string messages;
  const auto v = viscosity(cards + "*CONTROL_HOURGLASS\n3,0.02\n*CONTROL_BULK_VISCOSITY\n1.,0.5\n", messages);
  EXPECT_EQ(messages, "");
  expect_values(v[0], 3, 0.02, 1, 0.5);
  expect_values(v[1], 3, 0.02, 1.5, 0.06);  // its Q1 and Q2 are in *HOURGLASS
  expect_values(v[2], 2, 0.05, 2, 0.1);
  expect_values(v[3], 3, 0.03, 1e-20, 0.06);
}

TEST(SolidViscosity, MissingHourglassIsNamed) {
  std::string messages;
  viscosity("*HOURGLASS\n1\n2\n", messages);
  EXPECT_NE(messages.find("field 5 (HGID, hourglass and bulk viscosity id [-]): hourglass 3 does not exist"),
            std::string::npos)
      << messages;
  EXPECT_EQ(messages.find("hourglass 9"), std::string::npos);
}

}  // namespace courant
