#pragma once
#include <array>
#include <vector>

#include "keyword/card.hpp"

namespace courant {

/// *INTEGRATION_BEAM: points in the section of beams whose section has QR/IRID = -IRID.
struct IntegrationBeam : Entry {
  Id irid = 0;
  int nip = 0, icst = 0, k = 1;
  Real ra = 0, d1 = 0, d2 = 0, d3 = 0, d4 = 0, d5 = 0, d6 = 0, sref = 0, tref = 0;
  std::vector<Real> s{}, t{}, wf{};
  std::vector<Id> pid{};
  std::array<Real, 4> dimensions() const { return {d1, d2, d3, d4}; }
};

}  // namespace courant
