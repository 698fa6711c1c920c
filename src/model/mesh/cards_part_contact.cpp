// *PART_CONTACT: a part with data for contacts.
#include "keyword/registry.hpp"
#include "model/cards.hpp"
#include "model/mesh/part_card.hpp"

namespace courant {

namespace {

/// Contacts read the friction of parts where their own FS is -1, which they refuse: no effect.
const FieldRules scale{.standard = 1, .honour = Honour::no};

using P = PartContactCard;
const RegisterKeyword<P> part_contact{
    {.names = {"PART_CONTACT"},
     .purpose = "parts with friction of their own, which only contacts with FS = -1 would read",
     .id_space = IdSpace::part,
     .heading = true,
     .title = &P::title,
     .cards = {part_card<P>(),
               {.fields = {{"FS", &P::fs, "-", "static friction", no_effect},
                           {"FD", &P::fd, "-", "dynamic friction", no_effect},
                           {"DC", &P::dc, "T/L", "decay of the friction", no_effect},
                           {"VC", &P::vc, "M/LT2", "largest friction stress", no_effect},
                           {"OPTT", &P::optt, "L", "contact thickness", unsupported},
                           {"SFT", &P::sft, "-", "scale of the contact thickness", scale},
                           {"SSF", &P::ssf, "-", "scale of the stiffness", scale},
                           {"CPARM8", &P::cparm8, "-", "beams left out of contact", no_effect}}}}}};

}  // namespace

}  // namespace courant
