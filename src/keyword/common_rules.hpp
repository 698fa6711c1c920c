#pragma once
// Rules that many fields share.
#include "keyword/card.hpp"

namespace courant::rules {

inline const FieldRules required_id{.required = true, .check = Check::positive};
inline const FieldRules point{.spatial = Spatial::point};
inline const FieldRules direction{.spatial = Spatial::direction};

inline FieldRules required_id_of(IdSpace space) {
  return {.required = true, .check = Check::positive, .refers = space};
}
/// 0: none.
inline FieldRules optional_id_of(IdSpace space) {
  return {.check = Check::not_negative, .refers = space};
}
/// Any integer: signs of ids are flags in some keywords.
inline FieldRules id_of(IdSpace space) {
  return {.refers = space};
}
inline FieldRules or_blank(Real standard) {
  return {.standard = standard};
}

}  // namespace courant::rules
