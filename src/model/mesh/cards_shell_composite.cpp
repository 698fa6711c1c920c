// *ELEMENT_SHELL_COMPOSITE: shells with layers of their own.
#include "keyword/common_rules.hpp"
#include "keyword/registry.hpp"
#include "model/mesh/shell_composite.hpp"
#include "model/transforms/transformation.hpp"

namespace courant {

namespace {

using namespace rules;
using Shell = ElementShellCompositeCard;

const FieldRules shell_id{.required = true, .check = Check::positive, .width = 8};
const FieldRules part_of_shell{
    .required = true, .check = Check::positive, .width = 8, .refers = IdSpace::part};
const FieldRules shell_corner{
    .required = true, .check = Check::positive, .width = 8, .refers = IdSpace::node};
const FieldRules fourth_corner{.check = Check::not_negative, .width = 8, .refers = IdSpace::node};
const FieldRules middle_node{.honour = Honour::no, .width = 8, .refers = IdSpace::node};
const FieldRules layer_material{.check = Check::not_negative, .refers = IdSpace::material};
const FieldRules layer_thickness{.check = Check::not_negative};

const RegisterKeyword<Shell> element_shell_composite{
    {.names = {"ELEMENT_SHELL_COMPOSITE", "ELEMENT_SHELL_COMPOSITE_LONG", "ELEMENT_SHELL_OFFSET_COMPOSITE",
               "ELEMENT_SHELL_OFFSET_COMPOSITE_LONG"},
     .purpose =
         "layered shells: layers of each element, one point in the middle of each, from the lower face "
         "up; two on a card, with _LONG one. They replace those of the part",
     .id_space = IdSpace::shell,
     .cards = {{.fields = {{"EID", &Shell::eid, "-", "element id", shell_id},
                           {"PID", &Shell::pid, "-", "part id", part_of_shell},
                           {"N1", &Shell::n1, "-", "corner node 1", shell_corner},
                           {"N2", &Shell::n2, "-", "corner node 2", shell_corner},
                           {"N3", &Shell::n3, "-", "corner node 3", shell_corner},
                           {"N4", &Shell::n4, "-", "corner node 4; triangle: N3 or 0", fourth_corner},
                           {"N5", &Shell::n5, "-", "mid-side node", middle_node},
                           {"N6", &Shell::n6, "-", "mid-side node", middle_node},
                           {"N7", &Shell::n7, "-", "mid-side node", middle_node},
                           {"N8", &Shell::n8, "-", "mid-side node", middle_node}}},
               {.fields = {{"OFFSET",
                            &Shell::offset,
                            "L",
                            "height of the middle surface over the nodes, instead of NLOC",
                            {.width = 16}}},
                .when = [](const Shell& e) { return e.has_offset(); }},
               {.fields = {{"MID1", &Shell::mid1, "-", "material of a layer", layer_material},
                           {"THICK1", &Shell::thick1, "L", "its thickness", layer_thickness},
                           {"B1", &Shell::b1, "-", "angle of its material, degrees"},
                           {},
                           {"MID2", &Shell::mid2, "-", "material of the layer above", layer_material},
                           {"THICK2", &Shell::thick2, "L", "its thickness", layer_thickness},
                           {"B2", &Shell::b2, "-", "angle of its material, degrees"}},
                .repeat = true,
                .until_entry = true,
                .when = [](const Shell& e) { return !e.is_long(); }},
               {.fields = {{"MID1", &Shell::mid1, "-", "material of a layer", layer_material},
                           {"THICK1", &Shell::thick1, "L", "its thickness", layer_thickness},
                           {"B1", &Shell::b1, "-", "angle of its material, degrees"},
                           {},
                           {"PLYID", &Shell::plyid, "-", "name of the layer", {.honour = Honour::ignored}}},
                .repeat = true,
                .until_entry = true,
                .when = [](const Shell& e) { return e.is_long(); }}},
     .move = refuse_mirror<Shell>}};

}  // namespace

}  // namespace courant
