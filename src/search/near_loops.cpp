// Compiled once for each instruction set; see docs/architecture.md.
#include "search/near_loops.hpp"
#include "base/simd.hpp"

namespace courant::COURANT_SIMD {

namespace {

template <bool UniformH>
void near(const NearQuery& q, Index begin, Index end, NearFound& found) {
  const Pack xi = Pack::load(q.x + q.first, q.count), yi = Pack::load(q.y + q.first, q.count),
             zi = Pack::load(q.z + q.first, q.count), hi = Pack::load(q.h + q.first, q.count);
  Pack reach = q.support * hi, wide = reach + q.skin;
  Pack reach2 = reach * reach, wide2 = wide * wide;
  Index within = found.within_count, beyond = found.beyond_count;
  for (Index j = begin; j < end; ++j) {
    const Pack dx = xi - q.x[j], dy = yi - q.y[j], dz = zi - q.z[j];
    const Pack r2 = dx * dx + dy * dy + dz * dz;
    if constexpr (!UniformH) {
      reach = q.support * max(hi, Pack::of(q.h[j])), wide = reach + q.skin;
      reach2 = reach * reach, wide2 = wide * wide;
    }
    const int is_within = any_less(r2, reach2) ? 1 : 0, is_found = any_less(r2, wide2) ? 1 : 0;
    found.within[within] = found.beyond[beyond] = j;
    within += is_within;
    beyond += is_found & ~is_within;
  }
  found.within_count = within, found.beyond_count = beyond;
}

}  // namespace

void find_near(const NearQuery& q, Index begin, Index end, NearFound& found) {
  q.uniform_h ? near<true>(q, begin, end, found) : near<false>(q, begin, end, found);
}

}  // namespace courant::COURANT_SIMD
