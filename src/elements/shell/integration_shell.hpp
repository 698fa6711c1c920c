#pragma once
#include <vector>

#include "elements/shell/shell_element_cards.hpp"
#include "keyword/card.hpp"

namespace courant {

/// *INTEGRATION_SHELL: points through the thickness of shells whose section has QR/IRID = -IRID.
struct IntegrationShell : IntegrationShellFields {
  std::vector<Real> s{}, wf{};
};

}  // namespace courant
