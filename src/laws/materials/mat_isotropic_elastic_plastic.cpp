#include "laws/materials/strength_cards.hpp"
#include "laws/strength/linear_hardening.hpp"

namespace courant {

namespace {

struct MatIsotropicElasticPlastic : MatIsotropicElasticPlasticFields {
  std::shared_ptr<StrengthLaw> law() const {
    return linear_hardening_law(ro, {.lambda = bulk - 2 * g / 3, .G = g, .yield = sigy, .isotropic = etan});
  }
};

// By hand, as *MAT_PLASTIC_KINEMATIC: G = 1, BULK = 5/3, SIGY = 3, ETAN = 1: pulled by (2, -1, -1), s = (4,
// -2, -2), q = 6, de = 3/(3 + 1), q = 6 - 9/4: 5/8 of s.
const RegisterStrength<MatIsotropicElasticPlastic> mat_isotropic_elastic_plastic{
    "q = sqrt(3/2 s:s) <= SIGY + ETAN e, return along s; pressure by BULK",
    "J2 plasticity with radial return: Krieg & Key 1976",
    {{"1,2.0,1.0,3.0,1.0,1.6666666666666667\n", {2, -1, -1}, {}, {2.5, -1.25, -1.25}, {0}, {0.75}}},
    mat_isotropic_elastic_plastic_table()};

}  // namespace

}  // namespace courant
