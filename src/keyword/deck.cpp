#include "keyword/deck.hpp"

#include <fmt/format.h>

#include "keyword/read/number.hpp"
#include "keyword/read/parameters.hpp"
#include "keyword/read/variant_card.hpp"
#include "keyword/registry.hpp"
#include "keyword/source.hpp"

namespace courant {

namespace {

struct FieldPlace {
  std::size_t card = 0, field = 0;
  bool found = false;
};

const KeywordSpec* spec_of(const Entry& entry) {
  const auto& registry = keyword_registry();
  if (entry.keyword < 0 || entry.keyword >= static_cast<std::int32_t>(registry.size())) return nullptr;
  return registry[static_cast<std::size_t>(entry.keyword)].get();
}

FieldPlace find_field(const KeywordSpec& spec, std::string_view name) {
  if (name.empty()) return {};  // of the whole card; unused fields have no name, too
  for (std::size_t c = 0; c < spec.cards.size(); ++c)
    for (std::size_t f = 0; f < spec.cards[c].fields.size(); ++f)
      if (spec.cards[c].fields[f].name == name) return {c, f, true};
  return {};
}

/// Looks for an id on the lines of a repeated card.
bool find_value(DataLines data, const CardSpec& card, CardFormat format, Id value, Location& found) {
  std::vector<Slice> slices;
  for (; value != 0 && !data.done(); data.step()) {
    split_card(data.line(), card, format, slices);
    for (const Slice& slice : slices) {
      Id here = 0;
      if (!parse_integer(slice.text, here) || here != value) continue;
      found.line = static_cast<int>(data.index()) + 1;
      found.column = slice.column;
      return true;
    }
  }
  return false;
}

/// To a row of a repeated card, if it is there.
void step_rows(DataLines& data, std::size_t rows) {
  DataLines ahead = data;
  for (; rows > 0 && !ahead.done(); --rows) ahead.step();
  if (!ahead.done()) data = ahead;
}

/// Reads the entry's cards again, to find where a field stands: only messages need it, so no location is kept
/// with the data. `text`: what is there, unless it is a list.
Location locate(const KeywordSpec& spec, const Entry& entry, FieldPlace place, Deck::Repeat repeat,
                const SourceText& source, Location line, std::string& text) {
  const auto first = static_cast<std::size_t>(entry.line - 1);
  std::size_t above = first;
  while (above > 0 && (source.lines[above].empty() || source.lines[above][0] != '*')) --above;
  if (source.lines[above].empty() || source.lines[above][0] != '*') return line;
  const KeywordLine keyword = parse_keyword_line(source.lines[above], source.format);
  const KeywordMatch match = KeywordIndex().match(keyword.name);
  DataLines data(source, first);
  for (const bool extra : {spec.heading, match.id, match.title})
    if (extra && !data.done()) data.step();
  if (match.mpp) skip_mpp_lines(data);
  for (std::size_t c = 0; c < place.card && !data.done(); ++c)
    if ((!spec.cards[c].when || spec.cards[c].when(entry)) && !is_absent_variant(spec, c, data.line()))
      skip_card(data, spec.cards[c]);
  if (data.done()) return line;
  std::vector<Slice> slices;
  if (spec.cards[place.card].repeat) {
    step_rows(data, repeat.row);
    if (find_value(data, spec.cards[place.card], keyword.format, repeat.value, line)) return line;
  }
  split_card(data.line(), spec.cards[place.card], keyword.format, slices);
  line.line = static_cast<int>(data.index()) + 1;
  line.column = slices[place.field].column;
  // of a list, the message may be about any number
  if (!spec.cards[place.card].fields[place.field].is_vector()) text = slices[place.field].text;
  return line;
}

}  // namespace

Location Deck::where(const Entry& entry) const {
  if (entry.file < 0 || entry.file >= static_cast<std::int32_t>(files.size())) return {};
  return location(entry.file, entry.line, 1);
}

Location Deck::location(std::int32_t file, int line, int column) const {
  const auto file_at = [&](std::int32_t f) -> const DeckFile& { return files[static_cast<std::size_t>(f)]; };
  Location out{file_at(file).name, line, column, {}};
  for (std::int32_t f = file; file_at(f).parent >= 0; f = file_at(f).parent)
    out.included_from += fmt::format("{}{}:{}", out.included_from.empty() ? "" : ", from ",
                                     file_at(file_at(f).parent).name, file_at(f).line);
  return out;
}

Location Deck::where(const Entry& entry, std::string_view field, Repeat repeat) const {
  std::string text;
  return find(entry, field, repeat, text);
}

Location Deck::find(const Entry& entry, std::string_view field, Repeat repeat, std::string& text) const {
  const KeywordSpec* spec = spec_of(entry);
  const Location line = where(entry);
  if (!spec || line.file.empty() || entry.line < 1) return line;
  const FieldPlace place = find_field(*spec, field);
  const auto& source = files[static_cast<std::size_t>(entry.file)].source;
  if (!place.found || !source || static_cast<std::size_t>(entry.line) > source->lines.size()) return line;
  return locate(*spec, entry, place, repeat, *source, line, text);
}

std::string Deck::keyword(const Entry& entry) const {
  const KeywordSpec* spec = spec_of(entry);
  return spec ? fmt::format("*{}", spec->names[static_cast<std::size_t>(entry.name)]) : "*?";
}

std::string Deck::describe(const Entry& entry, std::string_view field) const {
  const KeywordSpec* spec = spec_of(entry);
  const FieldPlace place = spec ? find_field(*spec, field) : FieldPlace{};
  if (!place.found) return field.empty() ? keyword(entry) : fmt::format("{} {}", keyword(entry), field);
  return describe_field(*spec, entry.name, place.card, place.field);
}

const Entry* Deck::define(IdSpace space, Id id, const Entry& entry) {
  const auto [it, is_new] = definitions_.try_emplace({space, id}, entry);
  return is_new ? nullptr : &it->second;
}

std::string Deck::found_instead(IdSpace space, Id id) const {
  const auto it = definitions_.find({space, id});
  if (it == definitions_.end()) return "there is none";
  return fmt::format("it is a {}, defined at {}", keyword(it->second), place(it->second));
}

std::string Deck::first_name_of(IdSpace space, Id id) const {
  const auto it = definitions_.find({space, id});
  const KeywordSpec* spec = it == definitions_.end() ? nullptr : spec_of(it->second);
  return spec ? std::string(spec->names.front()) : std::string();
}

std::string Deck::place(const Entry& entry) const {
  const Location at = where(entry);
  return fmt::format("{}:{}", at.file, at.line);
}

/// "&width is 2.0, defined at deck.k:21", for a field that holds a parameter's name.
std::string Deck::origin(const std::string& text) const {
  if (!Parameters::is_name(text)) return {};
  const std::string name = upper_case(text.substr(text.find('&') + 1));
  const DeckParameter* found = nullptr;
  for (const DeckParameter& parameter : parameters) {
    if (upper_case(parameter.name) != name) continue;
    if (found) return {};  // which of several local ones is no longer known
    found = &parameter;
  }
  if (!found) return {};
  return fmt::format(
      "&{} is {}, {}", found->name, found->text,
      found->given ? "by --param" : fmt::format("defined at {}:{}", found->where.file, found->where.line));
}

Diagnostic Deck::about(const Entry& entry, std::string_view field, const std::string& message,
                       std::string hint) const {
  std::string text;
  Location where = find(entry, field, {}, text);
  if (const std::string from = origin(text); !from.empty()) hint += (hint.empty() ? "" : "; ") + from;
  return {Severity::error, std::move(where), describe(entry, field) + ": " + message, std::move(hint)};
}

void Deck::error(Diagnostics& diagnostics, const Entry& entry, std::string_view field, std::string message,
                 std::string hint) const {
  diagnostics.add(about(entry, field, message, std::move(hint)));
}

void Deck::refuse(Diagnostics& diagnostics, const Entry& entry, std::string_view field, std::string message,
                  std::string hint) const {
  Diagnostic refusal = about(entry, field, message, std::move(hint));
  refusal.contained = true;
  diagnostics.add(std::move(refusal));
}

void Deck::warning(Diagnostics& diagnostics, const Entry& entry, std::string_view field, std::string message,
                   std::string hint) const {
  Diagnostic warning = about(entry, field, message, std::move(hint));
  warning.severity = Severity::warning;
  diagnostics.add(std::move(warning));
}

}  // namespace courant
