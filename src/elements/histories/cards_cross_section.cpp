// Tables of *DATABASE_CROSS_SECTION and *DATABASE_SECFORC.
#include "elements/histories/cards_cross_section.hpp"

#include "keyword/registry.hpp"

namespace courant {

namespace {

const RegisterKeyword<CrossSectionPlaneCard> cross_section_plane{database_cross_section_plane_table()};
const RegisterKeyword<CrossSectionSetCard> cross_section_set{database_cross_section_set_table()};
const RegisterKeyword<DatabaseSecforc> database_secforc{history_interval<DatabaseSecforc>(
    "DATABASE_SECFORC", "interval of secforc: force, moment, centroid and area of each cross section")};

}  // namespace

IdSpace space_of_section(const CrossSectionCard& card) {
  return card.itype == 2 ? IdSpace::coordinate_system : card.itype == 0 ? IdSpace::part : IdSpace::none;
}

}  // namespace courant
