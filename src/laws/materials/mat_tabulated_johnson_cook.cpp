// *MAT_TABULATED_JOHNSON_COOK: yield stress by tables over the rate and the temperature, failure by tables
// over the state of stress. Carney, DuBois, Buyuk & Kan 2009.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "keyword/expectations.hpp"
#include "laws/failure/fracture_strain.hpp"
#include "laws/materials/strength_cards.hpp"
#include "laws/strength/radial_return.hpp"
#include "laws/strength/strength.hpp"
#include "laws/strength/tabulated_yield.hpp"
#include "laws/strength/yield_return.hpp"

namespace courant {

namespace {

struct MatTabulatedJohnsonCook : MatTabulatedJohnsonCookFields {
  std::shared_ptr<StrengthLaw> law(const Model& model) const;
  void check(const Deck& deck, const Model& model, Diagnostics& diagnostics) const;
};

/// q <= k1(e, rate of plastic strain) kt(e, T)/kt(e, TR), with e of the factor and T at the start of the
/// step.
class TabulatedJohnsonCook : public StrengthLaw {
 public:
  TabulatedJohnsonCook(const MatTabulatedJohnsonCook& card, const Model& model)
      : c_(card),
        fracture_(model, card.lcf),
        by_rate_(model, card.lcg),
        by_heat_(model, card.lch),
        by_size_(model, card.lci) {
    ro = card.ro;
    law_ = {.lambda = card.E * card.pr / ((1 + card.pr) * (1 - 2 * card.pr)),
            .G = card.E / (2 * (1 + card.pr))};
    const auto pieces = [&](Id id) {
      const auto found = model.curves.find(id);
      return found == model.curves.end() ? IndexedPieces()
                                         : IndexedPieces(found->second.abscissa, found->second.ordinate);
    };
    const auto curves = [&](Id id, std::vector<IndexedPieces>& to, std::vector<Real>& values) {
      if (const auto table = model.tables.find(id); table != model.tables.end()) {
        for (const Id one : table->second.curve) to.push_back(pieces(one));
        values = table->second.value;
      } else if (id != 0) {
        to.push_back(pieces(id));
      }
    };
    curves(card.tabk1, yield_.curves, yield_.rates), curves(card.tabkt, warm_.curves, warm_.rates);
    yield_.logarithmic = !yield_.rates.empty() && yield_.rates.front() < 0;
    if (yield_.curves.size() > 1) law_.rate = yield_.depends_on = YieldRate::of_flow;
    failing_layers = static_cast<int>(card.numint);
  }
  Real bulk_modulus() const override { return law_.lambda + 2 * law_.G / 3; }
  Real shear_modulus() const override { return law_.G; }
  std::vector<HistoryVariable> history() const override {
    std::vector<HistoryVariable> out{{"plastic_strain", "-"}};
    if (heats()) out.push_back({"temperature_rise", "-"});
    if (!fracture_.empty()) out.push_back({"damage", "-"});
    if (!by_size_.empty()) out.push_back({element_size, "L"});
    return out;
  }
  std::string failure_variable() const override { return "damage"; }
  Real failure_limit() const override {
    return fracture_.empty() || c_.erode == 1 ? std::numeric_limits<Real>::infinity() : 1;
  }

  void update(const PointBlock& block) const override {
    Kept kept = kept_of(block);
    PlasticTrial trial;
    go_elastically(law_.lambda, law_.G, block, FixedCentre{}, trial);
    Real factor[block_size];
    const bool scaled = !warm_.curves.empty() && heats();
    for (Index i = 0; scaled && i < block.count; ++i) factor[i] = softened(kept.plastic[i], kept.heated[i]);
    find_increments(loops_, law_, block, kept.plastic, trial, [&](YieldPoints& points) {
      yield_.at(points);
      if (law_.rate == YieldRate::none) std::fill_n(points.by_rate, points.count, 0.0);
      if (scaled) rates_.limit(std::numeric_limits<Real>::infinity(), factor, points);
    });
    constexpr Real none = 1e-300;
    return_radially(law_.G, 0, none, block, FixedCentre{}, trial);
    for (Index i = 0; i < block.count; ++i) {
      const Real e = trial.plastic[i];
      kept.plastic[i] += e;
      if (kept.damage) damage(block, kept, i, e);
      if (kept.heated) kept.heated[i] += c_.beta / (ro * c_.cp) * (trial.q[i] - 3 * law_.G * e) * e;
    }
    keep_stiffness(block, sound_speed());
  }
  void update_in_plane_stress(const PointBlock& block, Real* rate_zz) const override {
    if (heats() || !(block.dt > 0)) return StrengthLaw::update_in_plane_stress(block, rate_zz);
    const Kept kept = kept_of(block);
    Real before[block_size];
    std::copy_n(kept.plastic, block.count, before);
    update_in_plane(loops_, law_, block, nullptr, rate_zz,
                    [this](YieldPoints& points) { yield_.at(points); });
    for (Index i = 0; kept.damage && i < block.count; ++i)
      damage(block, kept, i, kept.plastic[i] - before[i]);
    keep_stiffness(block, sound_speed());
  }

 private:
  /// Null where there is none.
  struct Kept {
    Real *plastic, *heated = nullptr, *damage = nullptr, *size = nullptr;
  };
  Kept kept_of(const PointBlock& block) const {
    std::size_t at = 0;
    Kept out{block.history[at++]};
    if (heats()) out.heated = block.history[at++];
    if (!fracture_.empty()) out.damage = block.history[at++];
    if (!by_size_.empty()) out.size = block.history[at++];
    return out;
  }
  bool heats() const { return c_.cp > 0 && c_.beta > 0; }
  /// kt(e, T)/kt(e, TR); straight between temperatures, constant beyond.
  Real softened(Real e, Real rise) const {
    const auto at = [&](Real T) {
      const auto above = std::upper_bound(warm_.rates.begin(), warm_.rates.end(), T);
      const auto k = static_cast<std::size_t>(above - warm_.rates.begin());
      if (k == 0) return warm_.curves.front()(e);
      if (k == warm_.curves.size()) return warm_.curves.back()(e);
      const Real share = (T - warm_.rates[k - 1]) / (warm_.rates[k] - warm_.rates[k - 1]);
      return (1 - share) * warm_.curves[k - 1](e) + share * warm_.curves[k](e);
    };
    return at(c_.tr + rise) / at(c_.tr);
  }
  /// D += de/e_f; the deviator of solids that keep their element vanishes at D = 1.
  void damage(const PointBlock& block, const Kept& kept, Index i, Real e) const {
    const auto& s = block.stress;
    if (e > 0) {
      const StressState state = StressState::of({s[0][i], s[1][i], s[2][i], s[3][i], s[4][i], s[5][i]});
      Real strain = fracture_(-state.triaxiality, state.lode);
      if (!by_rate_.empty()) strain *= by_rate_(e / block.dt);
      if (!by_heat_.empty()) strain *= by_heat_(c_.tr + (kept.heated ? kept.heated[i] : 0));
      if (kept.size) strain *= by_size_(kept.size[i]);
      kept.damage[i] += e / strain;
    }
    if (c_.erode != 1 || !(kept.damage[i] >= 1)) return;
    const Real mean = (s[0][i] + s[1][i] + s[2][i]) / 3;
    for (std::size_t k = 0; k < 6; ++k) s[k][i] = k < 3 ? mean : 0;
  }

  MatTabulatedJohnsonCook c_;
  ReturnLaw law_;
  TabulatedYield yield_, warm_;  ///< of the second the curves, over temperatures
  CurveOrTable fracture_, by_rate_, by_heat_, by_size_;
  RateLoops rates_ = rate_loops();
  ReturnLoops loops_ = return_loops();
};

std::shared_ptr<StrengthLaw> MatTabulatedJohnsonCook::law(const Model& model) const {
  return std::make_shared<TabulatedJohnsonCook>(*this, model);
}

void MatTabulatedJohnsonCook::check(const Deck& deck, const Model& model, Diagnostics& diagnostics) const {
  const auto expect = expectations_of(*this, deck, diagnostics);
  expect(pr < 0.5, "PR", "a number < 0.5", pr, "a material that keeps its volume has no finite bulk modulus");
  expect(beta >= 0 && beta <= 1, "BETA", "a number from 0 to 1", beta, "tables (< 0) are not supported");
  expect(numint >= 1 && numint == std::floor(numint), "NUMINT", "a number of points", numint,
         "per cent of them (< 0) are not supported");
  expect(erode == 0 || erode == 1, "ERODE", "0 or 1", erode, "1: solids that fail stay without deviator");
  const char* hint = "yield stresses over the plastic strain, curve by curve";
  check_positive_curves(deck, model, *this, "TABK1", tabk1, true, hint, diagnostics);
  check_positive_curves(deck, model, *this, "TABKT", tabkt, true, hint, diagnostics);
  check_positive_curves(deck, model, *this, "LCF", lcf, true, "failure strains over pressure/q", diagnostics);
  for (const auto& [field, id] : {std::pair{"LCG", lcg}, {"LCH", lch}, {"LCI", lci}}) {
    check_positive_curves(deck, model, *this, field, id, false, "factors of the failure strain", diagnostics);
    if (id != 0 && lcf == 0)
      deck.error(diagnostics, *this, field, "does nothing without LCF", "LCF is the failure strain itself");
  }
  if (tabkt != 0 && model.tables.count(tabkt) == 0)
    deck.error(diagnostics, *this, "TABKT", fmt::format("table {} does not exist", tabkt),
               "a *DEFINE_TABLE over temperatures");
  if (tabkt != 0 && cp == 0)
    deck.warning(diagnostics, *this, "TABKT", "does nothing: without CP plastic work does not heat",
                 "give CP");
}

// By hand. E = 2.5, PR = 1/4: lambda = G = 1, K = 5/3; dt = 1/2. Pulled by dev e = (2, -1, -1): q = 6. Points
// (0, 3) (1/4, 4) (5/4, 4): de = 2/3, q = 4. Table 1 at rate 0, 3 at 8: de = 4/3 at q = 2 and at a rate of
// 8/3: 1 + 2/3; in the middle: q = 6 - 3 de = 1 + de/2: de = 10/7, q = 12/7. Without mean stress LCF 4/3
// there: D = 1/2. Heated from 2/3 4/(2 3) = 4/9.
const std::string sheets =
    "*DEFINE_CURVE\n1\n0.0,1.0\n1.0,1.0\n*DEFINE_CURVE\n2\n0.0,3.0\n1.0,3.0\n*DEFINE_CURVE\n5\n0.0,3.0\n0.25,"
    "4.0\n1.25,"
    "4.0\n*DEFINE_TABLE_2D\n6\n0.0,1\n8.0,2\n*DEFINE_CURVE\n7\n-1.0,1.0\n0.0,1.3333333333333333\n1.0,1.0\n";
const std::array<Real, 6> by_2{2, -1, -1};
const RegisterStrength<MatTabulatedJohnsonCook> mat_tabulated_johnson_cook{
    "q = sqrt(3/2 s:s) <= k1(e, rate) kt(e, T)/kt(e, TR) by TABK1, TABKT; dT = BETA q de/(RO CP); dD = "
    "de/(LCF(p/q, 27 "
    "J3/(2 q^3)) LCG(rate) LCH(T) LCI(size)), fails at D = 1",
    "Carney, DuBois, Buyuk & Kan 2009; J2 plasticity with radial return: Krieg & Key 1976",
    {{"1,2.0,2.5,0.25\n5,0,7\n\n" + sheets, by_2, {}, {8.0 / 3, -4.0 / 3, -4.0 / 3}, {0}, {2.0 / 3, 0.5}},
     {"1,2.0,2.5,0.25\n6\n\n" + sheets, by_2, {}, {8.0 / 7, -4.0 / 7, -4.0 / 7}, {0}, {10.0 / 7}},
     {"1,2.0,2.5,0.25,3.0\n5\n\n" + sheets,
      by_2,
      {},
      {8.0 / 3, -4.0 / 3, -4.0 / 3},
      {0},
      {2.0 / 3, 4.0 / 9}}},
    mat_tabulated_johnson_cook_table()};

}  // namespace

}  // namespace courant
