#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "base/straight_pieces.hpp"
#include "keyword/common_rules.hpp"
#include "laws/strength/material_axes.hpp"
#include "laws/strength/strength.hpp"

namespace courant {

namespace {

struct MatHoneycomb : DirectionsCard {
  std::string title;
  Id mid = 0, lca = 0, lcb = 0, lcc = 0, lcs = 0, lcab = 0, lcbc = 0, lcca = 0, lcsr = 0;
  Real ro = 0, E = 0, pr = 0, sigy = 0, vf = 0, mu = 0, bulk = 0;
  Real eaau = 0, ebbu = 0, eccu = 0, gabu = 0, gbcu = 0, gcau = 0, tsef = 0, ssef = 0;
  int macf = 1;

  /// Of aa, bb, cc, ab, bc, ca, by what is in for those that are left out.
  std::array<Id, 6> curves() const {
    const Id shear = lcs != 0 ? lcs : lca;
    const auto or_else = [](Id own, Id other) { return own != 0 ? own : other; };
    return {lca,
            or_else(lcb, lca),
            or_else(lcc, lca),
            or_else(lcab, shear),
            or_else(lcbc, shear),
            or_else(lcca, shear)};
  }
  std::array<Real, 6> loose() const { return {eaau, ebbu, eccu, gabu, gbcu, gcau}; }
  Real bulk_modulus() const { return E / (3 * (1 - 2 * pr)); }
  Real shear_modulus() const { return E / (2 * (1 + pr)); }
  bool fails() const { return tsef > 0 || ssef > 0; }
  std::shared_ptr<StrengthLaw> law(const Model& model) const;
  void check(const Deck& deck, const Model& model, Diagnostics& diagnostics) const;
};

/// Most stress over 1 - V/V0. A curve that begins above 0 is one over V/V0.
struct CrushCurve {
  StraightPieces stress{};
  bool over_volume = false;
  CrushCurve() = default;
  explicit CrushCurve(const Curve& curve)
      : stress(curve.abscissa, curve.ordinate), over_volume(curve.abscissa.front() > 0) {}
  Real operator()(Real V) const { return std::max(stress(over_volume ? V : 1 - V), Real(0)); }
};

/// Until it is compacted each component along a, b, c for itself, below the stress that its curve has for the
/// volume; the moduli go from those of the loose one to the compacted one's. Then elastic and perfectly
/// plastic.
class Honeycomb : public StrengthLaw {
 public:
  Honeycomb(const MatHoneycomb& card, const Model& model)
      : card_(card), axes_(card.axes(model, 0)), loose_(card.loose()) {
    ro = card.ro, bulk_viscosity = card.bulk == 1;
    const std::array<Id, 6> ids = card.curves();
    for (std::size_t k = 0; k < 6; ++k)
      if (const auto found = model.curves.find(ids[k]); found != model.curves.end())
        most_[k] = CrushCurve(found->second);
    if (const auto found = model.curves.find(card.lcsr); found != model.curves.end())
      factor_ = {found->second.abscissa, found->second.ordinate};
    const Real K = card.bulk_modulus(), G = card.shear_modulus();
    const Real stiffest = *std::max_element(loose_.begin(), loose_.end());
    c0_ = std::sqrt(std::max(K + 4 * G / 3, stiffest) / ro);
  }
  Real bulk_modulus() const override { return card_.bulk_modulus(); }
  Real shear_modulus() const override { return card_.shear_modulus(); }
  const MaterialAxes* axes() const override { return &axes_; }
  bool in_sheets() const override { return false; }
  std::vector<HistoryVariable> history() const override {
    std::vector<HistoryVariable> out{{material_directions, "-", 6}};
    if (card_.fails()) out.push_back({"strain", "-", 6}), out.push_back({"failed_point", "-"});
    return out;
  }
  Real failure_limit() const override { return card_.fails() ? 1 : std::numeric_limits<Real>::infinity(); }
  std::string failure_variable() const override { return "failed_point"; }

  void update(const PointBlock& block) const override {
    for (Index i = 0; i < block.count; ++i) {
      const Real V = block.compression ? 1 / (1 + block.compression[i]) : 1;
      if (V > card_.vf)
        crush(block, i, V);
      else
        flow(block, i);
      if (card_.fails()) look_for_failure(block, i);
    }
    keep_stiffness(block, c0_);
  }

 private:
  template <class Arrays>
  static Matrix tensor_at(const Arrays& arrays, Index i) {
    Matrix out;
    out << arrays[0][i], arrays[3][i], arrays[5][i], arrays[3][i], arrays[1][i], arrays[4][i], arrays[5][i],
        arrays[4][i], arrays[2][i];
    return out;
  }
  static void set_stress(const PointBlock& block, Index i, const Matrix& s) {
    block.stress[0][i] = s(0, 0), block.stress[1][i] = s(1, 1), block.stress[2][i] = s(2, 2);
    block.stress[3][i] = s(0, 1), block.stress[4][i] = s(1, 2), block.stress[5][i] = s(2, 0);
  }
  static Matrix directions_at(const PointBlock& block, Index i) {
    std::array<Real, 6> tensor;
    for (std::size_t k = 0; k < 6; ++k) tensor[k] = block.history[k][i];
    return directions_of_tensor(tensor);
  }

  void crush(const PointBlock& block, Index i, Real V) const {
    const Matrix D = tensor_at(block.rate, i), Q = directions_at(block, i);
    const Matrix d = block.dt * (Q.transpose() * D * Q);
    Matrix s = Q.transpose() * tensor_at(block.stress, i) * Q;
    const Real compacted = std::clamp((1 - V) / (1 - card_.vf), Real(0), Real(1));
    const Real scale = factor_.empty() ? 1 : factor_(deviator_of(D).norm());
    constexpr int row[6] = {0, 1, 2, 0, 1, 2}, column[6] = {0, 1, 2, 1, 2, 0};
    for (std::size_t k = 0; k < 6; ++k) {
      const bool normal = k < 3;
      const Real dense = normal ? card_.E : card_.shear_modulus();
      const Real modulus = loose_[k] + compacted * (dense - loose_[k]);
      const Real most = scale * most_[k](V);
      Real& now = s(row[k], column[k]);
      now = std::clamp(now + (normal ? 1 : 2) * modulus * d(row[k], column[k]), -most, most);
      s(column[k], row[k]) = now;
    }
    set_stress(block, i, Q * s * Q.transpose());
  }
  void flow(const PointBlock& block, Index i) const {
    const Matrix e = block.dt * tensor_at(block.rate, i), old = tensor_at(block.stress, i);
    const Real mean = old.trace() / 3 + card_.bulk_modulus() * e.trace();
    Matrix s = deviator_of(old) + 2 * card_.shear_modulus() * deviator_of(e);
    const Real q = std::sqrt(1.5) * s.norm();
    if (q > card_.sigy) s *= card_.sigy / q;
    set_stress(block, i, s + mean * Matrix::Identity());
  }
  static Matrix deviator_of(const Matrix& m) { return m - m.trace() / 3 * Matrix::Identity(); }

  void look_for_failure(const PointBlock& block, Index i) const {
    for (std::size_t k = 0; k < 6; ++k) block.history[6 + k][i] += block.dt * block.rate[k][i];
    const Matrix Q = directions_at(block, i);
    const Matrix e = Q.transpose() * tensor_at(block.history.subspan(6), i) * Q;
    const Real shear = 2 * std::max({std::abs(e(0, 1)), std::abs(e(1, 2)), std::abs(e(2, 0))});
    if ((card_.tsef > 0 && e.diagonal().maxCoeff() > card_.tsef) || (card_.ssef > 0 && shear > card_.ssef))
      block.history[12][i] = 1;
  }

  MatHoneycomb card_;
  MaterialAxes axes_;
  std::array<Real, 6> loose_;  ///< moduli of aa, bb, cc, ab, bc, ca
  std::array<CrushCurve, 6> most_;
  StraightPieces factor_;  ///< over the rate; empty: 1
  Real c0_ = 0;
};

std::shared_ptr<StrengthLaw> MatHoneycomb::law(const Model& model) const {
  return std::make_shared<Honeycomb>(*this, model);
}

void MatHoneycomb::check(const Deck& deck, const Model& model, Diagnostics& diagnostics) const {
  check_axes_in_solids(deck, model, diagnostics);
  const auto expect = [&](bool holds, const char* field, const std::string& what, const char* hint) {
    if (!holds) deck.error(diagnostics, *this, field, what, hint);
  };
  expect(pr < 0.5, "PR", fmt::format("expected a number < 0.5, got '{:g}'", pr),
         "a material that keeps its volume has no finite bulk modulus");
  expect(vf < 1, "VF", fmt::format("expected a number < 1, got '{:g}'", vf),
         "the relative volume where it is compacted");
  expect(bulk == 0 || bulk == 1, "BULK", fmt::format("expected 0 or 1, got '{:g}'", bulk), "0 or 1");
  constexpr Real standard_mu = 0.05;
  if (mu != standard_mu && bulk != 1)
    deck.warning(diagnostics, *this, "MU",
                 "the viscous stress of the honeycomb is left out: stresses at high rates are lower",
                 "BULK 1 takes bulk viscosity (*CONTROL_BULK_VISCOSITY)");
  const auto check_curve = [&](const char* field, Id id, bool of_crush) {
    const auto found = model.curves.find(id);
    if (id == 0 || found == model.curves.end()) return;
    const std::vector<Real>&x = found->second.abscissa, &y = found->second.ordinate;
    bool rises = x.size() > 1;
    for (std::size_t k = 1; rises && k < x.size(); ++k) rises = x[k] > x[k - 1];
    expect(rises, field, fmt::format("curve {} has less than two points, or jumps", id),
           "abscissae rise from point to point");
    expect(std::all_of(y.begin(), y.end(), [](Real stress) { return stress >= 0; }), field,
           fmt::format("curve {} has values below 0", id), "stresses count alike in tension and compression");
    expect(!of_crush || x.empty() || x.front() <= 0 || x.back() >= 1, field,
           fmt::format("curve {} begins above 0, as one over the relative volume does, and ends below 1", id),
           "over 1 - V it begins at 0 or below, over V it reaches 1");
  };
  for (const auto& [field, id] :
       {std::pair{"LCA", lca}, std::pair{"LCB", lcb}, std::pair{"LCC", lcc}, std::pair{"LCS", lcs},
        std::pair{"LCAB", lcab}, std::pair{"LCBC", lcbc}, std::pair{"LCCA", lcca}})
    check_curve(field, id, true);
  check_curve("LCSR", lcsr, false);
}

using HC = MatHoneycomb;

constexpr FieldRules crush_curve = rules::over(rules::optional_id_of(IdSpace::curve), "-", "M/LT2");
constexpr const char* loose_cards =
    "1,2.0,100.0,0.25,2.0,0.2\n5\n10.0,20.0,30.0,4.0,5.0,6.0\n\n\n*DEFINE_CURVE\n5\n0.0,1.0\n0.8,5.0\n";
// By hand, at V = 1: moduli of the loose one, each component up to 1.
const RegisterStrength<HC> mat_honeycomb{
    "along a, b, c each component for itself: sigma + E D dt, at most LAMBDA sigma(V) of its curve, E = EU + "
    "(E - EU) (1 - V)/(1 - VF); from V = VF on elastic and perfectly plastic by E, PR, SIGY. LAMBDA over the "
    "norm of the deviator of D",
    "LS-DYNA's MAT_026",
    {{loose_cards,
      {-0.05, 0.02, 0.03, 0.01, -0.02, 0.01},
      {},
      {-0.5, 0.4, 0.9, 0.08, -0.2, 0.12},
      {},
      {0, 0, 0, 0, 0, 0}},
     {loose_cards, {-0.2, 0.06, 0.01, 0.2, 0, 0}, {}, {-1, 1, 0.3, 1, 0, 0}},
     {loose_cards, {0.05, 0, 0, 0, 0, 0}, {-1}, {-0.5}}},
    {.names = {"MAT_HONEYCOMB", "MAT_026"},
     .purpose = "honeycomb and foam that are crushed by stresses of each direction over the volume",
     .id_space = IdSpace::material,
     .title_option = true,
     .title = &HC::title,
     .cards = {
         {.fields = {{"MID", &HC::mid, "-", "id that *PART refers to", rules::required_id},
                     {"RO", &HC::ro, "M/L3", "density", rules::required_positive},
                     {"E", &HC::E, "M/LT2", "Young's modulus when compacted", rules::required_positive},
                     {"PR", &HC::pr, "-", "its Poisson ratio, below 0.5", {.check = Check::not_negative}},
                     {"SIGY", &HC::sigy, "M/LT2", "its yield stress", rules::required_positive},
                     {"VF", &HC::vf, "-", "V/V0 at which it is compacted", rules::required_positive},
                     {"MU",
                      &HC::mu,
                      "-",
                      "viscous stress: left out; another value than the standard with a warning",
                      {.standard = 0.05}},
                     {"BULK", &HC::bulk, "-", "bulk viscosity: off (0), on (1)"}}},
         {.fields = {{"LCA", &HC::lca, "-",
                      "curve of the most stress along a over 1 - V (it begins at 0 or below), or over V",
                      rules::over(rules::required_id_of(IdSpace::curve), "-", "M/LT2")},
                     {"LCB", &HC::lcb, "-", "along b; 0: LCA", crush_curve},
                     {"LCC", &HC::lcc, "-", "along c; 0: LCA", crush_curve},
                     {"LCS", &HC::lcs, "-", "of shear; 0: LCA", crush_curve},
                     {"LCAB", &HC::lcab, "-", "of shear ab; 0: LCS", crush_curve},
                     {"LCBC", &HC::lcbc, "-", "of shear bc; 0: LCS", crush_curve},
                     {"LCCA", &HC::lcca, "-", "of shear ca; 0: LCS", crush_curve},
                     {"LCSR", &HC::lcsr, "-", "factor of all of them over the rate of strain; 0: 1",
                      rules::over(crush_curve, "1/T", "-")}}},
         {.fields = {{"EAAU", &HC::eaau, "M/LT2", "modulus along a, loose", rules::required_positive},
                     {"EBBU", &HC::ebbu, "M/LT2", "along b", rules::required_positive},
                     {"ECCU", &HC::eccu, "M/LT2", "along c", rules::required_positive},
                     {"GABU", &HC::gabu, "M/LT2", "shear modulus ab, loose", rules::required_positive},
                     {"GBCU", &HC::gbcu, "M/LT2", "bc", rules::required_positive},
                     {"GCAU", &HC::gcau, "M/LT2", "ca", rules::required_positive},
                     {"AOPT", &HC::aopt, "-",
                      "a, b, c: 0 by nodes 1, 2, 4; 2 by A and D; 3 by V x n and n, the normal of the middle "
                      "face; < 0: axes of system -AOPT"},
                     {"MACF", &HC::macf, "-", "change of axes: 1 none", {.standard = 1, .allowed = {1}}}}},
         {.fields = {{"XP", &HC::xp, "L", "point of AOPT 1, which is not supported", no_effect},
                     {"YP", &HC::yp, "L", "its y", no_effect},
                     {"ZP", &HC::zp, "L", "its z", no_effect},
                     {"A1", &HC::a1, "-", "direction a of AOPT 2, x", {.spatial = Spatial::direction}},
                     {"A2", &HC::a2, "-", "direction a, y"},
                     {"A3", &HC::a3, "-", "direction a, z"}}},
         {.fields = {
              {"D1", &HC::d1, "-", "direction d of AOPT 2, c = a x d, x", rules::direction},
              {"D2", &HC::d2, "-", "direction d, y"},
              {"D3", &HC::d3, "-", "direction d, z"},
              {"TSEF",
               &HC::tsef,
               "-",
               "tensile strain along a, b, c at which elements fail; 0: none",
               {.check = Check::not_negative}},
              {"SSEF", &HC::ssef, "-", "the same of shear, of the engineer", {.check = Check::not_negative}},
              {"V1", &HC::v1, "-", "direction v of AOPT 3, x", rules::direction},
              {"V2", &HC::v2, "-", "direction v, y"},
              {"V3", &HC::v3, "-", "direction v, z"}}}}}};

}  // namespace

}  // namespace courant
