#include "keyword/read/repeated_cards.hpp"

#include <fmt/format.h>

#include "keyword/registry.hpp"

namespace courant {
namespace {

/// As it would be on the card.
std::string value_in(const KeywordSpec& spec, const Entry& entry, std::size_t card, std::size_t field) {
  const FieldType type = spec.cards[card].fields[field].type;
  const bool number = type == FieldType::integer || type == FieldType::id || type == FieldType::real;
  return number ? fmt::format("{:g}", spec.number_of(entry, card, field)) : spec.text_of(entry, card, field);
}

/// The first field in which the cards differ.
struct Difference {
  std::string field, before, now;
};

Difference difference(const KeywordSpec& spec, const Entry& before, const Entry& now) {
  for (std::size_t c = 0; c < spec.cards.size(); ++c)
    for (std::size_t f = 0; f < spec.cards[c].fields.size(); ++f) {
      if (spec.cards[c].fields[f].type == FieldType::skip) continue;
      Difference out{std::string(spec.cards[c].fields[f].name), value_in(spec, before, c, f),
                     value_in(spec, now, c, f)};
      if (out.before != out.now) return out;
    }
  return {};
}

}  // namespace

void keep_last_cards(Deck& deck, std::int32_t keyword, std::int32_t name, Diagnostics& diagnostics) {
  const KeywordSpec& spec = *keyword_registry()[static_cast<std::size_t>(keyword)];
  const Entry *before = nullptr, *last = nullptr;
  spec.for_each(deck, keyword, [&](const Entry& entry) {
    if (entry.name == name) before = std::exchange(last, &entry);
  });
  if (!before) return;
  const Difference d = difference(spec, *before, *last);
  if (!d.field.empty())
    deck.warning(diagnostics, *last, d.field,
                 fmt::format("the last card counts, with '{}' here; the one at {} has '{}'", d.now,
                             deck.place(*before), d.before),
                 "leave out the other one");
  spec.keep_last(deck, keyword, name);
}

}  // namespace courant
