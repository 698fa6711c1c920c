// Compiled once for each instruction set; see docs/architecture.md.
#include "search/near_loops.hpp"
#include "base/simd.hpp"

namespace courant::COURANT_SIMD {

namespace {

template <bool UniformH>
Index near(const NearQuery& q, Index begin, Index end, Index* out) {
  const Pack xi = Pack::load(q.x + q.first, q.count), yi = Pack::load(q.y + q.first, q.count),
             zi = Pack::load(q.z + q.first, q.count), hi = Pack::load(q.h + q.first, q.count);
  Pack reach = q.support * hi + q.skin;
  Pack reach2 = reach * reach;
  Index found = 0;
  for (Index j = begin; j < end; ++j) {
    const Pack dx = xi - q.x[j], dy = yi - q.y[j], dz = zi - q.z[j];
    const Pack r2 = dx * dx + dy * dy + dz * dz;
    if constexpr (!UniformH) {
      reach = q.support * max(hi, Pack::of(q.h[j])) + q.skin;
      reach2 = reach * reach;
    }
    out[found] = j;
    found += any_less(r2, reach2) ? 1 : 0;
  }
  return found;
}

}  // namespace

Index find_near(const NearQuery& q, Index begin, Index end, Index* out) {
  return q.uniform_h ? near<true>(q, begin, end, out) : near<false>(q, begin, end, out);
}

}  // namespace courant::COURANT_SIMD
