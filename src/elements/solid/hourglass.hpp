#pragma once
#include <vector>

#include "keyword/deck.hpp"
#include "model/model.hpp"

namespace courant {

/// Hourglass control and bulk viscosity of the solids of a part.
struct SolidViscosity {
  /// 1 viscous, 2 and 3 Flanagan-Belytschko viscous, 4 and 5 the same as a stiffness, 6 assumed strains
  int ihq = 1;
  Real qm = 0.1;   ///< hourglass coefficient
  Real q1 = 1.5;   ///< quadratic bulk viscosity
  Real q2 = 0.06;  ///< linear bulk viscosity
};

/// *HOURGLASS where a part names one, else *CONTROL_HOURGLASS and *CONTROL_BULK_VISCOSITY, else the values
/// above. One for each part of the model; those of parts without solids mean nothing. Kinds of hourglass
/// control that are not there are an error where a part with solids asks for them.
std::vector<SolidViscosity> read_solid_viscosity(const Deck& deck, const Model& model,
                                                 Diagnostics& diagnostics);

}  // namespace courant
