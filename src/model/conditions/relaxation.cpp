#include "model/conditions/relaxation.hpp"
#include "model/conditions/condition_cards.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "keyword/registry.hpp"
#include "model/cards.hpp"
#include "model/model_builder.hpp"
#include "model/transforms/included_entries.hpp"

namespace courant {

namespace {

using R = RelaxationCard;
/// Cards of IDRFLG 3 and 6, which are refused: with others nothing of them counts.
KeywordTable relaxation_keyword() {
  KeywordTable out = control_dynamic_relaxation_table();
  for (int card = 0; card < 3; ++card)
    out.cards.push_back({.fields = std::vector<FieldSpec>(2), .optional = true});
  return out;
}
const RegisterKeyword<R> control_dynamic_relaxation{relaxation_keyword()};

bool is_load_or_motion(const KeywordSpec& spec, const FieldSpec& field) {
  if (!spec.lacking.empty() || !(field.curve_of || field.rules.curve.known())) return false;
  const std::string& name = spec.names[0];
  return name.starts_with("LOAD_") || name.starts_with("DAMPING_") || name.starts_with("BOUNDARY_") ||
         name.starts_with("RIGIDWALL_") || name.starts_with("INITIAL_AXIAL_FORCE");
}

/// Where a curve gets the value that it keeps. [T]
Real last_change(const Curve& curve) {
  for (std::size_t k = curve.ordinate.size(); k-- > 1;)
    if (curve.ordinate[k - 1] != curve.ordinate[k]) return curve.abscissa[k];
  return 0;
}

/// Of curves that may be silent in this phase.
bool begins_above_none(Curve curve) {
  curve.silent = false;
  return curve(0) != 0;
}

}  // namespace

bool is_of_relaxation(std::string_view field) {
  return field == "LCIDDR" || field == "LCDR";
}

void for_load_curves(const Deck& deck, const std::function<void(const Entry&, const char*, Id)>& of) {
  const auto& registry = keyword_registry();
  for (std::size_t k = 0; k < registry.size(); ++k) {
    const KeywordSpec& spec = *registry[k];
    const bool asked = std::any_of(spec.cards.begin(), spec.cards.end(), [&](const CardSpec& card) {
      return std::any_of(card.fields.begin(), card.fields.end(),
                         [&](const FieldSpec& field) { return is_load_or_motion(spec, field); });
    });
    if (!asked) continue;
    spec.for_each(deck, static_cast<std::int32_t>(k), [&](const Entry& entry) {
      spec.for_each_id(entry, [&](const IdUse& id) {
        const FieldSpec& field = spec.cards[id.card].fields[id.field];
        if (id.space == IdSpace::curve && id.id > 0 && is_load_or_motion(spec, field))
          of(entry, field.name.data(), id.id);
      });
    });
  }
}

namespace {

/// What goes by the time of the run and would go on in a relaxation, by keyword and its words; "" where
/// nothing of it is in the deck. The card that has it.
std::string what_cannot_rest(const Deck& deck, const Entry*& card) {
  const auto& registry = keyword_registry();
  std::string out;
  for (std::size_t k = 0; k < registry.size() && out.empty(); ++k) {
    const KeywordSpec& spec = *registry[k];
    spec.for_each(deck, static_cast<std::int32_t>(k), [&](const Entry& entry) {
      const std::string& name = spec.names[static_cast<std::size_t>(entry.name)];
      const bool wall = name.starts_with("RIGIDWALL") &&
                        (name.find("_MOVING") != name.npos || name.find("_MOTION") != name.npos);
      const char* what = name.starts_with("SENSOR_CONTROL") ? "controls by sensors"
                         : name.find("_MOTOR") != name.npos ? "motors of joints"
                         : wall                             ? "rigid walls that move"
                                                            : nullptr;
      if (what && out.empty()) out = what, card = &entry;
    });
  }
  return out;
}

constexpr std::size_t vad_field = 2;  // of *BOUNDARY_PRESCRIBED_MOTION

}  // namespace

Relaxation relaxation_of(const Deck& deck, const Model& model, bool has_particles, Diagnostics& diagnostics) {
  Relaxation out;
  const auto* card = deck.last<R>();
  int most = 0;
  Entry of_load;
  for_load_curves(deck, [&](const Entry& entry, const char* field, Id id) {
    const bool of_relaxation = is_of_relaxation(field);
    const auto curve = model.curves.find(id);
    if (curve == model.curves.end()) return;
    if (curve->second.sidr == 1 || of_relaxation) out.ramp = std::max(out.ramp, last_change(curve->second));
    const KeywordSpec& spec = *keyword_registry()[static_cast<std::size_t>(entry.keyword)];
    if ((of_relaxation || curve->second.sidr != 0) && spec.names[0].starts_with("LOAD_"))
      out.at_once = out.at_once || begins_above_none(curve->second);
    if (curve->second.sidr != 0 && (most == 0 || curve->second.sidr == 1))
      most = curve->second.sidr, of_load = entry;
  });
  if (card) out.check_every = card->nrcyck, out.tolerance = card->drtol, out.factor = card->drfctr;
  if (card && card->drterm > 0) out.end = card->drterm;
  out.ramp = std::min(out.ramp, out.end);
  out.asked = most != 0 || (card && card->idrflg != 0);
  if (!out.asked) return out;
  if (card && !(card->drfctr < 1))
    deck.error(diagnostics, *card, "DRFCTR", "expected a number below 1, which takes velocity away");
  if (card && card->idrflg == -1)
    deck.warning(diagnostics, *card, "IDRFLG",
                 "histories of the relaxation are not written, only its convergence, in the file relax");
  const bool by_card = card && card->idrflg != 0;
  const Entry* resting = nullptr;
  if (const std::string what = what_cannot_rest(deck, resting); !what.empty()) {
    out.asked = false;
    if (most == 2 && !by_card)
      deck.warning(diagnostics, of_load, "",
                   fmt::format("its curve has SIDR 2, which asks for a relaxation; there are {}, and the run "
                               "begins without one",
                               what),
                   "with SIDR 0 this is what was asked for");
    else
      deck.error(diagnostics, *resting, "", fmt::format("{} in a relaxation are not supported", what),
                 "leave them out, or bring the model to rest within the run, by *DAMPING_GLOBAL");
    return out;
  }
  for_load_curves(deck, [&](const Entry& entry, const char* field, Id id) {
    const auto curve = model.curves.find(id);
    if (curve == model.curves.end() || (curve->second.sidr == 0 && !is_of_relaxation(field))) return;
    if (curve->second.by_formula)
      deck.error(diagnostics, entry, field,
                 fmt::format(
                     "curve {} is a formula, which is known up to ENDTIM only, and acts in a relaxation", id),
                 "give it by points, with *DEFINE_CURVE");
    const KeywordSpec& spec = *keyword_registry()[static_cast<std::size_t>(entry.keyword)];
    const bool accelerates =
        spec.names[0].starts_with("BOUNDARY_PRESCRIBED_MOTION") && spec.number_of(entry, 0, vad_field) == 1;
    if (accelerates)
      deck.error(diagnostics, entry, "VAD",
                 "accelerations that are prescribed in a relaxation are not supported",
                 "prescribe velocities or displacements, or give the curve SIDR 0");
  });
  if (!has_particles) return out;
  out.asked = false;
  const Entry& asks = by_card ? static_cast<const Entry&>(*card) : of_load;
  if (most == 2 && !by_card)
    deck.warning(diagnostics, asks, "",
                 "its curve has SIDR 2, which asks for a relaxation; there are particles, and the run begins "
                 "without one",
                 "with SIDR 0 this is what was asked for");
  else
    deck.error(diagnostics, asks, "", "a relaxation of particles is not supported",
               "bring them to rest within the run, by *DAMPING_GLOBAL");
  return out;
}

Real relaxation_tssfac(const Deck& deck, Real tssfac) {
  const auto* card = deck.last<R>();
  return card && card->tssfdr > 0 ? card->tssfdr : tssfac;
}

// SIDR tells in which phase a load acts; of curves that are no loads it tells nothing.
void ModelBuilder::silence_curves() {
  const auto note = [&](const auto& cards) {
    for (const auto& card : cards) model_.curves[card.lcid].sidr = card.sidr;
  };
  note(deck_.all<DefineCurveCard>());
  for_load_curves(deck_, [&](const Entry&, const char* field, Id id) {
    const auto found = model_.curves.find(id);
    if (found == model_.curves.end() || is_of_relaxation(field)) return;
    found->second.silent = found->second.sidr == (model_.phase == RunPhase::relaxation ? 0 : 1);
  });
}

}  // namespace courant
