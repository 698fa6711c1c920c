#include "keyword/registry.hpp"
#include "sph/cards.hpp"
#include "sph/options/option_cards.hpp"

namespace courant {

namespace {

const RegisterKeyword<CourantPairGeometry> pair_geometry{courant_pair_geometry_table()};

}  // namespace

}  // namespace courant
