#include "search/region.hpp"

#include <algorithm>
#include <limits>

namespace courant {

Real Region::time_to_reach(const Vec& x, const Vec& v, Real reach) const {
  constexpr Real never = std::numeric_limits<Real>::infinity();
  Real from = 0, to = never;
  for (int k = 0; k < 3; ++k) {
    const Real below = low[k] - reach - x[k], above = high[k] + reach - x[k];
    if (v[k] == 0) {
      if (below > 0 || above < 0) return never;
      continue;
    }
    from = std::max(from, std::min(below / v[k], above / v[k]));
    to = std::min(to, std::max(below / v[k], above / v[k]));
  }
  return from <= to ? from : never;
}

}  // namespace courant
