// *SET_BEAM. Histories and cross sections refer to it.
#include "model/sets/set_beam.hpp"

#include "keyword/common_rules.hpp"
#include "keyword/registry.hpp"

namespace courant {

namespace {

const RegisterKeyword<SetBeam> set_beam{
    {.names = {"SET_BEAM"},
     .purpose = "set of beams, for histories and cross sections",
     .id_space = IdSpace::beam_set,
     .title_option = true,
     .title = &SetBeam::title,
     .cards = {{.fields = {{"SID", &SetBeam::sid, "-", "id of the set", rules::required_id}}},
               {.fields = {{"EID",
                            &SetBeam::eids,
                            "-",
                            "beams, any number of cards",
                            {.check = Check::not_negative, .refers = IdSpace::beam}}},
                .repeat = true}}}};

}  // namespace

}  // namespace courant
