#pragma once
#include <vector>

#include "keyword/card.hpp"

namespace courant {

/// *INTEGRATION_SHELL: points through the thickness of shells whose section has QR/IRID = -IRID.
struct IntegrationShell : Entry {
  Id irid = 0;
  int nip = 0, esop = 0, failopt = 0;
  std::vector<Real> s{}, wf{};
  std::vector<Id> pid{};
};

}  // namespace courant
