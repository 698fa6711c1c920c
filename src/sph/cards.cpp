#include "sph/cards.hpp"
#include "sph/sph_cards.hpp"

#include "keyword/registry.hpp"

namespace courant {

namespace {

const RegisterKeyword<SectionSph> section_sph{section_sph_table()};
const RegisterKeyword<ControlSph> control_sph{control_sph_table()};

}  // namespace

}  // namespace courant
