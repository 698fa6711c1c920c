// The loops of shells with 2 x 2 points in their plane, and static solutions with them.
#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <tuple>

#include <Eigen/Eigenvalues>

#include "shell_patch.hpp"
#include "shell_statics.hpp"

namespace courant::test::full_shell {

namespace {

const Matrix tilt = Eigen::AngleAxisd(0.7, Vec(1, 2, -1).normalized()).toRotationMatrix();

ShellPatch full_plate(int nx, int ny, Real distortion, Real t, Real warp = 0, Real drilling = 0) {
  ShellPatch g = ShellPatch::plate(nx, ny, 4, distortion, t, warp);
  g.make_full(drilling);
  return g;
}
/// D or curvature xx yy xy of a tensor in the plate, in the axes of an element.
std::array<Real, 3> in_axes(const ShellPatch& g, std::size_t e, const Matrix& R, const Matrix& T) {
  const Matrix t = g.axes(e).transpose() * R * T * R.transpose() * g.axes(e);
  return {t(0, 0), t(1, 1), t(0, 1)};
}

/// The hemisphere with a hole of 18 degrees, pinched by forces of 2 at its equator: a quarter of it. How far
/// the point of a force moves.
Real pinched_hemisphere(int n, Real drilling) {
  const Real R = 10;
  ShellPatch g = mesh(
      n, n, 0.04, 6.825e7, 0.3, [&](ShellPatch& patch) { patch.make_full(drilling); },
      [&](Real a, Real b) {
        const Real along = 0.5 * pi * a, up = 0.4 * pi * b;
        return Vec(R * std::cos(up) * std::cos(along), R * std::cos(up) * std::sin(along), R * std::sin(up));
      });
  std::vector<char> held(6 * g.x.size(), 0);
  for (int j = 0; j <= n; ++j) {
    const auto at_x = static_cast<std::size_t>(6 * j * (n + 1)),
               at_y = at_x + static_cast<std::size_t>(6 * n);
    for (const std::size_t k : {1, 3, 5}) held[at_x + k] = 1;  // the plane y = 0
    for (const std::size_t k : {0, 4, 5}) held[at_y + k] = 1;  // the plane x = 0
  }
  held[2] = 1;
  Column load = Column::Zero(static_cast<Eigen::Index>(held.size()));
  load[0] = 1, load[6 * n + 1] = -1;
  return solve(stiffness(g), held, load)[0];
}

}  // namespace

// Patch test, rates: every position in the plane sees the same constant rates, and no drilling.
TEST(FullShell, AffineMotionsGiveOneRateEverywhere) {
  Matrix L = Matrix::Zero(), k = Matrix::Zero();
  L.topLeftCorner<2, 2>() << 0.3, -0.2, 0.5, -0.4;
  k.topLeftCorner<2, 2>() << 0.7, 0.25, 0.25, -0.6;
  ShellPatch g = full_plate(9, 8, 0.3, 0.1, 0, 0.01);
  for (std::size_t n = 0; n < g.x.size(); ++n) {
    const Vec X = g.x[n], b = k * X;
    g.v[n] = L * X + Vec(1, 2, 3), g.w[n] = Vec(-b[1], b[0], 0.5 * (0.5 + 0.2));
  }
  g.turn(tilt);
  g.advance(0, [&](Index begin, Index count) {
    for (Index i = 0; i < count; ++i) {
      const auto e = static_cast<std::size_t>(begin + i);
      const auto D = in_axes(g, e, tilt, 0.5 * (L + L.transpose())), K = in_axes(g, e, tilt, k);
      Real area = 0;
      for (int q = 0; q < 4; ++q) {
        const auto& of = g.scratch.quarter[q];
        for (std::size_t c = 0; c < 2; ++c) EXPECT_NEAR(of[c][i], D[c], 1e-13) << e << " " << q;
        for (std::size_t c = 0; c < 3; ++c) EXPECT_NEAR(of[2 + c][i], K[c], 1e-13) << e << " " << q;
        area += g.scratch.quarter_area[q][i];
      }
      EXPECT_NEAR(g.scratch.membrane[2][i], D[2], 1e-13);
      EXPECT_NEAR(area, g.area(e), 1e-15);
      for (int c = 0; c < 4; ++c) EXPECT_NEAR(g.scratch.hourglass_rate[c][i], 0, 1e-13);
    }
  });
}

// The shear of a slope, and none of a plate that turns, whatever the shape; of a plate that bends none in
// rectangles.
TEST(FullShell, TransverseShearIsThatOfTheSlopeLessTheTurn) {
  const Matrix k = (Matrix() << 0.7, 0.25, 0, 0.25, -0.6, 0, 0, 0, 0).finished();
  for (const bool even : {false, true}) {
    const ShellPatch start = full_plate(7, 6, even ? 0 : 0.3, 0.1);
    ShellPatch slope = start, turning = start, bending = start;
    for (std::size_t n = 0; n < start.x.size(); ++n) {
      const Vec X = start.x[n], b = k * X;
      slope.v[n] = Vec(0, 0, 0.4 * X[0] - 0.3 * X[1]);
      turning.w[n] = Vec(0.2, 0.5, 0.3), turning.v[n] = turning.w[n].cross(X);
      bending.v[n] = Vec(0, 0, -0.5 * X.dot(b)), bending.w[n] = Vec(-b[1], b[0], 0);
    }
    for (ShellPatch* g : {&slope, &turning, &bending}) {
      if (g == &bending && !even) continue;
      const Vec expected = g == &slope ? Vec(0.4, -0.3, 0) : Vec::Zero();
      g->turn(tilt);
      g->advance(0, [&](Index begin, Index count) {
        for (Index i = 0; i < count; ++i) {
          const auto e = static_cast<std::size_t>(begin + i);
          for (int q = 0; q < 4; ++q) {
            const auto& of = g->scratch.quarter[q];
            const Vec shear = tilt.transpose() * g->axes(e) * Vec(2 * of[5][i], 2 * of[6][i], 0);
            EXPECT_NEAR((shear - expected).norm(), 0, 1e-13) << e << " " << q;
          }
        }
      });
    }
  }
}

// Patch test, forces: under constant N and M no node inside feels a force or a moment.
TEST(FullShell, ConstantResultantsBalanceInside) {
  const Matrix S = (Matrix() << 3, 0.7, 0, 0.7, -1, 0, 0, 0, 0).finished();
  ShellPatch g = full_plate(9, 8, 0.3, 0.1);
  g.turn(tilt);
  for (std::size_t e = 0; e < g.size(); ++e) {
    const auto low = in_axes(g, e, tilt, S), high = in_axes(g, e, tilt, -2 * S);
    for (std::size_t q = 0; q < 4; ++q)
      for (std::size_t c = 0; c < 3; ++c) {
        const std::size_t at = 12 * q + (c == 2 ? 3 : c);
        g.stress[at][e] = low[c], g.stress[at + 6][e] = high[c];
      }
  }
  g.advance(0);
  const auto loads = g.on_nodes();
  Real largest = 0;
  for (std::size_t n = 0; n < g.x.size(); ++n) {
    largest = std::max(largest, loads.moment[n].norm());
    if (!g.inside[n]) continue;
    EXPECT_NEAR(loads.force[n].norm(), 0, 1e-14) << n;
    EXPECT_NEAR(loads.moment[n].norm(), 0, 1e-15) << n;
  }
  EXPECT_GT(largest, 1e-4);
}

// All signs and transposes at once, for warped shells, too: forces and moments do the work of the stress and
// of drilling in any motion, and have no resultants.
TEST(FullShell, ForcesArePowersSlopesAndBalance) {
  std::mt19937 random(5);
  std::uniform_real_distribution<Real> number(-1, 1);
  for (const bool invariant : {false, true}) {
    ShellPatch g = full_plate(9, 8, 0.3, 0.1, 0.05, 0.1);
    g.control.invariant_axes = invariant;
    g.control.shear_factor = 0.8, g.control.Q2 = 0.3, g.control.Q1 = 1.1;
    for (auto* a : {&g.v, &g.w})
      for (Vec& y : *a) y = Vec(number(random), number(random), number(random));
    for (std::size_t k = 0; k < 48; ++k)
      if (k % 6 != 2)
        for (Real& s : g.stress[k]) s = number(random);
    for (std::size_t c = 0; c < 4; ++c)
      for (Real& moment : g.hourglass[c]) moment = 0.01 * number(random);
    g.turn(tilt);
    const Real dt = 1e-9;
    std::vector<Real> expected(g.size());
    g.E = 1e-30, g.control.G = 1e-30;  // stress and moments stay
    g.advance(dt, [&](Index begin, Index count) {
      for (Index i = 0; i < count; ++i) {
        const auto e = static_cast<std::size_t>(begin + i);
        Real power = 0;
        for (std::size_t q = 0; q < 4; ++q) {
          const auto& of = g.scratch.quarter[q];
          const auto R = [&](std::size_t k) { return g.resultant[8 * q + k][e]; };
          power +=
              g.scratch.quarter_area[q][i] *
              (R(0) * of[0][i] + R(1) * of[1][i] + R(3) * of[2][i] + R(4) * of[3][i] +
               2 * (R(2) * g.scratch.membrane[2][i] + R(5) * of[4][i] + R(6) * of[5][i] + R(7) * of[6][i]));
        }
        for (std::size_t c = 0; c < 4; ++c) power += g.hourglass[c][e] * g.scratch.hourglass_rate[c][i];
        expected[e] = -power - 2 * g.bulk[e] / dt;  // of the mean of no force and the one now
      }
    });
    expect_power_and_balance(g, expected, 1e-14);
  }
}

// N = t C D, M = t^3/12 C K, Q = shear factor G t gamma at each position.
TEST(FullShell, ResultantsOfAnElasticPlate) {
  ShellPatch g = full_plate(1, 1, 0, 0.2);
  const Real c = g.E / (1 - g.nu * g.nu), G = g.E / (2 * (1 + g.nu)), t = 0.2, dt = 1e-6;
  g.control.shear_factor = 5.0 / 6;
  for (std::size_t n = 0; n < 4; ++n) {
    const Vec X = g.x[n];
    g.v[n] = Vec(0.3 * X[0] + 0.1 * X[1], 0.2 * X[1], 0.4 * X[0] + 0.6 * X[1]);
    g.w[n] = Vec(-0.5 * X[1], 0.7 * X[0], 0);
  }
  g.advance(dt);
  const Real expected[6] = {t * c * (0.3 + g.nu * 0.2),
                            t * c * (0.2 + g.nu * 0.3),
                            t * G * 0.1,
                            t * t * t / 12 * c * (0.7 + g.nu * 0.5),
                            t * t * t / 12 * c * (0.5 + g.nu * 0.7),
                            0};
  for (std::size_t q = 0; q < 4; ++q)
    for (std::size_t k = 0; k < 6; ++k) EXPECT_NEAR(g.resultant[8 * q + k][0] / dt, expected[k], 1e-6) << k;
  // theta of the middle: 0.35 and -0.25
  Real xz = 0, yz = 0;
  for (std::size_t q = 0; q < 4; ++q)
    xz += g.resultant[8 * q + 6][0] / 4, yz += g.resultant[8 * q + 7][0] / 4;
  EXPECT_NEAR(xz / dt, t * G * 5 / 6 * (0.4 + 0.35), 1e-6);
  EXPECT_NEAR(yz / dt, t * G * 5 / 6 * (0.6 + 0.25), 1e-6);
}

// Nothing but six rigid motions is without stiffness, drilling of each node included: warped or flat.
TEST(FullShell, OnlyRigidMotionsAreFree) {
  for (const Real warp : {0.0, 0.1})
    for (const auto& [nx, ny] : {std::pair(1, 1), {2, 2}}) {
      const Column values =
          Eigen::SelfAdjointEigenSolver<Dense>(stiffness(full_plate(nx, ny, 0.2, 0.2, warp, 0.01)))
              .eigenvalues();
      const Real scale = values[values.size() - 1];
      for (Eigen::Index k = 0; k < 6; ++k) EXPECT_LT(std::abs(values[k]), 1e-8 * scale) << warp << " " << nx;
      EXPECT_GT(values[6], 1e-5 * scale) << warp << " " << nx;
    }
}

// MacNeal & Harder 1985: 0.005424 in the plane and 0.001754 across it (t = 0.32, P = 1), 0.005256 and
// 0.001294 (t = 0.0032, P = 1E-6).
TEST(FullShell, TwistedBeam) {
  for (const auto& [n, m, bound] : {std::tuple(24, 4, 0.04), {48, 8, 0.02}})
    for (const bool thin : {false, true})
      for (const bool in_plane : {false, true}) {
        const Real reference = thin ? (in_plane ? 5.256e-3 : 1.294e-3) : (in_plane ? 5.424e-3 : 1.754e-3);
        const Real w = twisted_beam(n, m, thin ? 0.0032 : 0.32, thin ? 1e-6 : 1, in_plane,
                                    [](ShellPatch& g) { g.make_full(0.01); });
        EXPECT_NEAR(w / reference, 1, bound) << n << " " << thin << in_plane;
      }
}

// MacNeal & Harder 1985: 0.094; Simo, Fox & Rifai 1989: 0.093.
TEST(FullShell, PinchedHemisphere) {
  EXPECT_NEAR(pinched_hemisphere(16, 0.01) / 0.093, 1, 0.03);
}

}  // namespace courant::test::full_shell
