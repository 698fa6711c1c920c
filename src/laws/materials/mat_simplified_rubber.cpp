// Rubber by curves of a tensile test: *MAT_SIMPLIFIED_RUBBER/FOAM.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "laws/materials/strength_cards.hpp"
#include "laws/strength/curves_over_rate.hpp"
#include "laws/strength/stretch_rubber.hpp"

namespace courant {

namespace {

struct MatSimplifiedRubber : MatSimplifiedRubberFields {
  std::shared_ptr<StrengthLaw> law(const Model& model) const;
  void check(const Deck& deck, const Model& model, Diagnostics& diagnostics) const;
};

/// Of one curve s(e) of nominal stress over nominal strain of rubber that keeps its volume: f(l) with l s(l -
/// 1) = f(l) - f(l^(-1/2)), so f(l) = sum over k of m s(m - 1), m = l^((-1/2)^k); and df/d ln l.
struct TabulatedForce {
  Real f = 0, slope = 0;
  /// `x`: ln l.
  TabulatedForce(const StraightPieces& s, Real x) {
    constexpr Real small = 1e-3;  // below, m s(m - 1) is E (x + 3/2 x^2), and the rest of the sum is known
    Real factor = 1;              // d of the argument by x
    for (; std::abs(x) > small; x *= -0.5, factor *= -0.5) {
      const Real m = std::exp(x), stress = s(m - 1), E = s.steepest(m - 1, m - 1);
      f += m * stress, slope += factor * (m * stress + m * m * E);
    }
    constexpr Real tiny = 1e-12;
    const Real up = s.steepest(tiny, tiny), down = s.steepest(-tiny, -tiny);
    const Real mine = x > 0 ? up : down, other = x > 0 ? down : up;
    f += x * (4 * mine - 2 * other) / 3 + x * x * (16 * mine + 4 * other) / 10;
    slope += factor * ((4 * mine - 2 * other) / 3 + x * (16 * mine + 4 * other) / 5);
  }
};

/// sigma_i = (f(l_i) - mean of f)/J + KM (1 - 1/J), l without the change of volume: as of Ogden, whose sums
/// are f (Kolling, Du Bois, Benson & Feng 2007). With a table f goes straight from rate to rate.
class SimplifiedRubber : public StrengthLaw {
 public:
  SimplifiedRubber(const MatSimplifiedRubber& card, const Model& model)
      : K_(card.km),
        curves_(model, card.tbid, card.sgl, card.sw * card.st),
        tension_(static_cast<int>(card.tension)),
        engineering_(card.rtype == 1) {
    ro = card.ro;
  }
  Real bulk_modulus() const override { return K_; }
  Real shear_modulus() const override { return curves_.steepest_at_0() / 3; }
  std::vector<HistoryVariable> history() const override {
    std::vector<HistoryVariable> out{left_cauchy_green};
    if (curves_.has_rates()) out.push_back({"mean_rate", "1/T"});
    return out;
  }
  bool stiffens() const override { return true; }

  void update(const PointBlock& block) const override {
    for (Index i = 0; i < block.count; ++i) {
      if (curves_.has_rates() && block.dt > 0) {
        Real& mean = block.history[6][i];
        mean += weight_of_step * (rate_of(block, i) - mean);
      }
      const Real rate = curves_.has_rates() ? block.history[6][i] : 0;
      answer_stretches(block, i, K_, ro, [&](const Vec& l) { return forces(l, rate); });
    }
  }

 private:
  PrincipalForces forces(const Vec& l, Real rate) const {
    Vec f, slope;
    for (int k = 0; k < 3; ++k) {
      const Real x = std::log(l[k]);
      f[k] = curves_.between(rate, [&](std::size_t c) { return TabulatedForce(curves_.curves[c], x).f; });
      slope[k] =
          curves_.between(rate, [&](std::size_t c) { return TabulatedForce(curves_.curves[c], x).slope; });
    }
    const Vec first = f - Vec::Constant(f.mean());
    return {first, (slope + Vec::Constant(slope.mean())) / 3 - first};
  }

  /// The principal rate that is largest in size; 0 where TENSION lets rates not count.
  Real rate_of(const PointBlock& block, Index i) const {
    Matrix D, b;
    const auto& d = block.rate;
    const auto& h = block.history;
    D << d[0][i], d[3][i], d[5][i], d[3][i], d[1][i], d[4][i], d[5][i], d[4][i], d[2][i];
    b << 1 + h[0][i], h[3][i], h[5][i], h[3][i], 1 + h[1][i], h[4][i], h[5][i], h[4][i], 1 + h[2][i];
    const Eigen::SelfAdjointEigenSolver<Matrix> of_rate(D), of_b(b);
    int most = 0;
    of_rate.eigenvalues().cwiseAbs().maxCoeff(&most);
    const Vec n = of_rate.eigenvectors().col(most);
    const Real fastest = of_rate.eigenvalues()[most], stretch2 = n.dot(b * n);
    if (tension_ < 1) {
      // loading: what is longest or shortest gets more so
      const Vec x = of_b.eigenvalues().array().log();
      Vec deviator = x - Vec::Constant(x.mean());
      int far = 0;
      deviator.cwiseAbs().maxCoeff(&far);
      const Vec axis = of_b.eigenvectors().col(far);
      const bool loads = deviator[far] * axis.dot(D * axis) > 0;
      if (!loads || (tension_ == 0 && deviator[far] > 0)) return 0;
    }
    return std::abs(fastest) * (engineering_ ? std::sqrt(stretch2) : 1);
  }

  Real K_;
  CurvesOverRate curves_;
  int tension_;       ///< TENSION
  bool engineering_;  ///< RTYPE 1
};

std::shared_ptr<StrengthLaw> MatSimplifiedRubber::law(const Model& model) const {
  return std::make_shared<SimplifiedRubber>(*this, model);
}

void MatSimplifiedRubber::check(const Deck& deck, const Model& model, Diagnostics& diagnostics) const {
  const auto one_of = [&](const char* field, Real value, std::initializer_list<Real> values,
                          const char* hint) {
    if (std::find(values.begin(), values.end(), value) == values.end())
      deck.error(diagnostics, *this, field, fmt::format("'{:g}' is not supported", value), hint);
  };
  one_of("TENSION", tension, {-1, 0, 1}, "-1, 0 or 1");
  one_of("RTYPE", rtype, {0, 1}, "0: rates of ln l; 1: of l");
  one_of("AVGOPT", avgopt, {0, 1}, "0 and 1: a mean over some twelve steps");
  one_of("HU", hu, {1}, "1: unloading loses nothing besides rates");
  constexpr Real standard_mu = 0.1;
  if (mu != standard_mu)
    deck.warning(diagnostics, *this, "MU",
                 "the viscous stress of the rubber is left out: stresses at high rates are lower",
                 "bulk viscosity (*CONTROL_BULK_VISCOSITY) and hourglass control act as on all solids");
  const int errors = diagnostics.errors();
  check_curves_over_rate(deck, model, *this, "LC/TBID", tbid, -sgl, diagnostics);
  if (diagnostics.errors() > errors) return;
  const CurvesOverRate curves(model, tbid);
  if (!(curves.steepest_at_0() > 0))
    deck.error(diagnostics, *this, "LC/TBID", "the curve does not rise at 0", "stress over strain");
  if (!(curves.begins < 0))
    deck.warning(diagnostics, *this, "LC/TBID",
                 "a curve has no compression: it goes on as straight as it begins",
                 "rubber that is pulled is compressed across: give strains below 0, too");
}

// By hand. D dt = 2/3 along all axes: A = 2, J = 8, l = 1: nothing but KM (1 - 1/J).
const RegisterStrength<MatSimplifiedRubber> mat_simplified_rubber{
    "sigma_i = (f(l_i) - mean f)/J + KM (1 - 1/J), f(l) = sum_k m s(m - 1), m = l^((-1/2)^k), l = J^(-1/3) "
    "stretch, s "
    "the nominal stress of the test",
    "Kolling, Du Bois, Benson & Feng 2007",
    {{"1,2.0,4.0\n1.0,1.0,1.0,5\n*DEFINE_CURVE\n5\n-0.9,-2.7\n1.0,3.0\n",
      {2.0 / 3, 2.0 / 3, 2.0 / 3},
      {},
      {3.5, 3.5, 3.5},
      {},
      {3, 3, 3, 0, 0, 0}}},
    mat_simplified_rubber_foam_table()};

}  // namespace

}  // namespace courant
