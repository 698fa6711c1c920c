#pragma once
#include <array>
#include <vector>

#include "elements/beam/beam_cards.hpp"
#include "keyword/card.hpp"

namespace courant {

/// *INTEGRATION_BEAM: points in the section of beams whose section has QR/IRID = -IRID.
struct IntegrationBeam : IntegrationBeamFields {
  std::array<Real, 4> dimensions() const { return {d1, d2, d3, d4}; }
};

}  // namespace courant
