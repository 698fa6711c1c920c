#pragma once
// The units of a deck: LS-DYNA accepts any consistent ones, so the numbers are judged in each common system.
#include <optional>
#include <string>
#include <vector>

#include "app/check/deck_facts.hpp"

namespace courant {

struct UnitNames {
  std::string mass, length, time;
};

/// Numbers of the deck in common systems of units, and the most probable one. [L/T]
std::string units_text(const DeckFacts& facts, const std::vector<Real>& sound_speeds);
/// The system that `units_text` names; nothing where none fits, or two fit alike.
std::optional<UnitNames> guess_units(const DeckFacts& facts, const std::vector<Real>& sound_speeds);

}  // namespace courant
