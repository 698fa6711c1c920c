// Points of *MAT_026 that turn, and what its card refuses.
#include <gtest/gtest.h>

#include <array>
#include <vector>

#include "law_from_cards.hpp"
#include "laws/objective.hpp"
#include "laws/strength/material_axes.hpp"

using namespace courant;

namespace {

struct HoneycombPoint {
  std::shared_ptr<StrengthLaw> law =
      test::law_from_cards("MAT_HONEYCOMB",
                           "1,1.0,400.0,0.25,5.0,0.2\n11\n50.0,40.0,60.0,20.0,30.0,40.0\n\n\n*DEFINE_"
                           "CURVE\n11\n0.0,1.0\n0.8,8.0\n");
  std::array<Real, 6> stress{}, directions = direction_tensor(Matrix::Identity());
  Real compression = 0;

  void strain(const std::array<Real, 6>& rate) {
    PointBlock block;
    Real c = 0;
    std::vector<Real*> kept;
    for (Real& number : directions) kept.push_back(&number);
    block.count = 1, block.dt = 1, block.sound_speed = &c, block.history = kept;
    block.compression = &compression;
    for (std::size_t k = 0; k < 6; ++k) block.rate[k] = &rate[k], block.stress[k] = &stress[k];
    law->update(block);
  }
  void turn(const Vec& angle) {
    const Real* const w[3] = {&angle[0], &angle[1], &angle[2]};
    for (std::array<Real, 6>* tensor : {&stress, &directions}) {
      std::array<Real*, 6> data;
      for (std::size_t k = 0; k < 6; ++k) data[k] = &(*tensor)[k];
      turn_stress(w, 1, data.data(), 1);
    }
  }
};

Matrix as_matrix(const std::array<Real, 6>& t) {
  Matrix m;
  m << t[0], t[3], t[5], t[3], t[1], t[4], t[5], t[4], t[2];
  return m;
}
std::array<Real, 6> as_tensor(const Matrix& m) {
  return {m(0, 0), m(1, 1), m(2, 2), m(0, 1), m(1, 2), m(2, 0)};
}

}  // namespace

TEST(Honeycomb, DirectionsTurnWithTheBody) {
  HoneycombPoint still, turning;
  Matrix now = Matrix::Identity();
  const Vec step(0.05, 0.02, -0.04);
  Matrix W;
  W << 0, -step[2], step[1], step[2], 0, -step[0], -step[1], step[0], 0;
  const Matrix dR = (Matrix::Identity() - 0.5 * W).inverse() * (Matrix::Identity() + 0.5 * W);
  for (int k = 0; k < 60; ++k) {
    const std::array<Real, 6> e = {-0.004, 0.001, 0.0005, k < 30 ? 0.002 : -0.001, 0.001, -0.0015};
    still.compression = turning.compression = 0.002 * k;
    still.strain(e);
    now = dR * now;
    turning.turn(step);
    turning.strain(as_tensor(now * as_matrix(e) * now.transpose()));
  }
  EXPECT_LT((as_matrix(turning.stress) - now * as_matrix(still.stress) * now.transpose()).norm(), 1e-12);
  EXPECT_GT(as_matrix(still.stress).norm(), 1);
}

TEST(Honeycomb, DirectionsComeBackFromTheirTensor) {
  Matrix corner = Matrix::Identity();
  MaterialAxes axes;
  axes.rule = MaterialAxes::Rule::vector, axes.along = Vec(1, 2, 0.5), axes.beside = Vec(0, 1, 3);
  ASSERT_TRUE(directions_in_solid(axes, {}, corner));
  const Matrix back = directions_of_tensor(direction_tensor(corner));
  for (int k = 0; k < 3; ++k) EXPECT_NEAR(std::abs(back.col(k).dot(corner.col(k))), 1, 1e-14);
  axes.beside = 2 * axes.along;
  EXPECT_FALSE(directions_in_solid(axes, {}, corner));
}
