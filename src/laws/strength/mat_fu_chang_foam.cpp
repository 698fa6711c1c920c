#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <Eigen/Eigenvalues>

#include "keyword/common_rules.hpp"
#include "laws/strength/curves_over_rate.hpp"
#include "laws/strength/left_cauchy_green.hpp"

namespace courant {

namespace {

struct MatFuChangFoam : Entry {
  std::string title;
  Id mid = 0, tbid = 0, pvid = 0;
  Real ro = 0, E = 0, kcon = 0, tc = 0, fail = 0, damp = 0, bvflag = 0, sflag = 0, rflag = 0, tflag = 0;
  Real sraf = 0, ref = 0, hu = 0, d0 = 0, n0 = 0, n1 = 0, n2 = 0, n3 = 0, c0 = 0, c1 = 0, c2 = 0, c3 = 0;
  Real c4 = 0, c5 = 0, aij = 0, sij = 0, minr = 0, maxr = 0, shape = 0, expon = 1, riuld = 0;
  std::shared_ptr<StrengthLaw> law(const Model& model) const;
  void check(const Deck& deck, const Model& model, Diagnostics& diagnostics) const;
};

/// Foam that springs back: sigma_k = tau(l_k - 1, rate)/(l_i l_j) along the principal axes of b, each for
/// itself. Loading goes by the curve of its rate, unloading by that of the lowest one, the rate as a mean
/// over steps.
class RateFoam : public StrengthLaw {
 public:
  RateFoam(const MatFuChangFoam& card, const Model& model) : card_(card), curves_(model, card.tbid) {
    ro = card.ro;
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
  one_of("SRAF", sraf, {0, 1}, "0 and 1: a mean over some twelve steps");
  if (damp != 0)
    deck.warning(diagnostics, *this, "DAMP",
                 "the viscous stress of the foam is left out: stresses at high rates are lower",
                 "bulk viscosity (*CONTROL_BULK_VISCOSITY) and hourglass control act as on all solids");
  if (tbid == 0)
    return deck.error(diagnostics, *this, "TBID", "the form by constants is not supported",
                      "a *DEFINE_TABLE of curves over rates of strain");
  const int errors = diagnostics.errors();
  check_curves_over_rate(deck, model, *this, "TBID", tbid, -1e10, diagnostics);
  if (diagnostics.errors() == errors && tflag == 1 && !(CurvesOverRate(model, tbid).begins < 0))
    deck.error(diagnostics, *this, "TBID", "TFLAG 1 needs curves that have tension",
               "tension stands below 0, strain and stress");
}

using FF = MatFuChangFoam;

/// Of the fit that a table stands for.
constexpr FieldRules of_fit{.honour = Honour::ignored};
const std::string foam_curve = "*DEFINE_CURVE\n5\n0.0,0.0\n0.25,1.0\n1.0,4.0\n";
// By hand. E = 10; f = 4 e. D dt = (-2/3, 0, 0): l = 1/2: f = 2 over an area that is as it was.
const RegisterStrength<FF> mat_fu_chang_foam{
    "sigma_k = tau(l_k - 1, rate)/(l_i l_j), compression by the curve of the rate of loading, unloading by "
    "the "
    "first "
    "one; tension E e <= TC",
    "Chang, Song, Lu & DeSilva 1998 by tables, as LS-DYNA's MAT_083",
    {{"1,2.0,10.0,,,,,5\n\n\n\n" + foam_curve, {-2.0 / 3}, {}, {-2, 0, 0}, {}, {-0.75, 0, 0, 0, 0, 0}},
     {"1,2.0,10.0,,,,,5\n\n\n\n" + foam_curve, {2.0 / 21}, {}, {1, 0, 0}, {}, {0.21, 0, 0, 0, 0, 0}}},
    {.names = {"MAT_FU_CHANG_FOAM", "MAT_083"},
     .purpose = "foam of low density by curves of nominal stress over nominal strain for rates of strain",
     .id_space = IdSpace::material,
     .title_option = true,
     .title = &FF::title,
     .many = false,
     .cards = {
         {.fields = {{"MID", &FF::mid, "-", "id that *PART refers to", rules::required_id},
                     {"RO", &FF::ro, "M/L3", "density", rules::required_positive},
                     {"E", &FF::E, "M/LT2", "Young's modulus in tension", rules::required_positive},
                     {"KCON", &FF::kcon, "M/LT2", "stiffness for contact and steps", no_effect},
                     {"TC",
                      &FF::tc,
                      "M/LT2",
                      "most tension (nominal); 0: no limit",
                      {.standard = 1e20, .check = Check::positive}},
                     {"FAIL", &FF::fail, "-", "tension beyond TC: TC (0), none (1)"},
                     {"DAMP", &FF::damp, "-", "viscous stress: left out, with a warning"},
                     {"TBID", &FF::tbid, "-",
                      "table over the rate of curves of nominal stress over nominal strain, compression "
                      "positive, or one curve",
                      rules::optional_id_of(IdSpace::curve)}}},
         {.fields = {{"BVFLAG", &FF::bvflag, "-", "bulk viscosity: on, as in the rest", no_effect},
                     {"SFLAG", &FF::sflag, "-", "rate of ln l (0), of l (1)"},
                     {"RFLAG", &FF::rflag, "-",
                      "rate of the largest principal strain (0), of each direction (1), of the volume (2)"},
                     {"TFLAG", &FF::tflag, "-", "tension by E (0), by the curves below 0 (1)"},
                     {"PVID",
                      &FF::pvid,
                      "-",
                      "curve of pressure over the change of volume",
                      {.honour = Honour::no, .refers = IdSpace::curve}},
                     {"SRAF", &FF::sraf, "-", "mean of rates over some twelve steps: 0, 1"},
                     {"REF", &FF::ref, "-", "stress from a reference geometry", unsupported},
                     {"HU", &FF::hu, "-", "unloading by a share of loading", unsupported}}},
         {.fields = {{"D0", &FF::d0, "-", "of the fit", of_fit},
                     {"N0", &FF::n0, "-", "of the fit", of_fit},
                     {"N1", &FF::n1, "-", "of the fit", of_fit},
                     {"N2", &FF::n2, "-", "of the fit", of_fit},
                     {"N3", &FF::n3, "-", "of the fit", of_fit},
                     {"C0", &FF::c0, "-", "of the fit", of_fit},
                     {"C1", &FF::c1, "-", "of the fit", of_fit},
                     {"C2", &FF::c2, "-", "of the fit", of_fit}},
          .optional = true},
         {.fields = {{"C3", &FF::c3, "-", "of the fit", of_fit},
                     {"C4", &FF::c4, "-", "of the fit", of_fit},
                     {"C5", &FF::c5, "-", "of the fit", of_fit},
                     {"AIJ", &FF::aij, "-", "of the fit", of_fit},
                     {"SIJ", &FF::sij, "-", "of the fit", of_fit},
                     {"MINR", &FF::minr, "1/T", "least rate of interest", unsupported},
                     {"MAXR", &FF::maxr, "1/T", "largest rate of interest", unsupported},
                     {"SHAPE", &FF::shape, "-", "of unloading by HU", no_effect}},
          .optional = true},
         {.fields = {{"EXPON", &FF::expon, "-", "of unloading by HU", no_effect_but(1)},
                     {"RIULD", &FF::riuld, "-", "unloading that does not heed rates", unsupported}},
          .optional = true}}}};

}  // namespace

}  // namespace courant
