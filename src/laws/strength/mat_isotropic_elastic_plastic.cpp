#include "keyword/common_rules.hpp"
#include "laws/strength/linear_hardening.hpp"

namespace courant {

namespace {

using Isotropic = struct MatIsotropicElasticPlastic;
struct MatIsotropicElasticPlastic : Entry {
  std::string title;
  Id mid = 0;
  Real ro = 0, g = 0, sigy = 0, etan = 0, bulk = 0;
  std::shared_ptr<StrengthLaw> law() const {
    return linear_hardening_law(ro, {.lambda = bulk - 2 * g / 3, .G = g, .yield = sigy, .isotropic = etan});
  }
};

// By hand, as *MAT_PLASTIC_KINEMATIC: G = 1, BULK = 5/3, SIGY = 3, ETAN = 1: pulled by (2, -1, -1), s = (4,
// -2, -2), q = 6, de = 3/(3 + 1), q = 6 - 9/4: 5/8 of s.
const RegisterStrength<Isotropic> mat_isotropic_elastic_plastic{
    "q = sqrt(3/2 s:s) <= SIGY + ETAN e, return along s; pressure by BULK",
    "J2 plasticity with radial return: Krieg & Key 1976",
    {{"1,2.0,1.0,3.0,1.0,1.6666666666666667\n", {2, -1, -1}, {}, {2.5, -1.25, -1.25}, {0}, {0.75}}},
    {.names = {"MAT_ISOTROPIC_ELASTIC_PLASTIC", "MAT_012"},
     .purpose = "elasticity and plasticity with linear isotropic hardening, by moduli of shear and volume",
     .id_space = IdSpace::material,
     .title_option = true,
     .title = &Isotropic::title,
     .cards = {{.fields = {{"MID", &Isotropic::mid, "-", "id that *PART refers to", rules::required_id},
                           {"RO", &Isotropic::ro, "M/L3", "density", rules::required_positive},
                           {"G", &Isotropic::g, "M/LT2", "shear modulus", rules::required_positive},
                           {"SIGY", &Isotropic::sigy, "M/LT2", "yield stress", rules::required_positive},
                           {"ETAN",
                            &Isotropic::etan,
                            "M/LT2",
                            "plastic hardening modulus: slope of the yield stress over plastic strain",
                            {.check = Check::not_negative}},
                           {"BULK", &Isotropic::bulk, "M/LT2", "bulk modulus", rules::required_positive}}}}}};

}  // namespace

}  // namespace courant
