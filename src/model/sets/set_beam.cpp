// *SET_BEAM. Histories and cross sections refer to it.
#include "model/sets/sets_cards.hpp"

#include "keyword/registry.hpp"

namespace courant {

namespace {

const RegisterKeyword<SetBeam> set_beam{set_beam_table()};

}  // namespace

}  // namespace courant
