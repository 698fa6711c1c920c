#pragma once
// Cards with numbers, or with a word and other numbers (*SECTION_BEAM: "SECTION_05").
#include <cctype>
#include <string_view>

#include "keyword/keyword_spec.hpp"

namespace courant {

/// An optional card, not the last one, whose first field is a text: it is there where the line begins with a
/// letter.
inline bool is_absent_variant(const KeywordSpec& spec, std::size_t card, std::string_view line) {
  const CardSpec& c = spec.cards[card];
  if (!c.optional || card + 1 == spec.cards.size() || c.fields.front().type != FieldType::text) return false;
  const std::size_t first = line.find_first_not_of(' ');
  return first == std::string_view::npos || !std::isalpha(static_cast<unsigned char>(line[first]));
}

}  // namespace courant
