#pragma once
// Strength of concrete over all three invariants of the stress: Ottosen 1977.
#include <algorithm>
#include <cmath>

#include "base/real.hpp"

namespace courant {

/// a J2/fc^2 + lambda sqrt(J2)/fc + b I1/fc = 1, lambda = k1 cos(acos(k2 cos 3t)/3), or k1 cos(pi/3 -
/// acos(-k2 cos 3t)/3) where cos 3t < 0; I1 > 0 in tension. Its four numbers are those that bear fc in
/// uniaxial compression, `ratio` fc in tension, 1.16 fc in biaxial compression, and Ottosen's point in
/// triaxial compression, I1 = -5 sqrt(3) fc, J2 = 8 fc^2.
class OttosenSurface {
 public:
  /// `ratio`: strength in uniaxial tension over that in compression. [-]
  explicit OttosenSurface(Real ratio) {
    constexpr Real biaxial = 1.16, two_root_6 = 4.898979485566356, root_3 = 1.7320508075688772;
    constexpr Real far = 8.660254037844386, root_8 = 2.8284271247461903;
    const Real sum = biaxial - ratio, square = two_root_6 / 3 - 8;  // lambda of each meridian is eliminated
    b = (two_root_6 - 1 + 3 * square / (biaxial * ratio)) / (far - two_root_6 + 9 * square / sum);
    a = 9 * b / sum - 3 / (biaxial * ratio);
    const Real compression = (1 - 8 * a + far * b) / root_8;
    const Real tension = root_3 * (1 / ratio - a * ratio / 3 - b);
    const Real turn = std::atan((compression / tension - 0.5) / (0.5 * root_3));
    k1 = tension / std::cos(turn), k2 = std::cos(3 * turn);
  }
  /// `cosine`: cos 3t = 3 sqrt(3)/2 J3/J2^1.5, 1 in tension and -1 in compression.
  Real lambda(Real cosine) const {
    const Real x = k2 * std::clamp(cosine, Real(-1), Real(1));
    return x >= 0 ? k1 * std::cos(std::acos(x) / 3) : k1 * std::cos(third_pi - std::acos(-x) / 3);
  }
  /// sqrt(J2)/fc on the surface; `I1` over fc. 0 beyond its tip. [-]
  Real root_j2(Real I1, Real cosine) const {
    const Real left = 1 - b * I1, l = lambda(cosine);
    return left > 0 ? 2 * left / (l + std::sqrt(l * l + 4 * a * left)) : 0;
  }
  /// I1/fc of the tip in tension. [-]
  Real tip() const { return 1 / b; }
  Real a, b, k1, k2;  ///< [-]

 private:
  static constexpr Real third_pi = 1.0471975511965976;
};

}  // namespace courant
