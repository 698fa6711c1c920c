#pragma once
// Bars that vibrate along their axis, and how they decay.
#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <vector>

#include "shell_decks.hpp"
#include "solid_decks.hpp"

namespace courant::test {

/// E 4e4, nu 0, rho 1: waves of 200.
inline const std::string light = "*MAT_ELASTIC\n         1       1.0    4.0E+4       0.0\n";

/// A bar of 1 x 0.1 x 0.1, held at x = 0, in its first mode along x.
inline std::string solid_bar(int n, int elform, const std::string& damping,
                             const std::string& material = light) {
  test::SolidDeck deck;
  deck.block({1, 0.1, 0.1}, n, 1, 1, 1);
  deck.cards +=
      fmt::format("*PART\nbar\n         1         1         1\n*SECTION_SOLID\n         1{:10}\n", elform);
  deck.cards += material + damping + "*CONTROL_BULK_VISCOSITY\n    1e-20     1e-20\n";
  deck.node_set(1, [](const Vec& x) { return x[0] < 1e-9; });
  deck.cards +=
      "*BOUNDARY_SPC_SET\n         1         0         1         1         1\n*INITIAL_VELOCITY_NODE\n";
  for (std::size_t k = 0; k < deck.nodes.size(); ++k)
    deck.cards += fmt::format("{:10}{:10.3e}\n", k + 1, 1e-3 * std::sin(0.5 * pi * deck.nodes[k][0]));
  return deck.text(10);
}
/// The same of shells.
inline std::string shell_bar(int n, int elform, const std::string& damping,
                             const std::string& material = light) {
  test::ShellDeck deck;
  deck.plate(1, 0.1, n, 1, 1);
  deck.part(1, 0.1, material);
  if (elform != 2)
    deck.cards.replace(deck.cards.find("         2  0.833333"), 10, fmt::format("{:10}", elform));
  deck.cards += damping;
  deck.hold(1, "xyzXYZ", [](const Vec& x) { return x[0] < 1e-9; });
  deck.velocity([](const Vec& x) { return Vec(1e-3 * std::sin(0.5 * pi * x[0]), 0, 0); });
  return deck.text(10);
}

/// Fraction of critical damping from the speeds with which a node passes its position at rest, twice in a
/// period: v ~ exp(-z pi/sqrt(1 - z^2)) from one to the next.
struct Decay {
  Real fraction = 0, omega = 0;
};
inline Decay decay(Simulation& s, Index node, int axis, Real at_rest, int passes) {
  std::vector<Real> t, v;
  Real x_old = 0, v_old = 0;
  for (int step = 0; step < 2000000 && static_cast<int>(t.size()) < passes; ++step) {
    s.step(test::do_nothing);
    const Real x = s.world().nodes.x.data(axis)[node] - at_rest, now = s.world().nodes.v.data(axis)[node];
    if (step > 0 && (x < 0) != (x_old < 0)) {
      const Real share = x_old / (x_old - x);
      t.push_back(s.clock().t - (1 - share) * s.clock().dt_old);
      // the velocity belongs to the middle of the step
      v.push_back(std::abs(now + (share - 0.5) * (now - v_old)));
    }
    x_old = x, v_old = now;
  }
  EXPECT_EQ(static_cast<int>(t.size()), passes);
  if (static_cast<int>(t.size()) < passes) return {};
  t.erase(t.begin()), v.erase(v.begin());  // modes that the start has besides are gone
  const auto last = t.size() - 1;
  const Real d = std::log(v.front() / v.back()) / static_cast<Real>(last) / pi;  // z/sqrt(1 - z^2)
  const Real z = d / std::sqrt(1 + d * d);
  return {z, pi * static_cast<Real>(last) / (t.back() - t.front()) / std::sqrt(1 - z * z)};
}

}  // namespace courant::test
