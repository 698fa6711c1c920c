// *MAT_036 and *MAT_122: metal sheets that yield differently along and across the direction of rolling;
// *MAT_037: alike in all directions of their plane.
#include <fmt/format.h>

#include "keyword/common_rules.hpp"
#include "laws/strength/barlat.hpp"

namespace courant {

namespace {

struct MatBarlat : BarlatCard {
  Real iter = 0, m = 0, p3 = 0, c = 0, p = 0, pb = 0, htb = 0, htflag = 0, usrfail = 0;
  Id vlcid = 0, hta = 0, htc = 0, htd = 0, lcbi = 0, lcsh = 0;

  BarlatSurface surface() const {
    if (pb > 0) return {.A = r00, .C = r45, .H = r90, .P = pb, .M = m};
    return BarlatSurface::of_ratios(r00, r45, r90, m);
  }
  std::shared_ptr<StrengthLaw> law(const Model& model) const { return law_of(model, surface()); }
  void check(const Deck& deck, const Model& model, Diagnostics& diagnostics) const {
    check_hardening(deck, model, diagnostics);
    expect(deck, diagnostics, m >= 2, "M", "a number of 2 or more", m,
           "6 for body-centred, 8 for face-centred metals; back stresses (M < 0) are not supported");
    if (pb == 0) check_ratios(deck, diagnostics);
    if (pb < 0) expect(deck, diagnostics, false, "PB", "a number > 0", pb, "or leave it blank");
    for (const auto& [field, value] : {std::pair{"R00", r00}, std::pair{"R45", r45}, std::pair{"R90", r90}})
      if (pb > 0)
        expect(deck, diagnostics, value > 0, field, "a number > 0", value,
               "with PB the fields R00, R45, R90 are a, c and h of the surface");
    if (p != 0 && c != 0)
      deck.error(diagnostics, *this, "C", "influence of the rate of strain is not supported",
                 "leave C or P blank");
  }
};

struct MatHill : BarlatCard {
  std::shared_ptr<StrengthLaw> law(const Model& model) const {
    return law_of(model, BarlatSurface::of_ratios(r00, r45, r90, 2));
  }
  void check(const Deck& deck, const Model& model, Diagnostics& diagnostics) const {
    check_hardening(deck, model, diagnostics);
    check_ratios(deck, diagnostics);
  }
};

struct MatOneRatio : BarlatCard {
  Real sigy = 0, etan = 0;
  std::shared_ptr<StrengthLaw> law(const Model& model) const {
    SheetHardening hardening{.yield = sigy, .slope = etan};
    if (const auto found = model.curves.find(lcid); lcid != 0 && found != model.curves.end())
      hardening.curve = IndexedPieces(found->second.abscissa, found->second.ordinate);
    return make_sheet({ro, E, pr}, BarlatSurface::of_ratios(r00, r00, r00, 2).sheet(), {},
                      std::move(hardening));
  }
  void check(const Deck& deck, const Model& model, Diagnostics& diagnostics) const {
    expect(deck, diagnostics, pr < 0.5, "PR", "a number < 0.5", pr,
           "a material that keeps its volume has no finite bulk modulus");
    if (lcid != 0)
      check_sheet_curve(deck, model, *this, "HLCID", lcid,
                        "a *DEFINE_CURVE of yield stress over effective plastic strain", diagnostics);
    else
      expect(deck, diagnostics, sigy > 0, "SIGY", "a number > 0", sigy, "or give the curve HLCID");
  }
};

template <class C>
std::vector<FieldOf<C>> first_fields() {
  return {{"MID", &C::mid, "-", "id that *PART refers to", rules::required_id},
          {"RO", &C::ro, "M/L3", "density", rules::required_positive},
          {"E", &C::E, "M/LT2", "Young's modulus", rules::required_positive},
          {"PR", &C::pr, "-", "Poisson ratio, below 0.5", {.check = Check::not_negative}},
          {"HR", &C::hr, "-", "hardening: 1 linear, 2 power law, 3 curve", {.standard = 1}},
          {"P1", &C::p1, "M/LT2", "HR 1: tangent modulus; HR 2: factor K of K (E0 + e)^N"},
          {"P2", &C::p2, "-", "HR 1: yield stress; HR 2: exponent N"}};
}
constexpr FieldRules sheet_hardening = rules::over(rules::optional_id_of(IdSpace::curve), "-", "M/LT2");

constexpr FieldRules of_curve(FieldRules rules) {
  rules.refers = IdSpace::curve;
  return rules;
}

// By hand. E = 2.5, PR = 1/4, all R = 1: pulled by the same strain along a and b, s = 10/3 e along both, q =
// s. e = 0.9: q = 3; yield stress 1, P1 = 1/2: Ep = 5/8. The normal is (1/2, 1/2), its stiffness 5/3: de =
// 2/(5/3
// + 5/8) = 48/55, q = 1 + 5/8 de = 17/11. Below the yield stress as Hooke's law in the plane: aa = 8/3, ab =
// 2/3, G = 1.
const std::array<Real, 6> both_alike{0.9, 0.9}, stretched{17.0 / 11, 17.0 / 11};

using Barlat = MatBarlat;
const RegisterStrength<Barlat> mat_barlat{
    "1/2 (a |K1 + K2|^M + a |K1 - K2|^M + c |2 K2|^M) = q^M, K1 = (s_a + h s_b)/2, K2^2 = ((s_a - h "
    "s_b)/2)^2 "
    "+ p^2 s_ab^2; q <= sigma_y(e) by HR; plastic strain along its normal; a, c, h, p from R00, R45, R90; "
    "shear across the sheet is elastic",
    "Barlat & Lian 1989",
    {{"1,2.0,2.5,0.25,1,0.5,1.0\n8.0,1.0,1.0,1.0\n0\n\n\n", both_alike, {}, stretched, {0}, {48.0 / 55}},
     {"1,2.0,2.5,0.25,1,0.5,1.0\n8.0,1.0,1.0,1.0\n0\n\n\n",
      {0.06, 0, 0, 0.1, 0.05, 0.1},
      {},
      {0.16, 0.04, 0, 0.2, 0.1, 0.2},
      {0},
      {0}}},
    {.names = {"MAT_3-PARAMETER_BARLAT", "MAT_036", "MAT_3PARAMETER_BARLAT"},
     .purpose = "metal sheets whose yield stress and flow depend on the direction, by the surface of Barlat "
                "and Lian",
     .id_space = IdSpace::material,
     .title_option = true,
     .title = &Barlat::title,
     .cards =
         {{.fields = with_fields<Barlat>(first_fields<Barlat>(),
                                         {{"ITER", &Barlat::iter, "-", "iterations", no_effect}})},
          {.fields = {{"M", &Barlat::m, "-", "exponent of the surface, 2 or more", {.required = true}},
                      {"R00",
                       &Barlat::r00,
                       "-",
                       "ratio of strains in tension along a; a of the surface with PB",
                       {.required = true}},
                      {"R45",
                       &Barlat::r45,
                       "-",
                       "in tension between a and b; c of the surface with PB",
                       {.required = true}},
                      {"R90",
                       &Barlat::r90,
                       "-",
                       "in tension along b; h of the surface with PB",
                       {.required = true}},
                      {"LCID", &Barlat::lcid, "-", "yield stress over plastic strain, HR 3", sheet_hardening},
                      {"E0", &Barlat::e0, "-", "strain of HR 2", {.check = Check::not_negative}},
                      {"SPI",
                       &Barlat::spi,
                       "-",
                       "where E0 is 0: up to 0.02 that strain, else the yield stress",
                       {.check = Check::not_negative}},
                      {"P3", &Barlat::p3, "-", "of HR 5 and 6", no_effect}}},
          {.fields =
               {{"AOPT", &Barlat::aopt, "-", aopt_meaning},
                {"C", &Barlat::c, "1/T", "of Cowper and Symonds"},
                {"P", &Barlat::p, "-", "of Cowper and Symonds"},
                {"VLCID", &Barlat::vlcid, "-", "change of volume over plastic strain", of_curve(unsupported)},
                {},
                {"PB", &Barlat::pb, "-", "p of the surface; R00, R45, R90 then are a, c, h"},
                {"NLP/HTA", &Barlat::hta, "-", "forming limit or heat treatment", of_curve(unsupported)},
                {"HTB", &Barlat::htb, "-", "heat treatment", unsupported}}},
          {.fields = with_fields<Barlat>(
               fields_of_a<Barlat>(), {{"HTC", &Barlat::htc, "-", "heat treatment", of_curve(unsupported)},
                                       {"HTD", &Barlat::htd, "-", "heat treatment", of_curve(unsupported)}})},
          {.fields = with_fields<Barlat>(
               fields_of_v<Barlat>(),
               {{"BETA", &Barlat::beta, "-", "angle by which a is turned about the normal, degrees"},
                {"HTFLAG", &Barlat::htflag, "-", "stage of heat treatment", unsupported}})},
          {.fields = {{"USRFAIL", &Barlat::usrfail, "-", "failure by a subroutine", unsupported},
                      {"LCBI", &Barlat::lcbi, "-", "of HR 7", of_curve(no_effect)},
                      {"LCSH", &Barlat::lcsh, "-", "of HR 7", of_curve(no_effect)}},
           .optional = true}},
     .convert = convert_hardening<Barlat>}};

using OneRatio = MatOneRatio;
// Without P1 of HR 1, which is a tangent modulus, but with 5/8, which that makes of it.
const RegisterStrength<OneRatio> mat_one_ratio{
    "q^2 = s_a^2 + s_b^2 - 2 R/(1 + R) s_a s_b + 2 (1 + 2 R)/(1 + R) s_ab^2 <= sigma_y(e)^2; plastic strain "
    "along its normal; shear across the sheet is elastic",
    "Hill 1948",
    {{"1,2.0,2.5,0.25,1.0,0.625,1.0\n", both_alike, {}, stretched, {0}, {48.0 / 55}}},
    {.names = {"MAT_TRANSVERSELY_ANISOTROPIC_ELASTIC_PLASTIC", "MAT_037"},
     .purpose =
         "metal sheets that yield alike in all directions of their plane and otherwise across it, by the "
         "surface of Hill",
     .id_space = IdSpace::material,
     .title_option = true,
     .title = &OneRatio::title,
     .cards = {
         {.fields = {{"MID", &OneRatio::mid, "-", "id that *PART refers to", rules::required_id},
                     {"RO", &OneRatio::ro, "M/L3", "density", rules::required_positive},
                     {"E", &OneRatio::E, "M/LT2", "Young's modulus", rules::required_positive},
                     {"PR", &OneRatio::pr, "-", "Poisson ratio, below 0.5", {.check = Check::not_negative}},
                     {"SIGY",
                      &OneRatio::sigy,
                      "M/LT2",
                      "yield stress, where HLCID is 0",
                      {.check = Check::not_negative}},
                     {"ETAN",
                      &OneRatio::etan,
                      "M/LT2",
                      "slope of the yield stress over plastic strain",
                      {.check = Check::not_negative}},
                     {"R", &OneRatio::r00, "-",
                      "ratio of the plastic strain across a tension to that through the thickness",
                      rules::required_positive},
                     {"HLCID", &OneRatio::lcid, "-",
                      "yield stress over plastic strain, instead of SIGY and ETAN", sheet_hardening}}}}}};

using Hill = MatHill;
const RegisterStrength<Hill> mat_hill{
    "q^2 = s_a^2 + h^2 s_b^2 - 2 R00/(1 + R00) s_a s_b + (1 + 2 R45)(R00 + R90)/((1 + R00) R90) s_ab^2, h^2 "
    "= "
    "R00 (1 + R90)/(R90 (1 + R00)); q <= sigma_y(e) by HR; plastic strain along its normal; shear across the "
    "sheet is elastic",
    "Hill 1948",
    {{"1,2.0,2.5,0.25,1,0.5,1.0\n1.0,1.0,1.0\n0\n\n\n", both_alike, {}, stretched, {0}, {48.0 / 55}}},
    {.names = {"MAT_HILL_3R", "MAT_122"},
     .purpose = "metal sheets whose yield stress and flow depend on the direction, by the surface of Hill",
     .id_space = IdSpace::material,
     .title_option = true,
     .title = &Hill::title,
     .cards =
         {{.fields = first_fields<Hill>()},
          {.fields = {{"R00", &Hill::r00, "-", "ratio of strains in tension along a", {.required = true}},
                      {"R45", &Hill::r45, "-", "in tension between a and b", {.required = true}},
                      {"R90", &Hill::r90, "-", "in tension along b", {.required = true}},
                      {"LCID", &Hill::lcid, "-", "yield stress over plastic strain, HR 3", sheet_hardening},
                      {"E0",
                       &Hill::e0,
                       "-",
                       "strain of HR 2; 0: where E e = K e^N",
                       {.check = Check::not_negative}}}},
          {.fields = {{"AOPT", &Hill::aopt, "-", aopt_meaning}}},
          {.fields = fields_of_a<Hill>()},
          {.fields = with_fields<Hill>(
               fields_of_v<Hill>(),
               {{"BETA", &Hill::beta, "-", "angle by which a is turned about the normal, degrees"}})}},
     .convert = convert_hardening<Hill>}};

}  // namespace

}  // namespace courant
