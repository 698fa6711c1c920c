#include "app/restart_cards.hpp"

#include "keyword/registry.hpp"

namespace courant {

namespace {

FieldRules no_effect_of(IdSpace refers) {
  return {.honour = Honour::ignored, .refers = refers};
}
const FieldRules cycles{.check = Check::not_negative};

using R = DatabaseRunrsfCard;
const RegisterKeyword<R> runrsf{
    {.names = {"DATABASE_BINARY_RUNRSF"},
     .purpose = "interval of the running restart file restart/runrsf.h5, which each dump replaces",
     .once = true,
     .many = false,
     .cards = {
         {.fields = {{"CYCL", &R::cycl, "-", "interval in cycles, 0 none", cycles},
                     {"NR",
                      &R::nr,
                      "-",
                      "number of files, used by turns",
                      {.standard = 1, .check = Check::positive}},
                     {"BEAM", &R::beam, "-", "discrete elements as beams", no_effect},
                     {"NPLTC", &R::npltc, "-", "not used by this file", no_effect},
                     {"PSETID", &R::psetid, "-", "not used by this file", no_effect_of(IdSpace::part_set)},
                     {},
                     {"NSKIP", &R::nskip, "-", "kind of file in runs on many machines", no_effect}}}}}};

using D = DatabaseD3dumpCard;
const RegisterKeyword<D> d3dump{
    {.names = {"DATABASE_BINARY_D3DUMP"},
     .purpose = "interval of restart files that are all kept: restart/d3dump01.h5, d3dump02.h5, ...",
     .once = true,
     .many = false,
     .cards = {
         {.fields = {{"CYCL", &D::cycl, "-", "interval in cycles, 0 none", cycles},
                     {"LCDT", &D::lcdt, "-", "not used by this file", no_effect_of(IdSpace::curve)},
                     {"BEAM", &D::beam, "-", "discrete elements as beams", no_effect},
                     {"NPLTC", &D::npltc, "-", "not used by this file", no_effect},
                     {"PSETID", &D::psetid, "-", "not used by this file", no_effect_of(IdSpace::part_set)},
                     {"CID", &D::cid, "-", "not used by this file", no_effect_of(IdSpace::coordinate_system)},
                     {"NSKIP", &D::nskip, "-", "kind of file in runs on many machines", no_effect}}},
         {.fields = {{"IOOPT", &D::ioopt, "-", "mode of the curve", no_effect}}, .optional = true}}}};

}  // namespace

}  // namespace courant
