// *COURANT_EDDY_VISCOSITY: the mixing length model.
#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <string>

#include <fmt/format.h>

#include "../app/small_scene.hpp"
#include "shear_layer.hpp"
#include "sph/core/fields.hpp"

namespace courant {
namespace {

using namespace test::shear_layer;
using test::run;

std::string eddy(const std::string& numbers) {
  return "*COURANT_EDDY_VISCOSITY\n" + numbers + "\n";
}

class EddyViscosity : public testing::TestWithParam<const char*> {};

TEST_P(EddyViscosity, IsThatOfTheMixingLength) {
  const Real shear = 0.5;
  const auto s = test::build_deck(layer([&](Real y) { return shear * y; }, eddy(GetParam())));
  run(*s, 1e-6);
  Particles& p = s->world().particles;
  const Field<Real>& viscosity = sph_fields::viscosity(p);
  int at_most = 0;
  for (Index i = 0; i < p.active; ++i) {
    const Real y = p.x.vec(i)[1] + 6;
    if (y < 1 || y > 11) continue;  // mirrors turn the shear round
    const Real l = std::min(0.41 * y, 0.8);
    at_most += l == 0.8;
    EXPECT_NEAR(viscosity[i], 1000 * 0.09 * l * l * shear, 0.04 * 1000 * 0.09 * l * l * shear) << y;
  }
  EXPECT_GT(at_most, 300);
}

INSTANTIATE_TEST_SUITE_P(GivenAndStandardNumbers, EddyViscosity,
                         testing::Values("0.8,0.09,0.41\n0,-6,0,0,0,0", "0.8\n0,-6,0,0,0,0"));

TEST_F(EddyViscosity, WithoutAWallTheLengthIsTheLargestAndMUComesOnTop) {
  std::string deck = layer([](Real y) { return 0.5 * y; }, eddy("0.8,0.09"));
  const std::string null = "*MAT_NULL\n1,1000.0\n";
  deck.replace(deck.find(null), null.size(), "*MAT_NULL\n1,1000.0,,7\n");
  const auto s = test::build_deck(deck);
  run(*s, 1e-6);
  Particles& p = s->world().particles;
  for (Index i = 0; i < p.active; ++i)
    if (std::abs(p.x.vec(i)[1]) < 5) EXPECT_NEAR(sph_fields::viscosity(p)[i], 7 + 28.8, 0.04 * 28.8);
}

// u_t = K (|u_y| u_y)_y with K = CMU LMAX^2 has the source solution of Barenblatt (p-Laplacian, p = 3):
// u = s^(-1/4) (1 - |y s^(-1/4)|^(3/2)/6)^2 with s = K t, 0 beyond.
Real jet(Real y, Real s) {
  const Real edge = 1 - std::pow(std::abs(y) * std::pow(s, -0.25), 1.5) / 6;
  return edge > 0 ? std::pow(s, -0.25) * edge * edge : 0;
}

TEST_F(EddyViscosity, SpreadsAJetAsTheSolutionOfBarenblattDoes) {
  const auto s = test::build_deck(layer([](Real y) { return jet(y, 1); }, eddy("1,1")));
  run(*s, 1);
  const Particles& p = s->world().particles;
  Real square = 0, momentum = 0;
  for (Index i = 0; i < p.active; ++i) {
    const Real error = p.v.vec(i)[0] - jet(p.x.vec(i)[1], 2);
    square += error * error / static_cast<Real>(p.active);
    momentum +=
        p.v.vec(i)[0] - jet((static_cast<Real>((p.id[i] - 1) / columns) + 0.5 - rows / 2) * jet_dx, 1);
  }
  EXPECT_LT(std::sqrt(square), 0.004);  // the peak falls from 1 to 0.84
  EXPECT_NEAR(momentum, 0, 1e-10);
  const EnergyLedger e = s->sample("").energy;
  EXPECT_NEAR(e.residual(), 0, 0.01 * e.dissipated);
}

TEST_F(EddyViscosity, ShortensTheStep) {
  const auto with = test::build_deck(layer([](Real y) { return 0.5 * y; }, eddy("10,0.09")));
  const auto without = test::build_deck(layer([](Real y) { return 0.5 * y; }, ""));
  run(*with, 1e-2), run(*without, 1e-2);
  const Real h = 1.3 * jet_dx;
  EXPECT_GT(without->clock().dt, 0.8 * 0.9 * h / 20);
  EXPECT_LT(with->clock().dt, 1.1 * 0.9 * 0.125 * h * h / (0.09 * 100 * 0.5));
}

}  // namespace
}  // namespace courant
