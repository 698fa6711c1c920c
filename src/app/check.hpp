#pragma once
// `courant check`: a deck is read and built, nothing is run, and the user sees what Courant makes of it.
#include <string>
#include <vector>

#include "app/deck_facts.hpp"
#include "app/simulation.hpp"
#include "model/sets/unused_ids.hpp"

namespace courant {

struct CheckResult {
  bool sound = false;    ///< can be run; with `strict` also: without a warning
  std::string deck;      ///< what was read: files, keywords, mesh
  std::string messages;  ///< of reader and model
  std::string model;     ///< what a run would compute; empty unless the deck can be run
  std::string verdict;   ///< last line
};

/// `strict`: warnings and ids that nothing refers to are errors.
CheckResult check_deck(const std::string& path, const ReadOptions& options, bool strict);

// check_deck.cpp: the parts of CheckResult::deck
std::string files_text(const Deck& deck);
std::string parameters_text(const Deck& deck);  ///< empty if the deck has none
std::string keywords_text(const Deck& deck);
std::string mesh_text(const DeckFacts& facts);
/// What a run would need besides what the deck holds: refused keywords by what they lack, and what is missing
/// in a deck for any run. Empty if nothing.
std::string needs_text(const Deck& deck, const DeckFacts& facts);
std::string unused_text(const Deck& deck, const UnusedIds& unused);

// check_model.cpp
/// Evaluates the first step; the simulation must not be run afterwards.
std::string model_text(Simulation& simulation, std::vector<Real>& sound_speeds);

// check_units.cpp
/// Numbers of the deck in common systems of units, and which system they look like.
std::string units_text(const DeckFacts& facts, const std::vector<Real>& sound_speeds);

}  // namespace courant
