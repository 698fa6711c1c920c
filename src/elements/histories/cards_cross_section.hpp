#pragma once
#include "elements/histories/history_cards.hpp"
#include "extension/history_interval.hpp"
#include "keyword/card.hpp"

namespace courant {

struct CrossSectionPlaneCard : CrossSectionCard {};
struct CrossSectionSetCard : CrossSectionCard {};

struct DatabaseSecforc : HistoryInterval {};

}  // namespace courant
