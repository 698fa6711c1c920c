#include "generate/lattice.hpp"

#include <cmath>
#include <cstdint>

namespace courant {

namespace {

/// Steele, Lea, Flood 2014, SplitMix64: a bijection whose output bits each depend on all input bits.
std::uint64_t mixed(std::uint64_t z) {
  z += 0x9e3779b97f4a7c15U;
  z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9U;
  z = (z ^ (z >> 27)) * 0x94d049bb133111ebU;
  return z ^ (z >> 31);
}

}  // namespace

Real scattered(Id stream, Id index) {
  const std::uint64_t bits =
      mixed(mixed(static_cast<std::uint64_t>(stream)) + static_cast<std::uint64_t>(index));
  return std::ldexp(static_cast<Real>(bits >> 11), -52) - 1;  // 53 bits: exact in a double
}

std::vector<Vec> lattice_points(const SceneLattice& lattice, Id stream, const Variables& variables,
                                Diagnostics& diagnostics) {
  std::vector<Vec> points;
  points.reserve(static_cast<std::size_t>(lattice.count()));
  const Id count = lattice.count(), plane = lattice.n[1] * lattice.n[2];
  for (Id cell = 0; cell < count; ++cell) {
    const Id i = cell / plane, j = cell % plane / lattice.n[2], k = cell % lattice.n[2];
    Vec x = lattice.low + lattice.spacing * Vec(Real(i) + 0.5, Real(j) + 0.5, Real(k) + 0.5);
    if (lattice.dim == 2) x[2] = 0;
    if (lattice.where.given()) {
      const auto inside = value_at(lattice.where, "where", x, variables, diagnostics);
      if (!inside) break;
      if (!(*inside > 0)) continue;
    }
    for (int a = 0; a < lattice.dim && lattice.jitter > 0; ++a)
      x[a] += lattice.jitter * lattice.spacing * scattered(stream, 3 * cell + a);
    points.push_back(x);
  }
  return points;
}

}  // namespace courant
