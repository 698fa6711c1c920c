#pragma once
// What the laws of Johnson, Holmquist and Cook for ceramics and concrete have alike: a pressure over the
// change of volume, a strength that depends on it, and damage by plastic flow.
#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <utility>
#include <vector>

#include "laws/strength/radial_return.hpp"
#include "laws/strength/strength.hpp"

namespace courant {

/// K1 mu + K2 mu^2 + K3 mu^3 and its slope. [M/LT2]
struct CubicPressure {
  Real K1 = 0, K2 = 0, K3 = 0;
  Real operator()(Real mu) const { return ((K3 * mu + K2) * mu + K1) * mu; }
  Real slope(Real mu) const { return (3 * K3 * mu + 2 * K2) * mu + K1; }
};

/// 1 + C ln max(rate/rate0, 1), of the rate of the deviator of strain. [-]
inline Real rate_factor_of(Real C, Real rate0, const PointBlock& block, Index i) {
  const Real rate = C != 0 ? effective_rate(block, i, true) : 0;
  return rate > rate0 ? 1 + C * std::log(rate / rate0) : 1;
}

/// Of a trial deviator with effective stress q in history's order: returned to `strength`, the mean stress
/// set to -pressure. The increment of plastic strain. [-]
inline Real return_to(Real G, Real strength, Real pressure, Real q, const PointBlock& block, Index i) {
  const auto& s = block.stress;
  const Real mean = (s[0][i] + s[1][i] + s[2][i]) / 3;
  const bool flows = q > strength;
  const Real factor = flows ? strength / q : 1;
  for (std::size_t k = 0; k < 6; ++k)
    s[k][i] = k < 3 ? factor * (s[k][i] - mean) - pressure : factor * s[k][i];
  return flows ? (q - strength) / (3 * G) : 0;
}

/// Of compression waves, by the slope of the pressure over mu and the shear modulus. [L/T]
inline Real brittle_speed(const PointBlock& block, Index i, Real slope, Real mu, Real G, Real ro) {
  const Real stiffness = std::max(1 + mu, Real(1)) * slope + 4 * G / 3;
  return std::sqrt(stiffness / (ro * (1 + (block.compression ? block.compression[i] : 0))));
}

/// Its history: plastic strain, logarithm of the volume, damage, `fourth`, and 1 where it tore.
class BrittleLaw : public StrengthLaw {
 public:
  /// `fs`: plastic strain at failure, > 0 [-]; < 0: it fails where it tears; 0: it does not.
  BrittleLaw(Real density, Real G, Real fs, HistoryVariable fourth)
      : G_(G), fs_(fs), fourth_(std::move(fourth)) {
    ro = density;
  }
  Real shear_modulus() const override { return G_; }
  bool in_sheets() const override { return false; }
  std::vector<HistoryVariable> history() const override {
    return {{"plastic_strain", "-"}, {"logarithmic_volume", "-"}, {"damage", "-"}, fourth_, {"torn", "-"}};
  }
  Real failure_limit() const override {
    if (fs_ < 0) return 1;
    return fs_ > 0 ? fs_ : std::numeric_limits<Real>::infinity();
  }
  std::string failure_variable() const override { return fs_ < 0 ? "torn" : "plastic_strain"; }

 private:
  Real G_, fs_;
  HistoryVariable fourth_;
};

}  // namespace courant
