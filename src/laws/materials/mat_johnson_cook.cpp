#include <fmt/format.h>

#include "keyword/expectations.hpp"
#include "laws/materials/strength_cards.hpp"
#include "laws/strength/johnson_cook.hpp"

namespace courant {

namespace {

struct MatJohnsonCook : MatJohnsonCookFields {
  static constexpr bool deviator_only = true;

  std::shared_ptr<StrengthLaw> law() const {
    JohnsonCookData out{.G = G, .A = a, .B = b, .n = n, .C = c};
    if (cp > 0) out.M = m, out.melting = tm - tr, out.heat = 1 / (ro * cp);
    out.rate0 = epso > 0 ? epso : 1, out.second = c2;
    out.rate = static_cast<JohnsonCookData::Rate>(static_cast<int>(rateop));
    if (c == 0 && rateop != 1) out.rate = JohnsonCookData::Rate::log_linear;
    out.of_plastic_rate = vp == 1;
    out.d = {d1, d2, d3, d4, d5}, out.least_fracture = efmin, out.keeps_elements = erod != 0;
    out.spall = {static_cast<int>(spall), Spall::limit_of(pc)};
    return make_johnson_cook(ro, out);
  }
  void check(const Deck& deck, Diagnostics& diagnostics) const {
    const auto expect = expectations_of(*this, deck, diagnostics);
    expect(vp == 0 || vp == 1, "VP", "0 or 1", vp, "1: the rate is that of plastic strain");
    expect(rateop == 0 || rateop == 1 || rateop == 2 || rateop == 3, "RATEOP", "0, 1, 2 or 3", rateop,
           "0 log-linear, 1 log-quadratic, 2 power, 3 Cowper and Symonds");
    expect(spall == 1 || spall == 2 || spall == 3, "SPALL", "1, 2 or 3", spall,
           "1 limits the pressure, 2 and 3 spall");
    const bool cowper_symonds = rateop == 3 && c != 0;
    expect(!cowper_symonds || c2 > 0, "C2/P", "a number > 0", c2, "with RATEOP 3 it is the P of the rate");
    const bool logs = (c != 0 && rateop != 3) || (rateop == 1 && c2 != 0) || d4 != 0;
    expect(!logs || epso > 0, "EPSO", "a number > 0", epso, "C, C2 and D4 count from this rate of strain on");
    if (!(cp > 0)) return;
    expect(m > 0, "M", "a number > 0", m, "or leave CP blank: plastic work does not heat then");
    expect(tm > tr, "TM", "a number above TR", tm, "or leave CP blank: plastic work does not heat then");
  }
};

using J = MatJohnsonCook;

// By hand. G = 1, A = 3, B = 2, N = 1: shear from rest s_xy = 2 G e = 4, q = 4 sqrt(3): as linear hardening,
// de = (4 sqrt(3) - 3)/5. Rate (dt = 1/2): s_xy = 4 sqrt(3), q = 12, D_xy = 4 sqrt(3), rate 2 D/sqrt(3) = 8 =
// EPSO e^2, so that with C = 1/2 R = 2: A = 3, B = 0: q = 6, s_xy = 2 sqrt(3), de = 2. With CP and RO = 2, CP
// = 3: heated by 6 . 2/6 = 2. Damage: D1 = 4: 2/4 = 1/2. T* = 1/2 (TM - TR = 4, heated 2), M = 1: A = 6 gives
// 3, as C = 0.
const RegisterStrength<J> mat_johnson_cook{
    "q = sqrt(3/2 s:s) <= (A + B e^N) (1 + C ln max(rate/EPSO, 1)) (1 - T*^M), T* = (T - TR)/(TM - TR), dT = "
    "q de/(RO "
    "CP); damage D += de/e_f, e_f = (D1 + D2 exp(-D3 p/q)) (1 + D4 ln max(rate/EPSO, 1)) (1 + D5 T*) >= "
    "EFMIN, fails "
    "at D = 1",
    "Johnson & Cook 1983, 1985",
    {{"1,2.0,1.0\n3.0,2.0,1.0\n\n\n",
      {0, 0, 0, 2, 0, 0},
      {},
      {0, 0, 0, 4 - 1.7320508075688772 * 0.7856406460551018, 0, 0},
      {0},
      {0.7856406460551018}},
     {"1,2.0,1.0\n3.0,,,0.5,1.0,1e9,0.0,0.5413411329464508\n3.0,,,,4.0\n\n",
      {0, 0, 0, 3.4641016151377544, 0, 0},
      {},
      {0, 0, 0, 3.4641016151377544, 0, 0},
      {0, 0, 0},
      {2, 2, 0.5}},
     {"1,2.0,1.0\n6.0,,,,1.0,7.0,3.0\n3.0,,,,\n\n",
      {0, 0, 0, 3.4641016151377544, 0, 0},
      {},
      {0, 0, 0, 1.7320508075688772, 0, 0},
      {0, 2},
      {3, 3.5}}},
    mat_johnson_cook_table()};

}  // namespace

/// C of Cowper and Symonds is a rate.
std::string convert_rate(MatJohnsonCookFields& card, const Conversion& conversion) {
  if (card.rateop == 3) card.c *= conversion.units.of("1/T");
  return "";
}

}  // namespace courant
