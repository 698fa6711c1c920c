// *MAT_LINEAR_ELASTIC_DISCRETE_BEAM
#include "elements/beam/discrete_beam_cards.hpp"

namespace courant {

namespace {

struct LinearElasticBeam : DiscreteBeamCard, LinearBeamFields {
  std::shared_ptr<DiscreteBeamLaw> law(const Deck&, const Model&, Diagnostics&) const {
    auto out = std::make_shared<DiscreteBeamLaw>();
    put_shared(*out), put_linear(*out);
    return out;
  }
};

const RegisterDiscreteBeam<LinearElasticBeam> mat_linear_elastic_discrete_beam{
    {.names = {"MAT_LINEAR_ELASTIC_DISCRETE_BEAM", "MAT_066"},
     .purpose = "six linear springs and dampers between the ends of beams with ELFORM 6",
     .id_space = IdSpace::material,
     .title_option = true,
     .title = &LinearElasticBeam::title,
     .cards = {stiffness_of_beams<LinearElasticBeam>(), damping_of_beams<LinearElasticBeam>(),
               preload_of_beams<LinearElasticBeam>()}}};

}  // namespace

}  // namespace courant
