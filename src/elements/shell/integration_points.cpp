#include <cmath>
#include <utility>

#include "elements/shell/shells.hpp"

namespace courant {

namespace {

/// Legendre's polynomials of degree n and n - 1 at x.
std::pair<Real, Real> legendre(int n, Real x) {
  Real before = 1, p = x;
  for (int k = 2; k <= n; ++k) before = std::exchange(p, ((2 * k - 1) * x * p - (k - 1) * before) / k);
  return n == 0 ? std::pair<Real, Real>(1, 0) : std::pair(p, before);
}

constexpr int newton_steps = 60;

}  // namespace

void gauss_points(int count, std::vector<Real>& zeta, std::vector<Real>& weight) {
  zeta.assign(static_cast<std::size_t>(count), 0);
  weight.assign(zeta.size(), 1);
  if (count == 1) return;
  for (int i = 0; i < count; ++i) {
    Real x = -std::cos(pi * (i + 0.75) / (count + 0.5)), slope = 1;
    for (int k = 0; k < newton_steps; ++k) {
      const auto [p, before] = legendre(count, x);
      slope = count * (x * p - before) / (x * x - 1);
      x -= p / slope;
    }
    if (2 * i + 1 == count) x = 0;
    slope = count * (x * legendre(count, x).first - legendre(count, x).second) / (x * x - 1);
    zeta[static_cast<std::size_t>(i)] = x;
    weight[static_cast<std::size_t>(i)] = 1 / ((1 - x * x) * slope * slope);
  }
}

// The ends, and where the slope of the polynomial of degree n = count - 1 is zero:
// (1 - x^2) P'' = 2 x P' - n (n + 1) P.
void lobatto_points(int count, std::vector<Real>& zeta, std::vector<Real>& weight) {
  const int n = count - 1;
  zeta.assign(static_cast<std::size_t>(count), 0);
  weight.assign(zeta.size(), 0);
  for (int i = 0; i <= n; ++i) {
    Real x = -std::cos(pi * i / n);
    for (int k = 0; k < newton_steps && i > 0 && i < n; ++k) {
      const auto [p, before] = legendre(n, x);
      const Real slope = n * (x * p - before) / (x * x - 1);
      x -= slope * (1 - x * x) / (2 * x * slope - n * (n + 1) * p);
    }
    if (2 * i == n) x = 0;
    const Real p = legendre(n, x).first;
    zeta[static_cast<std::size_t>(i)] = x;
    weight[static_cast<std::size_t>(i)] = 1 / (n * (n + 1) * p * p);
  }
}

}  // namespace courant
