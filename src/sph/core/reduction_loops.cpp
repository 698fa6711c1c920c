// Compiled once for each instruction set; see docs/architecture.md.
#include "sph/core/reduction_loops.hpp"

#include <algorithm>

#include "sph/core/pair_packs.hpp"

namespace courant::COURANT_SIMD {

namespace {

/// The N numbers of each of particles [j, j + count), added up over the sources.
template <int N>
struct SharesOfEight {
  Pack of[N];
  COURANT_INLINE SharesOfEight(const Contributions& shares, Index j, Index count) {
    Real sums[N * lanes] = {};
    for (const Contributions::Source* s = shares.first; s != shares.last; ++s) {
      const Index numbers = std::min(count, s->end - j) * N;
      const Real* const from = s->numbers + std::ptrdiff_t(j - shares.begin) * N;
      for (Index k = 0; k < numbers; ++k) sums[k] += from[k];
    }
    for (int n = 0; n < N; ++n) of[n] = Pack::every(N, sums + n);
  }
};

COURANT_INLINE void add(const Pack& a, Real* to, Index count) {
  (Pack::load(to, count) + a).store(to, count);
}

template <int Dim, bool Viscous, bool Gradient>
void rates(const PairArrays& a, const Contributions& shares, Real norm) {
  for (Index j = shares.begin; j < shares.end; j += lanes) {
    const Index count = std::min(lanes, shares.end - j);
    const SharesOfEight<rates_shares(Dim, Viscous, Gradient)> sums(shares, j, count);
    const Pack* next = sums.of;
    add(norm * (Pack::load(a.rho + j, count) * *next++), a.drhodt + j, count);
    if constexpr (Viscous) {
      const Real factor = 2 * norm * a.h0;
      for (int k = 0; k < Dim; ++k) add(-factor * *next++, a.f[k] + j, count);
      add(-0.5 * factor * *next++, a.heat + j, count);
    }
    if constexpr (Gradient) {
      constexpr int component[2][6] = {{0, 1, 3}, {0, 1, 2, 3, 4, 5}};
      for (int n = 0; n < Dim * (Dim + 1) / 2; ++n) {
        const int k = component[Dim - 2][n];
        add(-(k < 3 ? 1 : 0.5) * norm * *next++, a.strain[k] + j, count);
      }
    }
  }
}

template <int Dim, bool Diffusion>
void forces(const PairArrays& a, const Contributions& shares, Real norm) {
  for (Index j = shares.begin; j < shares.end; j += lanes) {
    const Index count = std::min(lanes, shares.end - j);
    const SharesOfEight<forces_shares(Dim, Diffusion)> sums(shares, j, count);
    for (int k = 0; k < Dim; ++k) add(norm * sums.of[k], a.f[k] + j, count);
    if constexpr (Diffusion)
      add(-2 * a.delta * norm * a.h0 * sums.of[Dim] / Pack::load(a.c + j, count), a.diffusion + j, count);
  }
}

template <int Dim>
ReductionLoop rates_of(const RatesChoice& c) {
  if (c.viscous) return c.gradient ? &rates<Dim, true, true> : &rates<Dim, true, false>;
  return c.gradient ? &rates<Dim, false, true> : &rates<Dim, false, false>;
}
template <int Dim>
ReductionLoop forces_of(const ForcesChoice& c) {
  return c.diffusion ? &forces<Dim, true> : &forces<Dim, false>;
}

}  // namespace

ReductionLoop rates_reduction_loop(const RatesChoice& c) {
  return c.dim == 2 ? rates_of<2>(c) : rates_of<3>(c);
}
ReductionLoop forces_reduction_loop(const ForcesChoice& c) {
  return c.dim == 2 ? forces_of<2>(c) : forces_of<3>(c);
}

}  // namespace courant::COURANT_SIMD
