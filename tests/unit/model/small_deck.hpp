#pragma once
#include <string>

#include "../keyword/decks_in_memory.hpp"
#include "model/build_model.hpp"

namespace courant {

/// Nine nodes in the plane z = 0 with four shells between them, and two particles above.
///
///   7 - 8 - 9      shells 1 (1 2 5 4) and 2 (2 3 6 5) are part 2,
///   | 3 | 4/|      shells 3 (4 5 8 7) and 4 (5 6 9) are part 3,
///   4 - 5 - 6      particles 11 and 12 are part 1
///   | 1 | 2 |
///   1 - 2 - 3
inline constexpr const char* small_mesh =
    "*KEYWORD\n*NODE\n1,0.,0.,0.\n2,1.,0.,0.\n3,2.,0.,0.\n4,0.,1.,0.\n5,1.,1.,0.\n6,2.,1.,0.\n"
    "7,0.,2.,0.\n8,1.,2.,0.\n9,2.,2.,0.\n11,.5,.5,1.\n12,1.5,.5,1.\n"
    "*PART\nwater\n1,1,1\n*PART\nfloor\n2,2,2\n*PART\nwall\n3,2,2\n"
    "*ELEMENT_SPH\n11,1,1.\n12,1,1.\n"
    "*ELEMENT_SHELL\n1,2,1,2,5,4\n2,2,2,3,6,5\n3,3,4,5,8,7\n4,3,5,6,9\n"
    "*CONTROL_TERMINATION\n1.\n";

struct SmallModel {
  Deck deck;
  Model model;
  std::string messages;
};

/// The model of the mesh above with more keywords behind it.
inline SmallModel small_model(const std::string& keywords) {
  SmallModel out;
  Diagnostics diagnostics;
  const std::string text = small_mesh + keywords + "*END\n";
  out.deck = read_deck("deck.k", in_memory(text), diagnostics);
  out.model = build_model(out.deck, diagnostics);
  out.messages = diagnostics.text();
  return out;
}

}  // namespace courant
