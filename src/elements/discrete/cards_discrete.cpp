#include "elements/discrete/cards_discrete.hpp"

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

using D = ElementDiscreteCard;
const RegisterKeyword<D> element_discrete{
    {.names = {"ELEMENT_DISCRETE"},
     .purpose = "springs and dampers between two nodes, or between a node and the ground",
     .id_space = IdSpace::discrete,
     .cards = {
         {.fields = {{"EID", &D::eid, "-", "element id", narrow_id},
                     {"PID", &D::pid, "-", "part id", narrow(IdSpace::part, true)},
                     {"N1", &D::n1, "-", "end 1", narrow(IdSpace::node, true)},
                     {"N2", &D::n2, "-", "end 2; 0: the ground, along VID", narrow(IdSpace::node, false)},
                     {"VID", &D::vid, "-", "direction of *DEFINE_SD_ORIENTATION; 0: from N1 to N2",
                      narrow(IdSpace::definition, false)},
                     {"S",
                      &D::s,
                      "-",
                      "factor on the force",
                      {.standard = 1, .check = Check::positive, .width = 16}},
                     {"PF", &D::pf, "-", "0: in deforc, 1: not", {.allowed = {0, 1}, .width = 8}},
                     {"OFFSET",
                      &D::offset,
                      "L",
                      "stretch at the start, > 0 pulls; of torsional ones an angle",
                      {.width = 16}}}}}}};

using S = SectionDiscrete;
constexpr FieldRules is_not_negative{.check = Check::not_negative};
const RegisterKeyword<S> section_discrete{
    {.names = {"SECTION_DISCRETE"},
     .purpose = "springs and dampers: along their length, or torsional",
     .id_space = IdSpace::section,
     .title_option = true,
     .title = &S::title,
     .cards = {{.fields = {{"SECID", &S::secid, "-", "id that *PART refers to", required_id},
                           {"DRO", &S::dro, "-", "0: translational, 1: torsional", {.allowed = {0, 1}}},
                           {"KD", &S::kd, "-", "force times 1 + KD |V|/V0, V the rate", is_not_negative},
                           {"V0", &S::v0, "L/T", "rate to which KD belongs", is_not_negative},
                           {"CL", &S::cl, "L", "clearance", unsupported},
                           {"FD", &S::fd, "L", "stretch at which it fails", unsupported}}},
               {.fields = {{"CDL", &S::cdl, "L", "largest shortening", unsupported},
                           {"TDL", &S::tdl, "L", "largest stretch", unsupported}},
                .optional = true}}}};

using O = SdOrientation;
const RegisterKeyword<O> define_sd_orientation{
    {.names = {"DEFINE_SD_ORIENTATION"},
     .purpose = "fixed direction in which springs and dampers act",
     .id_space = IdSpace::definition,
     .title_option = true,
     .title = &O::title,
     .cards = {
         {.fields = {
              {"VID", &O::vid, "-", "id that *ELEMENT_DISCRETE refers to", required_id},
              {"IOP", &O::iop, "-", "0: along the vector; others follow nodes, or project", {.allowed = {0}}},
              {"XT", &O::xt, "-", "vector, x", direction},
              {"YT", &O::yt, "-", "vector, y"},
              {"ZT", &O::zt, "-", "vector, z"},
              {"NID1", &O::nid1, "-", "node of IOP 2 and 3", {.honour = Honour::no, .refers = IdSpace::node}},
              {"NID2",
               &O::nid2,
               "-",
               "node of IOP 2 and 3",
               {.honour = Honour::no, .refers = IdSpace::node}}}}}}};

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
const RegisterKeyword<M> element_mass{{.names = {"ELEMENT_MASS"},
                                       .purpose = "masses on single nodes",
                                       .id_space = IdSpace::mass,
                                       .cards = mass_cards<M>(IdSpace::node, "NID")}};
const RegisterKeyword<ElementMassSetCard> element_mass_set{
    {.names = {"ELEMENT_MASS_NODE_SET"},
     .purpose = "masses on all nodes of a set",
     .id_space = IdSpace::mass,
     .cards = mass_cards<ElementMassSetCard>(IdSpace::node_set, "NSID")}};

}  // namespace

}  // namespace courant
