// Fabric: orthotropic sheets that wrinkle, or two families of fibres by curves: *MAT_034.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "base/straight_pieces.hpp"
#include "keyword/common_rules.hpp"
#include "laws/strength/material_axes.hpp"
#include "laws/strength/strength.hpp"
#include "laws/strength/tension_field.hpp"
#include "parallel/parallel.hpp"

namespace courant {

namespace {

struct MatFabric : DirectionsCard {
  std::string title;
  Id mid = 0;
  Real ro = 0, ea = 0, eb = 0, prba = 0, prab = 0, gab = 0, cse = 0, el = 0, prl = 0, lratio = 0, damp = 0;
  Real flc = 0, fac = 0, ela = 0, lnrc = 0, tsrfac = 0, rgbrth = 0, x0 = 0, x1 = 0, beta = 0, rl = 0;
  int form = 0, fvopt = 0, a0ref = 0, isrefg = 0;
  Id lca = 0, lcb = 0, lcab = 0, lcua = 0, lcub = 0, lcuab = 0;

  bool isotropic() const { return eb == 0 && gab == 0; }
  Real modulus_b() const { return isotropic() ? ea : eb; }
  Real shear() const { return isotropic() ? ea / (2 * (1 + prba)) : gab; }
  bool by_fibres() const { return form == 14; }
  std::shared_ptr<StrengthLaw> law(const Model& model) const;
  void check(const Deck& deck, const Model& model, Diagnostics& diagnostics) const;
  void check_curves(const Deck& deck, const Model& model, Diagnostics& diagnostics) const;
  void check_liner(const Deck& deck, Diagnostics& diagnostics) const;
};

/// Stress over the strain of a family of fibres, or of shear between them.
class FibreCurve {
 public:
  FibreCurve() = default;
  /// `load`, `unload` 0: straight with `modulus`, back along the same curve. `unload` < 0: stretched.
  FibreCurve(const Model& model, Id load, Id unload, Real modulus) : modulus_(modulus) {
    if (const auto up = model.curves.find(load); up != model.curves.end())
      loading_ = {up->second.abscissa, up->second.ordinate};
    const auto down = model.curves.find(std::abs(unload));
    if (down == model.curves.end()) return;
    unloading_ = {down->second.abscissa, down->second.ordinate};
    reached_at_ = {down->second.ordinate, down->second.abscissa};
    stretched_ = unload < 0;
  }
  /// For e >= 0; `most`: the largest strain so far, which grows. [M/LT2]
  Real stress(Real e, Real& most) const {
    if (loading_.empty()) return modulus_ * e;
    if (e >= most) {
      most = e;
      return loading_(e);
    }
    if (unloading_.empty()) return loading_(e);
    const Real top = loading_(most);
    if (!(top > 0)) return loading_(e);
    const Real at_top = reached_at_(top);
    return std::max(unloading_(stretched_ ? e * at_top / most : e - most + at_top), Real(0));
  }
  Real modulus() const { return modulus_; }
  /// The largest slope there is, for the step. [M/LT2]
  Real steepest() const {
    Real out = modulus_, back = 0;
    for (std::size_t k = 0; k < loading_.pieces(); ++k) out = std::max(out, loading_.slope(k));
    for (std::size_t k = 0; k < unloading_.pieces(); ++k) back = std::max(back, unloading_.slope(k));
    return std::max(out, stretched_ ? steepest_stretched() : back);
  }

 private:
  /// Of stretched unloading from strains up to four times the largest of the curves. [M/LT2]
  Real steepest_stretched() const {
    constexpr int looks = 400;
    const Real last = 4 * std::max(loading_.last(), unloading_.last());
    Real out = 0;
    for (int k = 1; k <= looks && last > 0; ++k) {
      const Real most = last * k / looks, top = loading_(most);
      if (!(top > 0)) continue;
      const Real at_top = reached_at_(top);
      out = std::max(out, unloading_.steepest(0, at_top) * at_top / most);
    }
    return out;
  }

  Real modulus_ = 0;
  StraightPieces loading_, unloading_;
  StraightPieces reached_at_;  ///< strain over stress of unloading
  bool stretched_ = false;
};

/// FORM 0: linear in the summed strains along a and b, which stay at right angles. FORM 14: fibres a and b
/// that follow the motion of the sheet, each with the true stress of its logarithmic strain, and a shear
/// stress between them by the angle they have lost.
class WovenFabric : public StrengthLaw {
 public:
  WovenFabric(const MatFabric& card, const Model& model)
      : card_(card),
        axes_(card.axes(model, card.beta)),
        sheet_(card.ea, card.modulus_b(), card.prba),
        field_(sheet_, card.shear()),
        fabric_share_(1 - card.lratio),
        liner_(1, 1, card.prl) {
    for (Real* stiffness : {&liner_.aa, &liner_.bb, &liner_.ab}) *stiffness *= card.el;
    ro = card.ro;
    if (card.by_fibres())
      along_ = {FibreCurve(model, card.lca, card.lcua, card.ea),
                FibreCurve(model, card.lcb, card.lcub, card.modulus_b()),
                FibreCurve(model, card.lcab, card.lcuab, card.shear())};
  }
  std::vector<HistoryVariable> history() const override {
    std::vector<HistoryVariable> out = {
        {"fabric_strain_a", "-"}, {"fabric_strain_b", "-"}, {"fabric_strain_ab", "-"}};
    if (!card_.by_fibres()) return out;
    for (const char* name : {"fibre_a_less_1", "fibre_a_across", "fibre_b_across", "fibre_b_less_1",
                             "largest_strain_a", "largest_strain_b", "largest_strain_ab"})
      out.push_back({name, "-"});
    return out;
  }
  /// As if it were isotropic with Young's modulus EB: what contact asks for.
  Real bulk_modulus() const override { return card_.modulus_b() / (3 * (1 - 2 * 0.3)); }
  Real shear_modulus() const override { return card_.shear(); }
  const MaterialAxes* axes() const override { return &axes_; }
  Real plane_modulus() const override {
    const Real fabric =
        card_.by_fibres()
            ? SheetStiffness(along_[0].steepest(), along_[1].steepest(), 0).largest(along_[2].steepest())
            : sheet_.largest(card_.shear());
    return fabric_share_ * fabric + card_.lratio * liner_.largest(liner_shear());
  }

  /// Only sheets have it: the stress stays plane.
  void update(const PointBlock& block) const override {
    std::array<Real, block_size> rate_zz;
    update_in_plane_stress(block, rate_zz.data());
  }
  void update_in_plane_stress(const PointBlock& block, Real* rate_zz) const override {
    for (Index i = 0; i < block.count; ++i) {
      const Real a = block.history[0][i] += block.dt * block.rate[0][i],
                 b = block.history[1][i] += block.dt * block.rate[1][i],
                 ab = block.history[2][i] += block.dt * block.rate[3][i];
      const PlaneStress s = card_.by_fibres() ? of_fibres(block, i)
                            : card_.cse == 1  ? field_.without_compression(a, b, ab)
                                              : field_.linear(a, b, ab);
      const Real of_liner = card_.lratio, G = liner_shear();
      block.stress[0][i] = fabric_share_ * s.a + of_liner * (liner_.aa * a + liner_.ab * b);
      block.stress[1][i] = fabric_share_ * s.b + of_liner * (liner_.ab * a + liner_.bb * b);
      block.stress[2][i] = 0;
      block.stress[3][i] = fabric_share_ * s.ab + of_liner * 2 * G * ab;
      for (const std::size_t k : {4, 5})
        block.stress[k][i] +=
            2 * (fabric_share_ * card_.shear() + of_liner * G) * block.dt * block.rate[k][i];
      rate_zz[i] = 0;
    }
    keep_stiffness(block, std::sqrt(plane_modulus() / ro));
  }

 private:
  Real liner_shear() const { return card_.el / (2 * (1 + card_.prl)); }

  PlaneStress of_fibres(const PointBlock& block, Index i) const {
    Eigen::Matrix2d H, F;  // D dt/2, and the fibres as columns
    H << block.rate[0][i], block.rate[3][i], block.rate[3][i], block.rate[1][i];
    H *= 0.5 * block.dt;
    F << 1 + block.history[3][i], block.history[5][i], block.history[4][i], 1 + block.history[6][i];
    const Eigen::Matrix2d one = Eigen::Matrix2d::Identity();
    F = (one - H).inverse() * (one + H) * F;
    block.history[3][i] = F(0, 0) - 1, block.history[4][i] = F(1, 0);
    block.history[5][i] = F(0, 1), block.history[6][i] = F(1, 1) - 1;
    const Real la = F.col(0).norm(), lb = F.col(1).norm();
    const Eigen::Vector2d a = F.col(0) / la, b = F.col(1) / lb;
    const Real sa = along(0, std::log(la), block.history[7][i]),
               sb = along(1, std::log(lb), block.history[8][i]);
    const Real gamma = std::asin(std::clamp(a.dot(b), Real(-1), Real(1)));
    const Real tau = std::copysign(along_[2].stress(std::abs(gamma), block.history[9][i]), gamma);
    const Eigen::Matrix2d s =
        sa * a * a.transpose() + sb * b * b.transpose() + tau * (a * b.transpose() + b * a.transpose());
    return {s(0, 0), s(1, 1), s(0, 1)};
  }
  Real along(std::size_t fibre, Real e, Real& most) const {
    if (e >= 0) return along_[fibre].stress(e, most);
    return card_.cse == 1 ? 0 : along_[fibre].modulus() * e;
  }

  MatFabric card_;
  MaterialAxes axes_;
  SheetStiffness sheet_;
  TensionField field_;
  Real fabric_share_;
  SheetStiffness liner_;
  std::array<FibreCurve, 3> along_;  ///< a, b, shear
};

std::shared_ptr<StrengthLaw> MatFabric::law(const Model& model) const {
  return std::make_shared<WovenFabric>(*this, model);
}

void MatFabric::check(const Deck& deck, const Model& model, Diagnostics& diagnostics) const {
  check_axes(deck, model, diagnostics);
  const auto expect = [&](bool holds, const char* field, const std::string& what, const char* hint) {
    if (!holds) deck.error(diagnostics, *this, field, what, hint);
  };
  expect((eb == 0) == (gab == 0), eb == 0 ? "EB" : "GAB",
         "is blank beside a modulus that is not: fabric is orthotropic or isotropic",
         "give EB and GAB, or neither for a fabric that is isotropic");
  expect(prba * prba * ea < modulus_b(), "PRBA",
         "the material would give energy away: its stiffness is not positive definite", "PRBA^2 < EB/EA");
  const Real major = modulus_b() > 0 ? prba * ea / modulus_b() : 0;
  if (prab != 0 && std::abs(prab - major) > 0.01 * std::abs(major))
    deck.warning(
        diagnostics, *this, "PRAB",
        fmt::format("is not used: it is PRBA EA/EB = {:g}, with which strains have an energy", major),
        "leave it blank");
  expect(cse == 0 || cse == 1, "CSE", fmt::format("expected 0 or 1, got '{:g}'", cse),
         "0: compression stays; 1: the fabric bears none");
  expect(form == 0 || form == 14, "FORM", fmt::format("'{}' is not supported", form),
         "0: linear; 14: fibres with curves");
  if (by_fibres() && prba != 0)
    deck.warning(diagnostics, *this, "PRBA", "has no effect: fibres of FORM 14 are independent",
                 "FORM 0 has lateral contraction");
  if (damp != 0)
    deck.warning(diagnostics, *this, "DAMP", "the viscous stress of the fabric is left out",
                 "*DAMPING_PART_MASS and *DAMPING_GLOBAL damp motions as a whole");
  if (by_fibres()) check_curves(deck, model, diagnostics);
  if (!by_fibres())
    for (const auto& [field, id] : {std::pair{"LCA", lca}, std::pair{"LCB", lcb}, std::pair{"LCAB", lcab}})
      if (id != 0) deck.warning(diagnostics, *this, field, "has no effect: FORM is not 14", "FORM = 14");
  check_liner(deck, diagnostics);
}

void MatFabric::check_liner(const Deck& deck, Diagnostics& diagnostics) const {
  if (lratio == 0) return;
  if (!(lratio < 1))
    deck.error(diagnostics, *this, "LRATIO", fmt::format("expected a number below 1, got '{:g}'", lratio),
               "the share of the liner in the thickness");
  if (!(el > 0))
    deck.error(diagnostics, *this, "EL", "a liner needs a modulus above 0", "Young's modulus of the liner");
  if (!(std::abs(prl) < 1))
    deck.error(diagnostics, *this, "PRL", fmt::format("expected a number below 1, got '{:g}'", prl),
               "Poisson's ratio of the liner");
}

void MatFabric::check_curves(const Deck& deck, const Model& model, Diagnostics& diagnostics) const {
  const auto rises = [&](const char* field, Id id) {
    const auto found = model.curves.find(std::abs(id));
    if (id == 0) return;
    if (found == model.curves.end()) {
      deck.error(diagnostics, *this, field, fmt::format("curve {} does not exist", std::abs(id)),
                 "define it with *DEFINE_CURVE");
      return;
    }
    const std::vector<Real>&x = found->second.abscissa, &y = found->second.ordinate;
    bool good = x.size() > 1 && x.front() == 0 && y.front() == 0;
    for (std::size_t k = 1; good && k < x.size(); ++k) good = x[k] > x[k - 1] && y[k] > y[k - 1];
    if (!good)
      deck.error(diagnostics, *this, field,
                 fmt::format("curve {} does not rise from (0, 0) in each of its pieces", std::abs(id)),
                 "true stress over logarithmic strain, both positive");
  };
  rises("LCA", lca), rises("LCB", lcb), rises("LCAB", lcab);
  rises("LCUA", lcua), rises("LCUB", lcub), rises("LCUAB", lcuab);
  for (const auto& [field, load, unload] :
       {std::tuple{"LCUA", lca, lcua}, std::tuple{"LCUB", lcb, lcub}, std::tuple{"LCUAB", lcab, lcuab}})
    if (unload != 0 && load == 0)
      deck.error(diagnostics, *this, field, "unloads from a curve that is not there",
                 "give the curve of loading, too");
}

using WF = MatFabric;

constexpr FieldRules of_airbags{.honour = Honour::ignored};
constexpr FieldRules at_least_0{.check = Check::not_negative};
constexpr FieldRules fibre_curve = rules::over(rules::optional_id_of(IdSpace::curve), "-", "M/LT2");
constexpr FieldRules signed_curve = rules::over(rules::id_of(IdSpace::curve), "-", "M/LT2");

// By hand. EA = 4, EB = 1, PRBA = 1/4: as of *MAT_ORTHOTROPIC_ELASTIC aa = 16/3, ab = bb = 4/3; GAB = 1. A
// liner of half the thickness, EL = 3, PRL = 1/2: aa = bb = 4, ab = 2, G = 1.
const RegisterStrength<WF> mat_fabric{
    "FORM 0: sigma = C e by the summed strains along a, b; CSE 1: the sigma without compression that is "
    "nearest "
    "to C e by the energy of their difference. FORM 14: sigma = s_a a a + s_b b b + tau (a b + b a), a, b "
    "the "
    "fibres as they lie now, s of ln l, tau of the angle lost, by curves. With a liner (1 - LRATIO) times "
    "that, and LRATIO times its own",
    "Hooke's law; tension fields: Pipkin 1986; fibres: Peng & Cao 2005",
    {{"1,2.0,4.0,1.0,,0.25\n1.0\n\n\n\n", {0.3, 0, 0, 0.1, 0, 0}, {}, {1.6, 0.4, 0, 0.2, 0, 0}},
     {"1,2.0,4.0,1.0,,0.25\n1.0,,,,3.0,0.5,0.5\n\n\n\n",
      {0.3, 0, 0, 0.1, 0, 0},
      {},
      {1.4, 0.5, 0, 0.2, 0, 0}}},
    {.names = {"MAT_FABRIC", "MAT_034"},
     .purpose = "fabric: sheets that bear no compression, with a liner, or two families of fibres by curves",
     .id_space = IdSpace::material,
     .title_option = true,
     .title = &WF::title,
     .many = false,
     .cards = {
         {.fields = {{"MID", &WF::mid, "-", "id that *PART refers to", rules::required_id},
                     {"RO", &WF::ro, "M/L3", "density", rules::required_positive},
                     {"EA", &WF::ea, "M/LT2", "Young's modulus along a", rules::required_positive},
                     {"EB", &WF::eb, "M/LT2", "along b; 0 with GAB 0: isotropic, EA and PRBA", at_least_0},
                     {},
                     {"PRBA", &WF::prba, "-", "strain along a over that along b of a stress along b"},
                     {"PRAB", &WF::prab, "-", "the other one, PRBA EA/EB"}}},
         {.fields = {{"GAB", &WF::gab, "M/LT2", "shear modulus, also across the sheet", at_least_0},
                     {},
                     {},
                     {"CSE", &WF::cse, "-", "compression: borne (0), not borne (1)"},
                     {"EL", &WF::el, "M/LT2", "Young's modulus of the liner", at_least_0},
                     {"PRL", &WF::prl, "-", "its Poisson ratio"},
                     {"LRATIO", &WF::lratio, "-", "its share of the thickness; 0: no liner", at_least_0},
                     {"DAMP", &WF::damp, "-", "viscous stress: left out, with a warning"}}},
         {.fields = {{"AOPT", &WF::aopt, "-", aopt_meaning},
                     {"FLC", &WF::flc, "-", "leakage of airbags, which are refused", of_airbags},
                     {"FAC", &WF::fac, "-", "the same, area", of_airbags},
                     {"ELA", &WF::ela, "-", "the same, blocked area", of_airbags},
                     {"LNRC", &WF::lnrc, "-", "no compression of the liner before a reference geometry",
                      unsupported},
                     {"FORM", &WF::form, "-", "0: linear; 14: fibres by curves"},
                     {"FVOPT", &WF::fvopt, "-", "venting of airbags", of_airbags},
                     {"TSRFAC", &WF::tsrfac, "-", "cut of tension", unsupported}}},
         {.fields = {{},
                     {"RGBRTH", &WF::rgbrth, "T", "birth of a reference geometry, which is refused",
                      no_effect},
                     {"A0REF", &WF::a0ref, "-", "area by which airbags leak", of_airbags},
                     {"A1", &WF::a1, "-", "direction a of AOPT 2, x", {.spatial = Spatial::direction}},
                     {"A2", &WF::a2, "-", "direction a, y"},
                     {"A3", &WF::a3, "-", "direction a, z"},
                     {"X0", &WF::x0, "-", "leakage of airbags", of_airbags},
                     {"X1", &WF::x1, "-", "leakage of airbags", of_airbags}}},
         {.fields = {{"V1", &WF::v1, "-", "direction v of AOPT 3, x", {.spatial = Spatial::direction}},
                     {"V2", &WF::v2, "-", "direction v, y"},
                     {"V3", &WF::v3, "-", "direction v, z"},
                     {},
                     {},
                     {},
                     {"BETA", &WF::beta, "-", "angle by which a is turned about the normal, degrees"},
                     {"ISREFG", &WF::isrefg, "-", "stress from a reference geometry", unsupported}}},
         {.fields = {{"LCA", &WF::lca, "-", "FORM 14: true stress over logarithmic strain of fibres a; 0: EA",
                      fibre_curve},
                     {"LCB", &WF::lcb, "-", "of fibres b; 0: EB", fibre_curve},
                     {"LCAB", &WF::lcab, "-", "of shear, over the angle between fibres that is lost; 0: GAB",
                      fibre_curve},
                     {"LCUA", &WF::lcua, "-",
                      "unloading of LCA, shifted to where loading ended, < 0 stretched; 0: along LCA",
                      signed_curve},
                     {"LCUB", &WF::lcub, "-", "of LCB", signed_curve},
                     {"LCUAB", &WF::lcuab, "-", "of LCAB", signed_curve},
                     {"RL", &WF::rl, "-", "reloading between the curves", unsupported}},
          .optional = true,
          .when = [](const WF& c) {
            return c.form == 4 || c.form == 14 || c.form == 24 || c.form == -14;
          }}}}};

}  // namespace

}  // namespace courant
