#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "keyword/expectations.hpp"
#include "laws/failure/thinning_failure.hpp"
#include "laws/materials/mat_piecewise_linear_plasticity.hpp"
#include "laws/strength/hardening.hpp"
#include "laws/strength/isotropic_plasticity.hpp"
#include "laws/strength/strength.hpp"
#include "laws/strength/tabulated_yield.hpp"

namespace courant {

namespace {

using M = struct MatPiecewiseLinearPlasticity;
struct MatPiecewiseLinearPlasticity : MatPiecewiseLinearPlasticityFields {
  Hardening table() const {
    Hardening out{{eps1, eps2, eps3, eps4, eps5, eps6, eps7, eps8}, {es1, es2, es3, es4, es5, es6, es7, es8}};
    drop_blank_points(out);
    return out;
  }
  /// Without points where there is none; `check` tells.
  static Curve curve_of(const Model& model, Id id) {
    const auto found = model.curves.find(id);
    return found == model.curves.end() ? Curve() : found->second;
  }
  static Hardening of_curve(const Curve& curve) { return {curve.abscissa, curve.ordinate}; }
  static IndexedPieces pieces_of(const Hardening& points) { return {points.strain, points.stress}; }
  bool has_table(const Model& model) const { return lcss != 0 && model.tables.count(lcss) > 0; }
  /// _LOG_INTERPOLATION, of *MAT_PIECEWISE_LINEAR_PLASTICITY alone.
  bool by_logarithm() const { return name >= 2; }

  std::shared_ptr<StrengthLaw> law(const Model& model) const {
    TabulatedYield yield;
    if (has_table(model)) {
      const Table& t = model.tables.at(lcss);
      for (const Id id : t.curve) yield.curves.push_back(pieces_of(of_curve(curve_of(model, id))));
      yield.rates = t.value;
      yield.logarithmic = by_logarithm() || (!t.value.empty() && t.value.front() < 0);
      if (by_logarithm())
        for (Real& rate : yield.rates) rate = std::log(rate);
    } else {
      Hardening one = lcss != 0 ? of_curve(curve_of(model, lcss)) : table();
      if (lcss == 0 && one.strain.empty()) one = {{0, 1}, {sigy, sigy + E * etan / (E - etan)}};
      yield.curves.push_back(pieces_of(one));
      yield.rate_term.C = c, yield.rate_term.P = c > 0 ? p : 1;
      if (vp == 1) yield.added = sigy;
      if (lcsr != 0) {
        const Curve factor = curve_of(model, std::abs(lcsr));
        yield.factor = IndexedPieces(factor.abscissa, factor.ordinate, IndexedPieces::Beyond::constant);
      }
    }
    if (yield.curves.size() > 1 || c > 0 || lcsr != 0)
      yield.depends_on = vp == 0 ? YieldRate::of_flow_and_volume : YieldRate::of_flow;
    auto law = std::make_shared<IsotropicPlasticity<TabulatedYield>>(ro, E, pr, std::move(yield));
    if (fail > 0 && fail < never_fails) law->fails_at = fail;
    law->shortest_step = tdel;
    return law;
  }

  void check(const Deck& deck, const Model& model, Diagnostics& diagnostics) const;
  void check_curve(const Deck& deck, const Model& model, Id id, Diagnostics& diagnostics) const;
  void check_factor(const Deck& deck, const Model& model, Diagnostics& diagnostics) const;
};

void M::check_curve(const Deck& deck, const Model& model, Id id, Diagnostics& diagnostics) const {
  const auto found = model.curves.find(id);
  const auto fail = [&](const std::string& what, const char* hint) {
    deck.error(diagnostics, *this, "LCSS", what, hint);
  };
  if (found == model.curves.end())
    return fail(fmt::format("there is no curve or table {}", id),
                "add a *DEFINE_CURVE or *DEFINE_TABLE of yield stress over effective plastic strain");
  const Hardening points = of_curve(found->second);
  if (points.strain.size() < 2)
    return fail(fmt::format("curve {} has less than two points", id), "yield stress over plastic strain");
  for (std::size_t k = 0; k < points.strain.size(); ++k) {
    if (!(points.stress[k] > 0))
      return fail(fmt::format("curve {}: expected yield stresses > 0, got '{:g}' at point {}", id,
                              points.stress[k], k + 1),
                  "the first point is the yield stress without plastic strain");
    if (k == 0) continue;
    if (!(points.strain[k] > points.strain[k - 1]))
      return fail(fmt::format("curve {} jumps at plastic strain {:g}", id, points.strain[k]),
                  "plastic strains increase from point to point");
    if (const SteepestFall fall = steepest_fall(model, mid, E, pr); !(points.slope(k - 1) > fall.slope))
      return fail(fmt::format("curve {} behind point {}: {}", id, k, fall.too_fast), "");
  }
  if (points.strain.front() != 0)
    deck.warning(diagnostics, *this, "LCSS",
                 fmt::format("curve {} begins at a plastic strain of {:g}, not 0", id, points.strain.front()),
                 "abscissae are effective plastic strains, without the elastic part");
}

void M::check_factor(const Deck& deck, const Model& model, Diagnostics& diagnostics) const {
  if (lcsr == 0) return;
  const Curve factor = curve_of(model, std::abs(lcsr));
  const char* hint = "a *DEFINE_CURVE of the factor of the yield stress over the rate of strain";
  if (factor.abscissa.empty())
    deck.error(diagnostics, *this, "LCSR", fmt::format("curve {} does not exist", std::abs(lcsr)), hint);
  else if (*std::min_element(factor.ordinate.begin(), factor.ordinate.end()) <= 0)
    deck.error(diagnostics, *this, "LCSR",
               fmt::format("curve {} has factors that are not > 0", std::abs(lcsr)), hint);
  if (c > 0)
    deck.error(diagnostics, *this, "LCSR", "is given with C and P, which define the same",
               "give one of them");
}

void M::check(const Deck& deck, const Model& model, Diagnostics& diagnostics) const {
  const auto expect = expectations_of(*this, deck, diagnostics);
  expect(pr < 0.5, "PR", "a number < 0.5", pr, "a material that keeps its volume has no finite bulk modulus");
  expect(fail >= 0, "FAIL", "a number >= 0", fail, "failure by a subroutine of one's own is not supported");
  if (const Hardening points = table(); lcss == 0 && !points.strain.empty()) {
    check_points(deck, *this, points, steepest_fall(model, mid, E, pr), diagnostics);
  } else if (lcss == 0) {
    expect(sigy > 0, "SIGY", "a number > 0", sigy,
           "the yield stress comes from LCSS, from the table of EPS and ES, or from SIGY and ETAN");
    expect(etan < E, "ETAN", "a number below E", etan,
           "beyond the yield stress the material is softer than before");
  } else if (has_table(model)) {
    const Table& t = model.tables.at(lcss);
    if (t.of_tables)
      deck.error(diagnostics, *this, "LCSS", fmt::format("table {} is one of tables", lcss),
                 "give a table of curves, one for each rate of strain");
    else
      for (const Id id : t.curve) check_curve(deck, model, id, diagnostics);
    if (c > 0 || lcsr != 0)
      deck.warning(diagnostics, *this, c > 0 ? "C" : "LCSR", "does nothing beside a table of rates");
    if (by_logarithm() && !t.value.empty() && !(t.value.front() > 0))
      deck.error(
          diagnostics, *this, "LCSS",
          fmt::format("table {} begins at a rate of {:g}, which has no logarithm", lcss, t.value.front()),
          "with _LOG_INTERPOLATION rates are > 0; without it a table may be over logarithms, the first < 0");
  } else {
    check_curve(deck, model, lcss, diagnostics);
  }
  if (by_logarithm() && !has_table(model))
    deck.warning(diagnostics, *this, "LCSS", "_LOG_INTERPOLATION has no effect without a table of rates",
                 "it is for LCSS that is a *DEFINE_TABLE");
  check_factor(deck, model, diagnostics);
  expect((c > 0) == (p > 0), c > 0 ? "P" : "C", "a number > 0", 0,
         "the rate of strain counts by C and P together; leave both blank where it does not");
}

// By hand. E = 2.5, PR = 1/4: lambda = G = 1, K = 5/3, 3 G = 3; dt = 1/2. dev e = (2, -1, -1): s_tr = (4, -2,
// -2), q = 6, at a rate 4. SIGY 3, ETAN 1/2: Ep = 5/8, de = 3/(3 + 5/8) = 24/29, s = 17/29 (4, -2, -2).
// Points (0, 3) (1/4, 4) (5/4, 4): the first piece, slope 4, would give de = 3/7 > 1/4, so the second: 6 - 3
// de = 4, de = 2/3, q = 4. Yield stress 2 (q_tr = 8, de = 2) at the rate
// of flow 2 de = 4: by LCSR from 1 at 0 to 3 at 8; by a table of 1 at 0 and 3 at 8, or 1 at ln(1/4) and 3 at
// ln 64. C: tr(D) = 6, the mean stress is 5; 2/9 tr(D)^2 = 8, as in uniaxial strain half of 4^2: rate
// sqrt(24) with VP 0, 4 with VP -1. With C = sqrt(24), P = 1, SIGY = 1 the yield stress is 2, or 1 +
// 4/sqrt(24), at q_tr = 6 more. C = P = 1: SIGY = 1, Ep = 5/8: 6 - 3 de = 1 + 5/8 de + 2 de, de = 8/9; of a
// curve alone 6 - 3 de = (1 + 5/8 de)(1 + 2 de), de = (sqrt(56.640625) - 5.625)/2.5.
const Real faster_alone = (std::sqrt(56.640625) - 5.625) / 2.5;
constexpr Real on_deviator = 1.8164965809277260;
const std::string curves =
    "*DEFINE_CURVE\n1\n0.0,1.0\n1.0,1.0\n*DEFINE_CURVE\n2\n0.0,3.0\n1.0,3.0\n*DEFINE_CURVE\n3\n0.0,1.0\n"
    "8.0,3.0\n*DEFINE_CURVE\n4\n0.0,1.0\n1.0,1.625\n*DEFINE_CURVE\n5\n0.0,3.0\n0.25,4.0\n1.25,4.0\n"
    "*DEFINE_TABLE_2D\n6\n0.0,1\n8.0,2\n*DEFINE_TABLE_2D\n7\n-1.3862943611198906,1\n4.1588830833596715,2\n";
const std::array<Real, 6> pull{2, -1, -1}, two_thirds{8.0 / 3, -4.0 / 3, -4.0 / 3};
StrengthReference flows(const std::string& cards, const std::array<Real, 6>& after, Real plastic) {
  return {cards + curves, pull, {}, after, {0}, {plastic}};
}
std::array<Real, 6> with_q(Real q, Real mean = 0) {
  return {mean + 2 * q / 3, mean - q / 3, mean - q / 3};
}
/// Pulled to a trial state with q + 6 and tr(D) dt = `volume`: de = 2, at a rate of flow of 4.
StrengthReference flows_at_4(const std::string& cards, Real q, Real volume = 0) {
  const Real e = (q + 6) / 3, mean = volume / 3;
  return {cards + curves, {e + mean, mean - e / 2, mean - e / 2}, {}, with_q(q, 5 * mean), {0}, {2}};
}
const RegisterStrength<M> mat_piecewise_linear_plasticity{
    "s_tr = s + 2 G dev(D) dt; q = sqrt(3/2 s:s) <= sigma_y(e, rate) by LCSS, EPS and ES, or SIGY + Ep e, Ep "
    "= E ETAN/(E - ETAN); times 1 + (rate/C)^(1/P) or LCSR(rate); VP 1 with SIGY: plus SIGY (rate/C)^(1/P); "
    "return along s_tr; pressure by Hooke's law",
    "J2 plasticity with radial return: Krieg & Key 1976; rates: Cowper & Symonds 1957",
    {flows("1,2.0,2.5,0.25,3.0,0.5\n\n\n\n", with_q(102.0 / 29), 24.0 / 29),
     flows("1,2.0,2.5,0.25\n\n0.0,0.25,1.25\n3.0,4.0,4.0\n", two_thirds, 2.0 / 3),
     flows("1,2.0,2.5,0.25\n,,5\n\n\n", two_thirds, 2.0 / 3), flows_at_4("1,2.0,2.5,0.25,1.0\n,,,3\n\n\n", 2),
     flows_at_4("1,2.0,2.5,0.25\n,,6\n\n\n", 2), flows_at_4("1,2.0,2.5,0.25\n,,7\n\n\n", 2),
     flows("1,2.0,2.5,0.25,1.0,0.5\n1.0,1.0,,,1\n\n\n", with_q(10.0 / 3), 8.0 / 9),
     flows("1,2.0,2.5,0.25\n1.0,1.0,4,,1\n\n\n", with_q(6 - 3 * faster_alone), faster_alone),
     flows_at_4("1,2.0,2.5,0.25,1.0\n4.898979485566356,1.0\n\n\n", 2, 3),
     flows_at_4("1,2.0,2.5,0.25,1.0\n4.898979485566356,1.0,,,-1\n\n\n", on_deviator, 3)},
    mat_piecewise_linear_plasticity_table()};

/// The same with failure of sheets by thinning, and a number of points that takes the element away.
using Thinning = struct MatModifiedPiecewiseLinearPlasticity;
struct MatModifiedPiecewiseLinearPlasticity : M {
  std::shared_ptr<StrengthLaw> law(const Model& model) const {
    ThinningLimits limits;
    if (epsthin > 0) limits.thinning = epsthin;
    if (epsmaj > 0) limits.major = epsmaj;
    const auto plain = M::law(model), out = limits.any() ? fail_by_thinning(plain, limits) : plain;
    out->failing_layers = static_cast<int>(numint);
    return out;
  }
  void check(const Deck& deck, const Model& model, Diagnostics& diagnostics) const {
    M::check(deck, model, diagnostics);
    for (const auto& [field, value] : {std::pair{"EPSTHIN", epsthin}, std::pair{"EPSMAJ", epsmaj}})
      if (value < 0)
        deck.error(diagnostics, *this, field, fmt::format("'{:g}' is not supported", value),
                   "values > 0 are limits of each point; means and filtered strains (< 0) are not there");
    check_failing_layers(deck, *this, numint, diagnostics);
  }
};

// Stress as above; nothing is as thin or as long as to fail.
const RegisterStrength<Thinning> mat_modified_piecewise_linear_plasticity{
    "as MAT_PIECEWISE_LINEAR_PLASTICITY; points of shells fail at -e_zz = EPSTHIN and at the larger "
    "principal strain in the "
    "plane EPSMAJ, logarithmic",
    "J2 plasticity with radial return: Krieg & Key 1976; rates: Cowper & Symonds 1957",
    {flows("1,2.0,2.5,0.25,3.0,0.5\n\n\n\n", with_q(102.0 / 29), 24.0 / 29),
     flows("1,2.0,2.5,0.25,3.0,0.5\n0.0,0.0,0,0,0,0.5,2.0,0\n\n\n", with_q(102.0 / 29), 24.0 / 29)},
    mat_modified_piecewise_linear_plasticity_table()};

M plain_card(const MatPiecewiseLinearPlasticityFields& card) {
  M out;
  static_cast<MatPiecewiseLinearPlasticityFields&>(out) = card;
  return out;
}

}  // namespace

std::shared_ptr<StrengthLaw> piecewise_linear_plasticity(const MatPiecewiseLinearPlasticityFields& card,
                                                         const Model& model) {
  return plain_card(card).law(model);
}

void check_piecewise_linear_plasticity(const MatPiecewiseLinearPlasticityFields& card, const Deck& deck,
                                       const Model& model, Diagnostics& diagnostics) {
  plain_card(card).check(deck, model, diagnostics);
}

void check_failing_layers(const Deck& deck, const Entry& card, Real numint, Diagnostics& diagnostics) {
  if (numint < 0 || numint != std::floor(numint))
    deck.error(diagnostics, card, "NUMINT", fmt::format("'{:g}' is not supported", numint),
               "the number of points through the thickness that must fail; 0: all of them");
}

}  // namespace courant
