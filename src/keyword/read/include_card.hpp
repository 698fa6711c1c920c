#pragma once
#include <string>

#include "keyword/card.hpp"
#include "keyword/deck_cards.hpp"

namespace courant {

/// *INCLUDE_TRANSFORM; field names as in the table in include_keywords.cpp.
struct IncludeTransformCard : IncludeTransformCardFields {
  Conversion conversion() const;
};

}  // namespace courant
