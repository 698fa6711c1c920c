// *MAT_ADD_DAMAGE_GISSMO: damage of a plastic material by its state of stress. Neukamm, Feucht & Haufe 2009.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "keyword/expectations.hpp"
#include "laws/failure/failing_law.hpp"
#include "laws/failure/fracture_strain.hpp"
#include "laws/materials/strength_cards.hpp"
#include "laws/strength/radial_return.hpp"

namespace courant {

namespace {

struct MatAddDamageGissmo : MatAddDamageGissmoFields {
  void check(const Deck& deck, const Model& model, Diagnostics& diagnostics) const;
};

/// Fading stress of `of`: 1 - ((D - Dc)/(1 - Dc))^m of that without damage; D^(1/n) grows by de/ef, the
/// instability F in the same manner by de/ec up to 1, where Dc is the damage.
class Gissmo : public FailingLaw {
 public:
  Gissmo(std::shared_ptr<StrengthLaw> of, const MatAddDamageGissmo& card, const Model& model)
      : FailingLaw(std::move(of), numbers(card)),
        c_(card),
        fracture_(model, card.lcsdg),
        unstable_(model, card.ecrit < 0 ? static_cast<Id>(-card.ecrit) : 0),
        by_size_(model, card.lcregd),
        by_rate_(model, std::abs(card.lcsrs)) {
    failing_layers = static_cast<int>(card.numfip);
    const auto kinds = of_->history();
    std::size_t at = 0;
    for (const HistoryVariable& h : kinds) {
      if (h.name == "plastic_strain") plastic_ = at;
      if (h.name == of_->failure_variable()) fails_ = static_cast<int>(at);
      at += static_cast<std::size_t>(h.components);
    }
    const auto found = model.curves.find(std::abs(card.lcsrs));
    logarithmic_ = found != model.curves.end() && found->second.abscissa.front() < 0;
  }

  void update(const PointBlock& block) const override {
    around(block, [this](const PointBlock& own) { of_->update(own); });
  }
  void update_in_plane_stress(const PointBlock& block, Real* rate_zz) const override {
    PointBlock whole = block;
    whole.rate[2] = rate_zz;  // as the law leaves it
    around(whole, [&](const PointBlock& own) { of_->update_in_plane_stress(own, rate_zz); });
  }

 private:
  enum Number : std::size_t { damage, instability, critical, fading, size };
  static std::vector<HistoryVariable> numbers(const MatAddDamageGissmo& card) {
    std::vector<HistoryVariable> out{
        {"damage", "-"}, {"instability", "-"}, {"critical_damage", "-"}, {"stress_fading", "-"}};
    if (card.lcregd != 0) out.push_back({element_size, "L"});
    return out;
  }
  Real* number(const PointBlock& block, std::size_t of) const { return block.history[kept_ + of]; }

  template <class Step>
  void around(const PointBlock& block, const Step& step) const {
    Real before[block_size], factor[block_size];
    const Real *plastic = block.history[plastic_], *faded = number(block, fading);
    for (Index i = 0; i < block.count; ++i)
      before[i] = plastic[i], factor[i] = faded[i] < 1 ? 1 / (1 - faded[i]) : 0;
    scale(block, factor);
    step(of_law(block));
    Real* ratio = block.history.back();
    for (Index i = 0; i < block.count; ++i) {
      if (plastic[i] > before[i]) grow(block, i, plastic[i] - before[i]);
      const Real own =
          fails_ >= 0 ? block.history[static_cast<std::size_t>(fails_)][i] / of_->failure_limit() : 0;
      ratio[i] = std::max({ratio[i], own, c_.dtyp == 1 ? number(block, damage)[i] : 0});
      factor[i] = 1 - faded[i];
    }
    scale(block, factor);
  }
  void grow(const PointBlock& block, Index i, Real flown) const {
    const auto& s = block.stress;
    const StressState state = StressState::of({s[0][i], s[1][i], s[2][i], s[3][i], s[4][i], s[5][i]});
    Real by_rate = 1;
    if (!by_rate_.empty()) {
      const Real rate = effective_rate(block, i, false);
      by_rate = by_rate_(logarithmic_ ? std::log(std::max(rate, least_rate)) : rate);
    }
    const Real by_size = by_size_.empty() ? 1 : by_size_(number(block, size)[i]);
    Real &D = number(block, damage)[i], &F = number(block, instability)[i];
    const auto grown = [&](Real x, Real strain) {
      return std::min(std::pow(std::pow(x, 1 / c_.dmgexp) + flown / strain, c_.dmgexp), Real(1));
    };
    const bool was_stable = F < 1;
    if (c_.ecrit != 0 && was_stable) {
      const Real at = c_.ecrit > 0 ? c_.ecrit : unstable_(state.triaxiality, state.lode);
      F = grown(F, at * (c_.lcsrs > 0 ? by_rate : 1));
    }
    D = grown(D, fracture_(state.triaxiality, state.lode) * by_size * by_rate);
    if (c_.dtyp != 1) return;
    Real& first = number(block, critical)[i];
    if (c_.ecrit == 0)
      first = c_.dcrit;
    else if (was_stable)
      first = D;  // it fades from here on
    if (c_.ecrit != 0 && F < 1) return;
    const Real x = D > first ? (D - first) / (1 - first) : 0;
    number(block, fading)[i] =
        D < 1 ? std::max(number(block, fading)[i], x > 0 ? std::pow(x, c_.fadexp) : 0) : 1;
  }
  static void scale(const PointBlock& block, const Real* factor) {
    for (Real* stress : block.stress)
      for (Index i = 0; i < block.count; ++i) stress[i] *= factor[i];
  }

  static constexpr Real least_rate = 1e-300;
  MatAddDamageGissmo c_;
  CurveOrTable fracture_, unstable_, by_size_, by_rate_;
  std::size_t plastic_ = 0;
  int fails_ = -1;
  bool logarithmic_ = false;  ///< rates of LCSRS are logarithms
};

const MatAddDamageGissmo* card_of(const Deck& deck, Id mid) {
  const auto& cards = deck.all<MatAddDamageGissmo>();
  const auto found = std::find_if(cards.begin(), cards.end(), [mid](const auto& c) { return c.mid == mid; });
  return found == cards.end() ? nullptr : &*found;
}
bool flows(const StrengthLaw& law) {
  const auto kinds = law.history();
  return std::any_of(kinds.begin(), kinds.end(), [](const auto& h) { return h.name == "plastic_strain"; });
}
std::shared_ptr<StrengthLaw> add_gissmo(const Deck& deck, const Model& model, Id mid,
                                        std::shared_ptr<StrengthLaw> law) {
  const MatAddDamageGissmo* card = card_of(deck, mid);
  if (!card || law->deviator_only() || !flows(*law)) return law;
  return std::make_shared<Gissmo>(std::move(law), *card, model);
}

void MatAddDamageGissmo::check(const Deck& deck, const Model& model, Diagnostics& diagnostics) const {
  const auto expect = expectations_of(*this, deck, diagnostics);
  expect(dtyp == 0 || dtyp == 1, "DTYP", "0 or 1", dtyp, "damage is driven by the plastic strain");
  expect(numfip >= 1 && numfip == std::floor(numfip), "NUMFIP", "a number of points", numfip,
         "per cent of them (< 0) are not supported");
  expect(dcrit < 1, "DCRIT", "a number below 1", dcrit, "at damage 1 a point fails");
  expect(fadexp > 0, "FADEXP", "a number > 0", fadexp, "curves (< 0) are not supported");
  expect(lcregd >= 0, "LCREGD", "a curve", static_cast<Real>(lcregd),
         "tables over the triaxiality are not supported");
  const char* over_stress =
      "failure strains over mean stress/q, or a table of such curves over 27 J3/(2 q^3)";
  const auto curves = [&](const char* field, Id id, bool tables, const char* hint) {
    check_positive_curves(deck, model, *this, field, id, tables, hint, diagnostics);
  };
  curves("LCSDG", lcsdg, true, over_stress);
  if (ecrit < 0) curves("ECRIT", static_cast<Id>(-ecrit), true, over_stress);
  curves("LCREGD", std::max<Id>(lcregd, 0), false, "factors over the element's size");
  curves("LCSRS", std::abs(lcsrs), false, "factors over the rate of strain");
  if (card_of(deck, mid) != this)
    deck.error(diagnostics, *this, "MID", fmt::format("material {} has two of these cards", mid),
               "leave one of them out");
  for (const ModelPart& part : model.parts)
    if (part.mid == mid && part.has_beam)
      deck.error(diagnostics, *this, "MID",
                 fmt::format("the beams of part {} have material {}", part.id, mid),
                 "solids and shells have this damage");
  if (diagnostics.errors() > 0) return;
  for (const StrengthEntry& kind : strength_registry()) {
    if (kind.keyword.starts_with("MAT_ADD_")) continue;
    for (const auto& [id, law] : kind.all(deck, model))
      if (id == mid && (law->deviator_only() || !flows(*law)))
        deck.error(diagnostics, *this, "MID",
                   fmt::format("*{} of material {} is not supported here", kind.keyword, mid),
                   "materials with a plastic strain that give all of the stress are");
  }
}

/// The laws that it changes, for the tests that go through the registry.
struct RegisterGissmo {
  RegisterGissmo() {
    law_additions().push_back(&add_gissmo);
    StrengthEntry entry;
    entry.keyword = "MAT_ADD_DAMAGE_GISSMO";
    entry.equation =
        "s = (1 - ((D - Dc)/(1 - Dc))^FADEXP) s0; D^(1/DMGEXP) grows by de/(LCSDG LCREGD LCSRS), "
        "F^(1/DMGEXP) by "
        "de/ECRIT, Dc = D where F = 1, or DCRIT; a point fails at D = 1";
    entry.source = "Neukamm, Feucht & Haufe 2009";
    // By hand. *MAT_PIECEWISE_LINEAR_PLASTICITY with SIGY 3, ETAN 1/2: de = 24/29, s = 17/29 (4, -2, -2).
    // Pulled by dev e without mean stress: failure strain 48/29 there: D = 1/2, with FADEXP 2 3/4 of the
    // stress is left. DMGEXP 2: D = 1/4, DCRIT 1/10: (0.15/0.9)^2 = 1/36.
    const std::string steel =
        "*MAT_PIECEWISE_LINEAR_PLASTICITY\n1,2.0,2.5,0.25,3.0,0.5\n\n\n\n*DEFINE_CURVE\n5\n-1.0,1.0\n0.0,"
        "1.6551724137931034\n1.0,1.0\n";
    entry.references = {{"1,,1\n5,0.0,1.0,0.0,2.0\n\n" + steel,
                         {2, -1, -1},
                         {},
                         {51.0 / 29, -51.0 / 58, -51.0 / 58},
                         {0},
                         {24.0 / 29, 0.5, 0, 0, 0.25, 0.5}},
                        {"1,,1\n5,0.0,2.0,0.1,2.0\n\n" + steel,
                         {2, -1, -1},
                         {},
                         {35.0 / 36 * 68 / 29, -35.0 / 36 * 34 / 29, -35.0 / 36 * 34 / 29},
                         {0},
                         {24.0 / 29, 0.25, 0, 0.1, 1.0 / 36, 0.25}}};
    entry.all = [](const Deck& deck, const Model& model) {
      std::vector<std::pair<Id, std::shared_ptr<StrengthLaw>>> out;
      for (const MatAddDamageGissmo& card : deck.all<MatAddDamageGissmo>())
        for (const StrengthEntry& kind : strength_registry()) {
          if (kind.keyword.starts_with("MAT_ADD_")) continue;
          for (const auto& one : kind.all(deck, model))
            if (one.first == card.mid) out.push_back(one);
        }
      return out;
    };
    entry.check = &check_cards<MatAddDamageGissmo>;
    add_to_strength_registry(std::move(entry));
    register_keyword(make_keyword_spec<MatAddDamageGissmo>(mat_add_damage_gissmo_table()));
  }
};
const RegisterGissmo mat_add_damage_gissmo;

}  // namespace

}  // namespace courant
