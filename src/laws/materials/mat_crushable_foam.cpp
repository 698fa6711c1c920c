#include <algorithm>
#include <cmath>

#include <fmt/format.h>
#include <Eigen/Eigenvalues>

#include "laws/materials/strength_cards.hpp"
#include "laws/strength/curves_over_rate.hpp"
#include "laws/strength/strength.hpp"

namespace courant {

namespace {

/// Yield stress of a foam over 1 - V/V0, and over the rate of that where there are rates. [M/LT2]
struct CrushStress {
  Curve curve{};
  CurvesOverRate over_rate{};
  Real weight = 1;            ///< of a step in the mean rate [-]
  bool nominal_rate = false;  ///< the rate is that of V/V0, else of its logarithm
  bool has_rates() const { return !over_rate.curves.empty(); }
  Real operator()(Real crushed, Real rate) const {
    if (!has_rates()) return curve(crushed);
    return over_rate.between(rate, [&](std::size_t k) { return over_rate.curves[k](crushed); });
  }
};

/// Foam that is crushed: each component of the trial stress sigma + E D dt for itself, its principal values
/// held between -sigma_y(1 - V/V0) and TSC. Back it springs with E.
class CrushableFoam : public StrengthLaw {
 public:
  CrushableFoam(Real density, Real E, Real tension, CrushStress yield)
      : E_(E), tension_(tension), yield_(std::move(yield)) {
    ro = density;
  }
  // as of Hooke's law without lateral contraction
  Real bulk_modulus() const override { return E_ / 3; }
  Real shear_modulus() const override { return E_ / 2; }
  bool in_sheets() const override { return false; }
  std::vector<HistoryVariable> history() const override {
    std::vector<HistoryVariable> out{{"logarithmic_volume", "-"}};
    if (yield_.has_rates()) out.push_back({"mean_crush_rate", "1/T"});
    return out;
  }

  void update(const PointBlock& block) const override {
    const auto& D = block.rate;
    Real* volume = block.history[0];
    for (Index i = 0; i < block.count; ++i) {
      for (std::size_t k = 0; k < 6; ++k) block.stress[k][i] += E_ * block.dt * D[k][i];
      const Real opens = D[0][i] + D[1][i] + D[2][i];
      volume[i] += block.dt * opens;
      limit(block, i, yield_(-std::expm1(volume[i]), mean_rate(block, i, opens)));
    }
    keep_stiffness(block, sound_speed());
  }

 private:
  /// Of 1 - V/V0, over some steps.
  Real mean_rate(const PointBlock& block, Index i, Real opens) const {
    if (!yield_.has_rates()) return 0;
    Real& mean = block.history[1][i];
    const Real now = -opens * (yield_.nominal_rate ? std::exp(block.history[0][i]) : 1);
    if (block.dt > 0) mean += yield_.weight * (now - mean);
    return mean;
  }
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
  CrushStress yield_;
};

struct MatCrushableFoam : MatCrushableFoamFields {
  std::shared_ptr<StrengthLaw> law(const Model& model_of_deck) const {
    CrushStress yield;
    if (const auto found = model_of_deck.curves.find(lcid); found != model_of_deck.curves.end())
      yield.curve = found->second;
    return std::make_shared<CrushableFoam>(ro, E, tsc, std::move(yield));
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

/// The same with yield stresses that depend on the rate.
struct MatModifiedCrushableFoam : MatModifiedCrushableFoamFields {
  std::vector<Id> curves(const Model& model) const {
    const auto table = model.tables.find(tid);
    return table == model.tables.end() ? std::vector<Id>{tid} : table->second.curve;
  }
  std::shared_ptr<StrengthLaw> law(const Model& model) const {
    CrushStress yield;
    yield.over_rate = CurvesOverRate(model, tid);
    yield.weight = 2 / (ncycle + 1), yield.nominal_rate = sflag == 1;
    return std::make_shared<CrushableFoam>(ro, E, tsc, std::move(yield));
  }
  void check(const Deck& deck, const Model& model, Diagnostics& diagnostics) const {
    if (damp != 0)
      deck.warning(diagnostics, *this, "DAMP",
                   "the viscous stress of the foam is left out: stresses at high rates are lower",
                   "bulk viscosity (*CONTROL_BULK_VISCOSITY) and hourglass control act as on all solids");
    const char* hint = "a *DEFINE_TABLE over the rate of curves of yield stress over 1 - V/V0, or one curve";
    const auto fail = [&](const std::string& what) { deck.error(diagnostics, *this, "TID", what, hint); };
    if (const auto table = model.tables.find(tid); table != model.tables.end() && table->second.of_tables)
      return fail(fmt::format("table {} is one of tables", tid));
    for (const Id id : curves(model)) {
      const auto found = model.curves.find(id);
      if (found == model.curves.end()) return fail(fmt::format("there is no curve or table {}", id));
      const std::vector<Real>&x = found->second.abscissa, &y = found->second.ordinate;
      if (x.size() < 2) return fail(fmt::format("curve {} has less than two points", id));
      for (std::size_t k = 0; k < x.size(); ++k)
        if (!(y[k] > 0) || (k > 0 && !(x[k] > x[k - 1])))
          return fail(
              fmt::format("curve {}: expected rising strains and stresses > 0, got ({:g}, {:g}) at point {}",
                          id, x[k], y[k], k + 1));
      if (y.back() < y[y.size() - 2])
        return fail(fmt::format("curve {} falls beyond its last point, to below 0", id));
    }
  }
};

// As above by one curve; the mean rate is 2/13 of 2 ln(4/3) (dt = 1/2, NCYCLE 12). By a table, a step that
// counts alone (NCYCLE 1): that curve at a rate of 2 ln(4/3), half of it at rest. By half in two directions:
// elastic.
const std::string two_rates = yield_curve +
                              "*DEFINE_CURVE\n6\n0.0,0.5\n0.5,1.5\n*DEFINE_TABLE_2D\n7\n0.0,6\n"
                              "0.57536414490356180,5\n";
const RegisterStrength<MatModifiedCrushableFoam> mat_modified_crushable_foam{
    "sigma + E D dt, principal values between -sigma_y(1 - V/V0, rate) and TSC",
    "LS-DYNA's MAT_163: MAT_063 with influence of the rate",
    {{"1,2.0,10.0,0.0,5,0.5\n\n" + yield_curve,
      {-0.28768207245178090},
      {},
      {-2, 0, 0},
      {},
      {-0.28768207245178090, 0.08851756075439413}},
     {"1,2.0,10.0,0.0,7,0.5,0,1\n\n" + two_rates,
      {-0.28768207245178090},
      {},
      {-2, 0, 0},
      {},
      {-0.28768207245178090, 0.57536414490356180}},
     {"1,2.0,10.0,0.0,7,0.5,0,1\n0,0\n" + two_rates,
      {-0.28768207245178090 / 2, -0.28768207245178090 / 2},
      {0, 0, 0},
      {-1.4384103622589045, -1.4384103622589045, 0}}},
    mat_modified_crushable_foam_table()};

}  // namespace

}  // namespace courant
