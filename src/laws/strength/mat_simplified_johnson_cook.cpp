#include <fmt/format.h>

#include "keyword/common_rules.hpp"
#include "laws/strength/johnson_cook.hpp"

namespace courant {

namespace {

struct MatSimplifiedJohnsonCook : Entry {
  std::string title;
  Id mid = 0;
  Real ro = 0, E = 0, pr = 0, vp = 0;
  Real a = 0, b = 0, n = 0, c = 0, psfail = 0, sigmax = 0, sigsat = 0, epso = 0;

  std::shared_ptr<StrengthLaw> law() const {
    JohnsonCookData out{.G = E / (2 * (1 + pr)), .K = E / (3 * (1 - 2 * pr)), .A = a, .B = b, .n = n, .C = c};
    out.rate0 = epso > 0 ? epso : 1, out.of_plastic_rate = vp == 1;
    out.most = sigmax, out.saturates = sigsat;
    if (psfail < never_fails) out.fails_at = psfail;
    return make_johnson_cook(ro, out);
  }
  void check(const Deck& deck, Diagnostics& diagnostics) const {
    if (!(pr < 0.5))
      deck.error(diagnostics, *this, "PR", fmt::format("expected a number < 0.5, got '{:g}'", pr),
                 "a material that keeps its volume has no finite bulk modulus");
    if (vp != 0 && vp != 1)
      deck.error(diagnostics, *this, "VP", fmt::format("expected 0 or 1, got '{:g}'", vp),
                 "1: the rate is that of plastic strain");
  }
};

using S = MatSimplifiedJohnsonCook;

/// A blank EPSO is 1 in the units of its file.
std::string convert_blank_rate(S& card, const Conversion& conversion) {
  if (card.epso == 0) card.epso = conversion.units.of("1/T");
  return "";
}

constexpr FieldRules no_limit{.standard = 1e28, .check = Check::positive};
// By hand. E = 2.5, PR = 1/4: lambda = G = 1. A = 3, B = 2, N = 1: shear as in *MAT_JOHNSON_COOK. SIGMAX = 4,
// pulled by (2, -1, -1): s = (4, -2, -2), q = 6; 3 + 2 de is 4 at de = 1/2, where q is 4.5: de = 2/3, s = 2/3
// (4, -2, -2).
const RegisterStrength<S> mat_simplified_johnson_cook{
    "q = sqrt(3/2 s:s) <= min(min(A + B e^N, SIGMAX) (1 + C ln max(rate/EPSO, 1)), SIGSAT); pressure by "
    "Hooke's law",
    "Johnson & Cook 1983, without temperature",
    {{"1,2.0,2.5,0.25\n3.0,2.0,1.0\n",
      {0, 0, 0, 2, 0, 0},
      {1, 1, 1},
      {1, 1, 1, 4 - 1.7320508075688772 * 0.7856406460551018, 0, 0},
      {0},
      {0.7856406460551018}},
     {"1,2.0,2.5,0.25\n3.0,2.0,1.0,,,4.0\n",
      {2, -1, -1, 0, 0, 0},
      {},
      {8.0 / 3, -4.0 / 3, -4.0 / 3, 0, 0, 0},
      {0},
      {2.0 / 3}},
     {"1,2.0,2.5,0.25\n3.0,2.0,1.0,,,,4.0\n",
      {2, -1, -1, 0, 0, 0},
      {},
      {8.0 / 3, -4.0 / 3, -4.0 / 3, 0, 0, 0},
      {0},
      {2.0 / 3}}},
    {.names = {"MAT_SIMPLIFIED_JOHNSON_COOK", "MAT_098"},
     .purpose = "elasticity and plasticity that heeds strain and its rate as Johnson and Cook have it",
     .id_space = IdSpace::material,
     .title_option = true,
     .title = &S::title,
     .cards =
         {{.fields = {{"MID", &S::mid, "-", "id that *PART refers to", rules::required_id},
                      {"RO", &S::ro, "M/L3", "density", rules::required_positive},
                      {"E", &S::E, "M/LT2", "Young's modulus", rules::required_positive},
                      {"PR", &S::pr, "-", "Poisson ratio, below 0.5", {.check = Check::not_negative}},
                      {"VP", &S::vp, "-", "rate of all strain (0) or of plastic strain (1)"}}},
          {.fields = {{"A", &S::a, "M/LT2", "yield stress at rest", rules::required_positive},
                      {"B", &S::b, "M/LT2", "factor of e^N", {.check = Check::not_negative}},
                      {"N", &S::n, "-", "exponent of plastic strain", {.check = Check::not_negative}},
                      {"C", &S::c, "-", "influence of the rate of strain", {.check = Check::not_negative}},
                      {"PSFAIL",
                       &S::psfail,
                       "-",
                       "effective plastic strain at which points of elements fail; 0: never",
                       {.standard = 1e17, .check = Check::positive}},
                      {"SIGMAX", &S::sigmax, "M/LT2", "A + B e^N is not above; 0: no limit", no_limit},
                      {"SIGSAT", &S::sigsat, "M/LT2", "nor is this with the factor of the rate; 0: no limit",
                       no_limit},
                      {"EPSO",
                       &S::epso,
                       "1/T",
                       "rate of strain from which on it counts; 0: 1 per unit of time",
                       {.check = Check::not_negative}}}}},
     .convert = convert_blank_rate}};

}  // namespace

}  // namespace courant
