// Unit factors of curves in files that *INCLUDE_TRANSFORM reads.
#include <fmt/format.h>
#include <cstdlib>
#include <map>

#include "keyword/registry.hpp"
#include "model/cards.hpp"
#include "model/transforms/included_entries.hpp"

namespace courant {

namespace {

struct ConvertedCurve {
  DefineCurveCard* card = nullptr;
  Real abscissa = 1, ordinate = 1;
  Entry user{};  ///< the entry that gave the factors
  bool used = false;
};

void use(const Deck& deck, const Entry& entry, const KeywordSpec& spec, const IdUse& id,
         ConvertedCurve& curve, Diagnostics& diagnostics) {
  const FieldSpec& field = spec.cards[id.card].fields[id.field];
  if (field.rules.honour != Honour::yes || !spec.lacking.empty()) return;  // no effect, or refused already
  const CurveOf dimensions = curve_of(field, entry);
  const char* hint =
      "give the curve in the deck's own units: in a file without unit factors, or through SFA and SFO";
  if (!dimensions.known()) {
    deck.error(diagnostics, entry, field.name,
               fmt::format("curve {} is in a file with unit factors, and the dimensions of its numbers are "
                           "not known here",
                           std::abs(id.id)),
               hint);
    return;
  }
  const UnitFactors& units = deck.files[static_cast<std::size_t>(curve.card->file)].conversion.units;
  const Real abscissa = units.of(dimensions.abscissa), ordinate = units.of(dimensions.ordinate);
  if (curve.used && (curve.abscissa != abscissa || curve.ordinate != ordinate))
    deck.error(diagnostics, entry, field.name,
               fmt::format("curve {} is in a file with unit factors, and its numbers have another dimension "
                           "here than for {} at {}",
                           std::abs(id.id), deck.keyword(curve.user), deck.place(curve.user)),
               hint);
  curve.abscissa = abscissa;
  curve.ordinate = ordinate;
  curve.user = entry;
  curve.used = true;
}

}  // namespace

CurveOf curve_of(const FieldSpec& field, const Entry& entry) {
  return field.curve_of ? field.curve_of(entry) : field.rules.curve;
}

void convert_curves(Deck& deck, Diagnostics& diagnostics) {
  std::map<Id, ConvertedCurve> curves;
  for (DefineCurveCard& card : deck.store<DefineCurveCard>())
    if (deck.files[static_cast<std::size_t>(card.file)].conversion.units.any())
      curves[card.lcid].card = &card;
  if (curves.empty()) return;
  const auto& registry = keyword_registry();
  for (std::size_t k = 0; k < registry.size(); ++k) {
    const KeywordSpec& spec = *registry[k];
    spec.for_each(deck, static_cast<std::int32_t>(k), [&](const Entry& entry) {
      spec.for_each_id(entry, [&](const IdUse& id) {
        if (id.space != IdSpace::curve || id.defines) return;
        const auto it = curves.find(std::abs(id.id));
        if (it != curves.end()) use(deck, entry, spec, id, it->second, diagnostics);
      });
    });
  }
  for (auto& [id, curve] : curves) {
    curve.card->sfa *= curve.abscissa;
    curve.card->sfo *= curve.ordinate;
  }
}

}  // namespace courant
