// Tables of *INCLUDE and its kin. DeckReader handles them by name; *INCLUDE_TRANSFORM is read by its table.
#include "keyword/include_card.hpp"
#include "keyword/registry.hpp"

namespace courant {

Conversion IncludeTransformCard::conversion() const {
  Conversion out;
  out.offsets = {.node = idnoff,
                 .element = ideoff,
                 .part = idpoff,
                 .material = idmoff,
                 .set = idsoff,
                 .curve = idfoff,
                 .definition = iddoff,
                 .other = idroff};
  out.units = {.mass = fctmas, .time = fcttim, .length = fctlen};
  out.prefix = prefix;
  out.suffix = suffix;
  if (tranid != 0) out.transformations = {tranid};
  return out;
}

namespace {

struct IncludeLine : Entry {
  std::string text;
};

const RegisterKeyword<IncludeLine> include_keyword{
    {.names = {"INCLUDE"},
     .purpose = "reads other files: a name is looked for beside this file, in the working directory, then in "
                "the folders of INCLUDE_PATH; ' +' at the end of a line continues the name",
     .cards = {{.fields = {{"FILENAME", &IncludeLine::text, "-", "name of a file", {.width = 80}}}}}}};

const RegisterKeyword<IncludeLine> include_path{
    {.names = {"INCLUDE_PATH"},
     .purpose = "folders in which the files included further down are looked for, in this order; their names "
                "are relative to the working directory, then to the deck's own folder",
     .cards = {{.fields = {{"PATH", &IncludeLine::text, "-", "name of a folder", {.width = 80}}}}}}};

const RegisterKeyword<IncludeLine> include_path_relative{
    {.names = {"INCLUDE_PATH_RELATIVE"},
     .purpose = "as INCLUDE_PATH, for folders whose names are relative to the deck's own folder",
     .cards = {{.fields = {{"PATH", &IncludeLine::text, "-", "name of a folder", {.width = 80}}}}}}};

using T = IncludeTransformCard;
const FieldRules offset{.check = Check::not_negative};
const FieldRules factor{.standard = 1, .check = Check::positive};

const RegisterKeyword<T> include_transform{
    {.names = {"INCLUDE_TRANSFORM"},
     .purpose = "reads a file with its ids shifted, its units changed, and its points moved",
     .many = false,
     .cards = {
         {.fields = {{"FILENAME", &T::filename, "-", "name of a file", {.width = 80}}}},
         {.fields = {{"IDNOFF", &T::idnoff, "-", "offset of node ids", offset},
                     {"IDEOFF", &T::ideoff, "-", "offset of element ids", offset},
                     {"IDPOFF", &T::idpoff, "-", "offset of part and rigid wall ids", offset},
                     {"IDMOFF", &T::idmoff, "-", "offset of material and equation of state ids", offset},
                     {"IDSOFF", &T::idsoff, "-", "offset of set ids", offset},
                     {"IDFOFF", &T::idfoff, "-", "offset of curve and table ids", offset},
                     {"IDDOFF", &T::iddoff, "-", "offset of all other *DEFINE ids", offset}},
          .optional = true},
         {.fields = {{"IDROFF", &T::idroff, "-", "offset of all other ids", offset},
                     {},
                     {"PREFIX", &T::prefix, "-", "stands before titles, joined by a dot"},
                     {"SUFFIX", &T::suffix, "-", "stands behind titles, joined by a dot"}},
          .optional = true},
         {.fields = {{"FCTMAS", &T::fctmas, "-", "the file's unit of mass in the deck's", factor},
                     {"FCTTIM", &T::fcttim, "-", "the file's unit of time in the deck's", factor},
                     {"FCTLEN", &T::fctlen, "-", "the file's unit of length in the deck's", factor},
                     {"FCTTEM", &T::fcttem, "-", "change of temperature scale; only none (blank, 0 or 1)"},
                     {"INCOUT1", &T::incout1, "-", "1 writes the converted file", no_effect_but(1)},
                     {"FCTCHG", &T::fctchg, "-", "unit of charge; nothing here has one", no_effect_but(1)}},
          .optional = true},
         {.fields = {{"TRANID",
                      &T::tranid,
                      "-",
                      "*DEFINE_TRANSFORMATION that moves the file, 0 none",
                      {.check = Check::not_negative, .refers = IdSpace::transformation}}},
          .optional = true}}}};

}  // namespace

}  // namespace courant
