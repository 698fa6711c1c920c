#pragma once
#include "search/neighbours.hpp"
#include "sph/core/neighbour_lists.hpp"
#include "sph/core/pair_loops.hpp"
#include "state/world.hpp"

namespace courant {

/// The arrays that every pair loop works with (places, forces, h); the rest is null. `f`: gets the forces.
inline PairArrays particle_arrays(Particles& p, Field<Real>& f) {
  PairArrays a{};
  for (int k = 0; k < 3; ++k) {
    a.x[k] = p.x.data(k);
    a.f[k] = f.data(k);
  }
  a.h = p.h.data();
  a.h0 = p.active > 0 ? p.h[0] : 1;
  return a;
}

/// The lists that pair loops take for a block of particles.
inline NeighbourLists lists_of(const Neighbours& neighbours, Index begin, Index end) {
  neighbours.expect_whole();
  const Index block = begin / block_size;
  return {neighbours.list(block), neighbours.starts(block), begin, end};
}

/// Calls `f(std::bool_constant)` with a run-time bool: one position where a choice becomes a specialised
/// loop.
template <class F>
decltype(auto) with_bool(bool value, F&& f) {
  if (value) return f(std::true_type{});
  return f(std::false_type{});
}
template <class F>
decltype(auto) with_dimension(int dim, F&& f) {
  if (dim == 2) return f(std::integral_constant<int, 2>{});
  return f(std::integral_constant<int, 3>{});
}

}  // namespace courant
