#include "elements/beam/integration_beam.hpp"
#include "elements/beam/beam_cards.hpp"

#include "keyword/registry.hpp"

namespace courant {

namespace {

const RegisterKeyword<IntegrationBeam> integration_beam{integration_beam_table()};

}  // namespace

}  // namespace courant
