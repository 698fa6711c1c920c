#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "keyword/expectations.hpp"
#include "laws/materials/strength_cards.hpp"
#include "laws/strength/brittle_strength.hpp"

namespace courant {

namespace {

struct MatJohnsonHolmquistCeramics : MatJohnsonHolmquistCeramicsFields {
  std::shared_ptr<StrengthLaw> law() const;
  void check(const Deck& deck, Diagnostics& diagnostics) const;
};

/// JH-2: a strength between that of intact and of broken ceramic, and pressure by bulking where it breaks.
class Ceramic : public BrittleLaw {
 public:
  explicit Ceramic(const MatJohnsonHolmquistCeramics& card)
      : BrittleLaw(card.ro, card.g, card.fs, {"bulking_pressure", "M/LT2"}),
        card_(card),
        pressure_{card.k1, card.k2, card.k3},
        elastic_limit_(1.5 * (card.hel - card.phel)) {}
  Real bulk_modulus() const override { return card_.k1; }
  void update(const PointBlock& block) const override {
    PlasticTrial trial;
    const auto& D = block.rate;
    go_elastically(0, card_.g, block, FixedCentre{}, trial);
    for (Index i = 0; i < block.count; ++i) {
      Real &plastic = block.history[0][i], &volume = block.history[1][i], &damage = block.history[2][i],
           &bulking = block.history[3][i];
      volume += block.dt * (D[0][i] + D[1][i] + D[2][i]);
      const Real mu = std::expm1(-volume), elastic = mu > 0 ? pressure_(mu) : card_.k1 * mu;
      const Real rate = rate_factor_of(card_.c, card_.epsi, block, i);
      const Real p = std::max(elastic + bulking, -card_.t * (1 - damage));
      if (elastic + bulking < -card_.t) block.history[4][i] = 1;
      const Real now = strength(p, damage, rate);
      const Real flown = return_to(card_.g, now, p, trial.q[i], block, i);
      if (flown > 0) {
        plastic += flown;
        const Real before = damage;
        damage = std::min(damage + flown / fracture_strain(p), Real(1));
        if (card_.beta > 0 && mu > 0 && damage > before)
          bulking += more_bulking(elastic + bulking, now, strength(p, damage, rate));
      }
      const Real slope = mu > 0 ? pressure_.slope(mu) : card_.k1;
      block.sound_speed[i] = brittle_speed(block, i, std::max(slope, card_.k1), mu, card_.g, ro);
    }
  }

 private:
  /// [M/LT2]
  Real strength(Real p, Real damage, Real rate) const {
    const Real P = p / card_.phel, T = card_.t / card_.phel;
    const Real intact = card_.a * (P + T > 0 ? std::pow(P + T, card_.n) : 0) * rate;
    const Real broken =
        damage > 0 ? std::min(card_.b * (P > 0 ? std::pow(P, card_.m) : 0) * rate, card_.sfmax) : 0;
    return elastic_limit_ * std::max(intact - damage * (intact - std::min(broken, intact)), Real(0));
  }
  /// 0 where nothing but flow is missing: the point breaks at once. [-]
  Real fracture_strain(Real p) const {
    const Real sum = (p + card_.t) / card_.phel;
    return sum > 0 ? card_.d1 * std::pow(sum, card_.d2) : 0;
  }
  /// BETA of the elastic energy of shear that is lost becomes energy of pressure: with p = K1 mu + bulking,
  /// p'^2 = p^2 + 2 BETA K1 dU, U = strength^2/(6 G). [M/LT2]
  Real more_bulking(Real p, Real before, Real after) const {
    const Real lost = (before * before - after * after) / (6 * card_.g);
    return std::sqrt(p * p + 2 * card_.beta * card_.k1 * std::max(lost, Real(0))) - p;
  }

  MatJohnsonHolmquistCeramics card_;
  CubicPressure pressure_;
  Real elastic_limit_;  ///< of the deviator at HEL [M/LT2]
};

std::shared_ptr<StrengthLaw> MatJohnsonHolmquistCeramics::law() const {
  return std::make_shared<Ceramic>(*this);
}

void MatJohnsonHolmquistCeramics::check(const Deck& deck, Diagnostics& diagnostics) const {
  const auto expect = expectations_of(*this, deck, diagnostics);
  expect(hel > phel, "HEL", "a number above PHEL", hel,
         "their difference times 3/2 is the effective stress by which strengths are scaled");
  expect(c == 0 || epsi > 0, "EPSI", "a number > 0", epsi, "C counts from this rate of strain on");
  expect(beta <= 1, "BETA", "a number from 0 to 1", beta,
         "the share of the elastic energy of shear that is lost");
}

// By hand. G = 1, K1 = 5/3; HEL 5, PHEL 3: strengths times 3; T = 3: T* = 1. Pressure 0 (shear without a
// change of volume): intact 1 by A = 1, N = 1: 3. dev e = (2, -1, -1): q = 6: de = 1, s half. D1 = 4, D2 = 1:
// e_f = 4: D = 1/4. Rate (dt = 1/2) 4 = EPSI e^2, C = 1/2: twice that, q = 6: nothing flows. Compressed to mu
// = 1 (ln V = -ln 2 in one direction): p = K1 + K2 + K3 = 5/3 + 1/3 + 1 = 3: P* = 1, intact 2 -> 6; q = 2 ln
// 2: elastic.
const std::string ceramic_card =
    "1,2.0,1.0,1.0,0.5,0.0,1.0,1.0\n1.0,3.0,1.0,5.0,3.0\n4.0,1.0,1.6666666666666667,";
constexpr Real ln2 = 0.69314718055994531;
const RegisterStrength<MatJohnsonHolmquistCeramics> mat_johnson_holmquist_ceramics{
    "p = K1 mu + K2 mu^2 + K3 mu^3 + bulking >= -T (1 - D), K1 mu in tension; q <= 3/2 (HEL - PHEL) (i - D "
    "(i - b)), "
    "i = A (P + T)^N R, b = B P^M R <= SFMAX, P and T over PHEL, R = 1 + C ln max(rate/EPSI, 1); dD = de/(D1 "
    "(P + "
    "T)^D2)",
    "Johnson & Holmquist 1994 (JH-2)",
    {{ceramic_card + "0.0,0.0\n", {2, -1, -1}, {}, {2, -1, -1}, {0, 0, 0}, {1, 0, 0.25}},
     {"1,2.0,1.0,1.0,0.5,0.5,1.0,1.0\n0.5413411329464508,3.0,1.0,5.0,3.0\n4.0,1.0,1.6666666666666667,0.0,0."
      "0\n",
      {2, -1, -1},
      {},
      {4, -2, -2},
      {0, 0, 0},
      {0, 0, 0}},
     {ceramic_card + "0.3333333333333333,1.0\n",
      {-ln2, 0, 0},
      {},
      {-3 - 4 * ln2 / 3, -3 + 2 * ln2 / 3, -3 + 2 * ln2 / 3},
      {0, 0, 0},
      {0, -ln2, 0}}},
    mat_johnson_holmquist_ceramics_table()};

}  // namespace

}  // namespace courant
