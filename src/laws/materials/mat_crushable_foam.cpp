#include <algorithm>
#include <cmath>

#include <fmt/format.h>
#include <Eigen/Eigenvalues>

#include "laws/materials/strength_cards.hpp"
#include "laws/strength/strength.hpp"

namespace courant {

namespace {

/// Foam that is crushed: each component of the trial stress sigma + E D dt for itself, its principal values
/// held between -sigma_y(1 - V/V0) and TSC. Back it springs with E.
class CrushableFoam : public StrengthLaw {
 public:
  CrushableFoam(Real density, Real E, Real tension, Curve yield)
      : E_(E), tension_(tension), yield_(std::move(yield)) {
    ro = density;
  }
  // as of Hooke's law without lateral contraction
  Real bulk_modulus() const override { return E_ / 3; }
  Real shear_modulus() const override { return E_ / 2; }
  bool in_sheets() const override { return false; }
  std::vector<HistoryVariable> history() const override { return {{"logarithmic_volume", "-"}}; }

  void update(const PointBlock& block) const override {
    const auto& D = block.rate;
    Real* volume = block.history[0];
    for (Index i = 0; i < block.count; ++i) {
      for (std::size_t k = 0; k < 6; ++k) block.stress[k][i] += E_ * block.dt * D[k][i];
      volume[i] += block.dt * (D[0][i] + D[1][i] + D[2][i]);
      limit(block, i, yield_(-std::expm1(volume[i])));
    }
    keep_stiffness(block, sound_speed());
  }

 private:
  void limit(const PointBlock& block, Index i, Real yield) const {
    const auto& s = block.stress;
    Matrix stress;
    stress << s[0][i], s[3][i], s[5][i], s[3][i], s[1][i], s[4][i], s[5][i], s[4][i], s[2][i];
    const Eigen::SelfAdjointEigenSolver<Matrix> principal(stress);
    const Vec values = principal.eigenvalues(), held = values.cwiseMax(-yield).cwiseMin(tension_);
    if (held == values) return;
    const Matrix& axes = principal.eigenvectors();
    const Matrix now = axes * held.asDiagonal() * axes.transpose();
    s[0][i] = now(0, 0), s[1][i] = now(1, 1), s[2][i] = now(2, 2);
    s[3][i] = now(0, 1), s[4][i] = now(1, 2), s[5][i] = now(0, 2);
  }

  Real E_, tension_;
  Curve yield_;
};

struct MatCrushableFoam : MatCrushableFoamFields {
  std::shared_ptr<StrengthLaw> law(const Model& model_of_deck) const {
    const auto yield = model_of_deck.curves.find(lcid);
    return std::make_shared<CrushableFoam>(ro, E, tsc,
                                           yield == model_of_deck.curves.end() ? Curve() : yield->second);
  }
  void check(const Deck& deck, const Model& model_of_deck, Diagnostics& diagnostics) const {
    if (damp != 0)
      deck.warning(diagnostics, *this, "DAMP",
                   "the viscous stress of the foam is left out: stresses at high rates are lower",
                   "bulk viscosity (*CONTROL_BULK_VISCOSITY) and hourglass control act as on all solids");
    const auto yield = model_of_deck.curves.find(lcid);
    if (yield == model_of_deck.curves.end()) return;
    const auto& stress = yield->second.ordinate;
    if (!std::all_of(stress.begin(), stress.end(), [](Real y) { return y > 0; }))
      deck.error(diagnostics, *this, "LCID",
                 fmt::format("curve {} has yield stresses that are not > 0", lcid),
                 "the curve gives the yield stress over 1 - V/V0, both positive in compression");
  }
};

const std::string yield_curve = "*DEFINE_CURVE\n5\n0.0,1.0\n0.5,3.0\n";
// By hand. E = 10, TSC = 1/2, sigma_y from 1 at 0 to 3 at 1/2. D dt = (-ln(4/3), 0, 0): V/V0 = 3/4, sigma_y =
// 2 < 10 ln(4/3). Shear 2 e_xy = 0.4 without a change of volume: 2 along one diagonal, -2 along the other,
// held to 1/2 and -1. From there back by 0.05: elastically.
const RegisterStrength<MatCrushableFoam> mat_crushable_foam{
    "sigma + E D dt, principal values between -sigma_y(1 - V/V0) and TSC",
    "LS-DYNA's MAT_063: Poisson's ratio 0, each principal stress for itself",
    {{"1,2.0,10.0,0.0,5,0.5\n" + yield_curve,
      {-0.28768207245178090},
      {},
      {-2, 0, 0},
      {},
      {-0.28768207245178090}},
     {"1,2.0,10.0,0.0,5,0.5\n" + yield_curve, {0, 0, 0, 0.2, 0, 0}, {}, {-0.25, -0.25, 0, 0.75, 0, 0}},
     {"1,2.0,10.0,0.0,5,0.5\n" + yield_curve, {0.05}, {-2}, {-1.5}, {-0.4}, {-0.35}}},
    mat_crushable_foam_table()};

}  // namespace

}  // namespace courant
