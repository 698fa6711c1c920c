#pragma once
// Which units a deck uses: LS-DYNA's are whatever the numbers agree on, so the numbers are judged in each
// common system.
#include <optional>
#include <string>
#include <vector>

#include "app/check/deck_facts.hpp"

namespace courant {

struct UnitNames {
  std::string mass, length, time;
};

/// Numbers of the deck in common systems of units, and which system they look like. [L/T]
std::string units_text(const DeckFacts& facts, const std::vector<Real>& sound_speeds);
/// The system that `units_text` names; nothing where none fits, or two fit alike.
std::optional<UnitNames> guess_units(const DeckFacts& facts, const std::vector<Real>& sound_speeds);

}  // namespace courant
