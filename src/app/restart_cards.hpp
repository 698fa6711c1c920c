#pragma once
#include "app/app_cards.hpp"
#include "keyword/card.hpp"

namespace courant {}  // namespace courant
