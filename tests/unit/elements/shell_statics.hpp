#pragma once
// Static solutions with the loops of shells: stiffness by unit motions, the twisted beam.
#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <vector>

#include <Eigen/Cholesky>

#include "shell_patch.hpp"

namespace courant::test {

using Dense = Eigen::MatrixXd;
using Column = Eigen::VectorXd;

/// Forces on nodes for unit motions: six numbers a node. Linear about the positions of `g`.
inline Dense stiffness(ShellPatch g) {
  const auto n = static_cast<Eigen::Index>(6 * g.x.size());
  constexpr Real small = 1e-7;
  Dense K(n, n);
  for (Eigen::Index j = 0; j < n; ++j) {
    for (auto* a : {&g.v, &g.w})
      for (Vec& y : *a) y.setZero();
    const auto node = static_cast<std::size_t>(j / 6);
    (j % 6 < 3 ? g.v : g.w)[node][j % 3] = small;
    for (auto& s : g.stress) std::fill(s.begin(), s.end(), 0);
    for (auto& s : g.hourglass) std::fill(s.begin(), s.end(), 0);
    g.advance(1);
    const auto loads = g.on_nodes();
    for (std::size_t k = 0; k < g.x.size(); ++k)
      for (int c = 0; c < 3; ++c) {
        K(static_cast<Eigen::Index>(6 * k) + c, j) = -loads.force[k][c] / small;
        K(static_cast<Eigen::Index>(6 * k) + 3 + c, j) = -loads.moment[k][c] / small;
      }
  }
  return 0.5 * (K + K.transpose());
}
/// Motions under loads, where `held` are.
inline Column solve(const Dense& K, const std::vector<char>& held, const Column& load) {
  std::vector<Eigen::Index> free;
  for (std::size_t k = 0; k < held.size(); ++k)
    if (!held[k]) free.push_back(static_cast<Eigen::Index>(k));
  const Column u = Eigen::LDLT<Dense>(K(free, free)).solve(load(free));
  Column out = Column::Zero(K.rows());
  out(free) = u;
  return out;
}

/// A mesh of (n + 1) x (m + 1) nodes at `place` of [0, 1] x [0, 1].
using Formulation = std::function<void(ShellPatch&)>;  ///< of quadrilaterals of one point

inline ShellPatch mesh(int n, int m, Real t, Real E, Real nu, const Formulation& make,
                       const std::function<Vec(Real, Real)>& place) {
  ShellPatch g = ShellPatch::plate(n, m, 4, 0, t);
  make(g);
  for (int j = 0; j <= m; ++j)
    for (int i = 0; i <= n; ++i)
      g.x[static_cast<std::size_t>(j * (n + 1) + i)] = place(Real(i) / n, Real(j) / m);
  g.E = E, g.nu = nu;
  g.control.E = E, g.control.G = E / (2 * (1 + nu)), g.control.plate_modulus = E / (1 - nu * nu);
  g.control.shear_factor = 5.0 / 6;
  for (std::size_t e = 0; e < g.size(); ++e) g.mass[e] = g.rho * t * g.area(e);
  return g;
}

/// The twisted beam of MacNeal and Harder: how far its end moves along a force there. In its plane: across
/// the width at the end, else across the thickness.
inline Real twisted_beam(int n, int m, Real t, Real P, bool in_plane, const Formulation& make) {
  const Real L = 12, width = 1.1;
  ShellPatch g = mesh(n, m, t, 29e6, 0.22, make, [&](Real a, Real b) {
    const Real turn = 0.5 * pi * a, y = width * (b - 0.5);
    return Vec(L * a, y * std::cos(turn), y * std::sin(turn));
  });
  std::vector<char> held(6 * g.x.size(), 0);
  Column load = Column::Zero(static_cast<Eigen::Index>(held.size()));
  const int axis = in_plane ? 2 : 1;  // the end has turned by 90 degrees
  for (int j = 0; j <= m; ++j) {
    const auto first = static_cast<std::size_t>(6 * j * (n + 1));
    std::fill(held.begin() + static_cast<std::ptrdiff_t>(first),
              held.begin() + static_cast<std::ptrdiff_t>(first) + 6, 1);
    load[static_cast<Eigen::Index>(first) + 6 * n + axis] = P / m * (j == 0 || j == m ? 0.5 : 1);
  }
  const Column u = solve(stiffness(g), held, load);
  return u[6 * ((m / 2) * (n + 1) + n) + axis];
}

/// Forces and moments of each element do that work per time in the motion at hand (1e-7), and have no
/// resultants.
inline void expect_power_and_balance(const ShellPatch& g, const std::vector<Real>& expected, Real round_off) {
  for (std::size_t e = 0; e < g.size(); ++e) {
    Real power = 0;
    Vec sum = Vec::Zero(), about = Vec::Zero();
    for (int c = 0; c < 4; ++c) {
      Vec f, m;
      for (int k = 0; k < 3; ++k)
        f[k] = g.force[static_cast<std::size_t>(3 * c + k)][e],
        m[k] = g.moment[static_cast<std::size_t>(3 * c + k)][e];
      const auto n = static_cast<std::size_t>(g.corner[static_cast<std::size_t>(c)][e]);
      power += f.dot(g.v[n]) + m.dot(g.w[n]);
      sum += f, about += m + g.x[n].cross(f);
    }
    EXPECT_NEAR(power, expected[e], 1e-7) << e;
    EXPECT_NEAR(sum.norm(), 0, round_off);
    EXPECT_NEAR(about.norm(), 0, round_off);
  }
}

}  // namespace courant::test
