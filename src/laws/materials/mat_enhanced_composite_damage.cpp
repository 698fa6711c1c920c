// Plies of shells that fail by fibre and by matrix: *MAT_054 (Chang and Chang) and *MAT_055 (Tsai and Wu).
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "keyword/common_rules.hpp"
#include "laws/strength/material_axes.hpp"
#include "laws/strength/strength.hpp"
#include "parallel/parallel.hpp"

namespace courant {

namespace {

struct MatEnhancedCompositeDamage : DirectionsCard {
  std::string title;
  Id mid = 0;
  Real ro = 0, ea = 0, eb = 0, ec = 0, prba = 0, prca = 0, prcb = 0, gab = 0, gbc = 0, gca = 0, kf = 0;
  Real twoway = 0, ti = 0, mangle = 0, dfailm = 0, dfails = 0;
  Real tfail = 0, alph = 0, soft = 1, fbrt = 0, ycfac = 2, dfailt = 0, dfailc = 0, efs = 0;
  Real xc = 0, xt = 0, yc = 0, yt = 0, sc = 0, crit = 54, beta = 0;
  int pel = 0;
  Real epsf = 0, epsr = 0, tsmd = 0.9, soft2 = 1;
  Real slimt1 = 1, slimc1 = 1, slimt2 = 1, slimc2 = 1, slims = 1, ncyred = 0, softg = 1;
  Id lcxc = 0, lcxt = 0, lcyc = 0, lcyt = 0, lcsc = 0;
  Real dt = 0;

  bool has_rates() const { return (lcxc | lcxt | lcyc | lcyt | lcsc) != 0; }
  /// SOFT and SOFTG act where TFAIL deletes elements.
  bool tfail_is_time = false;  ///< told before it was converted
  /// TFAIL above 0.1 is a share of the first step.
  bool is_ratio(Real of) const { return of > 0.1 && !tfail_is_time; }
  bool softens() const { return tfail > 0 && (soft != 1 || softg != 1); }
  std::shared_ptr<StrengthLaw> law(const Model& model) const;
  void check(const Deck& deck, const Model& model, Diagnostics& diagnostics) const;

 private:
  void check_rates(const Deck& deck, const Model& model, Diagnostics& diagnostics) const;
};

using ED = MatEnhancedCompositeDamage;

enum FailureMode { fibre_tension = 1, fibre_compression = 2, matrix_tension = 4, matrix_compression = 8 };

/// In the order of the card's curves. [M/LT2]
struct Strengths {
  Real xc, xt, yc, yt, sc;
};

/// What a point keeps, in the order of history().
struct PlyState {
  Real &ea, &eb, &eab;                                               ///< strain [-]
  Real &a_tension, &a_compression, &b_tension, &b_compression, &ab;  ///< of failed modes: what is borne
  Real &modes, &failed, &beside;
  explicit PlyState(const PointBlock& block, Index i)
      : ea(block.history[0][i]),
        eb(block.history[1][i]),
        eab(block.history[2][i]),
        a_tension(block.history[3][i]),
        a_compression(block.history[4][i]),
        b_tension(block.history[5][i]),
        b_compression(block.history[6][i]),
        ab(block.history[7][i]),
        modes(block.history[8][i]),
        failed(block.history[9][i]),
        beside(block.history[10][i]) {}
  bool has(int mode) const { return (static_cast<int>(modes) & mode) != 0; }
  void add(int mode) { modes += has(mode) ? 0 : mode; }
};

/// Of linear + quadratic criterion A s^2 + B s = 1 along a ray of stress: where on it the point fails, at
/// most 1.
Real reach_of_ray(Real A, Real B) {
  return A + B > 1 ? 2 / (B + std::sqrt(B * B + 4 * A)) : 1;
}

class ChangChang : public StrengthLaw {
 public:
  ChangChang(const ED& card, const MaterialAxes& axes, std::array<Curve, 5> over_rate)
      : card_(card), axes_(axes), sheet_(card.ea, card.eb, card.prba), over_rate_(std::move(over_rate)) {
    ro = card.ro;
  }
  std::vector<HistoryVariable> history() const override {
    std::vector<HistoryVariable> out = {{"ply_strain_a", "-"},
                                        {"ply_strain_b", "-"},
                                        {"ply_strain_ab", "-"},
                                        {"borne_a_tension", "M/LT2"},
                                        {"borne_a_compression", "M/LT2"},
                                        {"borne_b_tension", "M/LT2"},
                                        {"borne_b_compression", "M/LT2"},
                                        {"borne_ab", "M/LT2"},
                                        {"failed_modes", "-"},
                                        {"failed_ply", "-"},
                                        {beside_deleted, "-"}};
    if (card_.has_rates()) out.push_back({"ply_rate", "1/T"});
    return out;
  }
  /// As if it were isotropic with Young's modulus EB across the fibres: what contact asks for.
  Real bulk_modulus() const override { return card_.eb / (3 * (1 - 2 * 0.3)); }
  Real shear_modulus() const override { return std::max({card_.gab, card_.gbc, card_.gca}); }
  const MaterialAxes* axes() const override { return &axes_; }
  Real plane_modulus() const override { return sheet_.largest(card_.gab); }
  Real failure_limit() const override { return 1; }
  std::string failure_variable() const override { return "failed_ply"; }
  LeastStep least_step() const override {
    return card_.is_ratio(card_.tfail) ? LeastStep{0, card_.tfail}
                                       : LeastStep{std::max(card_.tfail, Real(0)), 0};
  }

  /// Only sheets have it: the stress stays plane.
  void update(const PointBlock& block) const override {
    std::array<Real, block_size> rate_zz;
    update_in_plane_stress(block, rate_zz.data());
  }
  void update_in_plane_stress(const PointBlock& block, Real* rate_zz) const override {
    for (Index i = 0; i < block.count; ++i) {
      PlyState ply(block, i);
      const Real da = block.dt * block.rate[0][i], db = block.dt * block.rate[1][i],
                 dab = block.dt * block.rate[3][i];
      ply.ea += da, ply.eb += db, ply.eab += dab;
      const bool soft = ply.beside > 0 && card_.softens();
      const Strengths at = strengths(block, i, soft, da, db, dab);
      const Real across = soft ? card_.softg : 1;
      Sheet s{block.stress[0][i], block.stress[1][i], block.stress[3][i]};
      const Sheet before = s;
      advance(da, db, dab, ply, s);
      if (block.dt > 0) fail(ply, at, s);
      Real yz = block.stress[4][i] + 2 * across * card_.gbc * block.dt * block.rate[4][i],
           zx = block.stress[5][i] + 2 * across * card_.gca * block.dt * block.rate[5][i];
      if (ply.failed > 0) s = {0, 0, 0}, yz = zx = 0;
      block.stress[0][i] = s.a, block.stress[1][i] = s.b, block.stress[2][i] = 0;
      block.stress[3][i] = s.ab, block.stress[4][i] = yz, block.stress[5][i] = zx;
      rate_zz[i] = block.dt > 0 ? thinning(s, before) / block.dt : 0;
    }
    keep_stiffness(block, std::sqrt(sheet_.largest(card_.gab) / ro));
  }

 private:
  struct Sheet {
    Real a, b, ab;
  };

  /// Those of the card, or over the mean rate; a share of them beside deleted elements.
  Strengths strengths(const PointBlock& block, Index i, bool soft, Real da, Real db, Real dab) const {
    Strengths out{card_.xc, card_.xt, card_.yc, card_.yt, card_.sc};
    if (card_.has_rates() && block.dt > 0) {
      Real& mean = block.history[11][i];
      const Real now = std::sqrt(4.0 / 3 * (da * da + db * db + da * db + dab * dab)) / block.dt;
      constexpr Real steps = 11;  // of the mean where DT does not tell its time
      const Real weight = card_.dt > 0 ? 1 - std::exp(-block.dt / card_.dt) : 2 / (steps + 1);
      mean += weight * (now - mean);
    }
    if (card_.has_rates()) {
      Real* const to[] = {&out.xc, &out.xt, &out.yc, &out.yt, &out.sc};
      for (std::size_t k = 0; k < over_rate_.size(); ++k)
        if (!over_rate_[k].abscissa.empty()) *to[k] = over_rate_[k](block.history[11][i]);
    }
    if (soft)
      for (Real* strength : {&out.xc, &out.xt, &out.yc, &out.yt, &out.sc}) *strength *= card_.soft;
    return out;
  }

  Real thinning(const Sheet& s, const Sheet& before) const {
    return card_.ec > 0 ? -(card_.prca * (s.a - before.a) + card_.prcb * (s.b - before.b)) / card_.ec : 0;
  }

  /// Elastic; where a mode has failed without Poisson's ratio, and no more than it bears.
  void advance(Real da, Real db, Real dab, const PlyState& ply, Sheet& s) const {
    if (ply.modes == 0)
      s.a += sheet_.aa * da + sheet_.ab * db, s.b += sheet_.ab * da + sheet_.bb * db;
    else
      s.a += card_.ea * da, s.b += card_.eb * db;
    s.ab = sheared(s.ab, 2 * dab);
    limit(ply, s);
  }

  /// gamma = tau/GAB + ALPH tau^3, from one tau to that of a gamma more, by Newton's method.
  Real sheared(Real tau, Real more) const {
    if (card_.alph == 0) return tau + card_.gab * more;
    const Real gamma = tau / card_.gab + card_.alph * tau * tau * tau + more;
    constexpr int most_steps = 50;
    Real t = std::abs(gamma) * card_.gab;  // above the root: the method falls onto it
    for (int k = 0; k < most_steps; ++k) {
      const Real f = t / card_.gab + card_.alph * t * t * t - std::abs(gamma);
      const Real step = f / (1 / card_.gab + 3 * card_.alph * t * t);
      t -= step;
      if (!(step > 1e-14 * t)) break;
    }
    return std::copysign(t, gamma);
  }

  static void limit(const PlyState& ply, Sheet& s) {
    if (ply.has(fibre_tension)) s.a = std::min(s.a, ply.a_tension);
    if (ply.has(fibre_compression)) s.a = std::max(s.a, -ply.a_compression);
    if (ply.has(fibre_tension | matrix_tension)) s.b = std::min(s.b, ply.b_tension);
    if (ply.has(fibre_tension | matrix_compression)) s.b = std::max(s.b, -ply.b_compression);
    if (ply.has(fibre_tension | matrix_tension | matrix_compression))
      s.ab = std::clamp(s.ab, -ply.ab, ply.ab);
  }

  void fail(PlyState& ply, const Strengths& at, Sheet& s) const {
    const Real of_shear = s.ab * s.ab / (at.sc * at.sc);
    const bool crushed = ply.has(matrix_compression);
    const Real XT = crushed && card_.fbrt > 0 ? card_.fbrt * at.xt : at.xt,
               XC = crushed ? std::min(at.xc, card_.ycfac * at.yc) : at.xc;
    if (s.a > 0 && !ply.has(fibre_tension)) {
      const Real f = reach_of_ray(s.a * s.a / (XT * XT) + card_.beta * of_shear, 0);
      if (f < 1) fail_fibre_tension(f, ply, s);
    } else if (s.a < 0 && !ply.has(fibre_compression) && -s.a > XC) {
      ply.add(fibre_compression);
      ply.a_compression = card_.slimc1 * XC;
    }
    const int mode = s.b >= 0 ? matrix_tension : matrix_compression;
    if (!ply.has(mode | fibre_tension)) {
      const Real f = matrix_reach(at, s);
      if (f < 1) fail_matrix(mode, f, ply, s);
    }
    limit(ply, s);
    const Real e =
        std::sqrt(4.0 / 3 * (ply.ea * ply.ea + ply.eb * ply.eb + ply.ea * ply.eb + ply.eab * ply.eab));
    const bool torn =
        card_.dfailt > 0 && (ply.ea > card_.dfailt || (card_.dfailc < 0 && ply.ea < card_.dfailc) ||
                             (card_.dfailm > 0 && std::abs(ply.eb) > card_.dfailm) ||
                             (card_.dfails > 0 && std::abs(ply.eab) > card_.dfails));
    if (torn || (card_.efs > 0 && e > card_.efs)) ply.failed = 1;
  }

  void fail_fibre_tension(Real f, PlyState& ply, Sheet& s) const {
    ply.add(fibre_tension);
    if (card_.dfailt == 0) ply.failed = 1;
    s.a *= f;
    if (card_.beta > 0) s.ab *= f;
    ply.a_tension = card_.slimt1 * s.a;
    hold_shear(std::abs(s.ab), ply);  // the fibres carry the matrix: nothing bears more from now on
    ply.b_tension = std::max(s.b, Real(0)), ply.b_compression = std::max(-s.b, Real(0));
  }

  void fail_matrix(int mode, Real f, PlyState& ply, Sheet& s) const {
    s.b *= f, s.ab *= f;
    hold_shear(card_.slims * std::abs(s.ab), ply);
    ply.add(mode);
    (mode == matrix_tension ? ply.b_tension : ply.b_compression) =
        (mode == matrix_tension ? card_.slimt2 : card_.slimc2) * std::abs(s.b);
  }

  static void hold_shear(Real tau, PlyState& ply) {
    const bool held = ply.has(fibre_tension | matrix_tension | matrix_compression) && ply.ab > 0;
    ply.ab = held ? std::min(ply.ab, tau) : tau;
  }

  /// Where on the ray to this stress the matrix fails, at most 1.
  Real matrix_reach(const Strengths& at, const Sheet& s) const {
    const Real shear = s.ab / at.sc, yc = at.yc, yt = at.yt;
    if (card_.crit == 55)
      return reach_of_ray(s.b * s.b / (yc * yt) + shear * shear, (yc - yt) * s.b / (yc * yt));
    if (s.b >= 0) return reach_of_ray(s.b * s.b / (yt * yt) + shear * shear, 0);
    const Real twice = 2 * at.sc;
    return reach_of_ray(s.b * s.b / (twice * twice) + shear * shear,
                        (yc * yc / (twice * twice) - 1) * s.b / yc);
  }

  ED card_;
  MaterialAxes axes_;
  SheetStiffness sheet_;
  std::array<Curve, 5> over_rate_;  ///< without points: there is none
};

std::shared_ptr<StrengthLaw> ED::law(const Model& model) const {
  std::array<Curve, 5> over_rate;
  const Id ids[] = {lcxc, lcxt, lcyc, lcyt, lcsc};
  for (std::size_t k = 0; k < over_rate.size(); ++k)
    if (const auto found = model.curves.find(ids[k]); found != model.curves.end())
      over_rate[k] = found->second;
  return std::make_shared<ChangChang>(*this, axes(model, mangle), std::move(over_rate));
}

/// Curves over the rate, which have a strength above 0 everywhere.
void ED::check_rates(const Deck& deck, const Model& model, Diagnostics& diagnostics) const {
  for (const auto& [field, id] : {std::pair{"LCXC", lcxc}, std::pair{"LCXT", lcxt}, std::pair{"LCYC", lcyc},
                                  std::pair{"LCYT", lcyt}, std::pair{"LCSC", lcsc}}) {
    if (id == 0) continue;
    const auto found = model.curves.find(id);
    if (found == model.curves.end()) {
      deck.error(diagnostics, *this, field, fmt::format("curve {} does not exist", id),
                 "define it with *DEFINE_CURVE");
      continue;
    }
    const std::vector<Real>& values = found->second.ordinate;
    if (std::any_of(values.begin(), values.end(), [](Real value) { return !(value > 0); }))
      deck.error(diagnostics, *this, field, fmt::format("curve {} has strengths that are not above 0", id),
                 "give the strength over the rate of effective strain");
  }
  if (dt != 0 && !has_rates())
    deck.warning(diagnostics, *this, "DT", "has no effect: no strength depends on the rate",
                 "give LCXC and its like, or leave it blank");
}

void ED::check(const Deck& deck, const Model& model, Diagnostics& diagnostics) const {
  check_axes(deck, model, diagnostics);
  const auto refuse = [&](const char* field, bool wrong, Real value, const char* why, const char* hint) {
    if (wrong)
      deck.error(diagnostics, *this, field, fmt::format("'{:g}' is not supported: {}", value, why), hint);
  };
  if (!(prba * prba * ea < eb))
    deck.error(diagnostics, *this, "PRBA",
               "the material would give energy away: its stiffness is not positive definite",
               "PRBA^2 < EB/EA");
  refuse("CRIT", crit != 54 && crit != 55, crit, "the matrix fails by Chang and Chang or by Tsai and Wu",
         "54 or 55");
  for (const auto& [field, value] : {std::pair{"SOFT", soft}, std::pair{"SOFTG", softg}}) {
    refuse(field, !(value > 0 && value <= 1), value, "it is a fraction of the value on the card",
           "above 0, and 1 at most");
    if (value != 1 && !(tfail > 0))
      deck.warning(
          diagnostics, *this, field,
          fmt::format("'{:g}' has no effect: it acts beside deleted elements where TFAIL > 0", value),
          "give TFAIL");
  }
  check_rates(deck, model, diagnostics);
  refuse("SOFT2", soft2 != 1, soft2, "stiffness does not fall beside deleted elements",
         "leave the field blank");
  for (const auto& [field, value] :
       {std::pair{"SLIMT1", slimt1}, std::pair{"SLIMC1", slimc1}, std::pair{"SLIMT2", slimt2},
        std::pair{"SLIMC2", slimc2}, std::pair{"SLIMS", slims}})
    refuse(field, value > 1, value, "more than the strength cannot be left", "0 to 1");
  const bool falls = std::min({slimt1, slimc1, slimt2, slimc2, slims}) < 1;
  refuse("NCYRED", falls && ncyred > 1, ncyred, "stress falls to SLIM of the strength at once", "1");
  if (dfailt == 0)
    for (const auto& [field, value] :
         {std::pair{"DFAILM", dfailm}, std::pair{"DFAILS", dfails}, std::pair{"DFAILC", dfailc}})
      if (value != 0)
        deck.warning(
            diagnostics, *this, field,
            fmt::format("'{:g}' has no effect: strains take plies away only where DFAILT > 0", value),
            "give DFAILT, or EFS");
}

std::string convert_least_step(ED& card, const Conversion& conversion) {
  if (card.is_ratio(card.tfail) || card.tfail <= 0) return "";
  card.tfail *= conversion.units.of("T"), card.tfail_is_time = true;
  return "";
}

// By hand. EA = 4, EB = 1, PRBA = 1/4: C aa = 16/3, C ab = C bb = 4/3. Strain 0.3 along a: stress a 1.6, b
// 0.4. XT = 0.8: the fibre fails, and without DFAILT the ply. Strain 0.3 along b: a 0.4, b 0.4; YT = 0.2: b
// stays 0.2.
constexpr const char* stiff_ply = "1,2.0,4.0,1.0,,0.25\n1.0,2.0,3.0\n\n\n";
constexpr FieldRules curve_over_rate =
    rules::over({.check = Check::not_negative, .refers = IdSpace::curve}, "1/T", "M/LT2");
const RegisterStrength<ED> mat_enhanced_composite_damage{
    "elastic by the directions of a sheet, 2 D ab = d(tau/GAB + ALPH tau^3)/dt, until fibres fail, "
    "(s_a/XT)^2 + "
    "BETA (tau/SC)^2 = 1 or s_a = -XC, or the matrix: (s_b/YT)^2 + (tau/SC)^2 = 1 for s_b >= 0, (s_b/(2 "
    "SC))^2 "
    "+ ((YC/(2 SC))^2 - 1) s_b/YC + (tau/SC)^2 = 1 below; 55: s_b^2/(YC YT) + (tau/SC)^2 + (YC - YT) s_b/(YC "
    "YT) = 1",
    "Chang & Chang 1987; Tsai & Wu 1971",
    {{std::string(stiff_ply) + "\n9.0,9.0,9.0,9.0,9.0\n",
      {0.3, 0, 0, 0.1, 0.2, 0.3},
      {0, 0, 0, 0, 0, 0},
      {1.6, 0.4, 0, 0.2, 0.8, 1.8}},
     {std::string(stiff_ply) + "\n9.0,0.8,9.0,9.0,9.0\n", {0.3, 0, 0, 0.1, 0.2, 0.3}, {}, {0, 0, 0, 0, 0, 0}},
     {std::string(stiff_ply) + "\n9.0,9.0,9.0,0.2,9.0\n", {0, 0.3, 0, 0, 0, 0}, {}, {0.4, 0.2, 0, 0, 0, 0}},
     {std::string(stiff_ply) + "\n9.0,9.0,9.0,9.0,0.4\n", {0, 0, 0, 0.3, 0, 0}, {}, {0, 0, 0, 0.4, 0, 0}}},
    {.names = {"MAT_ENHANCED_COMPOSITE_DAMAGE", "MAT_054", "MAT_055", "MAT_054/055"},
     .purpose = "plies of shells that are elastic until fibre or matrix fail",
     .id_space = IdSpace::material,
     .title_option = true,
     .title = &ED::title,
     .cards =
         {{.fields =
               {{"MID", &ED::mid, "-", "id that *PART refers to", rules::required_id},
                {"RO", &ED::ro, "M/L3", "density", rules::required_positive},
                {"EA", &ED::ea, "M/LT2", "Young's modulus along a, the fibres", rules::required_positive},
                {"EB", &ED::eb, "M/LT2", "along b", rules::required_positive},
                {"EC", &ED::ec, "M/LT2", "along c; 0: the thickness stays", {.check = Check::not_negative}},
                {"PRBA", &ED::prba, "-", "strain along a over that along b of a stress along b"},
                {"PRCA", &ED::prca, "-", "of a and c, with EC for the thickness alone"},
                {"PRCB", &ED::prcb, "-", "of b and c, the same"}}},
          {.fields = {{"GAB", &ED::gab, "M/LT2", "shear modulus in the plane", rules::required_positive},
                      {"GBC", &ED::gbc, "M/LT2", "across it along b", rules::required_positive},
                      {"GCA", &ED::gca, "M/LT2", "across it along a", rules::required_positive},
                      {"KF", &ED::kf, "M/LT2", "bulk modulus of failed material", no_effect},
                      {"AOPT", &ED::aopt, "-", aopt_meaning},
                      {"2WAY", &ED::twoway, "-", "two directions of fibres", unsupported},
                      {"TI", &ED::ti, "-", "transversely isotropic solids", unsupported}}},
          {.fields = with_fields<ED>(
               fields_of_a<ED>(),
               {{"MANGLE", &ED::mangle, "-", "angle by which a is turned about the normal, degrees"}})},
          {.fields =
               with_fields<ED>(fields_of_v<ED>(), {{"DFAILM",
                                                    &ED::dfailm,
                                                    "-",
                                                    "strain along b at which a ply fails, where DFAILT > 0",
                                                    {.check = Check::not_negative}},
                                                   {"DFAILS",
                                                    &ED::dfails,
                                                    "-",
                                                    "the same of shear (of the tensor)",
                                                    {.check = Check::not_negative}}})},
          {.fields = {{"TFAIL", &ED::tfail, "-",
                       "elements go whose step is below it, above 0.1 its share of the first one; 0: none"},
                      {"ALPH",
                       &ED::alph,
                       "L3T6/M3",
                       "of the cube of the shear stress",
                       {.check = Check::not_negative}},
                      {"SOFT", &ED::soft, "-", "share of strengths beside deleted elements", {.standard = 1}},
                      {"FBRT",
                       &ED::fbrt,
                       "-",
                       "factor of XT behind failure of the matrix in compression; 0: none",
                       {.check = Check::not_negative}},
                      {"YCFAC",
                       &ED::ycfac,
                       "-",
                       "XC is at most YCFAC YC behind that",
                       {.standard = 2, .check = Check::positive}},
                      {"DFAILT",
                       &ED::dfailt,
                       "-",
                       "strain along the fibres at which a ply fails; 0: where the fibres fail in tension",
                       {.check = Check::not_negative}},
                      {"DFAILC",
                       &ED::dfailc,
                       "-",
                       "the same in compression, where DFAILT > 0",
                       {.check = Check::not_positive}},
                      {"EFS",
                       &ED::efs,
                       "-",
                       "effective strain at which a ply fails; 0: never",
                       {.check = Check::not_negative}}}},
          {.fields =
               {{"XC", &ED::xc, "M/LT2", "strength along a in compression", rules::required_positive},
                {"XT", &ED::xt, "M/LT2", "in tension", rules::required_positive},
                {"YC", &ED::yc, "M/LT2", "along b in compression", rules::required_positive},
                {"YT", &ED::yt, "M/LT2", "in tension", rules::required_positive},
                {"SC", &ED::sc, "M/LT2", "in shear", rules::required_positive},
                {"CRIT", &ED::crit, "-", "matrix: 54 Chang and Chang, 55 Tsai and Wu", {.standard = 54}},
                {"BETA",
                 &ED::beta,
                 "-",
                 "weight of shear for the fibres in tension",
                 {.check = Check::not_negative}}}},
          {.fields = {{"PEL",
                       &ED::pel,
                       "-",
                       "per cent of layers that must fail before SOFT applies, 100 for 0",
                       {.allowed = {0, 100}}},
                      {"EPSF", &ED::epsf, "-", "shear across at which damage begins", unsupported},
                      {"EPSR", &ED::epsr, "-", "at which it ends", unsupported},
                      {"TSMD", &ED::tsmd, "-", "its largest", no_effect_but(0.9)},
                      {"SOFT2", &ED::soft2, "-", "stiffness beside deleted elements", {.standard = 1}}},
           .optional = true},
          {.fields =
               {{"SLIMT1",
                 &ED::slimt1,
                 "-",
                 "left of the strength of fibres in tension",
                 {.standard = 1, .check = Check::not_negative}},
                {"SLIMC1",
                 &ED::slimc1,
                 "-",
                 "of fibres in compression",
                 {.standard = 1, .check = Check::not_negative}},
                {"SLIMT2",
                 &ED::slimt2,
                 "-",
                 "of the matrix in tension",
                 {.standard = 1, .check = Check::not_negative}},
                {"SLIMC2",
                 &ED::slimc2,
                 "-",
                 "of the matrix in compression",
                 {.standard = 1, .check = Check::not_negative}},
                {"SLIMS", &ED::slims, "-", "of shear", {.standard = 1, .check = Check::not_negative}},
                {"NCYRED", &ED::ncyred, "-", "steps in which stress falls to it", no_effect},
                {"SOFTG", &ED::softg, "-", "share of GBC and GCA beside deleted elements", {.standard = 1}}},
           .optional = true},
          {.fields = {{"LCXC", &ED::lcxc, "-", "XC over the rate of effective strain", curve_over_rate},
                      {"LCXT", &ED::lcxt, "-", "XT over the rate of effective strain", curve_over_rate},
                      {"LCYC", &ED::lcyc, "-", "YC over the rate of effective strain", curve_over_rate},
                      {"LCYT", &ED::lcyt, "-", "YT over the rate of effective strain", curve_over_rate},
                      {"LCSC", &ED::lcsc, "-", "SC over the rate of effective strain", curve_over_rate},
                      {"DT", &ED::dt, "T", "over which the rate is averaged; 0 and less: over 11 steps"}},
           .optional = true}},
     .convert = convert_least_step}};

}  // namespace

}  // namespace courant
