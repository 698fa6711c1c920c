// The penalty stiffness of particles is that of their bulk modulus, whatever their strength.
#include <gtest/gtest.h>

#include "small_scene.hpp"

using namespace courant;
using courant::test::build_deck;
using courant::test::SmallScene;

namespace {

constexpr Real K = 9e5, G = 3e5;

/// SFSA K of the first particle of a block on a floor, in 2D; `material`: the keyword and its cards.
Real stiffness(const std::string& material, bool eos) {
  SmallScene scene;
  if (!eos) scene.eos.clear();
  scene.extra = courant::test::floor_cards();
  std::string text = scene.text();
  const std::string fluid = "*MAT_NULL\n" + scene.material + "\n";
  text.replace(text.find(fluid), fluid.size(), material);
  if (!eos) text.replace(text.find("1,1,1,1,1\n"), 10, "1,1,1,0,1\n");
  const auto s = build_deck(text);
  if (!s) return 0;
  const auto* k = dynamic_cast<const Field<Real>*>(s->world().particles.fields.find("contact_1_stiffness"));
  return (*k)[0] / 0.1;  // SLSFAC
}

}  // namespace

TEST(ContactStiffness, IsThatOfTheBulkModulusOfAnEquationOfState) {
  EXPECT_NEAR(stiffness("*MAT_NULL\n1,1000.,-1.E20\n", true), K, 1e-9 * K);
}

TEST(ContactStiffness, OfAnElasticMaterialTakesNoShearModulus) {
  const Real E = 9 * K * G / (3 * K + G), nu = (3 * K - 2 * G) / (6 * K + 2 * G);
  EXPECT_NEAR(stiffness(fmt::format("*MAT_ELASTIC\n1,1000.,{},{}\n", E, nu), false), K, 1e-9 * K);
}

TEST(ContactStiffness, OfADeviatorBesideAnEquationOfStateTakesNoShearModulus) {
  EXPECT_NEAR(stiffness(fmt::format("*MAT_ELASTIC_PLASTIC_HYDRO\n1,1000.,{},1.E9\n", G), true), K, 1e-9 * K);
}
