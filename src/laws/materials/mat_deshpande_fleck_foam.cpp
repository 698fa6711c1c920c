#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "laws/materials/strength_cards.hpp"
#include "laws/strength/radial_return.hpp"
#include "laws/strength/strength.hpp"

namespace courant {

namespace {

struct MatDeshpandeFleckFoam : MatDeshpandeFleckFoamFields {
  std::shared_ptr<StrengthLaw> law() const;
  void check(const Deck& deck, Diagnostics& diagnostics) const;
};

/// Metal foam: its volume shrinks as it flows. With k = de/(A^2 Q), A^2 = 1 + (ALPHA/3)^2, the associated
/// flow leaves s = s_tr/(1 + 3 G k), mean = mean_tr/(1 + K ALPHA^2 k).
class DeshpandeFleck : public StrengthLaw {
 public:
  explicit DeshpandeFleck(const MatDeshpandeFleckFoam& card)
      : card_(card),
        K_(card.E / (3 * (1 - 2 * card.pr))),
        G_(card.E / (2 * (1 + card.pr))),
        shape_(card.alpha * card.alpha) {
    ro = card.ro;
  }
  Real bulk_modulus() const override { return K_; }
  Real shear_modulus() const override { return G_; }
  bool in_sheets() const override { return false; }
  std::vector<HistoryVariable> history() const override {
    return {{"plastic_strain", "-"}, {"logarithmic_volume", "-"}};
  }
  std::string failure_variable() const override { return "logarithmic_volume"; }
  Real failure_limit() const override {
    return card_.cfail > 0 && card_.cfail < never_fails ? card_.cfail : std::numeric_limits<Real>::infinity();
  }

  void update(const PointBlock& block) const override {
    PlasticTrial trial;
    const auto& D = block.rate;
    const auto& s = block.stress;
    go_elastically(K_ - 2 * G_ / 3, G_, block, FixedCentre{}, trial);
    for (Index i = 0; i < block.count; ++i) {
      block.history[1][i] += block.dt * (D[0][i] + D[1][i] + D[2][i]);
      flow(block, i, trial.q[i], (s[0][i] + s[1][i] + s[2][i]) / 3);
    }
    keep_stiffness(block, sound_speed());
  }

 private:
  struct Yield {
    Real stress, slope;
  };
  /// SIGP + GAMMA x + ALPHA2 ln(1/(1 - x^BETA)), x = e/EPSD; infinite from EPSD on.
  Yield yield(Real e) const {
    const Real x = e / card_.epsd;
    if (!(x < 1)) return {std::numeric_limits<Real>::infinity(), 0};
    const Real power = x > 0 ? std::pow(x, card_.beta) : 0, left = 1 - power;
    return {card_.sigp + card_.gamma * x - card_.alpha2 * std::log(left),
            (card_.gamma + (x > 0 ? card_.alpha2 * card_.beta * power / (x * left) : 0)) / card_.epsd};
  }
  /// Q after flow by k, with -dQ/dk.
  struct Effective {
    Real stress, fall;
  };
  Effective effective(Real q, Real mean, Real k) const {
    const Real of_q = 1 / (1 + 3 * G_ * k), of_mean = 1 / (1 + K_ * shape_ * k), square = 1 + shape_ / 9;
    const Real s = q * q * of_q * of_q, m = shape_ * mean * mean * of_mean * of_mean;
    const Real stress = std::sqrt((s + m) / square);
    return {stress, stress > 0 ? (s * 3 * G_ * of_q + m * K_ * shape_ * of_mean) / (square * stress) : 0};
  }

  /// Newton's method for k between bounds of it.
  void flow(const PointBlock& block, Index i, Real q, Real mean) const {
    constexpr int most_rounds = 200;
    constexpr Real close = 1e-14;
    Real& plastic = block.history[0][i];
    const Real square = 1 + shape_ / 9, old = plastic, first = yield(old).stress;
    if (!(effective(q, mean, 0).stress > first)) return;
    const Real slower = shape_ > 0 ? std::min(3 * G_, K_ * shape_) : 3 * G_;
    Real low = 0, high = (effective(q, mean, 0).stress / first - 1) / slower, k = 0;
    for (int round = 0; round < most_rounds; ++round) {
      const Effective now = effective(q, mean, k);
      const Real e = k * square * now.stress;
      const Yield y = yield(old + e);
      const Real over = now.stress - y.stress;
      (over > 0 ? low : high) = k;
      plastic = old + e;
      if (std::abs(over) < close * y.stress || !(high - low > close * high)) break;
      const Real fall = now.fall + y.slope * square * (now.stress - k * now.fall);
      const Real next = std::isfinite(over) && fall > 0 ? k + over / fall : high;
      k = next > low && next < high ? next : 0.5 * (low + high);
    }
    const Real of_q = 1 / (1 + 3 * G_ * k), of_mean = mean * (1 / (1 + K_ * shape_ * k) - of_q);
    for (std::size_t c = 0; c < 6; ++c)
      block.stress[c][i] = of_q * block.stress[c][i] + (c < 3 ? of_mean : 0);
  }

  MatDeshpandeFleckFoam card_;
  Real K_, G_;  ///< [M/LT2]
  Real shape_;  ///< ALPHA^2 [-]
};

std::shared_ptr<StrengthLaw> MatDeshpandeFleckFoam::law() const {
  return std::make_shared<DeshpandeFleck>(*this);
}

void MatDeshpandeFleckFoam::check(const Deck& deck, Diagnostics& diagnostics) const {
  if (!(pr < 0.5))
    deck.error(diagnostics, *this, "PR", fmt::format("expected a number < 0.5, got '{:g}'", pr),
               "a material that keeps its volume has no finite bulk modulus");
  // of a ratio nu of plastic strains ALPHA^2 = 9/2 (1 - 2 nu)/(1 + nu)
  constexpr Real most = 4.5;
  if (alpha * alpha > most)
    deck.warning(diagnostics, *this, "ALPHA",
                 fmt::format("'{:g}' lets bars grow thinner where they are crushed", alpha),
                 "sqrt(4.5) is a foam that keeps its width, 0 one that keeps its volume");
}

// By hand. E = 2.5, PR = 1/4: lambda = G = 1, K = 5/3. ALPHA = 3: A^2 = 2. Crushed evenly by e = -0.6 in each
// direction: mean = -3, Q = 3 3/sqrt(2). 1 + 15 k for the mean: k = 1/15 halves it. Q = 4.5/sqrt(2) = 9/(2
// sqrt(2)), de = k 2 Q = 3/(5 sqrt(2)) = 0.3 sqrt(2). Yield stress SIGP + GAMMA e/EPSD with EPSD = 3 sqrt(2):
// SIGP
// + 0.1 GAMMA is that Q where GAMMA is Q and SIGP 0.9 Q. In shear alone with ALPHA = 0: as J2.
const RegisterStrength<MatDeshpandeFleckFoam> mat_deshpande_fleck_foam{
    "Q <= SIGP + GAMMA e/EPSD + ALPHA2 ln(1/(1 - (e/EPSD)^BETA)), Q^2 = (q^2 + ALPHA^2 mean^2)/(1 + "
    "(ALPHA/3)^2); "
    "plastic strain along its normal, e its work over Q",
    "Deshpande & Fleck 2000; Hanssen et al. 2002",
    {{"1,2.0,2.5,0.25,3.0,3.1819805153394642\n4.242640687119285,0.0,1.0,2.8637824638055176\n",
      {-0.6, -0.6, -0.6},
      {},
      {-1.5, -1.5, -1.5},
      {0, 0},
      {0.42426406871192851, -1.8}},
     {"1,2.0,2.5,0.25,0.0,0.0\n10.0,0.0,1.0,3.0\n", {2, -1, -1}, {}, {2, -1, -1}, {0, 0}, {1, 0}}},
    mat_deshpande_fleck_foam_table()};

}  // namespace

}  // namespace courant
