// *MAT_BARLAT_YLD2000: metal sheets by eight coefficients. Barlat et al. 2003.
#include <fmt/format.h>

#include <cmath>

#include "keyword/common_rules.hpp"
#include "keyword/expectations.hpp"
#include "laws/strength/barlat.hpp"

namespace courant {

namespace {

struct MatBarlatYld2000 : DirectionsCard {
  std::string title;
  Id mid = 0, hta = 0, htb = 0, htc = 0, htd = 0;
  Real ro = 0, E = 0, pr = 0, fit = 0, beta = 0, iter = 0, iscale = 0;
  Real k = 0, e0 = 0, n = 0, c = 0, p = 0, hard = 0, a = 0, p4 = 0;
  Real alpha1 = 0, alpha2 = 0, alpha3 = 0, alpha4 = 0, alpha5 = 0, alpha6 = 0, alpha7 = 0, alpha8 = 0;
  Real offang = 0, htflag = 0, usrfail = 0;

  /// X = L s of the paper, (17): the radius of X' alone, half the sum and the radius of X'' beside each
  /// other.
  SheetSurface surface() const {
    const Real l11 = (8 * alpha5 - 2 * alpha3 - 2 * alpha6 + 2 * alpha4) / 9,
               l12 = (4 * alpha6 - 4 * alpha4 - 4 * alpha5 + alpha3) / 9,
               l21 = (4 * alpha3 - 4 * alpha5 - 4 * alpha4 + alpha6) / 9,
               l22 = (8 * alpha4 - 2 * alpha6 - 2 * alpha3 + 2 * alpha5) / 9;
    SheetSurface out{.M = a};
    out.k = {1.5 * (l11 + l21), 1.5 * (l12 + l22)}, out.d = {0.5 * (l11 - l21), 0.5 * (l12 - l22)},
    out.t = alpha8;
    out.e = {(2 * alpha1 + alpha2) / 6, -(alpha1 + 2 * alpha2) / 6}, out.u = alpha7;
    if (iscale == 0) scale(out);
    return out;
  }
  SheetHardening hardening(const Model& model) const {
    SheetHardening out;
    if (hard < 0) {
      if (const auto found = model.curves.find(static_cast<Id>(-hard)); found != model.curves.end())
        out.curve = IndexedPieces(found->second.abscissa, found->second.ordinate);
    } else if (hard == 2 || hard == 5) {
      out.top = k, out.range = e0, out.rate = n, out.power = hard == 5 ? p4 : 1;
    } else {
      out.K = k, out.e0 = e0, out.N = n, out.less = hard == 4 ? p4 : 0;
    }
    return out;
  }
  std::shared_ptr<StrengthLaw> law(const Model& model) const {
    return make_sheet({ro, E, pr}, surface(), axes(model, offang), hardening(model));
  }
  void check(const Deck& deck, const Model& model, Diagnostics& diagnostics) const;

 private:
  /// Tension along a yields at the yield stress itself.
  static void scale(SheetSurface& s) {
    const auto power = [&](Real x) { return std::pow(std::abs(x), s.M); };
    const Real q =
        std::pow(0.5 * (power(s.k[0] + s.d[0]) + power(s.k[0] - s.d[0]) + power(2 * s.e[0])), 1 / s.M);
    for (Real* x : {&s.k[0], &s.k[1], &s.d[0], &s.d[1], &s.e[0], &s.e[1], &s.t, &s.u}) *x /= q;
  }
};

using Yld2000 = MatBarlatYld2000;

void Yld2000::check(const Deck& deck, const Model& model, Diagnostics& diagnostics) const {
  const auto expect = expectations_of(*this, deck, diagnostics);
  check_axes(deck, model, diagnostics);
  expect(pr < 0.5, "PR", "a number < 0.5", pr, "a material that keeps its volume has no finite bulk modulus");
  expect(a >= 2, "A", "a number of 2 or more", a,
         "6 for body-centred, 8 for face-centred metals; back stresses (A < 0) are not supported");
  expect(iscale == 0 || iscale == 1, "ISCALE", "0 or 1", iscale,
         "0: tension along a yields at the yield stress");
  expect(p == 0, "P", "0", p, "influence of the rate of strain is not supported");
  const Real one[] = {alpha1, alpha2, alpha3, alpha4, alpha5, alpha6, alpha7, alpha8};
  for (std::size_t m = 0; m < 8; ++m)
    if (!(one[m] > 0))
      deck.error(diagnostics, *this, fmt::format("ALPHA{}", m + 1),
                 fmt::format("expected a number > 0, got '{:g}'", one[m]),
                 "1 for a metal without directions");
  if (hard < 0)
    return check_sheet_curve(deck, model, *this, "HARD", static_cast<Id>(-hard),
                             "a *DEFINE_CURVE of yield stress over effective plastic strain", diagnostics);
  expect(hard == 1 || hard == 2 || hard == 4 || hard == 5, "HARD", "1, 2, 4, 5, or minus a curve", hard,
         "1 power law, 2 Voce, 4 Gosh, 5 Hockett and Sherby; Hansel's is not supported");
  expect(k > 0, "K", "a number > 0", k, "the factor of the power law, or the yield stress in the end");
  if (hard == 2 || hard == 5) {
    expect(e0 >= 0 && e0 < k, "E0", "a number from 0 to below K", e0,
           "K - E0 is the yield stress at the start");
    expect(n >= 0, "N", "a number of 0 or more", n, "the rate at which it saturates");
    expect(hard == 2 || p4 > 0, "P4", "a number > 0", p4, "with HARD 5 the exponent of the plastic strain");
  } else {
    expect(n > 0 && n < 1, "N", "a number between 0 and 1", n, "the exponent of hardening");
    expect(e0 > 0, "E0", "a number > 0", e0, "the strain of K (E0 + e)^N");
    const Real first = k * std::pow(e0, n);
    expect(hard != 4 || p4 < first, "P4", "a number below K E0^N", p4, "what the power law is lowered by");
  }
}

/// Constants of hardening that are stresses.
std::string convert_hardening_of(Yld2000& card, const Conversion& conversion) {
  const Real factor = conversion.units.of("M/LT2");
  if (card.hard >= 0) card.k *= factor;
  if (card.hard == 2 || card.hard == 5) card.e0 *= factor;
  if (card.hard == 4) card.p4 *= factor;
  return "";
}

constexpr FieldRules unsupported_curve{.honour = unsupported.honour, .refers = IdSpace::curve};

// By hand. As *MAT_3-PARAMETER_BARLAT with all R = 1, which is this surface with all coefficients 1: E = 2.5,
// PR = 1/4, pulled alike along a and b: s = 10/3 0.9 = 3, q = s, stiffness of the normal 5/3. Voce with N =
// 0: a yield stress of K - E0 = 1 that stays: de = 2/(5/3) = 6/5.
const std::string all_one = "1.0,1.0,1.0,1.0,1.0,1.0,1.0,1.0\n0\n\n\n";
const RegisterStrength<Yld2000> mat_barlat_yld2000{
    "|X1' - X2'|^A + |2 X2'' + X1''|^A + |2 X1'' + X2''|^A = 2 q^A, X' and X'' the principal values of two "
    "linear "
    "functions of the stress by ALPHA1 to ALPHA8; q <= sigma_y(e) by HARD; plastic strain along its normal; "
    "shear across "
    "the sheet is elastic",
    "Barlat et al. 2003",
    {{"1,2.0,2.5,0.25\n2.0,1.0,0.0,0.0,0.0,2,8.0\n" + all_one, {0.9, 0.9}, {}, {1, 1}, {0}, {1.2}},
     {"1,2.0,2.5,0.25\n2.0,1.0,0.0,0.0,0.0,2,8.0\n" + all_one,
      {0.06, 0, 0, 0.1, 0.05, 0.1},
      {},
      {0.16, 0.04, 0, 0.2, 0.1, 0.2},
      {0},
      {0}}},
    {.names = {"MAT_BARLAT_YLD2000", "MAT_133"},
     .purpose = "metal sheets whose yield stress and flow depend on the direction, by eight coefficients",
     .id_space = IdSpace::material,
     .title_option = true,
     .title = &Yld2000::title,
     .cards =
         {{.fields = {{"MID", &Yld2000::mid, "-", "id that *PART refers to", rules::required_id},
                      {"RO", &Yld2000::ro, "M/L3", "density", rules::required_positive},
                      {"E", &Yld2000::E, "M/LT2", "Young's modulus", rules::required_positive},
                      {"PR", &Yld2000::pr, "-", "Poisson ratio, below 0.5", {.check = Check::not_negative}},
                      {"FIT", &Yld2000::fit, "-", "coefficients from tests: 1", unsupported},
                      {"BETA", &Yld2000::beta, "-", "share of kinematic hardening", unsupported},
                      {"ITER", &Yld2000::iter, "-", "algorithm of the return", no_effect},
                      {"ISCALE", &Yld2000::iscale, "-",
                       "0: tension along a yields at the yield stress; 1: as ALPHA has it"}}},
          {.fields = {{"K", &Yld2000::k, "-", "HARD 1, 4: factor K; HARD 2, 5: yield stress in the end"},
                      {"E0", &Yld2000::e0, "-",
                       "HARD 1, 4: E0 of K (E0 + e)^N; HARD 2, 5: what the yield stress rises by"},
                      {"N", &Yld2000::n, "-", "HARD 1, 4: exponent; HARD 2, 5: rate C of exp(-C e)"},
                      {"C", &Yld2000::c, "1/T", "rate of strain of P", no_effect},
                      {"P", &Yld2000::p, "-", "exponent of the rate of strain"},
                      {"HARD",
                       &Yld2000::hard,
                       "-",
                       "1 power law, 2 Voce, 4 Gosh, 5 Hockett and Sherby, < 0: curve -HARD",
                       {.standard = 1}},
                      {"A", &Yld2000::a, "-", "exponent of the surface, 2 or more", {.required = true}}}},
          {.fields = {{"ALPHA1", &Yld2000::alpha1, "-", "coefficient of X'", {.required = true}},
                      {"ALPHA2", &Yld2000::alpha2, "-", "coefficient of X'", {.required = true}},
                      {"ALPHA3", &Yld2000::alpha3, "-", "coefficient of X''", {.required = true}},
                      {"ALPHA4", &Yld2000::alpha4, "-", "coefficient of X''", {.required = true}},
                      {"ALPHA5", &Yld2000::alpha5, "-", "coefficient of X''", {.required = true}},
                      {"ALPHA6", &Yld2000::alpha6, "-", "coefficient of X''", {.required = true}},
                      {"ALPHA7", &Yld2000::alpha7, "-", "of the shear of X'", {.required = true}},
                      {"ALPHA8", &Yld2000::alpha8, "-", "of the shear of X''", {.required = true}}}},
          {.fields =
               {{"AOPT", &Yld2000::aopt, "-", aopt_meaning},
                {"OFFANG", &Yld2000::offang, "-", "angle by which a is turned about the normal, degrees"},
                {"P4", &Yld2000::p4, "-", "HARD 4: what the power law is lowered by; HARD 5: exponent of e"},
                {"HTFLAG", &Yld2000::htflag, "-", "stage of heat treatment", unsupported},
                {"HTA", &Yld2000::hta, "-", "heat treatment", unsupported_curve},
                {"HTB", &Yld2000::htb, "-", "heat treatment", unsupported_curve},
                {"HTC", &Yld2000::htc, "-", "heat treatment", unsupported_curve},
                {"HTD", &Yld2000::htd, "-", "heat treatment", unsupported_curve}}},
          {.fields = fields_of_a<Yld2000>()},
          {.fields = with_fields<Yld2000>(
               fields_of_v<Yld2000>(),
               {{"USRFAIL", &Yld2000::usrfail, "-", "failure by a subroutine", unsupported}})}},
     .convert = convert_hardening_of}};

}  // namespace

}  // namespace courant
