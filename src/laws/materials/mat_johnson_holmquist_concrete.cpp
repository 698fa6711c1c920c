#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "keyword/expectations.hpp"
#include "laws/materials/strength_cards.hpp"
#include "laws/strength/brittle_strength.hpp"
#include "laws/strength/root_below.hpp"

namespace courant {

namespace {

struct MatJohnsonHolmquistConcrete : MatJohnsonHolmquistConcreteFields {
  CubicPressure dense() const { return {k1, k2, k3}; }
  /// Where the line that crushes meets the curve of the dense material, as (mu - UL)/(1 + UL). [-]
  Real locked() const {
    const CubicPressure curve = dense();
    Real high = pl / k1;
    for (int k = 0; k < 60 && curve(high) < pl; ++k) high *= 2;
    return root_below(high, [&](Real x) { return pl - curve(x); });
  }
  std::shared_ptr<StrengthLaw> law() const;
  void check(const Deck& deck, Diagnostics& diagnostics) const;
};

/// Concrete that is crushed for good: its pressure is elastic up to PC, then straight to PL, then that of the
/// dense material; back it goes by a slope between.
class Concrete : public BrittleLaw {
 public:
  explicit Concrete(const MatJohnsonHolmquistConcrete& card)
      : BrittleLaw(card.ro, card.g, card.fs, {"largest_compression", "-"}),
        card_(card),
        dense_(card.dense()),
        elastic_(card.pc / card.uc),
        locks_(card.ul + card.locked() * (1 + card.ul)) {}
  Real bulk_modulus() const override { return elastic_; }
  void update(const PointBlock& block) const override {
    PlasticTrial trial;
    const auto& D = block.rate;
    go_elastically(0, card_.g, block, FixedCentre{}, trial);
    for (Index i = 0; i < block.count; ++i) {
      Real &plastic = block.history[0][i], &volume = block.history[1][i], &damage = block.history[2][i],
           &largest = block.history[3][i];
      volume += block.dt * (D[0][i] + D[1][i] + D[2][i]);
      const Real mu = std::expm1(-volume), before = residual(largest);
      largest = std::max(largest, mu);
      const Pressure at = pressure(mu, largest);
      const Real p = std::max(at.p, -card_.t * (1 - damage));
      if (at.p < -card_.t) block.history[4][i] = 1;
      const Real now = strength(p, damage, rate_factor_of(card_.c, card_.eps0, block, i));
      const Real flown = return_to(card_.g, now, p, trial.q[i], block, i);
      plastic += flown;
      if (const Real more = flown + residual(largest) - before; more > 0)
        damage = std::min(damage + more / fracture_strain(p), Real(1));
      block.sound_speed[i] = brittle_speed(block, i, at.slope, mu, card_.g, ro);
    }
  }

 private:
  struct Pressure {
    Real p, slope;  ///< slope: the steepest of loading and unloading there [M/LT2]
  };
  /// Of first loading. [M/LT2]
  Pressure loading(Real mu) const {
    if (mu <= card_.uc) return {elastic_ * mu, elastic_};
    if (mu <= locks_) {
      const Real slope = (card_.pl - card_.pc) / (locks_ - card_.uc);
      return {card_.pc + slope * (mu - card_.uc), slope};
    }
    const Real x = (mu - card_.ul) / (1 + card_.ul);
    return {dense_(x), dense_.slope(x) / (1 + card_.ul)};
  }
  /// Slope of unloading from the largest compression. [M/LT2]
  Real unloading(Real largest) const {
    const Real share = std::clamp((largest - card_.uc) / (locks_ - card_.uc), Real(0), Real(1));
    return (1 - share) * elastic_ + share * card_.k1;
  }
  Pressure pressure(Real mu, Real largest) const {
    const Real back = unloading(largest);
    const Pressure top = loading(largest);
    return {top.p - back * (largest - mu), mu < largest ? back : std::max(back, top.slope)};
  }
  /// What is left of a compression without pressure. [-]
  Real residual(Real largest) const {
    return largest > card_.uc ? largest - loading(largest).p / unloading(largest) : 0;
  }
  /// [M/LT2]
  Real strength(Real p, Real damage, Real rate) const {
    const Real P = p / card_.fc;
    const Real of_pressure = P > 0 ? card_.b * std::pow(P, card_.n) : 0;
    // in tension down to 0 at -T (1 - D)
    const Real left = card_.t * (1 - damage), kept = p < 0 ? (left > 0 ? 1 + p / left : 0) : 1;
    return card_.fc *
           std::min((card_.a * (1 - damage) * std::max(kept, Real(0)) + of_pressure) * rate, card_.sfmax);
  }
  /// [-]
  Real fracture_strain(Real p) const {
    const Real sum = (p + card_.t) / card_.fc;
    return std::max(sum > 0 ? card_.d1 * std::pow(sum, card_.d2) : 0, card_.efmin);
  }

  MatJohnsonHolmquistConcrete card_;
  CubicPressure dense_;
  Real elastic_;  ///< bulk modulus before it is crushed [M/LT2]
  Real locks_;    ///< compression from which on it is dense [-]
};

std::shared_ptr<StrengthLaw> MatJohnsonHolmquistConcrete::law() const {
  return std::make_shared<Concrete>(*this);
}

void MatJohnsonHolmquistConcrete::check(const Deck& deck, Diagnostics& diagnostics) const {
  const auto expect = expectations_of(*this, deck, diagnostics);
  expect(pl > pc, "PL", "a number above PC", pl, "from PC to PL concrete is crushed");
  expect(ul > uc, "UL", "a number above UC", ul, "the compression of the dense material without pressure");
  expect(c == 0 || eps0 > 0, "EPS0", "a number > 0", eps0, "C counts from this rate of strain on");
  expect(k1 > pc / uc, "K1", "a number above PC/UC", k1, "the dense material is stiffer than the porous one");
}

// By hand. G = 1; PC = 5/3, UC = 1: elastic K = 5/3. FC = 2, A = 1, B = 2, N = 1, SFMAX 10, T = 2. At
// pressure 0 the strength is 2: dev e = (2, -1, -1): q = 6: de = 4/3, s a third. D1 = 4, D2 = 1: e_f = 4 (0 +
// 1): D = 1/3. EFMIN above that: 8: D = 1/6. Rate (dt = 1/2) 4 = EPS0 e^2, C = 1: three times that: 6,
// nothing flows. Compressed to mu = 2 (ln V = -ln 3): PL = 5, UL = 1.5 (1 + UL = 2.5), K1 = 5 (K2 = K3 = 0):
// dense at x = 1, mu = 4: the line has the slope 10/9: p = 5/3 + 10/9 = 25/9. Unloads by (2/3) 5/3 + (1/3) 5
// = 25/9, so that 1 of mu = 2 is left; strength 2 (1 + 2 25/18), q = 2 ln 3 below it; e_f = 4 (25/18 + 1) =
// 86/9: D = 9/86.
constexpr Real ln3 = 1.0986122886681098;
const std::string concrete_head = "1,2.0,1.0,1.0,2.0,",
                  concrete_middle = "10.0,1.6666666666666667,1.0,5.0,1.5\n4.0,1.0,5.0\n";
const RegisterStrength<MatJohnsonHolmquistConcrete> mat_johnson_holmquist_concrete{
    "p: elastic to PC at UC, straight to PL, then K1 x + K2 x^2 + K3 x^3, x = (mu - UL)/(1 + UL), back by "
    "slopes "
    "between; p >= -T (1 - D); q <= FC (A (1 - D) + B (p/FC)^N) (1 + C ln max(rate/EPS0, 1)) <= FC SFMAX, in "
    "tension "
    "A (1 - D) (1 + p/(T (1 - D))); dD = (de + dmu_p)/max(D1 ((p + T)/FC)^D2, EFMIN)",
    "Holmquist, Johnson & Cook 1993",
    {{concrete_head + "0.0,1.0,2.0\n2.0,1.0,0.01," + concrete_middle,
      {2, -1, -1},
      {},
      {4.0 / 3, -2.0 / 3, -2.0 / 3},
      {0, 0, 0},
      {4.0 / 3, 0, 1.0 / 3}},
     {concrete_head + "0.0,1.0,2.0\n2.0,1.0,8.0," + concrete_middle,
      {2, -1, -1},
      {},
      {4.0 / 3, -2.0 / 3, -2.0 / 3},
      {0, 0, 0},
      {4.0 / 3, 0, 1.0 / 6}},
     {concrete_head + "1.0,1.0,2.0\n2.0,0.5413411329464508,0.01," + concrete_middle,
      {2, -1, -1},
      {},
      {4, -2, -2},
      {0, 0, 0},
      {0, 0, 0}},
     {concrete_head + "0.0,1.0,2.0\n2.0,1.0,0.01," + concrete_middle,
      {-ln3, 0, 0},
      {},
      {-25.0 / 9 - 4 * ln3 / 3, -25.0 / 9 + 2 * ln3 / 3, -25.0 / 9 + 2 * ln3 / 3},
      {0, 0, 0, 0},
      {0, -ln3, 9.0 / 86, 2}}},
    mat_johnson_holmquist_concrete_table()};

}  // namespace

}  // namespace courant
