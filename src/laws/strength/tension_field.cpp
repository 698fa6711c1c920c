#include "laws/strength/tension_field.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "laws/strength/root_below.hpp"

namespace courant {

TensionField::TensionField(const SheetStiffness& sheet, Real G) : sheet_(sheet), G_(G) {
  // 1/E = c^4/EA + s^4/EB + (1/G - 2 nu/E) s^2 c^2 (Jones 1975, eq. 2.97), by cosines of 2 and 4 theta
  const Real det = sheet.aa * sheet.bb - sheet.ab * sheet.ab;
  const Real a = sheet.bb / det, b = sheet.aa / det, mixed = 1 / G - 2 * sheet.ab / det;
  mean_ = (3 * (a + b) + mixed) / 8, twice_ = (a - b) / 2, four_ = (a + b - mixed) / 8;
}

PlaneStress TensionField::linear(Real a, Real b, Real ab) const {
  return {sheet_.aa * a + sheet_.ab * b, sheet_.ab * a + sheet_.bb * b, 2 * G_ * ab};
}

PlaneStress TensionField::without_compression(Real a, Real b, Real ab) const {
  const PlaneStress s = linear(a, b, ab);
  if (s.a >= 0 && s.b >= 0 && s.a * s.b >= s.ab * s.ab) return s;
  const Real m = 0.5 * (a + b), p = 0.5 * (a - b);
  if (!(m + std::hypot(p, ab) > 0)) return {};
  // over x = 2 theta: strain e, 1/E = S; E e^2 is largest where 2 e' S - e S' falls through 0
  struct StrainAt {
    Real e, de, S, dS;
    Real energy() const { return e > 0 ? e * e / S : 0; }
    Real slope() const { return 2 * de * S - e * dS; }
  };
  const auto along = [&](Real x) {
    const Real c = std::cos(x), n = std::sin(x);
    return StrainAt{m + p * c + ab * n, ab * c - p * n, mean_ + twice_ * c + four_ * (2 * c * c - 1),
                    -n * (twice_ + 4 * four_ * c)};
  };
  constexpr int parts = 24;
  constexpr Real part = 2 * pi / parts;
  // the direction of the largest strain is tried, too: there may be few others with any
  const Real longest = std::atan2(ab, p);
  Real x = longest, most = along(longest).energy();
  for (int k = 1; k < parts; ++k)
    if (const Real energy = along(longest + k * part).energy(); energy > most)
      x = longest + k * part, most = energy;
  Real low = x - part;
  const auto slope = [&](Real above) {
    const StrainAt at = along(low + above);
    return at.e > 0 ? at.slope() : above < part ? 1 : -1;
  };
  if (slope(0) > 0 && slope(2 * part) <= 0) x = low + root_below(2 * part, slope);
  const StrainAt at = along(x);
  const Real t = std::max(at.e, Real(0)) / at.S, c = std::cos(x), n = std::sin(x);
  return {0.5 * t * (1 + c), 0.5 * t * (1 - c), 0.5 * t * n};
}

}  // namespace courant
