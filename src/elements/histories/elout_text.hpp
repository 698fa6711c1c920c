#pragma once
// Layout of elout, as text and in binout: that of LS-DYNA.
#include <array>
#include <string>
#include <vector>

#include "elements/element_report.hpp"
#include "state/history_numbers.hpp"
#include "state/world.hpp"

namespace courant {

/// An element of elout.
struct EloutElement {
  Id id = 0, part = 0;
  int material = 0;  ///< number of its law: 24 of *MAT_024
  ElementReport report{};
};

struct EloutContent {
  bool local = false;    ///< axes of shells
  int history = 0;       ///< numbers of the law; from 1 on the layout is LS-DYNA's for that, of all kinds
  bool strains = false;  ///< of solids and shells (STRFLG)
};

/// A state of the elements of a kind, which are not empty.
std::string elout_text(ElementKind kind, const std::vector<EloutElement>& elements, const Clock& clock,
                       const EloutContent& content);
/// The same numbers for binout, in the folders `solid`, `beam` and `shell`, and for history.h5.
void add_elout_numbers(ElementKind kind, const std::vector<EloutElement>& elements,
                       const EloutContent& content, HistoryNumbers& to);

/// Of von Mises. [M/LT2]
Real effective_stress(const std::array<Real, 6>& stress);

}  // namespace courant
