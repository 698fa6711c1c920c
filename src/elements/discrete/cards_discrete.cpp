#include "elements/discrete/cards_discrete.hpp"
#include "elements/discrete/discrete_cards.hpp"

#include "keyword/common_rules.hpp"
#include "keyword/registry.hpp"

namespace courant {

namespace {

using namespace rules;

constexpr FieldRules narrow(IdSpace space, bool required) {
  return {.required = required,
          .check = required ? Check::positive : Check::not_negative,
          .width = 8,
          .refers = space};
}
constexpr FieldRules narrow_id{.required = true, .check = Check::positive, .width = 8};

const RegisterKeyword<ElementDiscreteCard> element_discrete{element_discrete_table()};

using S = SectionDiscrete;
const RegisterKeyword<S> section_discrete{section_discrete_table()};
const RegisterKeyword<SdOrientation> define_sd_orientation{define_sd_orientation_table()};

using M = ElementMassCard;
template <class Card>
std::vector<CardOf<Card>> mass_cards(IdSpace on, const char* field) {
  return {{.fields = {
               {"EID", &Card::eid, "-", "element id", narrow_id},
               {field, &Card::nid, "-", "what carries it", narrow(on, true)},
               {"MASS", &Card::mass, "M", "mass of each node", {.check = Check::not_negative, .width = 16}},
               {"PID",
                &Card::pid,
                "-",
                "part id, for output",
                {.honour = Honour::ignored, .width = 8, .refers = IdSpace::part}}}}};
}
const RegisterKeyword<M> element_mass{element_mass_table()};
const RegisterKeyword<ElementMassSetCard> element_mass_set{
    {.names = {"ELEMENT_MASS_NODE_SET"},
     .purpose = "masses on all nodes of a set",
     .id_space = IdSpace::mass,
     .cards = mass_cards<ElementMassSetCard>(IdSpace::node_set, "NSID")}};

}  // namespace

}  // namespace courant
