// *MAT_ADD_EROSION, and what else lets elements fail.
#include <fmt/format.h>

#include <cmath>
#include <map>
#include <tuple>

#include "elements/element_cards.hpp"
#include "elements/erosion.hpp"
#include "keyword/registry.hpp"
#include "model/cards.hpp"

namespace courant {

namespace {

struct MatAddErosion : MatAddErosionFields {
  /// A value that asks for its criterion.
  bool asks(Real value) const { return value != 0 && value != excl; }
  /// Of the criteria.
  int count() const {
    int out = 0;
    for (const Real value :
         {mxpres, mneps, effeps, voleps, mnpres, sigp1, sigvm, mxeps, epssh, impulse, failtm})
      out += asks(value);
    return out;
  }
};

using A = MatAddErosion;
const RegisterKeyword<A> mat_add_erosion{mat_add_erosion_table()};

/// The criteria of a card.
void take_card(const A& c, FailureRules& out) {
  const auto take = [&](Real value, Real& to) {
    if (c.asks(value)) to = value;
  };
  take(c.mxpres, out.most_pressure), take(c.mnpres, out.least_pressure);
  take(c.sigp1, out.principal_stress), take(c.sigvm, out.mises);
  take(c.mxeps, out.most_strain), take(c.mneps, out.least_strain), take(c.epssh, out.shear_strain);
  if (c.asks(c.effeps)) (c.effeps > 0 ? out.effective_strain : out.plastic_strain) = std::abs(c.effeps);
  if (c.asks(c.voleps)) (c.voleps > 0 ? out.expansion : out.contraction) = c.voleps;
  if (c.asks(c.impulse)) out.impulse = c.impulse, out.threshold = c.asks(c.sigth) ? c.sigth : 0;
  if (c.asks(c.failtm)) out.time = std::abs(c.failtm);  // < 0: not during dynamic relaxation
  out.conditions = static_cast<int>(c.ncs), out.points = static_cast<int>(c.numfip);
}

void check_card(const Deck& deck, const A& c, Diagnostics& diagnostics) {
  const auto refuse = [&](const char* field, Real value, bool wrong, const char* why, const char* hint) {
    if (wrong) deck.error(diagnostics, c, field, fmt::format("'{:g}' {}", value, why), hint);
  };
  constexpr const char* of_rate = "asks for a curve over the rate of strain, which is not supported";
  refuse("SIGVM", c.sigvm, c.sigvm < 0 && c.asks(c.sigvm), of_rate, "give the value itself, > 0");
  refuse("MXEPS", c.mxeps, c.mxeps < 0 && c.asks(c.mxeps), of_rate, "give the value itself, > 0");
  refuse("NUMFIP", c.numfip, c.numfip < -100, "is not supported", "-100 to -1 are per cent of the points");
  for (const auto& [field, value] : {std::pair{"NUMFIP", c.numfip}, std::pair{"NCS", c.ncs}})
    refuse(field, value, value != std::floor(value), "is no whole number", "");
  refuse("IMPULSE", c.impulse, c.impulse < 0 && c.asks(c.impulse), "is below 0", "");
  constexpr const char* at_rest = "holds without any load: all elements would fail at once";
  const auto expect = [&](const char* field, Real value, int sign) {
    const bool wrong = c.asks(value) && sign * value < 0;
    refuse(field, value, wrong, at_rest, sign == 1 ? "give a value > 0" : "give a value < 0");
  };
  expect("MXPRES", c.mxpres, 1), expect("MNEPS", c.mneps, -1), expect("MNPRES", c.mnpres, -1);
  expect("SIGP1", c.sigp1, 1), expect("EPSSH", c.epssh, 1);
  if (c.asks(c.sigth) && !c.asks(c.impulse))
    deck.warning(diagnostics, c, "SIGTH", "has no effect without IMPULSE", "give IMPULSE, or leave it blank");
  const int count = c.count();
  if (count == 0)
    deck.warning(diagnostics, c, "MID", "the card asks for no criterion: nothing fails by it",
                 "leave it out");
  else
    refuse("NCS", c.ncs, c.ncs > count,
           fmt::format("can never hold at once: the card asks for {}", count).c_str(), "");
}

/// Parts of the card's material, and whether it does anything there.
void check_parts(const Deck& deck, const Model& model, const std::vector<std::shared_ptr<StrengthLaw>>& laws,
                 const A& c, Diagnostics& diagnostics) {
  bool used = false;
  for (std::size_t k = 0; k < model.parts.size(); ++k) {
    const ModelPart& part = model.parts[k];
    if (part.mid != c.mid || part.null) continue;
    if (part.has_sph)
      deck.error(diagnostics, c, "MID",
                 fmt::format("particles cannot fail: part {} has some of this material", part.id),
                 "give them a material of their own");
    if (part.has_beam && !laws[k])
      deck.error(diagnostics, c, "MID",
                 fmt::format("cables and discrete beams cannot fail by it: part {} has some of this material",
                             part.id),
                 "give them a material of their own");
    used = used || part.has_sph || part.has_beam || (!part.rigid && (part.has_solid || part.has_shell));
  }
  if (!used)
    deck.warning(diagnostics, c, "MID",
                 fmt::format("has no effect: no elements that deform are of material {}", c.mid),
                 "leave it out");
}

}  // namespace

bool has_erosion_card(const Deck& deck, Id mid) {
  const std::vector<A>& cards = deck.all<A>();
  return std::any_of(cards.begin(), cards.end(), [&](const A& card) { return card.mid == mid; });
}

std::vector<FailureRules> failure_rules(const Deck& deck, const Model& model,
                                        const std::vector<std::shared_ptr<StrengthLaw>>& laws, bool goes_on,
                                        Diagnostics& diagnostics) {
  std::map<Id, const A*> cards;
  for (const A& card : deck.all<A>()) {
    check_card(deck, card, diagnostics);
    check_parts(deck, model, laws, card, diagnostics);
    if (!cards.emplace(card.mid, &card).second)
      deck.error(diagnostics, card, "MID", fmt::format("there is another card for material {}", card.mid),
                 "give all criteria on one card");
  }
  std::vector<FailureRules> out(model.parts.size());
  const auto* step = deck.last<ControlTimestepCard>();
  const int erode = step ? step->erode : 0;
  for (std::size_t k = 0; k < out.size(); ++k) {
    if (!laws[k]) continue;
    out[k].law_limit = laws[k]->failure_limit(), out[k].law_variable = laws[k]->failure_variable();
    out[k].law_time = laws[k]->failure_time(), out[k].least_step = laws[k]->least_step();
    std::tie(out[k].least_volume, out[k].most_volume) = laws[k]->volume_range();
    if (const auto card = cards.find(model.parts[k].mid); card != cards.end()) {
      take_card(*card->second, out[k]);
      if (out[k].plastic_strain < FailureRules::never && plastic_strain_of(*laws[k]) < 0)
        deck.error(diagnostics, *card->second, "EFFEPS",
                   fmt::format("the material of part {} has no plastic strain, which '{:g}' asks for",
                               model.parts[k].id, card->second->effeps),
                   "a value > 0 is one of the effective strain");
    }
    if (model.parts[k].has_beam) continue;
    out[k].small_step = model.parts[k].has_solid ? erode % 10 != 0 : erode / 10 % 10 != 0 && model.dtmin > 0;
  }
  take_deaths(deck, model, laws, goes_on, out, diagnostics);
  return out;
}

}  // namespace courant
