#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "base/eigenvalues.hpp"
#include "laws/failure/plastic_damage.hpp"
#include "laws/materials/mat_piecewise_linear_plasticity.hpp"

namespace courant {

namespace {

/// dD = Y/S de from the plastic strain EPSD on, where a principal stress is tension; Y is the elastic energy
/// per volume of the stress without damage.
struct DuctileDamage {
  Real threshold, S, E, nu;
  Real operator()(const DamageStep& step) const {
    const Real flown = step.after - std::max(step.before, threshold);
    if (!(flown > 0)) return step.damage;
    const auto& s = step.stress;
    Matrix minus;
    minus << -s[0], -s[3], -s[5], -s[3], -s[1], -s[4], -s[5], -s[4], -s[2];
    const Real sum = s[0] + s[1] + s[2], squares = minus.squaredNorm();
    constexpr Real round_off = 1e-6;  // of eigenvalues in closed form
    if (!(sum > 0) && !(least_eigenvalue(minus) < -round_off * std::sqrt(squares))) return step.damage;
    const Real Y = ((1 + nu) * squares - nu * sum * sum) / (2 * E);
    return std::min(step.damage + Y / S * flown, Real(1));
  }
};

struct MatDamage2 : MatPiecewiseLinearPlasticityFields {
  std::shared_ptr<StrengthLaw> law(const Model& model) const {
    constexpr Real share_of_yield = 200;
    PlasticDamage damage;
    damage.after = DuctileDamage{epsd, s > 0 ? s : sigy / share_of_yield, E, pr};
    damage.critical = dc;
    return damage_by_flow(piecewise_linear_plasticity(*this, model), std::move(damage));
  }
  void check(const Deck& deck, const Model& model, Diagnostics& diagnostics) const {
    check_piecewise_linear_plasticity(*this, deck, model, diagnostics);
    if (s == 0 && sigy == 0)
      deck.error(diagnostics, *this, "S", "expected a number > 0: SIGY is blank, of which it would be 1/200",
                 "give S, or SIGY");
    if (dc > 1)
      deck.error(diagnostics, *this, "DC", fmt::format("expected a number up to 1, got '{:g}'", dc),
                 "the damage at which a point fails; 1 is no strength");
  }
};

// By hand. E = 2.5, PR = 1/4, SIGY 3, ETAN 1/2: as *MAT_PIECEWISE_LINEAR_PLASTICITY de = 24/29 and s = 17/29
// (4, -2, -2), q = 102/29. In shear alone Y = (1 + PR) q^2/(3 E) = q^2/6. EPSD = 4/29, S = q^2/6 40/29: D =
// 1/2; 102^2 40/(6 29^3) = 416160/146334.
const RegisterStrength<MatDamage2> mat_damage_2{
    "s = (1 - D) s0, s0 as MAT_PIECEWISE_LINEAR_PLASTICITY; dD = Y/S de where e > EPSD and a principal "
    "stress is > "
    "0, Y = q0^2/(2 E) (2/3 (1 + PR) + 3 (1 - 2 PR) (p/q)^2); a point fails at DC and at FAIL",
    "Lemaitre 1985; J2 plasticity with radial return: Krieg & Key 1976",
    {{"1,2.0,2.5,0.25,3.0,0.5\n\n0.13793103448275862,2.843905039156997\n\n\n",
      {2, -1, -1},
      {},
      {34.0 / 29, -17.0 / 29, -17.0 / 29},
      {0, 0, 0},
      {24.0 / 29, 0.5, 1}}},
    mat_damage_2_table()};

}  // namespace

}  // namespace courant
