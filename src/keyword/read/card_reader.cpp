#include "keyword/read/card_reader.hpp"

#include <fmt/format.h>
#include <algorithm>
#include <cctype>
#include <limits>

#include "base/utf8.hpp"
#include "keyword/read/number.hpp"
#include "keyword/read/variant_card.hpp"

namespace courant {

bool satisfies(Check check, Real value) {
  switch (check) {
    case Check::positive:
      return value > 0;
    case Check::not_negative:
      return value >= 0;
    case Check::not_positive:
      return value <= 0;
    default:
      return true;
  }
}

bool is_whole(FieldType type) {
  return type == FieldType::integer || type == FieldType::id || type == FieldType::ids;
}

std::string expectation(const FieldSpec& field) {
  const char* condition[] = {"", " > 0", " >= 0", " <= 0"};
  return std::string(is_whole(field.type) ? "an integer" : "a number") +
         condition[static_cast<int>(field.rules.check)];
}

namespace {

/// Whether each line is an entry, as in the tables of nodes and elements.
bool is_table(const KeywordSpec& spec, const KeywordMatch& match) {
  return spec.many && spec.cards.size() == 1 && !spec.cards[0].repeat && !spec.heading && !match.id &&
         !match.title;
}

}  // namespace

void CardReader::read(const Block& block, Diagnostics& diagnostics) {
  block_ = block;
  diagnostics_ = &diagnostics;
  spec_ = keyword_registry()[static_cast<std::size_t>(block.match.keyword)].get();
  line_ = static_cast<int>(block.line) + 1;
  const auto sink = spec_->sink(deck_);
  find_end();
  table_ = {};
  faults_.clear(), repeated_ = {}, shifted_line_ = 0;
  if (is_table(*spec_, block.match)) {
    sink->expect(end_ - block.line - 1);
    table_ = TableLines(*spec_, block.format);
  }
  DataLines data(*block.source, block.line + 1);
  if (data.done() && !spec_->cards.empty() && !spec_->cards[0].optional) missing(data, "card 1");
  if (data.done() && spec_->cards.empty()) read_set(data, *sink);  // its name says all
  bool first = true;
  while (!data.done() && !full()) {
    if (!first && only_blanks_left(data)) break;
    line_ = static_cast<int>(data.index()) + 1;
    if (!first && !spec_->many) {
      diagnostics_->error(
          here(1),
          fmt::format("*{}: one line too many", spec_->names[static_cast<std::size_t>(block_.match.name)]),
          "the keyword takes one set of cards; compare `courant keywords " +
              spec_->names[static_cast<std::size_t>(block_.match.name)] + "`");
      break;
    }
    const std::size_t before = data.index();
    read_set(data, *sink);
    if (data.index() == before) break;  // a keyword without cards
    first = false;
  }
  repeated_.close(diagnostics);
}

/// Once for the block: to look ahead at each card would take the square of the number of blank lines.
void CardReader::find_end() {
  const auto& lines = block_.source->lines;
  end_ = block_.source->next_keyword(block_.line + 1);
  while (end_ > block_.line + 1 && (trimmed(lines[end_ - 1]).empty() || lines[end_ - 1][0] == '$')) --end_;
}

void CardReader::read_set(DataLines& data, EntrySink& sink) {
  Entry entry;
  entry.file = block_.file;
  entry.line = line_;
  entry.keyword = block_.match.keyword;
  entry.name = block_.match.name;
  sink.begin(entry);
  if (table_.usable()) {
    if (table_.read(data.line(), sink.fields())) {
      data.step();
      finish(sink);
      return;
    }
    sink.begin(entry);
  }
  if (!read_title_lines(data, sink)) return;
  read_cards(data, sink);
  finish(sink);
}

void CardReader::finish(EntrySink& sink) {
  convert(sink);
  refuse_second_definition(sink.entry());
  sink.commit();
  ++count_;
}

void CardReader::convert(EntrySink& sink) {
  const Conversion& conversion = deck_.files[static_cast<std::size_t>(block_.file)].conversion;
  if (!conversion.any()) return;
  const std::string reason = sink.convert(conversion);
  if (!reason.empty())
    diagnostics_->error(
        here(1), fmt::format("*{}: {}", spec_->names[static_cast<std::size_t>(block_.match.name)], reason));
}

void CardReader::refuse_second_definition(const Entry& entry) {
  const Id id = spec_->id_of(entry);
  // no id, one that was refused already, or none that must be unique
  if (id <= 0 || is_mesh(spec_->id_space) || may_repeat(spec_->id_space)) return;
  const Entry* first = deck_.define(spec_->id_space, id, entry);
  if (!first || block_.match.collect || spec_->id_may_repeat) return;
  deck_.error(*diagnostics_, entry, block_.match.id ? "" : spec_->cards[0].fields[0].name,
              fmt::format("{} {} is defined twice, first as {} at {}", id_word(spec_->id_space), id,
                          deck_.keyword(*first), deck_.place(*first)),
              fmt::format("give every {} an id of its own{}", id_word(spec_->id_space),
                          first->keyword == entry.keyword ? "" : ", whatever its kind"));
}

void CardReader::read_cards(DataLines& data, EntrySink& sink) {
  for (std::size_t c = 0; c < spec_->cards.size(); ++c) {
    const CardSpec& card = spec_->cards[c];
    if (card.when && !card.when(sink.entry())) continue;
    if (card.repeat) {
      for (; !data.done() && !full() && !only_blanks_left(data) && (!card.more || card.more(sink.entry()));
           data.step()) {
        if (card.until_entry && begins_entry(data.line())) return;
        if (card.whole_lines)
          read_whole_line(data, c, sink);
        else
          read_card(data, c, sink);
      }
      if (card.more) {
        if (!full() && card.more(sink.entry())) return missing(data, fmt::format("card {}", c + 1));
        continue;
      }
      while (!data.done()) data.step();
      return;
    }
    if (!data.done() && is_absent_variant(*spec_, c, data.line())) continue;
    if (data.done()) {
      if (!card.optional) {
        missing(data, fmt::format("card {}", c + 1));
        return;
      }
      continue;
    }
    if (holds_file_name(card)) {
      sink.set_text(c, 0, parameters_.with_texts(read_file_name(data)));
      continue;
    }
    read_card(data, c, sink);
    data.step();
  }
}

/// Whether a line has all that card 1 requires, as integers > 0.
bool CardReader::begins_entry(std::string_view line) {
  const CardSpec& first = spec_->cards.front();
  split_card(line, first, block_.format, slices_);
  for (std::size_t k = 0; k < first.fields.size(); ++k) {
    if (!first.fields[k].rules.required) continue;
    Id value = 0;
    const std::string_view text = slices_[k].text;
    const Parameters::Resolved named =
        Parameters::is_reference(text) ? parameters_.resolve(text) : Parameters::Resolved{};
    if (Parameters::is_reference(text) ? named.failed || !parse_integer(named.text, value)
                                       : !parse_integer(text, value))
      return false;
    if (value <= 0) return false;
  }
  return true;
}

/// Numbers of parameters are in parentheses, so that signs keep their operand.
void CardReader::read_whole_line(const DataLines& data, std::size_t card, EntrySink& sink) {
  line_ = static_cast<int>(data.index()) + 1;
  const std::string_view line = data.line();
  std::string out;
  for (std::size_t at = 0; at < line.size();) {
    if (line[at] != '&') {
      out += line[at++];
      continue;
    }
    std::size_t end = at + 1;
    while (end < line.size() && (std::isalnum(static_cast<unsigned char>(line[end])) || line[end] == '_'))
      ++end;
    const Parameters::Resolved value = parameters_.resolve(line.substr(at, end - at));
    if (value.failed && is_news(value))
      diagnostics_->error(
          here(static_cast<int>(at) + 1),
          fmt::format("*{}: {}", spec_->names[static_cast<std::size_t>(block_.match.name)], value.error),
          value.hint);
    out += value.type == 'C' ? value.text : "(" + value.text + ")";
    at = end;
  }
  sink.set_text(card, 0, out);
}

void CardReader::read_card(const DataLines& data, std::size_t card, EntrySink& sink) {
  line_ = static_cast<int>(data.index()) + 1;
  row_ = data.line();
  int too_many = 0;
  split_card(data.line(), spec_->cards[card], block_.format, slices_, &too_many);
  const std::size_t fields = spec_->cards[card].fields.size();
  for (std::size_t i = 0; i < slices_.size(); ++i)
    read_field(card, std::min(i, fields - 1), slices_[i], sink);
  if (spec_->cards[card].fields.back().rules.pairs && slices_.size() % 2 != 0)
    sink.set_integer(card, fields - 1, 0);
  if (!warn_of_cut_number(data.line(), spec_->cards[card], card) && too_many > 0)
    diagnostics_->warning(
        here(1),
        fmt::format("*{}: card {} has {} fields; values behind them ({}) are not read",
                    spec_->names[static_cast<std::size_t>(block_.match.name)], card + 1, fields, too_many));
}

/// Of a list of ids, whether a blank field or 0 has a location in it.
bool CardReader::keeps_zeros(std::size_t card, const FieldSpec& spec) const {
  return spec.type == FieldType::ids && (spec_->cards[card].is_table || spec.rules.pairs);
}

/// A value for what is blank or faulty, so that the lists of a table have a member for each card.
void CardReader::fill_list(std::size_t card, const FieldSpec& spec, std::size_t field, EntrySink& sink) {
  if (spec.type == FieldType::reals) sink.set_real(card, field, 0);
  if (spec.type == FieldType::texts) sink.set_text(card, field, "");
  if (keeps_zeros(card, spec)) sink.set_integer(card, field, 0);
}

void CardReader::read_field(std::size_t card, std::size_t field, Slice slice, EntrySink& sink) {
  const FieldSpec& spec = spec_->cards[card].fields[field];
  if (spec.type == FieldType::skip) {
    parameters_.note_mentions(slice.text);
    return;
  }
  if (!origin_.empty()) origin_.clear();
  if (slice.text.empty()) {
    if (spec.rules.required && !spec.is_vector())
      field_error(card, field, slice, fmt::format("expected {}, got a blank field", expectation(spec)),
                  spec.rules.allowed.empty()
                      ? ""
                      : fmt::format("supported values: {}", fmt::join(spec.rules.allowed, ", ")));
    return fill_list(card, spec, field, sink);  // the entry began with the standard values
  }
  std::string held;
  const bool text = spec.type == FieldType::text || spec.type == FieldType::texts;
  if (text) {
    if (!substitute_texts(card, field, slice, held)) return fill_list(card, spec, field, sink);
    if (spec.rules.honour == Honour::no) {
      field_refused(card, field, slice, "leave the field blank");
      return fill_list(card, spec, field, sink);
    }
    sink.set_text(card, field, without_controls(slice.text));
    return;
  }
  const bool known = !Parameters::is_reference(slice.text) || substitute(card, field, slice, held);
  if (!known ||
      !(is_whole(spec.type) ? read_integer(card, field, slice, sink) : read_real(card, field, slice, sink)))
    fill_list(card, spec, field, sink);
}

/// Whether the number is sound.
bool CardReader::read_integer(std::size_t card, std::size_t field, const Slice& slice, EntrySink& sink) {
  const FieldSpec& spec = spec_->cards[card].fields[field];
  Id value = 0;
  if (!parse_integer(slice.text, value)) {
    field_error(card, field, slice, fmt::format("expected {}, got '{}'", expectation(spec), slice.text),
                number_hint(slice.text));
    return false;
  }
  if (value == 0 && spec.type == FieldType::ids) {
    if (keeps_zeros(card, spec)) sink.set_integer(card, field, 0);
    return true;
  }
  if (value == 0 && spec.rules.zero_is_standard && !spec.rules.required) return true;
  if (spec.rules.required && value == 0 && spec.type == FieldType::id && spec.rules.check == Check::any) {
    field_error(card, field, slice, "expected an id that is not 0, got '0'");
    return false;
  }
  const Id largest = spec.type == FieldType::integer ? std::numeric_limits<int>::max() : largest_id;
  if (value > largest || value < -largest) {
    field_error(card, field, slice, fmt::format("'{}' is too large", slice.text));
    return false;
  }
  if (!passes(card, field, slice, static_cast<Real>(value)) || !is_allowed(card, field, slice, value))
    return false;
  sink.set_integer(card, field, value);
  return true;
}

bool CardReader::read_real(std::size_t card, std::size_t field, const Slice& slice, EntrySink& sink) {
  const FieldSpec& spec = spec_->cards[card].fields[field];
  Real value = 0;
  if (!parse_real(slice.text, value)) {
    field_error(card, field, slice, fmt::format("expected {}, got '{}'", expectation(spec), slice.text),
                number_hint(slice.text));
    return false;
  }
  if (value == 0 && !spec.is_vector() && spec.rules.zero_is_standard && !spec.rules.required) return true;
  if (!passes(card, field, slice, value)) return false;
  sink.set_real(card, field, value);
  return true;
}

bool CardReader::substitute(std::size_t card, std::size_t field, Slice& slice, std::string& held) {
  const FieldSpec& spec = spec_->cards[card].fields[field];
  Parameters::Resolved value = parameters_.resolve(slice.text);
  if (value.failed) {
    slice.column += static_cast<int>(value.at);
    if (!value.error.empty()) parameter_error(card, field, slice, value);
    return false;
  }
  origin_ = std::move(value.origin);
  if (value.type == 'C') {
    field_error(
        card, field, slice,
        fmt::format("expected {}, got '{}', which is a text (C) parameter", expectation(spec), slice.text));
    return false;
  }
  if (is_whole(spec.type) && value.type == 'R') {
    const bool named = !origin_.empty();
    Id whole = 0;
    if (named && parse_integer(value.text, whole)) {  // as 5.0 in a field for integers
      diagnostics_->warning(
          here(slice.column),
          fmt::format("{}: '{}' is a real (R) parameter, taken as {}",
                      describe_field(*spec_, block_.match.name, card, field), slice.text, whole),
          "declare it with the type letter I");
      held = std::to_string(whole);
      slice.text = held;
      return true;
    }
    field_error(card, field, slice,
                fmt::format("expected {}, got '{}', which is a real{}", expectation(spec), slice.text,
                            named ? " (R) parameter" : ""),
                named ? "declare it with the type letter I" : "int() or nint() makes it an integer");
    return false;
  }
  held = std::move(value.text);
  if (origin_.empty()) origin_ = fmt::format("{} is {}", slice.text, held);
  slice.text = held;
  return true;
}

bool CardReader::substitute_texts(std::size_t card, std::size_t field, Slice& slice, std::string& held) {
  if (slice.text.find('&') == std::string_view::npos) return true;
  if (Parameters::is_name(slice.text)) {
    Parameters::Resolved value = parameters_.resolve(slice.text);
    if (value.failed && !value.error.empty()) parameter_error(card, field, slice, value);
    if (value.failed) return false;
    held = std::move(value.text);
  } else {
    held = parameters_.with_texts(slice.text);
  }
  slice.text = held;
  return true;
}

}  // namespace courant
