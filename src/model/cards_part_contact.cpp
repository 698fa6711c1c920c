// *PART_CONTACT: a part with data for contacts.
#include "keyword/common_rules.hpp"
#include "keyword/registry.hpp"
#include "model/cards.hpp"

namespace courant {

namespace {

using namespace rules;

/// Contacts read the friction of parts where their own FS is -1, which they refuse: no effect.
const FieldRules scale{.standard = 1, .honour = Honour::no};

using P = PartContactCard;
const RegisterKeyword<P> part_contact{
    {.names = {"PART_CONTACT"},
     .purpose = "parts with friction of their own, which only contacts with FS = -1 would read",
     .id_space = IdSpace::part,
     .heading = true,
     .title = &P::title,
     .cards = {{.fields = {{"PID", &P::pid, "-", "part id", required_id},
                           {"SECID", &P::secid, "-", "section id", required_id_of(IdSpace::section)},
                           {"MID", &P::mid, "-", "material id", required_id_of(IdSpace::material)},
                           {"EOSID", &P::eosid, "-", "equation of state id", optional_id_of(IdSpace::eos)},
                           {"HGID", &P::hgid, "-", "hourglass and bulk viscosity id",
                            optional_id_of(IdSpace::hourglass)},
                           {"GRAV", &P::grav, "-", "gravity preload", unsupported},
                           {"ADPOPT", &P::adpopt, "-", "adaptivity", unsupported},
                           {"TMID",
                            &P::tmid,
                            "-",
                            "thermal material id",
                            {.honour = Honour::no, .refers = IdSpace::material}}}},
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
