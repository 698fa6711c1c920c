#pragma once
// A curve, or a table of curves over a rate of strain, as cards name them.
#include <algorithm>
#include <string>
#include <vector>

#include "base/straight_pieces.hpp"
#include "keyword/deck.hpp"
#include "model/model.hpp"

namespace courant {

/// Curves of stress over strain, one for each rate; straight between rates, constant beyond them.
struct CurvesOverRate {
  std::vector<StraightPieces> curves{};
  std::vector<Real> rates{};  ///< rising, one for each curve [1/T]
  Real begins = -1e30;        ///< the largest strain at which one begins

  CurvesOverRate() = default;
  /// Of a curve or table that is there and good: `check_curves_over_rate`. Strains are divided by `length`,
  /// stresses by `area`.
  CurvesOverRate(const Model& model, Id id, Real length = 1, Real area = 1);
  bool has_rates() const { return curves.size() > 1; }
  /// Value of `of(k)` for the curves k beside a rate.
  template <class Of>
  Real between(Real rate, const Of& of) const {
    const auto above = std::upper_bound(rates.begin(), rates.end(), rate);
    if (above == rates.begin()) return of(std::size_t(0));
    const auto k = static_cast<std::size_t>(above - rates.begin());
    if (above == rates.end()) return of(k - 1);
    const Real share = (rate - rates[k - 1]) / (rates[k] - rates[k - 1]);
    return (1 - share) * of(k - 1) + share * of(k);
  }
  /// Larger slopes of each curve right above and right below 0.
  Real steepest_at_0() const;
};

/// Reports a curve or table that is not there, of tables, jumps, or does not pass through (0, 0). `least`:
/// abscissae must lie above it.
void check_curves_over_rate(const Deck& deck, const Model& model, const Entry& card, const char* field, Id id,
                            Real least, Diagnostics& diagnostics);

/// How fast means over steps follow: each step has this weight, the age of a mean over 11 steps.
inline constexpr Real weight_of_step = 1.0 / 6;

}  // namespace courant
