// Shells against patch tests, closed solutions and their own energies.
#include "elements/shell/shell_loops.hpp"

#include <gtest/gtest.h>

#include "shell_patch.hpp"

using namespace courant;
using courant::test::ShellPatch;

namespace {

const Matrix tilt = (Eigen::AngleAxisd(0.7, Vec(0.3, -0.5, 0.8).normalized())).toRotationMatrix();

/// Rates in the axes of an element: membrane, curvature (both xx yy 2xy), shear 2 xz, 2 yz.
using Rates = std::array<Real, 8>;
Rates rates(const ShellScratch& s, Index i) {
  return {s.membrane[0][i],  s.membrane[1][i],      2 * s.membrane[2][i], s.curvature[0][i],
          s.curvature[1][i], 2 * s.curvature[2][i], 2 * s.shear[0][i],    2 * s.shear[1][i]};
}

/// A plane tensor of the plate's plane, xx yy 2xy, in the axes of an element of a plate turned by R.
std::array<Real, 3> in_axes(const ShellPatch& g, std::size_t e, const Matrix& R, const Matrix& tensor) {
  const Matrix Q = R.transpose() * g.axes(e), t = Q.transpose() * tensor * Q;
  return {t(0, 0), t(1, 1), t(0, 1) + t(1, 0)};
}

}  // namespace

// v = L x in the plane, and w so that the curvature is constant: theta_y = k_xx x + ..., theta_x = - (...)
TEST(Shell, AffineMotionsGiveOneRateAndNoHourglassForces) {
  Matrix L = Matrix::Zero(), k = Matrix::Zero();
  L.topLeftCorner<2, 2>() << 0.3, -0.2, 0.5, -0.4;
  k.topLeftCorner<2, 2>() << 0.7, 0.25, 0.25, -0.6;
  for (const int corners : {3, 4})
    for (const bool stiffness : {false, true}) {
      ShellPatch g = ShellPatch::plate(9, 8, corners, 0.3, 0.1);
      g.control.stiffness = stiffness;
      for (std::size_t n = 0; n < g.x.size(); ++n) {
        const Vec X = g.x[n], b = k * X;  // v_x at height z: z b_x
        g.v[n] = L * X + Vec(1, 2, 3);
        g.w[n] = Vec(-b[1], b[0], 0);
      }
      g.turn(tilt);
      g.advance(0, [&](Index begin, Index count) {
        for (Index i = 0; i < count; ++i) {
          const auto e = static_cast<std::size_t>(begin + i);
          const Rates r = rates(g.scratch, i);
          const auto D = in_axes(g, e, tilt, 0.5 * (L + L.transpose())), K = in_axes(g, e, tilt, k);
          for (std::size_t c = 0; c < 3; ++c) {
            EXPECT_NEAR(r[c], D[c], 1e-13) << e;
            EXPECT_NEAR(r[3 + c], K[c], 1e-13) << e;
          }
        }
      });
      for (const Real taken : g.hourglass_energy) EXPECT_NEAR(taken, 0, 1e-26);
    }
}

// Shear of a slope against still normals, none of a plate that turns rigidly, and, for triangles, none of a
// plate that bends: v_z = -(k_xx x^2 + 2 k_xy x y + k_yy y^2)/2 with theta as above.
TEST(Shell, TransverseShearIsThatOfTheSlopeLessTheTurn) {
  const Matrix k = (Matrix() << 0.7, 0.25, 0, 0.25, -0.6, 0, 0, 0, 0).finished();
  for (const int corners : {3, 4}) {
    const ShellPatch start = ShellPatch::plate(7, 6, corners, corners == 3 ? 0.3 : 0, 0.1);
    ShellPatch slope = start, turning = start, bending = start;
    for (std::size_t n = 0; n < start.x.size(); ++n) {
      const Vec X = start.x[n], b = k * X;
      slope.v[n] = Vec(0, 0, 0.4 * X[0] - 0.3 * X[1]);
      turning.w[n] = Vec(0.2, 0.5, 0), turning.v[n] = turning.w[n].cross(X);
      bending.v[n] = Vec(0, 0, -0.5 * X.dot(b)), bending.w[n] = Vec(-b[1], b[0], 0);
    }
    const auto shear_in_plate = [&](ShellPatch& g, std::size_t e, Index i) {
      const Rates r = rates(g.scratch, i);
      return Vec(tilt.transpose() * g.axes(e) * Vec(r[6], r[7], 0));
    };
    for (ShellPatch* g : {&slope, &turning, &bending}) {
      const Vec expected = g == &slope ? Vec(0.4, -0.3, 0) : Vec::Zero();
      g->turn(tilt);
      g->advance(0, [&](Index begin, Index count) {
        for (Index i = 0; i < count; ++i) {
          const auto e = static_cast<std::size_t>(begin + i);
          EXPECT_NEAR((shear_in_plate(*g, e, i) - expected).norm(), 0, 1e-13) << corners << " " << e;
        }
      });
    }
  }
}

// Patch test: under constant N and M no node inside feels a force or a moment.
TEST(Shell, ConstantResultantsBalanceInside) {
  const Matrix S = (Matrix() << 3, 0.7, 0, 0.7, -1, 0, 0, 0, 0).finished();
  for (const int corners : {3, 4}) {
    ShellPatch g = ShellPatch::plate(9, 8, corners, 0.3, 0.1);
    g.turn(tilt);
    for (std::size_t e = 0; e < g.size(); ++e) {
      const auto low = in_axes(g, e, tilt, S), high = in_axes(g, e, tilt, -2 * S);
      for (std::size_t c = 0; c < 3; ++c) {
        const Real share = c == 2 ? 0.5 : 1;
        g.stress[c == 2 ? 3 : c][e] = share * low[c], g.stress[6 + (c == 2 ? 3 : c)][e] = share * high[c];
      }
    }
    g.advance(0);
    const auto loads = g.on_nodes();
    Vec sum = Vec::Zero(), about = Vec::Zero();
    Real largest = 0;
    for (std::size_t n = 0; n < g.x.size(); ++n) {
      sum += loads.force[n], about += loads.moment[n] + g.x[n].cross(loads.force[n]);
      largest = std::max(largest, loads.moment[n].norm());
      if (!g.inside[n]) continue;
      EXPECT_NEAR(loads.force[n].norm(), 0, 1e-14) << corners << " " << n;
      EXPECT_NEAR(loads.moment[n].norm(), 0, 1e-15) << corners << " " << n;
    }
    EXPECT_GT(largest, 1e-4);
    EXPECT_NEAR(sum.norm(), 0, 1e-14);
    EXPECT_NEAR(about.norm(), 0, 1e-14);
  }
}

// The power of the forces on any motion is that of the stress and of hourglass control: all signs and all
// transposes at once, for warped shells, too.
TEST(Shell, ForcesArePowersSlopes) {
  std::mt19937 random(5);
  std::uniform_real_distribution<Real> number(-1, 1);
  for (const int corners : {3, 4})
    for (const bool invariant : {false, true}) {
      ShellPatch g = ShellPatch::plate(9, 8, corners, 0.3, 0.1, 0.02);
      g.control.invariant_axes = invariant;
      g.control.shear_factor = 0.8, g.control.Q2 = 0.3, g.control.Q1 = 1.1;
      for (auto* a : {&g.v, &g.w})
        for (Vec& y : *a) y = Vec(number(random), number(random), number(random));
      for (int k = 0; k < 12; ++k)
        if (k % 6 != 2)
          for (Real& s : g.stress[k]) s = number(random);
      g.turn(tilt);
      const Real dt = 1e-9;
      std::vector<Real> expected(g.size());
      const std::vector<Real> before = g.hourglass_energy;
      g.state.points = 2;
      g.E = 1e-30;  // the stress stays
      g.advance(dt, [&](Index begin, Index count) {
        for (Index i = 0; i < count; ++i) {
          const auto e = static_cast<std::size_t>(begin + i);
          const Rates r = rates(g.scratch, i);
          Real power = 0;
          for (std::size_t c = 0; c < 8; ++c) power += r[c] * g.resultant[c][e];
          // the energies are those of the mean of no force and the one now
          expected[e] = -power * g.area(e) - 2 * (g.hourglass_energy[e] + g.bulk[e]) / dt;
        }
      });
      Real largest = 0;
      for (std::size_t e = 0; e < g.size(); ++e) {
        Real power = 0;
        for (int c = 0; c < corners; ++c)
          for (int k = 0; k < 3; ++k)
            power += g.force[3 * c + k][e] * g.v[g.corner[c][e]][k] +
                     g.moment[3 * c + k][e] * g.w[g.corner[c][e]][k];
        EXPECT_NEAR(power, expected[e], 1e-7) << corners << " " << e;
        largest = std::max(largest, std::abs(expected[e]));
        if (corners == 4) {
          EXPECT_GT(g.hourglass_energy[e], 0);
        }
      }
      EXPECT_GT(largest, 1e-2);
    }
}

// A flat plate is shaken at random: what stress, hourglass control and bulk viscosity take is the work of the
// forces and moments through each step, mean of old and new.
TEST(Shell, EnergiesAreTheWorkOfTheForces) {
  for (const bool stiffness : {false, true})
    for (const int points : {2, 8}) {
      ShellPatch g = ShellPatch::plate(5, 4, 4, 0.2, 0.1);
      if (points == 8) g.make_full(0.1);
      g.control.stiffness = stiffness;
      g.control.shear_factor = 0.8, g.control.Q2 = 0.3, g.control.Q1 = 1.1;
      std::mt19937 random(11);
      std::uniform_real_distribution<Real> number(-1, 1);
      Real work = 0;
      constexpr Real dt = 1e-5;
      ShellPatch::Loads before;
      for (int k = 0; k <= 50; ++k) {
        const Real step = k == 0 ? 0 : dt;
        for (std::size_t p = 0; p < g.x.size(); ++p) {
          g.v[p] = Vec(number(random), number(random), number(random));
          g.w[p] = Vec(number(random), number(random), number(random));
          g.x[p] += step * g.v[p];
        }
        g.advance(step);
        const ShellPatch::Loads now = g.on_nodes();
        for (std::size_t p = 0; k > 0 && p < g.x.size(); ++p)
          work -=
              0.5 * dt *
              ((before.force[p] + now.force[p]).dot(g.v[p]) + (before.moment[p] + now.moment[p]).dot(g.w[p]));
        before = now;
      }
      Real taken = 0;
      for (const auto* of : {&g.internal, &g.hourglass_energy, &g.bulk})
        for (const Real energy : *of) taken += energy;
      EXPECT_NEAR(taken / work, 1, 1e-3) << stiffness << " " << points;
    }
}

// N = t C D, M = t^3/12 C K, Q = shear factor G t gamma, with two points exactly.
TEST(Shell, ResultantsOfAnElasticPlate) {
  ShellPatch g = ShellPatch::plate(1, 1, 4, 0, 0.2);
  const Real c = g.E / (1 - g.nu * g.nu), G = g.E / (2 * (1 + g.nu)), t = 0.2, dt = 1e-6;
  g.control.shear_factor = 5.0 / 6;
  for (std::size_t n = 0; n < 4; ++n) {
    const Vec X = g.x[n];
    g.v[n] = Vec(0.3 * X[0] + 0.1 * X[1], 0.2 * X[1], 0.4 * X[0] + 0.6 * X[1]);
    g.w[n] = Vec(-0.5 * X[1], 0.7 * X[0], 0);
  }
  g.advance(dt);
  const Real expected[8] = {t * c * (0.3 + g.nu * 0.2),
                            t * c * (0.2 + g.nu * 0.3),
                            t * G * 0.1,
                            t * t * t / 12 * c * (0.7 + g.nu * 0.5),
                            t * t * t / 12 * c * (0.5 + g.nu * 0.7),
                            0,
                            t * G * 5 / 6 * (0.4 + 0.35),
                            t * G * 5 / 6 * (0.6 + 0.25)};
  for (std::size_t k = 0; k < 8; ++k) EXPECT_NEAR(g.resultant[k][0] / dt, expected[k], 1e-6) << k;
}

TEST(Shell, ATurningPlateKeepsItsStress) {
  // 25 turns of 40 steps each, 9 degrees a step; the corners turn with the chord as their positions do
  for (const int corners : {3, 4})
    for (const bool invariant : {false, true}) {
      ShellPatch g = ShellPatch::plate(2, 2, corners, 0.2, 0.1);
      g.control.invariant_axes = invariant, g.control.stiffness = true, g.control.thins = true;
      g.turn(tilt);
      for (int k = 0; k < 12; ++k)
        if (k % 6 != 2)
          for (std::size_t e = 0; e < g.size(); ++e) g.stress[k][e] = 0.1 * k + 0.3;
      const auto before = g.stress;
      const Vec axis = Vec(0.3, -0.5, 0.8).normalized();
      const std::vector<Vec> start = g.x;
      const Real angle = 2 * pi / 40;
      g.advance(0);
      const auto energy = g.internal;
      for (int k = 1; k <= 1000; ++k) {
        const Matrix R = Eigen::AngleAxisd(angle * (k % 40), axis).toRotationMatrix();
        for (std::size_t n = 0; n < g.x.size(); ++n) {
          const Vec to = R * start[n];
          g.v[n] = (to - g.x[n]) / 0.01, g.x[n] = to, g.w[n] = 2 * std::tan(angle / 2) / 0.01 * axis;
        }
        g.advance(0.01);
      }
      for (std::size_t e = 0; e < g.size(); ++e) {
        for (int k = 0; k < 12; ++k) EXPECT_NEAR(g.stress[k][e], before[k][e], 1e-11) << k;
        EXPECT_NEAR(g.internal[e], energy[e], 1e-12);
        EXPECT_NEAR(g.hourglass_energy[e], 0, 1e-12);
        EXPECT_NEAR(g.thickness[e], 0.1, 1e-12);
      }
    }
}

// Uniaxial stress of a sheet: ln(L/L0) = strain, t follows with nu; internal energy is the work.
TEST(Shell, AStretchedSheetThins) {
  ShellPatch g = ShellPatch::plate(1, 1, 4, 0, 0.1);
  g.control.thins = true;
  const int n = 2000;
  const std::vector<Vec> start = g.x;
  const Real stretch = 1.5, narrow = std::pow(stretch, -g.nu);
  for (int k = 1; k <= n; ++k) {
    const Real f = std::exp(std::log(stretch) * k / n), s = std::pow(f, -g.nu);
    for (std::size_t p = 0; p < 4; ++p) {
      const Vec to(start[p][0] * f, start[p][1] * s, 0);
      g.v[p] = (to - g.x[p]) * n, g.x[p] = to;
    }
    g.advance(1.0 / n);
  }
  EXPECT_NEAR(g.stress[0][0], g.E * std::log(stretch), 1e-6);
  EXPECT_NEAR(g.stress[1][0], 0, 1e-6);
  EXPECT_NEAR(g.thickness[0] / 0.1, narrow, 1e-6);
  // per reference volume E int ln(f) f^(1 - 2 nu) dln(f), volume f^(1 - 2 nu)
  const Real a = 1 - 2 * g.nu, l = std::log(stretch);
  EXPECT_NEAR(g.internal[0] / 0.1, g.E * (std::exp(a * l) * (a * l - 1) + 1) / (a * a), 1e-5);
}

// sqrt(E/(rho (1 - nu^2))) and, with ISDO 2, sqrt(E/rho).
TEST(Shell, TheStepIsThatOfTheRuleOfLengths) {
  ShellPatch g = ShellPatch::plate(1, 1, 4, 0, 0.1);
  for (Vec& p : g.x) p = Vec(3 * p[0], 2 * p[1], 0);
  g.mass[0] = 0.1 * 6 * g.rho;
  const Real c = std::sqrt(g.E / (1 - g.nu * g.nu)), bar = std::sqrt(g.E);
  const Real expected[3] = {2 / c, 6 / std::sqrt(13.0) / c, 2 / bar};
  for (int rule = 0; rule < 3; ++rule) {
    g.control.length_rule = rule;
    EXPECT_NEAR(g.advance(0).step, expected[rule], 1e-14) << rule;
  }
  ShellPatch t = ShellPatch::plate(1, 1, 3, 0, 0.1);  // sides 1, 1, sqrt(2)
  EXPECT_NEAR(t.advance(0).step, 0.85 / std::sqrt(2.0) / c, 1e-14);
}
