// Layers of shells whose stiffness falls by damage of fibres, matrix and shear: *MAT_058.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "keyword/common_rules.hpp"
#include "laws/strength/material_axes.hpp"
#include "laws/strength/strength.hpp"
#include "parallel/parallel.hpp"

namespace courant {

namespace {

struct MatLaminatedCompositeFabric : DirectionsCard {
  std::string title;
  Id mid = 0;
  Real ro = 0, ea = 0, eb = 0, ec = 0, prba = 0, prca = 0, prcb = 0, gab = 0, gbc = 0, gca = 0;
  Real tau1 = 0, gamma1 = 0, slimt1 = 0, slimc1 = 0, slimt2 = 0, slimc2 = 0, slims = 0;
  Real tsize = 0, erods = 0, soft = 1, fs = 0, epsf = 0, epsr = 0, tsmd = 0.9, beta = 0;
  Id lcdfail = 0;
  Real e11c = 0, e11t = 0, e22c = 0, e22t = 0, gms = 0, xc = 0, xt = 0, yc = 0, yt = 0, sc = 0;
  Id lcxc = 0, lcxt = 0, lcyc = 0, lcyt = 0, lcsc = 0, lctau = 0, lcgam = 0;
  Real dt = 0;
  Id lce11c = 0, lce11t = 0, lce22c = 0, lce22t = 0, lcgms = 0, lcefs = 0;

  /// FS -1 with a first branch of the curve of shear.
  bool two_branches() const { return fs == -1 && tau1 > 0; }
  std::shared_ptr<StrengthLaw> law(const Model& model) const;
  void check(const Deck& deck, const Model& model, Diagnostics& diagnostics) const;
};

using LF = MatLaminatedCompositeFabric;

/// How stiffness in one direction falls with r, the strain over that at which it would break if it were
/// elastic: 1 - w = exp(-r^m/(m e)). Stress (1 - w) r is largest, 1, at r = e^(1/m); behind that it stays
/// above `limit`.
struct Softening {
  Real break_strain = 1;  ///< X/E [-]
  Real m = 0;             ///< infinity: none until r = 1
  Real peak = 1;          ///< r of the largest stress
  Real limit = 0;         ///< SLIM

  Softening(Real strength, Real stiffness, Real strain_at_strength, Real left)
      : break_strain(strength / stiffness),
        peak(std::max<Real>(strain_at_strength / break_strain, 1)),
        limit(left) {
    m = peak > least_peak ? 1 / std::log(peak) : std::numeric_limits<Real>::infinity();
  }
  Real left(Real r) const {
    if (!(r > 0)) return 1;
    const Real share = std::isinf(m) ? (r > peak ? 0 : 1) : std::exp(-std::pow(r, m) / (m * std::exp(1.0)));
    return r > peak ? std::max(share, limit / r) : share;
  }
  static constexpr Real least_peak = 1 + 1e-6;
};

/// What a point keeps, in the order of history().
struct FabricState {
  Real &ea, &eb, &ec, &eab, &ebc, &eca;                                       ///< strain, of the tensor [-]
  Real &a_tension, &a_compression, &b_tension, &b_compression, &ab, &across;  ///< largest r so far [-]
  Real &failed, &beside;
  explicit FabricState(const PointBlock& block, Index i)
      : ea(block.history[0][i]),
        eb(block.history[1][i]),
        ec(block.history[2][i]),
        eab(block.history[3][i]),
        ebc(block.history[4][i]),
        eca(block.history[5][i]),
        a_tension(block.history[6][i]),
        a_compression(block.history[7][i]),
        b_tension(block.history[8][i]),
        b_compression(block.history[9][i]),
        ab(block.history[10][i]),
        across(block.history[11][i]),
        failed(block.history[12][i]),
        beside(block.history[13][i]) {}
};

class Fabric : public StrengthLaw {
 public:
  Fabric(const LF& card, const MaterialAxes& axes)
      : card_(card),
        axes_(axes),
        sheet_(card.ea, card.eb, card.prba),
        poisson2_(card.prba * card.prba * card.ea / card.eb),
        at_(card, 1),
        soft_(card, card.soft) {
    ro = card.ro;
  }
  std::vector<HistoryVariable> history() const override {
    return {{"fabric_strain_a", "-"},       {"fabric_strain_b", "-"},       {"fabric_strain_c", "-"},
            {"fabric_strain_ab", "-"},      {"fabric_strain_bc", "-"},      {"fabric_strain_ca", "-"},
            {"largest_a_tension", "-"},     {"largest_a_compression", "-"}, {"largest_b_tension", "-"},
            {"largest_b_compression", "-"}, {"largest_shear", "-"},         {"largest_shear_across", "-"},
            {"failed_layer", "-"},          {beside_deleted, "-"}};
  }
  /// As if it were isotropic with Young's modulus EB: what contact asks for.
  Real bulk_modulus() const override { return card_.eb / (3 * (1 - 2 * 0.3)); }
  Real shear_modulus() const override { return std::max({card_.gab, card_.gbc, card_.gca}); }
  const MaterialAxes* axes() const override { return &axes_; }
  Real plane_modulus() const override { return sheet_.largest(card_.gab); }
  Real failure_limit() const override { return card_.erods != 0 ? 1 : std::numeric_limits<Real>::infinity(); }
  std::string failure_variable() const override { return "failed_layer"; }
  LeastStep least_step() const override { return {card_.tsize, 0}; }

  /// Only sheets have it: the stress stays plane.
  void update(const PointBlock& block) const override {
    std::array<Real, block_size> rate_zz;
    update_in_plane_stress(block, rate_zz.data());
  }
  void update_in_plane_stress(const PointBlock& block, Real* rate_zz) const override {
    for (Index i = 0; i < block.count; ++i) {
      FabricState state(block, i);
      Real* const strain[] = {&state.ea, &state.eb, nullptr, &state.eab, &state.ebc, &state.eca};
      for (std::size_t k = 0; k < 6; ++k)
        if (strain[k]) *strain[k] += block.dt * block.rate[k][i];
      const Real a = block.stress[0][i], b = block.stress[1][i];
      const auto s = stress_of(state);
      for (std::size_t k = 0; k < 6; ++k) block.stress[k][i] = s[k];
      const Real thinning =
          card_.ec > 0 ? -(card_.prca * (s[0] - a) + card_.prcb * (s[1] - b)) / card_.ec : 0;
      state.ec += thinning;
      if (card_.erods != 0 && effective_strain(state) > std::abs(card_.erods)) state.failed = 1;
      if (state.failed > 0)
        for (std::size_t k = 0; k < 6; ++k) block.stress[k][i] = 0;
      rate_zz[i] = block.dt > 0 ? thinning / block.dt : 0;
    }
    keep_stiffness(block, std::sqrt(sheet_.largest(card_.gab) / ro));
  }

 private:
  /// The five curves, of full strength or of that beside deleted elements.
  struct Curves {
    Softening a_tension, a_compression, b_tension, b_compression, shear;
    Curves(const LF& c, Real share)
        : a_tension(share * c.xt, c.ea, c.e11t, c.slimt1),
          a_compression(share * c.xc, c.ea, c.e11c, c.slimc1),
          b_tension(share * c.yt, c.eb, c.e22t, c.slimt2),
          b_compression(share * c.yc, c.eb, c.e22c, c.slimc2),
          shear(share * (c.two_branches() ? c.tau1 : c.sc), c.gab, c.two_branches() ? c.gamma1 : c.gms,
                c.two_branches() ? 0 : c.slims) {}
  };

  /// By total strain and the damage of the largest so far.
  std::array<Real, 6> stress_of(FabricState& s) const {
    if (s.beside == 1) {  // from now on strains are measured by the lower strengths
      for (Real* r : {&s.a_tension, &s.a_compression, &s.b_tension, &s.b_compression, &s.ab})
        *r /= card_.soft;
      s.beside = 2;
    }
    const Curves& at = s.beside > 0 ? soft_ : at_;
    load(at, s);
    const Real wa = (s.ea >= 0 ? at.a_tension.left(s.a_tension) : at.a_compression.left(s.a_compression)),
               wb = (s.eb >= 0 ? at.b_tension.left(s.b_tension) : at.b_compression.left(s.b_compression));
    const Real f = 1 / (1 - wa * wb * poisson2_);
    const Real across = wa * wb * card_.prba * card_.ea * f;
    const Real tear = across_left(s);
    return {wa * card_.ea * f * s.ea + across * s.eb,
            across * s.ea + wb * card_.eb * f * s.eb,
            0,
            shear_left(at, s) * card_.gab * 2 * s.eab,
            tear * card_.gbc * 2 * s.ebc,
            tear * card_.gca * 2 * s.eca};
  }

  /// The largest r so far. FS states which surface shear belongs to besides its own.
  void load(const Curves& at, FabricState& s) const {
    const Real shear = std::abs(2 * s.eab) / at.shear.break_strain;
    const Real with_a = card_.fs == 1 ? shear : 0, with_b = card_.fs >= 0 ? shear : 0;
    const auto grow = [](Real& largest, Real strain, const Softening& curve, Real with) {
      const Real r = std::hypot(std::max(strain, Real(0)) / curve.break_strain, with);
      largest = std::max(largest, r);
      return r;
    };
    const Real of_a = std::max(grow(s.a_tension, s.ea, at.a_tension, with_a),
                               grow(s.a_compression, -s.ea, at.a_compression, with_a));
    const Real of_b = std::max(grow(s.b_tension, s.eb, at.b_tension, with_b),
                               grow(s.b_compression, -s.eb, at.b_compression, with_b));
    s.ab = std::max({s.ab, shear, card_.fs == 1 ? of_a : 0, card_.fs >= 0 ? of_b : 0});
    s.across = std::max(s.across, 2 * std::hypot(s.ebc, s.eca));
  }

  /// With TAU1 and GAMMA1 the first branch ends there, and a straight one goes to SC at GMS.
  Real shear_left(const Curves& at, const FabricState& s) const {
    const Real r = s.ab;
    if (!card_.two_branches() || r <= at.shear.peak) return at.shear.left(r);
    const Real share = s.beside > 0 ? card_.soft : 1, gamma = r * at.shear.break_strain;
    const Real most = card_.tau1 + (card_.sc - card_.tau1) *
                                       std::min<Real>((gamma - card_.gamma1) / (card_.gms - card_.gamma1), 1);
    return share * (gamma > card_.gms ? card_.slims * card_.sc : most) / (card_.gab * gamma);
  }
  Real across_left(const FabricState& s) const {
    if (card_.epsf == 0 || s.across <= card_.epsf) return 1;
    return 1 - card_.tsmd * std::min<Real>((s.across - card_.epsf) / (card_.epsr - card_.epsf), 1);
  }
  /// ERODS > 0: as if the volume were kept, of strains in the plane; < 0: of all.
  Real effective_strain(const FabricState& s) const {
    if (card_.erods > 0)
      return std::sqrt(4.0 / 3 * (s.ea * s.ea + s.eb * s.eb + s.ea * s.eb + s.eab * s.eab));
    const Real mean = (s.ea + s.eb + s.ec) / 3;
    const Real a = s.ea - mean, b = s.eb - mean, c = s.ec - mean;
    return std::sqrt(2.0 / 3 * (a * a + b * b + c * c + 2 * (s.eab * s.eab + s.ebc * s.ebc + s.eca * s.eca)));
  }

  LF card_;
  MaterialAxes axes_;
  SheetStiffness sheet_;
  Real poisson2_;  ///< nu ab nu ba
  Curves at_, soft_;
};

std::shared_ptr<StrengthLaw> LF::law(const Model& model) const {
  return std::make_shared<Fabric>(*this, axes(model, beta));
}

void LF::check(const Deck& deck, const Model& model, Diagnostics& diagnostics) const {
  check_axes(deck, model, diagnostics);
  const auto refuse = [&](const char* field, bool wrong, Real value, const char* why, const char* hint) {
    if (wrong)
      deck.error(diagnostics, *this, field, fmt::format("'{:g}' is not supported: {}", value, why), hint);
  };
  if (!(prba * prba * ea < eb))
    deck.error(diagnostics, *this, "PRBA",
               "the material would give energy away: its stiffness is not positive definite",
               "PRBA^2 < EB/EA");
  refuse("FS", fs != 0 && fs != 1 && fs != -1, fs, "surfaces of damage are 0, 1 and -1", "0, 1 or -1");
  for (const auto& [field, value] :
       {std::pair{"SLIMT1", slimt1}, std::pair{"SLIMC1", slimc1}, std::pair{"SLIMT2", slimt2},
        std::pair{"SLIMC2", slimc2}, std::pair{"SLIMS", slims}})
    refuse(field, value > 1, value, "more than the strength cannot be left", "0 to 1");
  refuse("TSMD", tsmd > 1, tsmd, "more than all of the stiffness cannot go", "0 to 1");
  refuse("EPSR", epsf > 0 && !(epsr > epsf), epsr, "damage across ends before it begins", "EPSR > EPSF");
  refuse("SOFT", !(soft > 0 && soft <= 1), soft, "strength beside deleted elements is a share of it",
         "above 0, and 1 at most");
  if (soft < 1 && !(tsize > 0) && erods == 0)
    deck.warning(diagnostics, *this, "SOFT", "counts only in parts whose own elements can be deleted",
                 "by TSIZE, ERODS, *MAT_ADD_EROSION or ERODE of *CONTROL_TIMESTEP");
  const bool first = two_branches();
  if (fs == -1 && (tau1 > 0) != (gamma1 > 0))
    deck.error(diagnostics, *this, tau1 > 0 ? "GAMMA1" : "TAU1",
               "the first branch of the curve of shear needs both TAU1 and GAMMA1", "give both, or neither");
  if (fs != -1 && (tau1 > 0 || gamma1 > 0))
    deck.warning(diagnostics, *this, tau1 > 0 ? "TAU1" : "GAMMA1", "has no effect: FS is not -1",
                 "FS = -1 knows a first branch of the curve of shear");
  refuse("GAMMA1", first && !(gamma1 < gms), gamma1, "the first branch ends behind the second", "below GMS");
  refuse("TAU1", first && !(tau1 <= sc), tau1, "the first branch is stronger than SC", "SC at most");
  const auto reach = [&](const char* field, Real strain, Real strength, Real stiffness) {
    if (strain * stiffness < strength)
      deck.warning(
          diagnostics, *this, field,
          fmt::format("{:g} is below the strain {:g} at which an elastic layer has its strength: it is "
                      "elastic up to that one",
                      strain, strength / stiffness),
          "a larger strain lets damage grow before");
  };
  reach("E11T", e11t, xt, ea), reach("E11C", e11c, xc, ea);
  reach("E22T", e22t, yt, eb), reach("E22C", e22c, yc, eb);
  first ? reach("GAMMA1", gamma1, tau1, gab) : reach("GMS", gms, sc, gab);
}

// By hand. EA = EB = 4, PRBA = 0, XT = 0.4 at E11T = 0.2: X/E = 0.1, m = 1/ln 2, and at the strain 0.2 the
// stress is XT itself. GAB = 1, SC = 0.1 at GMS = 0.2: at gamma = 0.2 it is SC. Behind the peak, at 0.3,
// SLIMT1 = 1 keeps XT. In compression XC = 0.4 at 0.1: elastic, then nothing.
constexpr const char* fabric_cards = "1,2.0,4.0,4.0,,0.0\n1.0,2.0,3.0,1.0\n,,,,-1.0\n\n\n";
constexpr const char* fabric_strengths = "0.1,0.2,0.1,0.2,0.2\n0.4,0.4,0.4,0.4,0.1\n";
constexpr FieldRules over_rate{.honour = Honour::no, .refers = IdSpace::curve};
constexpr FieldRules share{.check = Check::not_negative};
const RegisterStrength<LF> mat_laminated_composite_fabric{
    "s_a = (1 - w_a) EA (strain_a + (1 - w_b) PRBA strain_b)/(1 - (1 - w_a)(1 - w_b) PRBA^2 EA/EB), s_b "
    "alike, "
    "tau = (1 - w_ab) GAB gamma; 1 - w = exp(-r^m/(m e)), m = 1/ln(E11T EA/XT), of the largest r so far: "
    "strain EA/XT and its like, with FS 1 sqrt(r_a^2 + r_ab^2), with FS 0 for b alone",
    "Matzenmiller, Lubliner & Taylor 1995",
    {{std::string(fabric_cards) + fabric_strengths,
      {0.2, 0, 0, 0.1, 0.2, 0.3},
      {},
      {0.4, 0, 0, 0.1, 0.8, 1.8}},
     {std::string(fabric_cards) + fabric_strengths, {0.3, -0.05, 0, 0, 0, 0}, {}, {0.4, -0.2, 0, 0, 0, 0}},
     {std::string(fabric_cards) + fabric_strengths, {-0.15, 0, 0, 0, 0, 0}, {}, {0, 0, 0, 0, 0, 0}}},
    {.names = {"MAT_LAMINATED_COMPOSITE_FABRIC", "MAT_058"},
     .purpose = "layers of shells whose stiffness falls by damage: of single directions, laminates, fabrics",
     .id_space = IdSpace::material,
     .title_option = true,
     .title = &LF::title,
     .cards = {
         {.fields = {{"MID", &LF::mid, "-", "id that *PART refers to", rules::required_id},
                     {"RO", &LF::ro, "M/L3", "density", rules::required_positive},
                     {"EA", &LF::ea, "M/LT2", "Young's modulus along a", rules::required_positive},
                     {"EB", &LF::eb, "M/LT2", "along b", rules::required_positive},
                     {"EC", &LF::ec, "M/LT2", "along c; 0: the thickness stays", share},
                     {"PRBA", &LF::prba, "-", "strain along a over that along b of a stress along b"},
                     {"TAU1", &LF::tau1, "M/LT2", "FS -1: end of the first branch of shear, stress", share},
                     {"GAMMA1", &LF::gamma1, "-", "its strain, of the engineer", share}}},
         {.fields = {{"GAB", &LF::gab, "M/LT2", "shear modulus in the plane", rules::required_positive},
                     {"GBC", &LF::gbc, "M/LT2", "across it along b", rules::required_positive},
                     {"GCA", &LF::gca, "M/LT2", "across it along a", rules::required_positive},
                     {"SLIMT1", &LF::slimt1, "-", "least share of XT behind it", share},
                     {"SLIMC1", &LF::slimc1, "-", "of XC", share},
                     {"SLIMT2", &LF::slimt2, "-", "of YT", share},
                     {"SLIMC2", &LF::slimc2, "-", "of YC", share},
                     {"SLIMS", &LF::slims, "-", "of SC", share}}},
         {.fields =
              {{"AOPT", &LF::aopt, "-", aopt_meaning},
               {"TSIZE", &LF::tsize, "T", "step below which an element is deleted; 0: none", share},
               {"ERODS", &LF::erods, "-",
                "effective strain at which a layer fails: > 0 as if the volume were kept, < 0 of all; 0: "
                "never"},
               {"SOFT", &LF::soft, "-", "share of strengths beside deleted elements", {.standard = 1}},
               {"FS", &LF::fs, "-",
                "surface of damage: 1 a with shear and b with shear, 0 b with shear alone, -1 each alone"},
               {"EPSF", &LF::epsf, "-", "shear across at which damage begins; 0: never", share},
               {"EPSR", &LF::epsr, "-", "at which it is TSMD", share},
               {"TSMD", &LF::tsmd, "-", "its largest", {.standard = 0.9, .check = Check::not_negative}}}},
         {.fields = with_fields<LF>(fields_of_a<LF>(),
                                    {{"PRCA", &LF::prca, "-", "of a and c, with EC for the thickness alone"},
                                     {"PRCB", &LF::prcb, "-", "of b and c, the same"}})},
         {.fields = with_fields<LF>(
              fields_of_v<LF>(),
              {{"BETA", &LF::beta, "-", "angle by which a is turned about the normal, degrees"},
               {"LCDFAIL", &LF::lcdfail, "-", "strains of failure by direction", over_rate}})},
         {.fields = {{"E11C", &LF::e11c, "-", "strain at XC", rules::required_positive},
                     {"E11T", &LF::e11t, "-", "strain at XT", rules::required_positive},
                     {"E22C", &LF::e22c, "-", "strain at YC", rules::required_positive},
                     {"E22T", &LF::e22t, "-", "strain at YT", rules::required_positive},
                     {"GMS", &LF::gms, "-", "strain at SC, of the engineer", rules::required_positive}}},
         {.fields = {{"XC", &LF::xc, "M/LT2", "strength along a in compression", rules::required_positive},
                     {"XT", &LF::xt, "M/LT2", "in tension", rules::required_positive},
                     {"YC", &LF::yc, "M/LT2", "along b in compression", rules::required_positive},
                     {"YT", &LF::yt, "M/LT2", "in tension", rules::required_positive},
                     {"SC", &LF::sc, "M/LT2", "in shear", rules::required_positive}}},
         {.fields = {{"LCXC", &LF::lcxc, "-", "XC over the rate", over_rate},
                     {"LCXT", &LF::lcxt, "-", "XT over the rate", over_rate},
                     {"LCYC", &LF::lcyc, "-", "YC over the rate", over_rate},
                     {"LCYT", &LF::lcyt, "-", "YT over the rate", over_rate},
                     {"LCSC", &LF::lcsc, "-", "SC over the rate", over_rate},
                     {"LCTAU", &LF::lctau, "-", "TAU1 over the rate", over_rate},
                     {"LCGAM", &LF::lcgam, "-", "GAMMA1 over the rate", over_rate},
                     {"DT", &LF::dt, "T", "over which the rate is averaged", no_effect}},
          .optional = true},
         {.fields = {{"LCE11C", &LF::lce11c, "-", "E11C over the rate", over_rate},
                     {"LCE11T", &LF::lce11t, "-", "E11T over the rate", over_rate},
                     {"LCE22C", &LF::lce22c, "-", "E22C over the rate", over_rate},
                     {"LCE22T", &LF::lce22t, "-", "E22T over the rate", over_rate},
                     {"LCGMS", &LF::lcgms, "-", "GMS over the rate", over_rate},
                     {"LCEFS", &LF::lcefs, "-", "ERODS over the rate", over_rate}},
          .optional = true}}}};

}  // namespace

}  // namespace courant
