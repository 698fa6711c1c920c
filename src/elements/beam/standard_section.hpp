#pragma once
#include <array>
#include <string>
#include <vector>

#include "base/real.hpp"

namespace courant {

/// A piece of a section: position from the middle of its box [L], and area [L2].
struct SectionCell {
  Real s = 0, t = 0, area = 0;
};

/// A standard section (ICST of *INTEGRATION_BEAM): its box, and cells whose sum of area, first and second
/// moments are exactly those of the section.
struct StandardSection {
  Real width_s = 0, width_t = 0;  ///< of its box [L]
  std::vector<SectionCell> cells{};
  /// Of Saint-Venant's torsion [L4]: thin open profiles sum b t^3/3, closed ones by Bredt, a rectangle and a
  /// circle exactly, a trapezoid by A^4/(40 Ip).
  Real torsion = 0;
  Real shear = 0;  ///< area of shear: webs of profiles, 5/6, 0.9 (circle), 1/2 (tube) of A [L2]

  /// About the centroid: area [L2], second moments about s, about t, and the product moment [L4].
  struct Moments {
    Real area = 0, ss = 0, tt = 0, st = 0;
  };
  Moments moments() const;
};

/// `d`: D1 to D4. 1 to 6 have the width D1 along s, the depth D3 along t, flanges D2 and a web D4 thick: I; a
/// channel with its web at -s; an angle with legs at -s and -t; a T with its flange at +t; a box tube; a Z
/// with its upper flange at -s and its lower one at +s of the web. 7: a trapezoid, D1 wide at -t, D2 at +t,
/// D3 deep. 8: a circle of radius D1; 9: a tube of radii D1 and D2; 11: a box, D1 along s, D2 along t. No
/// cells where the dimensions are of no such section, or `icst` is another one; `why` tells.
StandardSection standard_section(int icst, const std::array<Real, 4>& d, int refinement, std::string& why);

}  // namespace courant
