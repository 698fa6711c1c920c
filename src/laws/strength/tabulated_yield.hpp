#pragma once
#include <algorithm>
#include <vector>

#include "base/indexed_pieces.hpp"
#include "laws/strength/rate_factor.hpp"

namespace courant {

/// Yield stress over effective plastic strain and a rate. [M/LT2]
struct TabulatedYield {
  YieldRate depends_on = YieldRate::none;
  std::vector<IndexedPieces> curves{};  ///< one, or of a table one for each of `rates`
  std::vector<Real> rates{};            ///< increasing [1/T], or their logarithms
  bool logarithmic = false;
  CowperSymonds rate_term{};
  Real added = 0;          ///< what (rate/C)^(1/P) is a factor of; 0: of the yield stress [M/LT2]
  IndexedPieces factor{};  ///< LCSR, over the rate; empty: none

  YieldRate rate() const { return depends_on; }
  bool steep() const { return false; }
  bool smooth() const { return curves.size() == 1 && curves.front().size() == 1 && factor.empty(); }
  /// One curve and no rate: its pieces are walked through, on each of which the increment is linear.
  bool has_increments() const { return depends_on == YieldRate::none; }
  Real increment(Real q, Real e, Real three_g) const {
    const IndexedPieces& curve = curves.front();
    std::size_t k = curve.piece(e);
    if (!(q > std::max(curve.of_piece(k, e), Real(0)))) return 0;
    for (;; ++k) {
      const Real de = (q - curve.of_piece(k, e)) / (three_g + curve.slope(k));
      // where softening leaves no strength, not beyond
      if (!curve.ends_before(k, e + de)) return std::min(de, q / three_g);
    }
  }

  void at(YieldPoints& points) const {
    if (curves.size() > 1) {
      of_table(points);
    } else {
      const IndexedPieces& curve = curves.front();
      for (Index i = 0; i < points.count; ++i)
        points.stress[i] = curve(points.plastic[i], points.by_strain[i]);
      if (added > 0 && rate_term.counts())
        rate_loops_.add(rate_term, added, points);
      else if (!factor.empty())
        scale(points);
      else if (rate_term.counts())
        rate_loops_.scale(rate_term, points);
    }
    if (vanishes()) limit(points);
  }

 private:
  /// Softening continues beyond the last point of a curve, down to zero strength.
  bool vanishes() const {
    return std::any_of(curves.begin(), curves.end(),
                       [](const IndexedPieces& c) { return !c.empty() && c.slope(c.size() - 1) < 0; });
  }
  void limit(YieldPoints& points) const {
    for (Index i = 0; i < points.count; ++i) {
      if (points.stress[i] >= 0) continue;
      points.stress[i] = points.by_strain[i] = points.by_rate[i] = 0;
    }
  }
  void scale(YieldPoints& points) const {
    for (Index i = 0; i < points.count; ++i) {
      Real slope;
      const Real by = factor(points.rate[i], slope);
      points.by_rate[i] = points.stress[i] * slope;
      points.stress[i] *= by, points.by_strain[i] *= by;
    }
  }
  /// Of a table: straight between curves, constant beyond the first and the last.
  void of_table(YieldPoints& points) const {
    Real logarithm[block_size];
    if (logarithmic) rate_loops_.logarithm(points.count, points.rate, logarithm);
    for (Index i = 0; i < points.count; ++i) {
      const Real e = points.plastic[i], r = logarithmic ? logarithm[i] : points.rate[i];
      std::size_t k = 0;
      while (k < rates.size() && r >= rates[k]) ++k;
      const IndexedPieces &below = curves[k > 0 ? k - 1 : 0], &above = curves[std::min(k, rates.size() - 1)];
      points.stress[i] = below(e, points.by_strain[i]), points.by_rate[i] = 0;
      if (&below == &above) continue;
      Real slope;
      const Real higher = above(e, slope), width = rates[k] - rates[k - 1],
                 share = (r - rates[k - 1]) / width;
      points.by_rate[i] = (higher - points.stress[i]) / (logarithmic ? width * points.rate[i] : width);
      points.stress[i] += share * (higher - points.stress[i]);
      points.by_strain[i] += share * (slope - points.by_strain[i]);
    }
  }
  RateLoops rate_loops_ = rate_loops();
};

}  // namespace courant
