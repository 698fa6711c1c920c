#pragma once
// Artificial viscosity and hourglass control of parts: particles take the bulk viscosity, solids both.
#include <string>

#include "keyword/card.hpp"

namespace courant {

/// *HOURGLASS: coefficients of the parts that name it.
struct Hourglass : Entry {
  Id hgid = 0;
  int ihq = 0;
  Real qm = 0;  ///< 0: not given
  int ibq = 0;
  Real q1 = 0, q2 = 0, qb = 0, qw = 0;
  std::string title;
};

/// *CONTROL_HOURGLASS: what holds where no *HOURGLASS says otherwise.
struct ControlHourglass : Entry {
  int ihq = 0;
  Real qh = 0;
};

/// *CONTROL_BULK_VISCOSITY: coefficients of parts without an *HOURGLASS.
struct ControlBulkViscosity : Entry {
  Real q1 = 0, q2 = 0;
  int type = 0, btype = 0, tstype = 0;
};

}  // namespace courant
