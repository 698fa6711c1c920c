#pragma once
#include <string>
#include <vector>

#include "keyword/card.hpp"
#include "model/sets/sets_cards.hpp"

namespace courant {}  // namespace courant
