// *MAT_LINEAR_ELASTIC_DISCRETE_BEAM
#include "laws/discrete/discrete_beam_cards.hpp"

namespace courant {

namespace {

struct LinearElasticBeam : DiscreteBeamCard {
  std::shared_ptr<DiscreteBeamLaw> law(const Deck&, const Model&, Diagnostics&) const {
    auto out = std::make_shared<DiscreteBeamLaw>();
    put_shared(*out), put_linear(*out);
    return out;
  }
};

const RegisterDiscreteBeam<LinearElasticBeam> mat_linear_elastic_discrete_beam{
    mat_linear_elastic_discrete_beam_table()};

}  // namespace

}  // namespace courant
