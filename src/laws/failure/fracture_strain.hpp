#pragma once
// Plastic strain at fracture over the state of stress, as cards give it by curves and tables.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <vector>

#include "base/indexed_pieces.hpp"
#include "keyword/deck.hpp"
#include "model/model.hpp"

namespace courant {

/// Mean stress over q, > 0 in tension, and 27 J3/(2 q^3), from 1 in tension to -1 in compression of one axis.
/// [-]
struct StressState {
  Real triaxiality = 0, lode = 0;
  /// Of a stress xx yy zz xy yz zx; of none 0.
  static StressState of(const std::array<Real, 6>& s) {
    const Real mean = (s[0] + s[1] + s[2]) / 3, a = s[0] - mean, b = s[1] - mean, c = s[2] - mean;
    const Real q = std::sqrt(1.5 * (a * a + b * b + c * c) + 3 * (s[3] * s[3] + s[4] * s[4] + s[5] * s[5]));
    if (!(q > 0)) return {};
    const Real J3 =
        a * (b * c - s[4] * s[4]) - s[3] * (s[3] * c - s[4] * s[5]) + s[5] * (s[3] * s[4] - b * s[5]);
    return {mean / q, 13.5 * J3 / (q * q * q)};
  }
};

/// A curve over one number, or a table of such curves over a second one; straight between points and curves,
/// constant beyond. Empty: none.
class CurveOrTable {
 public:
  CurveOrTable() = default;
  CurveOrTable(const Model& model, Id id) {
    const auto add = [&](Id of) {
      const auto found = model.curves.find(of);
      if (found == model.curves.end()) return;
      curves_.emplace_back(found->second.abscissa, found->second.ordinate, IndexedPieces::Beyond::constant);
    };
    if (const auto table = model.tables.find(id); table != model.tables.end()) {
      for (const Id of : table->second.curve) add(of);
      values_ = table->second.value;
    } else if (id != 0) {
      add(id);
    }
  }
  bool empty() const { return curves_.empty(); }
  Real operator()(Real x, Real second = 0) const {
    if (curves_.size() == 1) return curves_.front()(x);
    const auto above = std::upper_bound(values_.begin(), values_.end(), second);
    const auto k = static_cast<std::size_t>(above - values_.begin());
    if (k == 0) return curves_.front()(x);
    if (k == curves_.size()) return curves_.back()(x);
    const Real share = (second - values_[k - 1]) / (values_[k] - values_[k - 1]);
    return (1 - share) * curves_[k - 1](x) + share * curves_[k](x);
  }

 private:
  std::vector<IndexedPieces> curves_;
  std::vector<Real> values_;
};

/// Reports a curve or table for `field` that is not there, of tables, jumps or has ordinates that are not >
/// 0. `tables`: they are allowed.
void check_positive_curves(const Deck& deck, const Model& model, const Entry& card, const char* field, Id id,
                           bool tables, const char* hint, Diagnostics& diagnostics);

}  // namespace courant
