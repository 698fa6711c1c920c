// *PART_CONTACT: a part with data for contacts.
#include "keyword/registry.hpp"
#include "model/cards.hpp"
#include "model/mesh/part_card.hpp"

namespace courant {

namespace {

/// Contacts read the friction of parts where their own FS is -1, which they refuse: no effect.
const FieldRules scale{.standard = 1, .honour = Honour::no};

using Q = PartContactCard;
const RegisterKeyword<Q> part_contact{
    {.names = {"PART_CONTACT"},
     .purpose = "parts with friction of their own, which only contacts with FS = -1 would read",
     .id_space = IdSpace::part,
     .heading = true,
     .title = &Q::title,
     .cards = {part_card<Q>(),
               {.fields = {{"FS", &Q::fs, "-", "static friction", no_effect},
                           {"FD", &Q::fd, "-", "dynamic friction", no_effect},
                           {"DC", &Q::dc, "T/L", "decay of the friction", no_effect},
                           {"VC", &Q::vc, "M/LT2", "largest friction stress", no_effect},
                           {"OPTT", &Q::optt, "L", "contact thickness", unsupported},
                           {"SFT", &Q::sft, "-", "scale of the contact thickness", scale},
                           {"SSF", &Q::ssf, "-", "scale of the stiffness", scale},
                           {"CPARM8", &Q::cparm8, "-", "beams left out of contact", no_effect}}}}}};

}  // namespace

}  // namespace courant
