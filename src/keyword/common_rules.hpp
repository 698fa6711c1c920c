#pragma once
// Rules that many fields share.
#include "keyword/card.hpp"

namespace courant::rules {

inline constexpr FieldRules required_id{.required = true, .check = Check::positive};
inline constexpr FieldRules required_positive{.required = true, .check = Check::positive};
inline constexpr FieldRules point{.spatial = Spatial::point};
inline constexpr FieldRules direction{.spatial = Spatial::direction};

constexpr FieldRules required_id_of(IdSpace space) {
  return {.required = true, .check = Check::positive, .refers = space};
}
/// 0: none.
constexpr FieldRules optional_id_of(IdSpace space) {
  return {.check = Check::not_negative, .refers = space};
}
/// Any integer: signs of ids are flags in some keywords.
constexpr FieldRules id_of(IdSpace space) {
  return {.refers = space};
}
constexpr FieldRules or_blank(Real standard) {
  return {.standard = standard};
}

/// For a field that names a curve: dimensions of its numbers.
constexpr FieldRules over(FieldRules rules, const char* abscissa, const char* ordinate) {
  rules.curve = {abscissa, ordinate};
  return rules;
}

}  // namespace courant::rules
