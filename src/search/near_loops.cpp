// Compiled once for each instruction set; see docs/architecture.md.
#include "search/near_loops.hpp"
#include "base/simd.hpp"

namespace courant::COURANT_SIMD {

namespace {

template <bool Spatial, bool UniformH>
void near(const NearQuery& q, Index begin, Index end, NearFound& found) {
  const Pack xi = Pack::load(q.x + q.first, q.count), yi = Pack::load(q.y + q.first, q.count),
             zi = Spatial ? Pack::load(q.z + q.first, q.count) : Pack::zero(),
             hi = Pack::load(q.h + q.first, q.count);
  Pack reach = q.support * hi, wide = reach + q.skin;
  Pack reach2 = reach * reach, wide2 = wide * wide;
  Index within = found.within_count, beyond = found.beyond_count;
  for (Index j = begin; j < end; ++j) {
    const Pack dx = xi - q.x[j], dy = yi - q.y[j];
    Pack r2 = dx * dx + dy * dy;
    if constexpr (Spatial) {
      const Pack dz = zi - q.z[j];
      r2 = r2 + dz * dz;
    }
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

void find(const NearQuery& q, Index begin, Index end, NearFound& found) {
  if (q.z)
    q.uniform_h ? near<true, true>(q, begin, end, found) : near<true, false>(q, begin, end, found);
  else
    q.uniform_h ? near<false, true>(q, begin, end, found) : near<false, false>(q, begin, end, found);
}

void cells(const CellFrame& f, const Real* const at[3], Index begin, Index end, Index* __restrict cell) {
  const Real *x = at[0], *y = at[1], *z = at[2];
  const Real x0 = f.origin[0], y0 = f.origin[1], z0 = f.origin[2];
  const Real nx = f.first[0], ny = f.first[1], nz = f.first[2];
  const Real ax = f.inverse_size[0], ay = f.inverse_size[1], az = f.inverse_size[2];
  const Index mx = f.cells[0] - 1, my = f.cells[1] - 1, mz = f.cells[2] - 1;
  const auto floor_of = [](Real a) {            // by rounding, which the baseline has in a vector, too
    constexpr Real whole = 6755399441055744.0;  // 1.5 x 2^52: sums with it have a resolution of 1
    const Real near = (a + whole) - whole;
    return near > a ? near - 1 : near;
  };
  const auto along = [](Real k, Index last) {  // what is not a number: 0
    const Real most = last, up = k < most ? k : most;
    return static_cast<Index>(k > 0 ? up : 0);
  };
#pragma omp simd
  for (Index i = begin; i < end; ++i) {
    // not from the first one on: what lies on a border shall round alike whatever the grid covers
    const Index kx = along(floor_of((x[i] - x0) * ax) - nx, mx),
                ky = along(floor_of((y[i] - y0) * ay) - ny, my),
                kz = along(floor_of((z[i] - z0) * az) - nz, mz);
    const Index row = kz * (my + 1) + (kz & 1 ? my - ky : ky);
    cell[i - begin] = row * (mx + 1) + (row & 1 ? mx - kx : kx);
  }
}

}  // namespace

NearLoops near_loops() {
  return {&find, &cells};
}

}  // namespace courant::COURANT_SIMD
