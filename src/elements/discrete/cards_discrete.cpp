#include "elements/discrete/cards_discrete.hpp"
#include "elements/discrete/discrete_cards.hpp"

#include "keyword/registry.hpp"

namespace courant {

namespace {

const RegisterKeyword<ElementDiscreteCard> element_discrete{element_discrete_table()};

const RegisterKeyword<SectionDiscrete> section_discrete{section_discrete_table()};
const RegisterKeyword<SdOrientation> define_sd_orientation{define_sd_orientation_table()};

const RegisterKeyword<ElementMassCard> element_mass{element_mass_table()};
const RegisterKeyword<ElementMassSetCard> element_mass_set{element_mass_node_set_table()};

}  // namespace

}  // namespace courant
