#pragma once
// Layout of elout: that of LS-DYNA.
#include <string>
#include <vector>

#include "elements/element_report.hpp"
#include "state/world.hpp"

namespace courant {

/// An element of elout.
struct EloutElement {
  Id id = 0, part = 0;
  int material = 0;  ///< number of its law: 24 of *MAT_024
  ElementReport report{};
};

/// A state of the elements of a kind, which are not empty. `local`: axes of shells. `history`: how many
/// numbers of the law follow; from 1 on the layout of all kinds is the one that LS-DYNA has for that.
std::string elout_text(ElementKind kind, const std::vector<EloutElement>& elements, const Clock& clock,
                       bool local, int history);

}  // namespace courant
