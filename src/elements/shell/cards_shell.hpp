#pragma once
#include "elements/shell/shell_element_cards.hpp"
#include "keyword/card.hpp"

namespace courant {

/// *CONTROL_ACCURACY: INN states how the axes of shells lie in them.
struct ControlAccuracy : ControlAccuracyFields {
  bool invariant_shells() const { return inn == 2 || inn == 4 || inn == -2 || inn == -4; }
};

}  // namespace courant
