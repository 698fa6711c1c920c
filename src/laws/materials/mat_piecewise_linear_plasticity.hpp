#pragma once
// The plasticity of *MAT_PIECEWISE_LINEAR_PLASTICITY, for materials that add damage or failure to it.
#include <memory>

#include "laws/materials/strength_cards.hpp"
#include "laws/strength/strength.hpp"

namespace courant {

std::shared_ptr<StrengthLaw> piecewise_linear_plasticity(const MatPiecewiseLinearPlasticityFields& card,
                                                         const Model& model);
void check_piecewise_linear_plasticity(const MatPiecewiseLinearPlasticityFields& card, const Deck& deck,
                                       const Model& model, Diagnostics& diagnostics);
/// NUMINT of cards that fail by points of shells.
void check_failing_layers(const Deck& deck, const Entry& card, Real numint, Diagnostics& diagnostics);

}  // namespace courant
