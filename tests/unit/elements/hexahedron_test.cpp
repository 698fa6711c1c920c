// The hexahedron with one point against geometry, patch tests, closed solutions and its own energies.
#include "elements/solid/solid_loops.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "base/instruction_set.hpp"
#include "hexahedra.hpp"

using namespace courant;
using courant::test::Hexahedra;

namespace {

/// Of the volume of a hexahedron: 2 x 2 x 2 points of Gauss, which are exact for bilinear faces.
Real gauss_volume(const std::vector<Vec>& x) {
  const Real at = 1 / std::sqrt(3.0);
  Real volume = 0;
  for (int p = 0; p < 8; ++p) {
    const Vec q(p & 1 ? at : -at, p & 2 ? at : -at, p & 4 ? at : -at);
    Matrix J = Matrix::Zero();
    for (int c = 0; c < 8; ++c) {
      const Vec s = Hexahedra::sign(c);
      const Real u = 1 + s[0] * q[0], v = 1 + s[1] * q[1], w = 1 + s[2] * q[2];
      J += 0.125 * x[c] * Vec(s[0] * v * w, s[1] * u * w, s[2] * u * v).transpose();
    }
    volume += J.determinant();
  }
  return volume;
}

Real sum_of(const std::vector<Real>& values) {
  Real sum = 0;
  for (const Real v : values) sum += v;
  return sum;
}

constexpr Real gamma_modes[4][8] = {{1, 1, -1, -1, -1, -1, 1, 1},
                                    {1, -1, -1, 1, -1, 1, 1, -1},
                                    {1, -1, 1, -1, 1, -1, 1, -1},
                                    {-1, 1, -1, 1, 1, -1, 1, -1}};

}  // namespace

TEST(Hexahedron, ForcesOfUnitPressureAreTheSlopesOfTheVolume) {
  Hexahedra g = Hexahedra::brick({1, 1, 1}, {1, 1, 1}, 0.25);
  for (int k = 0; k < 3; ++k) g.stress[k][0] = -1;
  g.lambda = g.shear = 0;
  g.advance(0);
  EXPECT_NEAR(g.scratch.relative_volume[0] * g.V0[0], gauss_volume(g.x), 1e-14);
  for (int c = 0; c < 8; ++c)
    for (int k = 0; k < 3; ++k) {
      const Real d = 1e-5;
      std::vector<Vec> more = g.x, less = g.x;
      more[c][k] += d, less[c][k] -= d;
      EXPECT_NEAR(g.corner_force[3 * c + k][0], (gauss_volume(more) - gauss_volume(less)) / (2 * d), 1e-10);
    }
}

TEST(Hexahedron, AnAffineVelocityGivesItsRateEverywhereAndNoHourglassForces) {
  Matrix L;
  L << 0.3, -0.2, 0.5, 0.1, -0.4, 0.7, -0.6, 0.2, 0.25;
  using Shape = test::CellShape;
  int hourglass = 3;
  for (const Shape shape : {Shape::hexahedron, Shape::hexahedron, Shape::wedges, Shape::wedges_from_quads,
                            Shape::pyramids, Shape::tetrahedra}) {
    Hexahedra g = Hexahedra::brick({4, 3, 5}, {1, 1, 1}, shape == Shape::hexahedron ? 0.25 : 0.1);
    const Real whole = sum_of(g.V0);
    g.split_cells(shape);
    for (const Real V : g.V0) EXPECT_GT(V, 0);
    // outside faces of wedges and tetrahedra are not quite those of the cells
    EXPECT_NEAR(sum_of(g.V0), whole, shape == Shape::hexahedron || shape == Shape::pyramids ? 1e-12 : 2e-2);
    hourglass = hourglass == 3 ? 2 : hourglass == 2 ? 5 : 3;
    g.control = {hourglass, 0.1, 0, 0};
    for (std::size_t n = 0; n < g.x.size(); ++n) g.v[n] = L * g.x[n] + Vec(1, 2, 3);
    g.lambda = 2, g.shear = 1;
    // the same L in the middle of the step: x - dt/2 v is affine, too
    const Real dt = 1e-3;
    const Matrix Lm = L * (Matrix::Identity() - 0.5 * dt * L).inverse();
    const Matrix W = 0.5 * (Lm - Lm.transpose()), middle = 0.5 * (Lm + Lm.transpose());
    const Matrix D = middle + 0.5 * dt * (W * middle - middle * W);  // in the axes at the end
    g.each_block(dt, [&](Index begin, Index count) {
      for (Index i = 0; i < count; ++i)
        for (int k = 0; k < 6; ++k)
          EXPECT_NEAR(g.scratch.rate[k][i], D(Hexahedra::row[k], Hexahedra::column[k]), 1e-12) << begin + i;
    });
    const std::vector<Vec> f = g.nodal_forces();
    const Matrix s = dt * (2 * D.trace() * Matrix::Identity() + 2 * D);
    for (std::size_t e = 0; e < g.size(); ++e) {
      Vec sum = Vec::Zero();
      for (int c = 0; c < 8; ++c)
        for (int k = 0; k < 3; ++k) sum[k] += g.corner_force[3 * c + k][e];
      EXPECT_NEAR(sum.norm(), 0, 1e-12);
      for (int k = 0; k < 6; ++k)
        EXPECT_NEAR(g.stress[k][e], s(Hexahedra::row[k], Hexahedra::column[k]), 1e-12);
      EXPECT_NEAR(g.hourglass_energy[e], 0, 1e-25);
    }
    for (std::size_t n = 0; n < g.x.size(); ++n) {
      if (!g.inside[n]) continue;
      EXPECT_NEAR(f[n].norm(), 0, 1e-14) << n;
    }
  }
}

// A mode u Gamma of one direction, with an eighth of the mass at each corner: omega^2 = 64 k/m, k = 3/16 QM
// rho c^2 L of a cube.
TEST(Hexahedron, HourglassModesSwingWithTheirStiffness) {
  Hexahedra g = Hexahedra::brick({1, 1, 1}, {2, 2, 2}, 0);
  g.lambda = 2, g.shear = 1;
  g.control = {5, 0.1, 0, 0};
  const Real k = 0.1875 * 0.1 * 4 * 2, m = 8, omega = std::sqrt(64 * k / m), dt = 1e-3 / omega;
  for (int c = 0; c < 8; ++c) g.v[c] = Vec(0, 1e-6 * gamma_modes[2][c], 0);
  const Real before = 0.5 * m * 1e-12;
  for (int step = 0; step < 1000; ++step) {  // to a phase of 1
    for (int c = 0; c < 8; ++c) g.x[c] += dt * g.v[c];
    g.advance(dt);
    const std::vector<Vec> f = g.nodal_forces();
    for (int c = 0; c < 8; ++c) g.v[c] += dt / (m / 8) * f[c];
  }
  for (int c = 0; c < 8; ++c) EXPECT_NEAR(g.v[c][1], 1e-6 * gamma_modes[2][c] * std::cos(1.0), 1e-9) << c;
  EXPECT_NEAR(g.hourglass_energy[0], before * std::pow(std::sin(1.0), 2), 2e-3 * before);
}

TEST(Hexahedron, HourglassForcesTurnWithTheElement) {
  Hexahedra g = Hexahedra::brick({1, 1, 1}, {1, 1, 1}, 0.1);
  g.lambda = 2, g.shear = 1;
  g.control = {4, 0.1, 0, 0};
  const Vec kept(0.3, -0.2, 0.7), axis = Vec(0.3, -0.5, 0.8).normalized();
  for (int k = 0; k < 3; ++k) g.hourglass_force[3 + k][0] = kept[k];
  const std::vector<Vec> start = g.x;
  Real angle = 0;
  for (int k = 1; k <= 45; ++k) {  // 8 degrees a step: a whole turn, and what is left of it
    const Real next = angle + 2 * pi / 40;
    const Matrix R = Eigen::AngleAxisd(next, axis).toRotationMatrix();
    for (std::size_t n = 0; n < 8; ++n) g.v[n] = R * start[n] - g.x[n], g.x[n] = R * start[n];
    g.advance(1);
    angle = next;
  }
  const Vec expected = Eigen::AngleAxisd(angle, axis).toRotationMatrix() * kept;
  for (int k = 0; k < 3; ++k) EXPECT_NEAR(g.hourglass_force[3 + k][0], expected[k], 1e-12);
  EXPECT_NEAR(g.hourglass_energy[0], 0, 1e-12);
}

TEST(Hexahedron, ATurningBarKeepsItsStress) {
  // 100 turns of 40 steps each, 9 degrees a step
  Hexahedra g = Hexahedra::brick({4, 1, 1}, {4, 1, 1}, 0.1);
  g.lambda = 2, g.shear = 1;
  const Real s0[6] = {3, -1, 0.5, 0.7, -0.3, 0.2};
  for (std::size_t e = 0; e < g.size(); ++e)
    for (int k = 0; k < 6; ++k) g.stress[k][e] = s0[k];
  const auto invariants = [&](std::size_t e) {
    Matrix s;
    s << g.stress[0][e], g.stress[3][e], g.stress[5][e], g.stress[3][e], g.stress[1][e], g.stress[4][e],
        g.stress[5][e], g.stress[4][e], g.stress[2][e];
    return Vec(s.trace(), (s * s).trace(), s.determinant());
  };
  const Vec before = invariants(0);
  const Vec axis = Vec(0.3, -0.5, 0.8).normalized();
  const std::vector<Vec> start = g.x;
  for (int k = 1; k <= 4000; ++k) {
    const Matrix R = Eigen::AngleAxisd(2 * pi * (k % 40) / 40, axis).toRotationMatrix();
    for (std::size_t n = 0; n < g.x.size(); ++n) {
      const Vec to = R * start[n];
      g.v[n] = (to - g.x[n]) / 0.01, g.x[n] = to;
    }
    g.advance(0.01);
  }
  for (std::size_t e = 0; e < g.size(); ++e) {
    EXPECT_NEAR((invariants(e) - before).norm(), 0, 1e-9);
    for (int k = 0; k < 6; ++k) EXPECT_NEAR(g.stress[k][e], s0[k], 1e-9);  // back at the start
    EXPECT_NEAR(g.internal_energy[e], 0, 1e-9);
    EXPECT_NEAR(g.hourglass_energy[e], 0, 1e-9);
  }
}

TEST(Hexahedron, UniaxialStrainAndShearFollowTheirClosedSolutions) {
  Real errors[2][3];
  for (int fine = 0; fine < 2; ++fine) {
    const int n = fine ? 400 : 200;
    Hexahedra pull = Hexahedra::brick({1, 1, 1}, {1, 1, 1}, 0), shear = pull;
    for (Hexahedra* g : {&pull, &shear}) g->lambda = 2, g->shear = 1;
    for (int k = 0; k < n; ++k) {  // to lambda = 2, gamma = 2
      for (std::size_t p = 0; p < 8; ++p) {
        const Vec X = pull.reference[p];
        pull.v[p] = Vec(X[0], 0, 0), shear.v[p] = Vec(2 * X[1], 0, 0);
        pull.x[p] = X + (k + 1.0) / n * pull.v[p], shear.x[p] = X + (k + 1.0) / n * shear.v[p];
      }
      pull.advance(1.0 / n), shear.advance(1.0 / n);
    }
    errors[fine][0] = std::abs(pull.stress[0][0] - 4 * std::log(2.0));
    errors[fine][1] = std::abs(shear.stress[3][0] - std::sin(2.0));
    errors[fine][2] = std::abs(shear.stress[0][0] - (1 - std::cos(2.0)));
    // energy per reference volume: E' (lambda ln lambda - lambda + 1), and with sigma_xy d gamma: 1 - cos
    // gamma
    EXPECT_NEAR(pull.internal_energy[0], 4 * (2 * std::log(2.0) - 1), 2e-5);
    EXPECT_NEAR(shear.internal_energy[0], 1 - std::cos(2.0), 1e-4);
  }
  for (int k = 0; k < 3; ++k) {
    EXPECT_LT(errors[0][k], 5e-5) << k;
    EXPECT_LT(errors[1][k], 0.3 * errors[0][k]) << k;  // of second order
  }
}

TEST(Hexahedron, HourglassModesAreResisted) {
  // by hand, for a cube of side 2: a = QM rho V^(2/3) c/4, rate 8 u for v = u Gamma, force -a 8 u Gamma
  for (const int hourglass : {1, 2, 3})
    for (int mode = 0; mode < 4; ++mode) {
      Hexahedra g = Hexahedra::brick({1, 1, 1}, {2, 2, 2}, 0);
      g.control = {hourglass, 0.2, 1.5, 0.06};
      g.lambda = g.shear = 1, g.rho0[0] = 3;
      const Vec u(0.1, -0.2, 0.3);
      for (int c = 0; c < 8; ++c) g.v[c] = gamma_modes[mode][c] * u;
      g.advance(0);
      EXPECT_EQ(g.hourglass_energy[0], 0);
      g.advance(1e-9);
      const Real sound = 1.0, a = 0.2 * 3 * 4 * sound / 4;  // c^2 = (lambda + 2 G)/rho
      for (int c = 0; c < 8; ++c)
        for (int k = 0; k < 3; ++k)
          EXPECT_NEAR(g.corner_force[3 * c + k][0], -a * 8 * u[k] * gamma_modes[mode][c], 1e-8);
      EXPECT_NEAR(g.hourglass_energy[0], 1e-9 * a * 64 * u.squaredNorm(), 1e-17);
      EXPECT_NEAR(g.internal_energy[0], 0, 1e-17);
    }
}

TEST(Hexahedron, BulkViscosityIsPressureInCompressionAlone) {
  // by hand, a unit cube, tr D = -+0.5: q = rho l (Q1 l e^2 + Q2 c e), step l/(Q + sqrt(Q^2 + c^2)), Q = Q2 c
  // + Q1 l e
  for (const Real sign : {-1.0, 1.0}) {
    Hexahedra g = Hexahedra::brick({1, 1, 1}, {1, 1, 1}, 0);
    g.control = {2, 0.1, 1.5, 0.06};
    g.lambda = 2, g.shear = 1, g.rho0[0] = 1;
    for (int c = 0; c < 8; ++c) g.v[c] = sign * 0.5 * Vec(g.x[c][0], 0, 0);
    const auto found = g.advance(0);
    const Real q = sign < 0 ? 1.5 * 0.25 + 0.06 * 2 * 0.5 : 0, Q = sign < 0 ? 0.06 * 2 + 1.5 * 0.5 : 0;
    EXPECT_NEAR(g.corner_force[0][0], -q / 4, 1e-12);  // pushes corner 1 to smaller x
    EXPECT_NEAR(found.step, 1 / (Q + std::sqrt(Q * Q + 4)), 1e-12);
    EXPECT_NEAR(found.least_volume, 1, 1e-14);
    EXPECT_EQ(g.bulk_viscosity_energy[0], 0);
    g.advance(1e-6);
    EXPECT_NEAR(g.bulk_viscosity_energy[0], q * 0.5 * 1e-6, 2e-12);
  }
}

// Of a plate of thickness h = 0.1: q is that of l = V^(1/3), so that a wave through the thickness is damped
// by Q/c = (l/h) (Q2 c + Q1 l e)/c of critical damping; the central difference is stable up to h/(Q +
// sqrt(Q^2 + c^2)).
TEST(Hexahedron, TheStepOfAFlatOneHeedsItsBulkViscosity) {
  Hexahedra g = Hexahedra::brick({1, 1, 1}, {1, 1, 0.1}, 0);
  g.control = {2, 0.1, 1.5, 0.06};
  g.lambda = 2, g.shear = 1, g.rho0[0] = 1;
  for (int c = 0; c < 8; ++c) g.v[c] = -0.5 * Vec(0, 0, g.x[c][2]);
  const Real l = std::cbrt(0.1), Q = l / 0.1 * (0.06 * 2 + 1.5 * l * 0.5);
  EXPECT_NEAR(g.advance(0).step, 0.1 / (Q + std::sqrt(Q * Q + 4)), 1e-12);
  // no faster than that: a kick of the upper face by the step of undamped waves would grow
  const Real m = 0.1 / 4, dt = 0.1 / 2, q = l * (0.06 * 2 + 1.5 * l * 0.5) * 0.5;
  EXPECT_NEAR(g.corner_force[3 * 4 + 2][0], q / 4, 1e-12);
  EXPECT_GT(q / 4 / m * dt, 2 * 0.5 * 0.1 / 2) << "it turns round each end of the plate within one step";
}

TEST(Hexahedron, TheStepFollowsTheLargestFace) {
  Hexahedra g = Hexahedra::brick({1, 1, 1}, {0.5, 2, 3}, 0);
  g.lambda = 2, g.shear = 1, g.rho0[0] = 1;
  EXPECT_NEAR(g.advance(0).step, 0.5 / 2, 1e-14);
  // of a warped one: A = |d1 x d2|/2
  Hexahedra w = Hexahedra::brick({1, 1, 1}, {1, 1, 1}, 0.3);
  w.lambda = 2, w.shear = 1, w.rho0[0] = 1;
  const int faces[6][4] = {{0, 1, 2, 3}, {4, 5, 6, 7}, {0, 1, 5, 4},
                           {1, 2, 6, 5}, {2, 3, 7, 6}, {3, 0, 4, 7}};
  Real most = 0;
  for (const auto& f : faces)
    most = std::max(most, 0.5 * (w.x[f[2]] - w.x[f[0]]).cross(w.x[f[3]] - w.x[f[1]]).norm());
  const Real volume = gauss_volume(w.x), c = std::sqrt(4 * volume / w.V0[0]);
  EXPECT_NEAR(w.advance(0).step, volume / most / c, 1e-13);
}

TEST(Hexahedron, ElementsTurnedInsideOutAreFound) {
  Hexahedra g = Hexahedra::brick({5, 5, 5}, {1, 1, 1}, 0.1);
  g.lambda = 2, g.shear = 1;
  EXPECT_GT(g.advance(0).least_volume, 0);
  for (int c = 4; c < 8; ++c) g.x[g.corner[c][77]][2] -= 0.5;
  const auto found = g.advance(0);
  EXPECT_LE(found.least_volume, 0);
  EXPECT_EQ(found.smallest, 77);
  g.x[g.corner[0][70]][0] = std::nan("");
  const auto broken = g.advance(0);
  EXPECT_FALSE(broken.least_volume == broken.least_volume);
  EXPECT_FALSE(broken.step == broken.step);
}

// A mesh is shaken, with noise that turns round with each step: energies are the work of corner forces
// through the step, mean of old and new.
TEST(Hexahedron, EnergiesAreTheWorkOfTheCornerForces) {
  for (const int hourglass : {1, 2, 3, 4, 5}) {
    Hexahedra g = Hexahedra::brick({3, 3, 3}, {1, 1, 1}, 0.2);
    g.lambda = 2, g.shear = 1;
    g.control = {hourglass, 0.1, 1.5, 0.06};
    constexpr int n = 200;
    constexpr Real dt = 1.0 / n;
    std::mt19937 random(3);
    std::uniform_real_distribution<Real> number(-0.3, 0.3);
    const auto place = [&](std::size_t p, Real t) -> Vec {
      const Vec X = g.reference[p];
      return X + 0.02 * Vec(std::sin(3 * t + 7 * X[1]), std::sin(4 * t + 9 * X[2] * X[0]),
                            std::cos(5 * t + 8 * X[0]));
    };
    Real work = 0;
    std::vector<Vec> before;
    for (int k = 0; k <= n; ++k) {
      const Real step = k == 0 ? 0 : dt;
      for (std::size_t p = 0; p < g.x.size(); ++p) {
        g.v[p] = (place(p, k * dt) - place(p, (k - 1) * dt)) / dt +
                 Vec(number(random), number(random), number(random));
        g.x[p] += step * g.v[p];
      }
      g.advance(step);
      const std::vector<Vec> now = g.nodal_forces();
      for (std::size_t p = 0; k > 0 && p < g.x.size(); ++p)
        work -= 0.5 * dt * (before[p] + now[p]).dot(g.v[p]);
      before = now;
    }
    EXPECT_NEAR(g.total_energy() / work, 1, 1e-3) << hourglass;
  }
}

TEST(Hexahedron, ElasticEnergyIsTheWorkOfTheCornerForcesToSecondOrder) {
  Real errors[2];
  for (int fine = 0; fine < 2; ++fine) {
    Hexahedra g = Hexahedra::brick({3, 3, 3}, {1, 1, 1}, 0.2);
    g.lambda = 2, g.shear = 1;
    g.control = {2, 0, 0, 0};
    const int n = fine ? 200 : 100;
    const Real dt = 1.0 / n;
    Real work = 0;
    std::vector<Vec> before(g.x.size(), Vec::Zero());
    for (int k = 1; k <= n; ++k) {
      for (std::size_t p = 0; p < g.x.size(); ++p) {
        const Vec X = g.reference[p];
        const Real t = k * dt;
        const Vec to =
            X + 0.05 * t * Vec(std::sin(3 * t + 7 * X[1]), std::sin(9 * X[2] * X[0]), std::cos(t + 8 * X[0]));
        g.v[p] = (to - g.x[p]) / dt, g.x[p] = to;
      }
      g.advance(dt);
      const std::vector<Vec> now = g.nodal_forces();
      for (std::size_t p = 0; p < g.x.size(); ++p) work -= 0.5 * dt * (before[p] + now[p]).dot(g.v[p]);
      before = now;
    }
    errors[fine] = std::abs(work - g.total_energy()) / std::abs(work);
  }
  EXPECT_LT(errors[0], 1e-3);
  EXPECT_LT(errors[1], 0.3 * errors[0]);
}

TEST(Hexahedron, AllInstructionSetsAgree) {
  std::vector<Hexahedra> results;
  const InstructionSet chosen = instruction_set();
  for (const InstructionSet set : instruction_sets()) {
    use_instruction_set(set);
    Hexahedra g = Hexahedra::brick({7, 3, 5}, {1, 1, 1}, 0.2);  // 105: a block of 64, one of 41
    g.lambda = 2, g.shear = 1;
    g.control = {2, 0.1, 1.5, 0.06};
    for (int k = 0; k < 20; ++k) {
      for (std::size_t p = 0; p < g.x.size(); ++p) {
        const Vec X = g.reference[p];
        g.v[p] = Vec(std::sin(7 * X[1] + k), std::sin(9 * X[2] * X[0]), -std::cos(8 * X[0]));
        g.x[p] += 1e-3 * g.v[p];
      }
      g.advance(1e-3);
    }
    results.push_back(g);
  }
  use_instruction_set(chosen);
  for (std::size_t k = 1; k < results.size(); ++k)
    for (std::size_t e = 0; e < results[0].size(); ++e) {
      const auto expect_same = [&](const auto& of) {
        EXPECT_NEAR(of(results[k])[e], of(results[0])[e], 1e-12) << k << " " << e;
      };
      for (int j = 0; j < 24; ++j)
        expect_same([&](const Hexahedra& g) -> const auto& { return g.corner_force[j]; });
      for (int j = 0; j < 6; ++j) expect_same([&](const Hexahedra& g) -> const auto& { return g.stress[j]; });
      expect_same([](const Hexahedra& g) -> const auto& { return g.internal_energy; });
      expect_same([](const Hexahedra& g) -> const auto& { return g.hourglass_energy; });
      expect_same([](const Hexahedra& g) -> const auto& { return g.bulk_viscosity_energy; });
      expect_same([](const Hexahedra& g) -> const auto& { return g.limit; });
    }
}

TEST(Hexahedron, AFreeCubeIsStableBelowItsCriticalStep) {
  // nu = 0.3: sqrt((1 - nu)/(1 + nu)) = 0.734 of L/c; without viscosity, which lowers it
  for (const Real courant : {0.72, 0.75}) {
    Hexahedra g = Hexahedra::brick({1, 1, 1}, {1, 1, 1}, 0);
    g.lambda = 0.3 / 1.3 / 0.4, g.shear = 1 / 2.6;  // E = 1
    g.control = {2, 0, 0, 0};
    std::mt19937 random(3);
    std::uniform_real_distribution<Real> number(-1e-9, 1e-9);
    for (Vec& v : g.v) v = {number(random), number(random), number(random)};
    const Real dt = courant / std::sqrt(g.lambda + 2 * g.shear), mass = 1.0 / 8;
    g.advance(0);
    Real most = 0;
    for (int k = 0; k < 400; ++k) {
      const std::vector<Vec> f = g.nodal_forces();
      Vec mean = Vec::Zero();
      for (int c = 0; c < 8; ++c) g.v[c] += dt / mass * f[c], g.x[c] += dt * g.v[c], mean += g.v[c] / 8;
      g.advance(dt);
      for (int c = 0; c < 8; ++c) most = std::max(most, (g.v[c] - mean).norm());
    }
    if (courant < 0.734)
      EXPECT_LT(most, 1e-7);
    else
      EXPECT_GT(most, 1e-4);
  }
}
