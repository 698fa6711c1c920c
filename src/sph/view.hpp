#pragma once
#include "search/neighbours.hpp"
#include "state/world.hpp"

namespace courant {

/// Raw pointers to the particle fields that pair loops read; `x[k]`, `v[k]` are component arrays.
struct ParticleView {
  explicit ParticleView(Particles& p)
      : x{p.x.data(0), p.x.data(1), p.x.data(2)},
        v{p.v.data(0), p.v.data(1), p.v.data(2)},
        m(p.m.data()),
        rho(p.rho.data()),
        h(p.h.data()) {}
  const Real* x[3];
  const Real* v[3];
  const Real* m;
  const Real* rho;
  const Real* h;
};

/// Where the padding particle stands: so far away that every kernel is zero, yet its square is finite.
inline constexpr Real far_away = 1e30;

/// Added to r^2 relative to h^2, so that two particles in one place give zero force instead of 0/0.
inline constexpr Real tiny_distance2 = 1e-24;

/// Calls `f(std::bool_constant)` with a run-time bool: one place where a choice becomes a specialised loop.
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
