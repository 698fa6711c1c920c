// *SET_BEAM: read, so that decks with it run; what could use it is refused or warned of.
#include <string>
#include <vector>

#include "keyword/common_rules.hpp"
#include "keyword/registry.hpp"

namespace courant {

namespace {

struct SetBeam : Entry {
  std::string title;
  Id sid = 0;
  std::vector<Id> eids;
};

const RegisterKeyword<SetBeam> set_beam{
    {.names = {"SET_BEAM"},
     .purpose = "set of beams, which nothing that is supported refers to",
     .id_space = IdSpace::beam_set,
     .title_option = true,
     .title = &SetBeam::title,
     .cards = {{.fields = {{"SID", &SetBeam::sid, "-", "id of the set", rules::required_id}}},
               {.fields = {{"EID",
                            &SetBeam::eids,
                            "-",
                            "beams, any number of cards",
                            {.honour = Honour::ignored, .refers = IdSpace::beam}}},
                .repeat = true}}}};

}  // namespace

}  // namespace courant
