// *PART_CONTACT: a part with data for contacts.
#include "keyword/registry.hpp"
#include "model/cards.hpp"
#include "model/mesh/part_card.hpp"

namespace courant {

namespace {

constexpr FieldRules scale{.standard = 1, .check = Check::positive};

using Q = PartContactCard;
const RegisterKeyword<Q> part_contact{
    {.names = {"PART_CONTACT"},
     .purpose =
         "parts with a thickness and a stiffness of their own in contacts; friction only contacts with "
         "FS = -1 would read, which are refused",
     .id_space = IdSpace::part,
     .heading = true,
     .title = &Q::title,
     .cards = {
         part_card<Q>(),
         {.fields = {{"FS", &Q::fs, "-", "static friction", no_effect},
                     {"FD", &Q::fd, "-", "dynamic friction", no_effect},
                     {"DC", &Q::dc, "T/L", "decay of the friction", no_effect},
                     {"VC", &Q::vc, "M/LT2", "largest friction stress", no_effect},
                     {"OPTT",
                      &Q::optt,
                      "L",
                      "thickness of its shells in contacts that are not tied and do not give one "
                      "themselves (SAST, SBST); 0: their own",
                      {.check = Check::not_negative}},
                     {"SFT", &Q::sft, "-", "scale of the thickness of its shells there, without OPTT", scale},
                     {"SSF", &Q::ssf, "-", "scale of the stiffness of its elements in all contacts", scale},
                     {"CPARM8", &Q::cparm8, "-", "beams left out of contact", no_effect}}}}}};

}  // namespace

}  // namespace courant
