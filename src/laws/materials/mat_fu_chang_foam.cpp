#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <Eigen/Eigenvalues>

#include "laws/materials/strength_cards.hpp"
#include "laws/strength/curves_over_rate.hpp"
#include "laws/strength/left_cauchy_green.hpp"

namespace courant {

namespace {

struct MatFuChangFoam : MatFuChangFoamFields {
  std::shared_ptr<StrengthLaw> law(const Model& model) const;
  void check(const Deck& deck, const Model& model, Diagnostics& diagnostics) const;
};

/// Foam that springs back: sigma_k = tau(l_k - 1, rate)/(l_i l_j) along the principal axes of b, each for
/// itself. Loading goes by the curve of its rate, unloading by that of the lowest one, the rate as a mean
/// over steps.
class RateFoam : public StrengthLaw {
 public:
  RateFoam(const MatFuChangFoam& card, const Model& model) : card_(card), curves_(model, card.tbid) {
    ro = card.ro, bulk_viscosity = card.bvflag == 1;
  }
  // as of Hooke's law without lateral contraction
  Real bulk_modulus() const override { return card_.E / 3; }
  Real shear_modulus() const override { return card_.E / 2; }
  bool in_sheets() const override { return false; }
  std::vector<HistoryVariable> history() const override {
    std::vector<HistoryVariable> out{left_cauchy_green};
    if (curves_.has_rates()) out.push_back({"mean_rate", "1/T", 6});
    return out;
  }

  void update(const PointBlock& block) const override {
    for (Index i = 0; i < block.count; ++i) {
      const Eigen::SelfAdjointEigenSolver<Matrix> stretched(strained(block, i).matrix());
      const Matrix& axes = stretched.eigenvectors();
      const Vec l = stretched.eigenvalues().cwiseSqrt(), rate = rates(block, i, axes, l);
      const Real J = l.prod();
      Vec principal;
      Real stiffest = 0;
      for (int k = 0; k < 3; ++k) {
        principal[k] = nominal(l[k] - 1, rate[k]) * l[k] / J;
        stiffest = std::max(stiffest, l[k] * l[k] * stiffness(l[k] - 1));
      }
      const Matrix now = axes * principal.asDiagonal() * axes.transpose();
      block.stress[0][i] = now(0, 0), block.stress[1][i] = now(1, 1), block.stress[2][i] = now(2, 2);
      block.stress[3][i] = now(0, 1), block.stress[4][i] = now(1, 2), block.stress[5][i] = now(0, 2);
      block.sound_speed[i] = std::sqrt(stiffest / ro);
    }
  }

 private:
  /// Of loading along each axis; below 0 where it unloads.
  Vec rates(const PointBlock& block, Index i, const Matrix& axes, const Vec& l) const {
    if (!curves_.has_rates()) return Vec::Zero();
    Symmetric mean;
    Real* const kept[6] = {&mean.xx, &mean.yy, &mean.zz, &mean.xy, &mean.yz, &mean.zx};
    for (std::size_t k = 0; k < 6; ++k) {
      Real& old = block.history[6 + k][i];
      if (block.dt > 0) old += weight_of_step * (block.rate[k][i] - old);
      *kept[k] = old;
    }
    const Matrix D = mean.matrix();
    Vec out;
    int most = 0;
    (l - Vec::Ones()).cwiseAbs().maxCoeff(&most);
    for (int k = 0; k < 3; ++k) {
      const int of = card_.rflag == 1 ? k : most;
      const Real along = axes.col(of).dot(D * axes.col(of)) * (card_.sflag == 1 ? l[of] : 1);
      out[k] = l[of] < 1 ? -along : along;
    }
    if (card_.rflag != 2) return out;
    const Real J = l.prod(), opens = D.trace() * (card_.sflag == 1 ? J : 1);
    return Vec::Constant(J < 1 ? -opens : opens);
  }
  Real nominal(Real e, Real rate) const {
    const bool linear = e >= 0 && card_.tflag != 1;
    const Real tau =
        linear ? card_.E * e : -curves_.between(rate, [&](std::size_t c) { return curves_.curves[c](-e); });
    return tau <= card_.tc ? tau : card_.fail == 1 ? 0 : card_.tc;
  }
  /// The larger of E and of the curves' slopes there. [M/LT2]
  Real stiffness(Real e) const {
    Real out = card_.E;
    if (e < 0 || card_.tflag == 1)
      for (const StraightPieces& curve : curves_.curves) out = std::max(out, curve.steepest(-e, -e));
    return out;
  }

  MatFuChangFoam card_;
  CurvesOverRate curves_;
};

std::shared_ptr<StrengthLaw> MatFuChangFoam::law(const Model& model) const {
  return std::make_shared<RateFoam>(*this, model);
}

void MatFuChangFoam::check(const Deck& deck, const Model& model, Diagnostics& diagnostics) const {
  const auto one_of = [&](const char* field, Real value, std::initializer_list<Real> values,
                          const char* hint) {
    if (std::find(values.begin(), values.end(), value) == values.end())
      deck.error(diagnostics, *this, field, fmt::format("'{:g}' is not supported", value), hint);
  };
  one_of("FAIL", fail, {0, 1}, "0: the tension stays TC; 1: it is gone beyond TC");
  one_of("SFLAG", sflag, {0, 1}, "0: rates of ln l; 1: of l");
  one_of("RFLAG", rflag, {0, 1, 2}, "0: of the largest strain; 1: of each direction; 2: of the volume");
  one_of("TFLAG", tflag, {0, 1}, "0: tension by E; 1: by the curves below 0");
  one_of("BVFLAG", bvflag, {0, 1}, "0: no bulk viscosity; 1: that of *CONTROL_BULK_VISCOSITY");
  one_of("SRAF", sraf, {0, 1}, "0 and 1: a mean over some twelve steps");
  if (damp != 0)
    deck.warning(diagnostics, *this, "DAMP",
                 "the viscous stress of the foam is left out: stresses at high rates are lower",
                 "BVFLAG 1 takes bulk viscosity (*CONTROL_BULK_VISCOSITY)");
  if (tbid == 0)
    return deck.error(diagnostics, *this, "TBID", "the form by constants is not supported",
                      "a *DEFINE_TABLE of curves over rates of strain");
  const int errors = diagnostics.errors();
  check_curves_over_rate(deck, model, *this, "TBID", tbid, -1e10, diagnostics);
  if (diagnostics.errors() == errors && tflag == 1 && !(CurvesOverRate(model, tbid).begins < 0))
    deck.error(diagnostics, *this, "TBID", "TFLAG 1 needs curves that have tension",
               "tension is below 0, strain and stress");
}

/// Of the fit that a table represents.
const std::string foam_curve = "*DEFINE_CURVE\n5\n0.0,0.0\n0.25,1.0\n1.0,4.0\n";
// By hand. E = 10; f = 4 e. D dt = (-2/3, 0, 0): l = 1/2: f = 2 over an area that is as it was.
const RegisterStrength<MatFuChangFoam> mat_fu_chang_foam{
    "sigma_k = tau(l_k - 1, rate)/(l_i l_j), compression by the curve of the rate of loading, unloading by "
    "the "
    "first "
    "one; tension E e <= TC",
    "Chang, Song, Lu & DeSilva 1998 by tables, as LS-DYNA's MAT_083",
    {{"1,2.0,10.0,,,,,5\n\n\n\n" + foam_curve, {-2.0 / 3}, {}, {-2, 0, 0}, {}, {-0.75, 0, 0, 0, 0, 0}},
     {"1,2.0,10.0,,,,,5\n\n\n\n" + foam_curve, {2.0 / 21}, {}, {1, 0, 0}, {}, {0.21, 0, 0, 0, 0, 0}}},
    mat_fu_chang_foam_table()};

}  // namespace

}  // namespace courant
