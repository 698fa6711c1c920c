// The loops of shells with one point in their plane with warp (BWC 1).
#include <gtest/gtest.h>

#include <random>
#include <tuple>

#include <Eigen/Eigenvalues>

#include "shell_patch.hpp"
#include "shell_statics.hpp"

namespace courant::test::warped_shell {

namespace {

const Matrix tilt = Eigen::AngleAxisd(0.7, Vec(1, 2, -1).normalized()).toRotationMatrix();

ShellPatch warped_plate(int nx, int ny, Real distortion, Real t, Real warp, Real drilling) {
  ShellPatch g = ShellPatch::plate(nx, ny, 4, distortion, t, warp);
  g.make_warped(drilling);
  return g;
}

void move_at_random(ShellPatch& g) {
  std::mt19937 random(5);
  std::uniform_real_distribution<Real> number(-1, 1);
  for (auto* a : {&g.v, &g.w})
    for (Vec& y : *a) y = Vec(number(random), number(random), number(random));
  for (std::size_t k = 0; k < 12; ++k)
    if (k % 6 != 2)
      for (Real& s : g.stress[k]) s = number(random);
  for (auto& force : g.hourglass)
    for (Real& f : force) f = 0.01 * number(random);
}

}  // namespace

// Flat ones differ from those that do not respect warp by drilling alone.
TEST(WarpedShell, FlatOnesAreAsTheOthers) {
  for (const bool stiff : {false, true}) {
    ShellPatch a = ShellPatch::plate(9, 8, 4, 0.3, 0.1), b = warped_plate(9, 8, 0.3, 0.1, 0, 0);
    for (ShellPatch* g : {&a, &b}) {
      g->control.stiffness = stiff, g->control.Q1 = 1.1, g->control.Q2 = 0.3;
      move_at_random(*g);
      g->turn(tilt);
      g->advance(1e-9);  // else the middle of the step is warped
    }
    for (std::size_t k = 0; k < 12; ++k)
      for (std::size_t e = 0; e < a.size(); ++e) {
        EXPECT_NEAR(a.force[k][e], b.force[k][e], 1e-11) << k;
        EXPECT_NEAR(a.moment[k][e], b.moment[k][e], 1e-12) << k;
      }
    for (std::size_t e = 0; e < a.size(); ++e) {
      EXPECT_NEAR(a.internal[e], b.internal[e], 1e-13);
      EXPECT_NEAR(a.hourglass_energy[e], b.hourglass_energy[e], 1e-13);
    }
  }
}

// ISTUPD 1 as well: the same thickness goes into the forces. In their plane, so that they stay flat.
TEST(WarpedShell, FlatOnesThinAsTheOthers) {
  ShellPatch a = ShellPatch::plate(9, 8, 4, 0.3, 0.1), b = warped_plate(9, 8, 0.3, 0.1, 0, 0);
  for (ShellPatch* g : {&a, &b}) {
    g->control.thins = true;
    move_at_random(*g);
    for (Vec& v : g->v) v[2] = 0;
    g->advance(0.01);
  }
  for (std::size_t e = 0; e < a.size(); ++e) {
    EXPECT_NE(b.thickness[e], 0.1);
    EXPECT_NEAR(a.thickness[e], b.thickness[e], 1e-13);
    for (std::size_t k = 0; k < 12; ++k) {
      EXPECT_NEAR(a.force[k][e], b.force[k][e], 1e-11) << k;
      EXPECT_NEAR(a.moment[k][e], b.moment[k][e], 1e-12) << k;
    }
  }
}

// A rigid motion has no rates, however much the elements are warped.
TEST(WarpedShell, RigidMotionsHaveNoRates) {
  ShellPatch g = warped_plate(6, 5, 0.3, 0.1, 0.1, 0.01);
  const Vec omega(0.3, -0.8, 0.5);
  for (std::size_t n = 0; n < g.x.size(); ++n) g.v[n] = Vec(1, 2, 3) + omega.cross(g.x[n]), g.w[n] = omega;
  g.advance(0, [&](Index, Index count) {
    for (Index i = 0; i < count; ++i) {
      for (std::size_t k = 0; k < 3; ++k) {
        EXPECT_NEAR(g.scratch.membrane[k][i], 0, 1e-13);
        EXPECT_NEAR(g.scratch.curvature[k][i], 0, 1e-12);
      }
      for (const auto& shear : g.scratch.shear) EXPECT_NEAR(shear[i], 0, 1e-13);
      for (const auto& rate : g.scratch.hourglass_rate) EXPECT_NEAR(rate[i], 0, 1e-13);
    }
  });
}

// All signs and transposes at once: forces and moments do the work of the stress, of hourglass control and of
// drilling in any motion of warped shells, and have no resultants.
TEST(WarpedShell, ForcesArePowersSlopesAndBalance) {
  for (const bool stiff : {false, true}) {
    ShellPatch g = warped_plate(9, 8, 0.3, 0.1, 0.05, 0.1);
    g.control.stiffness = stiff, g.control.shear_factor = 0.8;
    move_at_random(g);
    g.turn(tilt);
    const Real dt = 1e-9;
    std::vector<Real> expected(g.size());
    g.advance(dt, [&](Index begin, Index count) {
      for (Index i = 0; i < count; ++i) {
        const auto e = static_cast<std::size_t>(begin + i);
        const auto R = [&](std::size_t k) { return g.resultant[k][e]; };
        const ShellScratch& s = g.scratch;
        Real power = s.middle_area[i] * (R(0) * s.membrane[0][i] + R(1) * s.membrane[1][i] +
                                         R(3) * s.curvature[0][i] + R(4) * s.curvature[1][i] +
                                         2 * (R(2) * s.membrane[2][i] + R(5) * s.curvature[2][i] +
                                              R(6) * s.shear[0][i] + R(7) * s.shear[1][i]));
        for (std::size_t m = 0; m < g.hourglass.size(); ++m)
          power += g.hourglass[m][e] * s.hourglass_rate[m][i];
        expected[e] = -power;
      }
    });
    expect_power_and_balance(g, expected, 1e-13);
  }
}

// One alone has 17 rates for its 18 motions that are not rigid; two beside each other have none free.
TEST(WarpedShell, OnlyRigidMotionsAreFree) {
  for (const Real warp : {0.0, 0.1}) {
    ShellPatch g = warped_plate(2, 2, 0.2, 0.2, warp, 0.01);
    g.control.stiffness = true;
    const Column values = Eigen::SelfAdjointEigenSolver<Dense>(stiffness(g)).eigenvalues();
    const Real scale = values[values.size() - 1];
    for (Eigen::Index k = 0; k < 6; ++k) EXPECT_LT(std::abs(values[k]), 1e-8 * scale) << warp;
    EXPECT_GT(values[6], 1e-6 * scale) << warp;
  }
}

// MacNeal & Harder 1985, as of ELFORM 16; those that do not respect warp are several times too soft.
TEST(WarpedShell, TwistedBeam) {
  const auto shell = [](bool warps) {
    return [warps](ShellPatch& g) {
      if (warps) g.make_warped(0.01);
      g.control.stiffness = true, g.control.QM = g.control.QB = g.control.QW = 0.05;
    };
  };
  for (const auto& [n, m, bound] : {std::tuple(24, 4, 0.04), {48, 8, 0.02}})
    for (const bool thin : {false, true})
      for (const bool in_plane : {false, true}) {
        const Real reference = thin ? (in_plane ? 5.256e-3 : 1.294e-3) : (in_plane ? 5.424e-3 : 1.754e-3);
        const Real w = twisted_beam(n, m, thin ? 0.0032 : 0.32, thin ? 1e-6 : 1, in_plane, shell(true));
        EXPECT_NEAR(w / reference, 1, bound) << n << " " << thin << in_plane;
      }
  EXPECT_GT(twisted_beam(24, 4, 0.32, 1, true, shell(false)) / 5.424e-3, 4);
}

}  // namespace courant::test::warped_shell
