#pragma once
// Sheets that wrinkle: the stress of a thin sheet that bears no compression.
#include "laws/strength/material_axes.hpp"

namespace courant {

/// Along a, b, of the tensor. [M/LT2]
struct PlaneStress {
  Real a = 0, b = 0, ab = 0;
};

/// Linear orthotropic sheet whose relaxed energy knows no compression (Pipkin 1986): of all stresses without
/// it the one nearest to C e, by the complementary energy of the difference. Taut: C e itself. Slack, where
/// no direction is longer: none. Else tension t = E(n) e_n along the one direction n for which E(n) e_n^2 is
/// largest, e_n the strain and E(n) Young's modulus along n; across it the sheet is as short as it likes.
class TensionField {
 public:
  /// `G`: shear modulus in the plane.
  TensionField(const SheetStiffness& sheet, Real G);
  /// By strains of the tensor.
  PlaneStress linear(Real a, Real b, Real ab) const;
  PlaneStress without_compression(Real a, Real b, Real ab) const;

 private:
  SheetStiffness sheet_;
  Real G_;
  Real mean_, twice_, four_;  ///< 1/E(n) = mean + twice cos 2 theta + four cos 4 theta, theta from a [LT2/M]
};

}  // namespace courant
