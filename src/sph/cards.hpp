#pragma once
#include "keyword/deck.hpp"
#include "model/conditions/viscosity_cards.hpp"
#include "sph/boundaries/boundary_cards.hpp"
#include "sph/core/kernel_cards.hpp"
#include "sph/options/option_cards.hpp"
#include "sph/sph_cards.hpp"

namespace courant {

/// *COURANT_EDDY_VISCOSITY, ours.
struct CourantEddyViscosity : Entry {
  Real lmax = 0, cmu = 0, kappa = 0;
  Real vtx = 0, vty = 0, vtz = 0, vhx = 0, vhy = 0, vhz = 0;
};

}  // namespace courant
