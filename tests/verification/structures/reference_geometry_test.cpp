// *INITIAL_FOAM_REFERENCE_GEOMETRY and REF against the closed form of a stretched cube.
#include <gtest/gtest.h>

#include "same_bits.hpp"
#include "solid_decks.hpp"
#include "state/reports.hpp"

using namespace courant;

namespace reference_geometry_test {

using test::CellShape;
using test::do_nothing;
using test::SolidDeck;

namespace {

constexpr Real A = 1e5, B = 4e4, nu = 0.45, rho = 1000;
const Matrix F = (Matrix() << 1.4, 0.2, 0, 0, 0.9, -0.1, 0.05, 0, 1.1).finished();

/// A block of 2 x 1 x 1 cells that starts as F X, X the positions of the reference geometry.
SolidDeck stretched(int elform, const std::string& more = "", const Matrix& stretch = F,
                    const std::string& material = fmt::format("MAT_MOONEY-RIVLIN_RUBBER\n1,{},{},{},{},1.0",
                                                              rho, nu, A, B)) {
  SolidDeck deck;
  if (elform == 16) deck.cells = CellShape::tetrahedra;
  if (elform == 16) deck.keyword = "*ELEMENT_SOLID_TET4TOTET10";
  if (elform == 23) deck.keyword = "*ELEMENT_SOLID_H8TOH20";
  deck.cards = fmt::format("*PART\nblock\n1,1,1\n*SECTION_SOLID\n1,{}\n*{}\n", elform, material) + more;
  std::vector<Vec> reference;
  deck.block(Vec(2, 1, 1), 2, 1, 1, 1, [&](const Vec& X) {
    reference.push_back(X);
    return Vec(stretch * X);
  });
  deck.cards += "*INITIAL_FOAM_REFERENCE_GEOMETRY\n";
  for (std::size_t n = 0; n < reference.size(); ++n)
    deck.cards += fmt::format("{:8}{:16.9e}{:16.9e}{:16.9e}\n", n + 1, reference[n][0], reference[n][1],
                              reference[n][2]);
  return deck;
}

struct Rubber {
  Real C = 0.5 * A + B, D = (A * (5 * nu - 2) + B * (11 * nu - 5)) / (2 * (1 - 2 * nu));
  Matrix stress(const Matrix& b) const {
    const Real I3 = b.determinant(), J = std::sqrt(I3);
    return 2 / J *
           ((A + B * b.trace()) * b - B * b * b +
            I3 * (2 * D * (I3 - 1) - 2 * C / (I3 * I3 * I3)) * Matrix::Identity());
  }
  Real energy(const Matrix& b) const {
    const Real I1 = b.trace(), I2 = 0.5 * (I1 * I1 - (b * b).trace()), I3 = b.determinant();
    return A * (I1 - 3) + B * (I2 - 3) + C * (1 / (I3 * I3) - 1) + D * (I3 - 1) * (I3 - 1);
  }
};

Real size_of(const World& world, int axis) {
  const Real* x = world.nodes.x.data(axis);
  const auto [low, high] = std::minmax_element(x, x + world.nodes.size());
  return *high - *low;
}

}  // namespace

// Stress, stored energy and mass at the start: sigma(F F^T), W V0, ro V0 of the reference volume 2.
TEST(ReferenceGeometry, StrainsSolidsFromTheStart) {
  const Rubber rubber;
  const Matrix b = F * F.transpose(), stress = rubber.stress(b);
  for (const int elform : {1, 2, 16, 23}) {
    auto s = test::started(stretched(elform).text(1));
    ASSERT_TRUE(s) << elform;
    Real mass = 0;
    for (Index n = 0; n < s->world().nodes.size(); ++n) mass += s->world().nodes.m[n];
    EXPECT_NEAR(mass, 2 * rho, 1e-9 * rho) << elform;
    EXPECT_NEAR(s->world().energy.internal / (2 * rubber.energy(b)), 1, 1e-5) << elform;
    for (FieldFiller* filler : s->world().passes.all<FieldFiller>()) filler->fill_fields(s->world());
    const ElementGroup& group = *s->world().groups.at(0);
    const auto& found = dynamic_cast<const Field<Real>&>(*group.fields.find("stress"));
    constexpr int row[6] = {0, 1, 2, 0, 1, 2}, column[6] = {0, 1, 2, 1, 2, 0};
    for (Index e = 0; e < group.size(); ++e)
      for (int k = 0; k < 6; ++k)
        EXPECT_NEAR(found.data(k)[e] / stress.norm(), stress(row[k], column[k]) / stress.norm(), 2e-5)
            << elform << " " << k;
  }
}

// Let go, a damped block comes back to the size of the reference; the ledger knows the energy from the start.
TEST(ReferenceGeometry, ABlockSpringsBack) {
  for (const int elform : {1, 23}) {
    const SolidDeck deck = stretched(elform, "*DAMPING_GLOBAL\n0,20.0\n*CONTROL_TIMESTEP\n0.0,0.3\n",
                                     Vec(1.3, 0.9, 1.05).asDiagonal());
    auto s = test::started(deck.text(2));
    ASSERT_TRUE(s);
    while (s->clock().t < 1) s->step(do_nothing);
    // the light corners of twenty nodes ring fast: b is of the second order in their steps (five times this
    // with TSSFAC 0.9)
    const Real bound = elform == 1 ? 2e-4 : 1e-3;
    EXPECT_NEAR(size_of(s->world(), 0), 2, bound) << elform;
    EXPECT_NEAR(size_of(s->world(), 1), 1, bound) << elform;
    EXPECT_NEAR(size_of(s->world(), 2), 1, bound) << elform;
    EXPECT_LT(test::energy_error(*s), 5e-3) << elform;
  }
}

// REF 0 starts without stress, as does a deck without the cards; a foam goes by the same.
TEST(ReferenceGeometry, CountsWithRefOneAlone) {
  const std::string plain = fmt::format("MAT_MOONEY-RIVLIN_RUBBER\n1,{},{},{},{}", rho, nu, A, B);
  auto s = test::started(stretched(1, "", F, plain).text(1));
  ASSERT_TRUE(s);
  EXPECT_EQ(s->world().energy.internal, 0);
  const std::string foam =
      "MAT_LOW_DENSITY_FOAM\n1,50.0,1.0e5,1,0.0\n0.0,0.0,0.0,0.0,0.0,0.0,1.0\n*DEFINE_CURVE\n1\n"
      "0.0,0.0\n0.5,2.0e4\n0.9,1.0e5\n";
  auto f = test::started(stretched(1, "", Vec(0.7, 1, 1).asDiagonal(), foam).text(1));
  ASSERT_TRUE(f);
  const auto& stress = dynamic_cast<const Field<Real>&>(*f->world().groups.at(0)->fields.find("stress"));
  EXPECT_NEAR(stress.data(0)[0], -1.2e4, 1.0);  // the nominal one at 0.3, over an area that does not change
}

TEST(ReferenceGeometry, HasTheSameBitsOnAnyNumberOfThreadsAndAfterARestart) {
  test::expect_same_bits(stretched(23).text(1), 60, 20);
}

}  // namespace reference_geometry_test
