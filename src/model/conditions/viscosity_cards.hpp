#pragma once
// Artificial viscosity and hourglass control of parts: particles take the bulk viscosity, solids both.
#include <string>

#include "keyword/card.hpp"
#include "model/conditions/condition_cards.hpp"

namespace courant {}  // namespace courant
