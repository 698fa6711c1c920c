// *PART_COMPOSITE: a part of shells with its layers.
#include "keyword/common_rules.hpp"
#include "keyword/registry.hpp"
#include "model/mesh/part_composite.hpp"
#include "model/transforms/transformation.hpp"

namespace courant {

namespace {

using namespace rules;
using Layered = PartCompositeCard;

const FieldRules ply_material{.check = Check::not_negative, .refers = IdSpace::material};
const FieldRules thermal_material{
    .check = Check::not_negative, .honour = Honour::ignored, .refers = IdSpace::material};
const FieldRules at_least_0{.check = Check::not_negative};

const RegisterKeyword<Layered> part_composite{
    {.names = {"PART_COMPOSITE", "PART_COMPOSITE_LONG"},
     .purpose = "parts of layered shells: one point in the middle of each layer, from the lower face up; two "
                "layers on a card, with _LONG one",
     .id_space = IdSpace::part,
     .heading = true,
     .title = &Layered::title,
     .many = false,
     .cards =
         {{.fields =
               {{"PID", &Layered::pid, "-", "part id", required_id},
                {"ELFORM", &Layered::elform, "-",
                 "formulation: 2 Belytschko-Tsay, 4 flat triangle, 16 2 x 2 points; 0: THEORY of "
                 "*CONTROL_SHELL"},
                {"SHRF", &Layered::shrf, "-", "factor of transverse shear", {.standard = 1}},
                {"NLOC", &Layered::nloc, "-", "position of the nodes: 1 upper face, -1 lower, 0 middle"},
                {"MAREA", &Layered::marea, "M/L2", "mass per area besides that of the layers", at_least_0},
                {"HGID", &Layered::hgid, "-", "hourglass id", optional_id_of(IdSpace::hourglass)},
                {"ADPOPT", &Layered::adpopt, "-", "adaptivity", unsupported},
                {"THSHEL", &Layered::thshel, "-", "thermal shells", no_effect}}},
          {.fields = {{"MID1", &Layered::mid1, "-", "material of a layer", ply_material},
                      {"THICK1", &Layered::thick1, "L", "its thickness", at_least_0},
                      {"B1", &Layered::b1, "-", "angle of its material, degrees"},
                      {"TMID1", &Layered::tmid1, "-", "thermal material", thermal_material},
                      {"MID2", &Layered::mid2, "-", "material of the layer above", ply_material},
                      {"THICK2", &Layered::thick2, "L", "its thickness", at_least_0},
                      {"B2", &Layered::b2, "-", "angle of its material, degrees"},
                      {"TMID2", &Layered::tmid2, "-", "thermal material", thermal_material}},
           .repeat = true,
           .when = [](const Layered& c) { return !c.is_long(); }},
          {.fields =
               {{"MID1", &Layered::mid1, "-", "material of a layer", ply_material},
                {"THICK1", &Layered::thick1, "L", "its thickness", at_least_0},
                {"B1", &Layered::b1, "-", "angle of its material, degrees"},
                {"TMID1", &Layered::tmid1, "-", "thermal material", thermal_material},
                {"PLYID", &Layered::plyid, "-", "name of the layer", {.honour = Honour::ignored}},
                {"SHRFAC", &Layered::shrfac, "-", "factor of its shear stress", {.honour = Honour::no}}},
           .repeat = true,
           .when = [](const Layered& c) { return c.is_long(); }}},
     .move = refuse_mirror<Layered>}};

}  // namespace

}  // namespace courant
