#pragma once
#include <string>
#include <vector>

#include "elements/element_report.hpp"
#include "extension/history_interval.hpp"

namespace courant {

/// *DATABASE_HISTORY_SOLID, _BEAM, _SHELL, each with _SET.
struct HistoryElements : Entry {
  std::vector<Id> ids;
  ElementKind kind() const { return static_cast<ElementKind>(name / 2); }
  bool sets() const { return name % 2 == 1; }
};

/// The same with _ID, which gives each a heading.
struct HistoryElementIds : Entry {
  std::vector<Id> ids;
  std::vector<std::string> headings;
  ElementKind kind() const { return static_cast<ElementKind>(name); }
};

struct DatabaseElout : HistoryInterval {
  int solids = 0, shells = 0, thick_shells = 0, beams = 0;  ///< history variables to print
  int history_of(ElementKind kind) const {
    return kind == ElementKind::solid ? solids : kind == ElementKind::beam ? beams : shells;
  }
};

/// *CONTROL_OUTPUT, of which only the axes of elout are of influence.
struct ControlOutput : Entry {
  int unused = 0, eocs = 0;
  Real unused_real = 0;
};

}  // namespace courant
