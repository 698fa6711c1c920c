// Tables of *INCLUDE and its kin. DeckReader handles them by name; *INCLUDE_TRANSFORM is read by its table.
#include "keyword/deck_cards.hpp"
#include "keyword/read/include_card.hpp"
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

const RegisterKeyword<IncludeLine> include_path_relative{include_path_relative_table()};
const RegisterKeyword<IncludeTransformCard> include_transform{include_transform_table()};

}  // namespace

}  // namespace courant
