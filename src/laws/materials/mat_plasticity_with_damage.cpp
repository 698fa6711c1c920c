#include <fmt/format.h>

#include <algorithm>

#include "laws/failure/plastic_damage.hpp"
#include "laws/materials/mat_piecewise_linear_plasticity.hpp"

namespace courant {

namespace {

struct MatPlasticityWithDamage : MatPiecewiseLinearPlasticityFields {
  std::shared_ptr<StrengthLaw> law(const Model& model) const {
    PlasticDamage damage;
    damage.after = [from = eppf, range = eppfr - eppf](const DamageStep& step) {
      return std::clamp((step.after - from) / range, step.damage, Real(1));
    };
    const auto out = damage_by_flow(piecewise_linear_plasticity(*this, model), std::move(damage));
    out->failing_layers = static_cast<int>(numint);
    return out;
  }
  void check(const Deck& deck, const Model& model, Diagnostics& diagnostics) const {
    check_piecewise_linear_plasticity(*this, deck, model, diagnostics);
    check_failing_layers(deck, *this, numint, diagnostics);
    if (!(eppfr > eppf))
      deck.error(diagnostics, *this, "EPPFR", fmt::format("expected a number above EPPF, got '{:g}'", eppfr),
                 "damage grows from 0 at EPPF to 1 at EPPFR");
  }
};

// By hand. E = 2.5, PR = 1/4, SIGY 3, ETAN 1/2: as *MAT_PIECEWISE_LINEAR_PLASTICITY de = 24/29 and q =
// 102/29. EPPF = 4/29, EPPFR = 44/29: D = 1/2. With D = 1/4 before, where the stress was 3/4 (2, -1, -1), no
// flow yet at e = 10: the stress without damage is (2, -1, -1) + 2 G (0.1, -0.05, -0.05).
const RegisterStrength<MatPlasticityWithDamage> mat_plasticity_with_damage{
    "s = (1 - D) s0, s0 as MAT_PIECEWISE_LINEAR_PLASTICITY; D = (e - EPPF)/(EPPFR - EPPF) from 0 to 1, where "
    "a "
    "point fails",
    "J2 plasticity with radial return: Krieg & Key 1976; damage: Lemaitre 1985",
    {{"1,2.0,2.5,0.25,3.0,0.5,0.13793103448275862\n,,,,1.5172413793103448\n\n\n",
      {2, -1, -1},
      {},
      {34.0 / 29, -17.0 / 29, -17.0 / 29},
      {0, 0, 0},
      {24.0 / 29, 0.5, 0.5}},
     {"1,2.0,2.5,0.25,3.0,0.5,0.13793103448275862\n,,,,1.5172413793103448\n\n\n",
      {0.1, -0.05, -0.05},
      {1.5, -0.75, -0.75},
      {1.65, -0.825, -0.825},
      {10, 0.25, 0.25},
      {10, 0.25, 0.25}}},
    mat_plasticity_with_damage_table()};

}  // namespace

}  // namespace courant
