#pragma once
// Strength of concrete by three surfaces over pressure and a damage function between them: Malvar, Crawford,
// Wesevich & Simons 1997. Pressures p and strengths q = sqrt(3 J2) [M/LT2], compression > 0.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

#include "base/real.hpp"

namespace courant {

/// A strength and its slope over pressure.
struct StrengthAt {
  Real q, slope;
};

/// a0 + p/(a1 + a2 p) in triaxial compression, p >= 0.
struct PressureMeridian {
  Real a0 = 0, a1 = 1, a2 = 0;  ///< [M/LT2], [-], [LT2/M]
  StrengthAt operator()(Real p) const {
    const Real below = a1 + a2 * p;
    return {a0 + p / below, a1 / (below * below)};
  }
  /// Strength of a bar, where q = 3 p: 3 a2 p^2 + (3 a1 - a0 a2 - 1) p = a0 a1. Not above 0: there is none.
  Real of_bar() const {
    const Real b = 3 * a1 - a0 * a2 - 1, root = std::sqrt(std::max(b * b + 12 * a2 * a0 * a1, Real(0)));
    return b + root > 0 ? 6 * a0 * a1 / (b + root) : 0;
  }
};

class ConcreteSurfaces {
 public:
  ConcreteSurfaces(const PressureMeridian& greatest, const PressureMeridian& first,
                   const PressureMeridian& residual, Real tension)
      : greatest_(greatest), first_(first), residual_(residual), ft_(tension) {
    constexpr Real biaxial = 1.15;  // strength in biaxial over that in uniaxial compression
    fc_ = greatest.of_bar(), fy_ = first.of_bar();
    const Real p = 2 * biaxial * fc_ / 3;
    pressure_ = {0, fc_ / 3, p, 3 * fc_, 8.45 * fc_};
    ratio_ = {0.5, 0.5 + 1.5 * ft_ / fc_, biaxial * fc_ / greatest(p).q, 0.753, 1};
  }
  Real tension() const { return ft_; }      ///< strength of a bar in tension
  Real compression() const { return fc_; }  ///< and in compression
  Real yield() const { return fy_; }        ///< stress at which a bar begins to flow in compression
  /// Strength in triaxial extension over that in triaxial compression: 1/2 in tension, where the surface is
  /// that of the largest principal stress, such that bars have their strengths up to fc/3, and 1 from 8.45 fc
  /// on. [-]
  StrengthAt ratio(Real p) const {
    if (!(p > 0)) return {ratio_.front(), 0};
    for (std::size_t k = 1; k < pressure_.size(); ++k)
      if (p < pressure_[k]) {
        const Real slope = (ratio_[k] - ratio_[k - 1]) / (pressure_[k] - pressure_[k - 1]);
        return {ratio_[k - 1] + slope * (p - pressure_[k - 1]), slope};
      }
    return {1, 0};
  }
  /// The largest strength: below fc/3 3/(2 ratio) (p + ft).
  StrengthAt greatest(Real p) const {
    if (p >= fc_ / 3) return greatest_(p);
    const StrengthAt psi = ratio(p);
    const Real q = 1.5 / psi.q * (p + ft_);
    return {q, (1.5 - q * psi.slope) / psi.q};
  }
  /// Where flow begins: below fy/3 a line to 1.35 ft, and from there to 0 at -ft.
  StrengthAt first(Real p) const {
    constexpr Real share = 1.35;
    if (p >= fy_ / 3) return first_(p);
    if (p <= 0) return {share * (p + ft_), share};
    const Real slope = 3 * (1 - share * ft_ / fy_);
    return {share * ft_ + slope * p, slope};
  }
  /// What crushed concrete bears.
  StrengthAt residual(Real p) const { return p > 0 ? residual_(p) : StrengthAt{0, 0}; }

 private:
  PressureMeridian greatest_, first_, residual_;
  Real ft_, fc_ = 0, fy_ = 0;
  std::array<Real, 5> pressure_{}, ratio_{};
};

/// Willam & Warnke 1975: strength over that in triaxial compression. `psi`: in triaxial extension, 1/2 to 1;
/// `cosine` of the Lode angle, 1 in extension, 1/2 in compression. [-]
inline Real lode_factor(Real psi, Real cosine) {
  const Real c = 4 * (1 - psi * psi) * cosine, t = 2 * psi - 1;
  const Real root = std::sqrt(std::max(c * cosine + (5 * psi - 4) * psi, Real(0)));
  return (0.5 * c + t * root) / (c * cosine + t * t);
}

/// Straight between points, constant beyond: from the surface of first flow (0) to the greatest (1), and from
/// there to the residual one (0). [-]
struct DamageFunction {
  static constexpr std::size_t points = 13;
  std::array<Real, points> lambda{}, eta{};
  /// The first point at which eta is largest.
  std::size_t peak() const {
    return static_cast<std::size_t>(std::max_element(eta.begin(), eta.end()) - eta.begin());
  }
  Real operator()(Real at) const {
    if (!(at > lambda.front())) return eta.front();
    for (std::size_t k = 1; k < points; ++k)
      if (at < lambda[k])
        return eta[k - 1] + (eta[k] - eta[k - 1]) * (at - lambda[k - 1]) / (lambda[k] - lambda[k - 1]);
    return eta.back();
  }
};

}  // namespace courant
