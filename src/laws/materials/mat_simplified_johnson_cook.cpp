#include <fmt/format.h>

#include "laws/materials/strength_cards.hpp"
#include "laws/strength/johnson_cook.hpp"

namespace courant {

namespace {

struct MatSimplifiedJohnsonCook : MatSimplifiedJohnsonCookFields {
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
    mat_simplified_johnson_cook_table()};

}  // namespace

/// A blank EPSO is 1 in the units of its file.
std::string convert_blank_rate(MatSimplifiedJohnsonCookFields& card, const Conversion& conversion) {
  if (card.epso == 0) card.epso = conversion.units.of("1/T");
  return "";
}

}  // namespace courant
