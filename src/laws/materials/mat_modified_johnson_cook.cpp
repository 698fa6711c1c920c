// *MAT_MODIFIED_JOHNSON_COOK: Borvik, Hopperstad, Berstad & Langseth 2001; work to fracture: Cockcroft &
// Latham 1968.
#include <fmt/format.h>

#include "keyword/expectations.hpp"
#include "laws/materials/strength_cards.hpp"
#include "laws/strength/johnson_cook.hpp"

namespace courant {

namespace {

struct MatModifiedJohnsonCook : MatModifiedJohnsonCookFields {
  bool heats() const { return cp > 0 && xsi > 0; }
  std::shared_ptr<StrengthLaw> law() const {
    JohnsonCookData out{.G = E / (2 * (1 + pr)), .K = E / (3 * (1 - 2 * pr)), .A = a, .B = b, .n = n, .C = c};
    if (heats()) {
      out.M = m, out.melting = tm - tr, out.heat = xsi / (ro * cp), out.warm = t0 - tr;
      out.expands = 3 * out.K * alpha;
      if (tc > 0) out.hottest = tc - t0;
    }
    out.voce = {JohnsonCookData::Voce{q1, c1}, JohnsonCookData::Voce{q2, c2}};
    out.rate = JohnsonCookData::Rate::above_1, out.of_plastic_rate = true;
    out.rate0 = e0dot > 0 ? e0dot : 1;
    if (flag2 == 1)
      out.critical_work = pd;
    else
      out.d = {d1, d2, d3, d4, d5}, out.threshold = pd;
    out.critical = dc, out.coupling = out.damages() ? beta : 0;
    if (tauc > 0) out.most_shear = tauc;
    return make_johnson_cook(ro, out);
  }
  void check(const Deck& deck, Diagnostics& diagnostics) const {
    const auto expect = expectations_of(*this, deck, diagnostics);
    expect(pr < 0.5, "PR", "a number < 0.5", pr,
           "a material that keeps its volume has no finite bulk modulus");
    expect(beta <= 1, "BETA", "a number from 0 to 1", beta, "1: damage weakens in full, 0: not at all");
    expect(flag2 == 0 || flag2 == 1, "FLAG2", "0 or 1", flag2, "0 Johnson and Cook, 1 Cockcroft and Latham");
    expect((c == 0 && d4 == 0) || e0dot > 0, "E0DOT", "a number > 0", e0dot,
           "C and D4 count rates against it");
    expect(flag2 == 0 || pd > 0, "PD/WC", "a number > 0", pd, "with FLAG2 1 the work per volume at fracture");
    expect(dc <= 1, "DC", "a number up to 1", dc, "1 is no strength");
    expect(xsi <= 1, "XSI", "a number from 0 to 1", xsi, "the share of plastic work that heats");
    if (!heats()) {
      expect(tc == 0, "TC", "0", tc, "without CP and XSI nothing heats");
      return;
    }
    expect(m > 0, "M", "a number > 0", m, "or leave CP blank: plastic work does not heat then");
    expect(tm > tr, "TM", "a number above TR", tm, "or leave CP blank: plastic work does not heat then");
    expect(tc == 0 || tc > t0, "TC", "a number above T0", tc, "the material would fail at once");
  }
};

// By hand. E = 2.5, PR = 1/4: lambda = G = 1, K = 5/3; dt = 1/2. Pulled by dev e = (2, -1, -1): q = 6. A = 1,
// C = 1, E0DOT = 1: 6 - 3 de = 1 + 2 de: de = 1, q = 3. D1 = 4, PD = 1/5, DC = 1/2: D = 1/2 0.8/3.8 = 2/19.
// Cockcroft and Latham: s1 = 2, WC = 8: D = 1/4. Voce: Q1 = 2 with C1 = ln 2 at de = 1: A + 1; A = 2: 3.
// Heated with RO = 2, CP = 3, XSI = 1/2: by q de/12: A = 3, C = 0: de = 1, q = 3: 1/4. ALPHA = 0.1: mean = -5
// 0.1/4.
const std::array<Real, 6> pulled_by_2{2, -1, -1}, left_of_it{2, -1, -1};
constexpr Real log_of_2 = 0.69314718055994531;
const std::string iron = "1,2.0,2.5,0.25";
StrengthReference flows_to(const std::string& cards, const std::array<Real, 6>& after,
                           std::vector<Real> history) {
  return {cards, pulled_by_2, {}, after, {0}, std::move(history)};
}
using ModifiedJohnsonCookCard = MatModifiedJohnsonCook;
const RegisterStrength<ModifiedJohnsonCookCard> mat_modified_johnson_cook{
    "q = sqrt(3/2 s:s) <= (A + B e^N + Q1 (1 - exp(-C1 e)) + Q2 (1 - exp(-C2 e))) (1 + rate/E0DOT)^C (1 - "
    "T*^M), of the "
    "stress over 1 - BETA D; dT = XSI q de/(RO CP); dD = DC de/(e_f - PD) where e > PD, e_f = (D1 + D2 "
    "exp(D3 mean/q)) (1 "
    "+ rate/E0DOT)^D4 (1 + D5 T*), or max(s1, 0) de/WC; fails at D = DC, T = TC or the shear stress TAUC",
    "Borvik, Hopperstad, Berstad & Langseth 2001; Cockcroft & Latham 1968",
    {flows_to(iron + "\n1.0\n1.0,0.0,0.0,1.0\n\n0.5,0.2,4.0\n", left_of_it, {1, 2.0 / 19}),
     flows_to(iron + "\n1.0,,,,0,1\n1.0,0.0,0.0,1.0\n\n1.0,8.0\n", left_of_it, {1, 0.25}),
     flows_to(iron + fmt::format("\n\n2.0\n2.0,{:.16g}\n\n", log_of_2), left_of_it, {1}),
     flows_to(iron + ",0.0,0.5,3.0,0.1\n0.0,0.0,1e9\n3.0,0.0,0.0,0.0,1.0\n\n\n", {2 - 0.125, -1.125, -1.125},
              {1, 0.25})},
    mat_modified_johnson_cook_table()};

}  // namespace

/// PD/WC is a work with FLAG2 1.
std::string convert_work(MatModifiedJohnsonCookFields& card, const Conversion& conversion) {
  if (card.flag2 == 1) card.pd *= conversion.units.of("M/LT2");
  return "";
}

}  // namespace courant
