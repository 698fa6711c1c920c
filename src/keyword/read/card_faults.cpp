// Checks of fields, and messages about them.
#include <fmt/format.h>
#include <algorithm>
#include <utility>

#include "keyword/read/card_reader.hpp"
#include "keyword/read/number.hpp"

namespace courant {

bool CardReader::warn_of_cut_number(std::string_view line, const CardSpec& spec, std::size_t card) {
  const std::size_t last = last_column(spec, block_.format);
  const FieldType type = spec.fields.back().type;
  if (type == FieldType::text || type == FieldType::texts || type == FieldType::skip ||
      !runs_across(line, last) || line.substr(0, last).find(',') != std::string_view::npos)
    return false;
  diagnostics_->warning(
      here(static_cast<int>(last)),
      fmt::format("*{}: a number runs across column {}, the last of card {}; the rest is not read",
                  spec_->names[static_cast<std::size_t>(block_.match.name)], last, card + 1));
  return true;
}

bool CardReader::passes(std::size_t card, std::size_t field, const Slice& slice, Real value) {
  const FieldSpec& spec = spec_->cards[card].fields[field];
  if (!satisfies(spec.rules.check, value)) {
    field_error(card, field, slice, fmt::format("expected {}, got '{}'", expectation(spec), slice.text));
    return false;
  }
  if (value == spec.rules.standard) return true;
  if (spec.rules.honour == Honour::no) {
    field_refused(card, field, slice, fmt::format("leave the field blank or {:g}", spec.rules.standard));
    return false;
  }
  if (spec.rules.honour == Honour::output_only)
    diagnostics_->warning(here(slice.column),
                          fmt::format("{}: '{}' is not supported and has no effect",
                                      describe_field(*spec_, block_.match.name, card, field), slice.text));
  return true;
}

bool CardReader::is_allowed(std::size_t card, std::size_t field, const Slice& slice, Id value) {
  const auto& allowed = spec_->cards[card].fields[field].rules.allowed;
  if (allowed.takes(value)) return true;
  field_refused(card, field, slice, fmt::format("supported values: {}", fmt::join(allowed, ", ")));
  return false;
}

/// The field keeps its standard value.
void CardReader::field_refused(std::size_t card, std::size_t field, const Slice& slice, std::string hint) {
  field_error(card, field, slice, fmt::format("'{}' is not supported", slice.text), std::move(hint), true);
}

namespace {

/// Whether both letters belong to one number, as far as they show it: fields may follow each other closely.
bool cuts_number(char before, char behind) {
  const auto is_power = [](char c) { return c == 'e' || c == 'E'; };
  const auto is_sign = [](char c) { return c == '+' || c == '-'; };
  const auto is_part = [](char c) { return is_digit(c) || c == '.'; };
  return is_part(before)    ? is_part(behind) || is_power(behind)
         : is_power(before) ? is_digit(behind) || is_sign(behind)
                            : is_sign(before) && is_part(behind);
}

}  // namespace

// A fault that many lines of a block have is reported once; of one field at most five different ones.
void CardReader::field_error(std::size_t card, std::size_t field, const Slice& slice,
                             const std::string& message, std::string hint, bool contained) {
  constexpr int most_alike = 5;
  if (!origin_.empty()) hint += (hint.empty() ? "" : "; ") + origin_;
  if ((hint.empty() || contained) && is_shifted(card, slice)) {
    if (std::exchange(shifted_line_, line_) == line_) return;  // one cause
    hint = "are the fields of this line shifted by some columns? align them, or put commas between them";
  }
  std::string text = describe_field(*spec_, block_.match.name, card, field) + ": " + message;
  FieldFaults& faults = faults_[{card, field}];
  if (!repeated_.holds(text)) {
    if (faults.shown == most_alike)
      text = faults.last;
    else
      ++faults.shown, faults.last = text;
  }
  if (!repeated_.is_first(text, *diagnostics_)) return;
  diagnostics_->add({Severity::error, here(slice.column), std::move(text), std::move(hint), contained});
}

/// Whether a number of the line runs across the end of a field up to that of `slice`, or two are in it.
bool CardReader::is_shifted(std::size_t card, const Slice& slice) const {
  const CardSpec& spec = spec_->cards[card];
  if (is_comma_line(row_, last_column(spec, block_.format))) return false;
  Real number = 0;
  if (const std::size_t gap = slice.text.find("  "); gap != std::string_view::npos)
    return parse_real(slice.text.substr(0, gap), number) &&
           parse_real(trimmed(slice.text.substr(gap)), number);
  std::size_t column = 0;
  for (const FieldSpec& field : spec.fields) {
    if (column >= static_cast<std::size_t>(slice.column)) break;
    column += static_cast<std::size_t>(field_width(field, block_.format));
    if (field.type != FieldType::text && column < row_.size() && cuts_number(row_[column - 1], row_[column]))
      return true;
  }
  return false;
}

void CardReader::parameter_error(std::size_t card, std::size_t field, const Slice& slice,
                                 const Parameters::Resolved& failed) {
  if (failed.unknown.empty())
    field_error(card, field, slice, failed.error, failed.hint);
  else if (is_news(failed))
    diagnostics_->error(here(slice.column),
                        describe_field(*spec_, block_.match.name, card, field) + ": " + failed.error,
                        failed.hint);
}

// The message must follow, as the log knows it by its position.
bool CardReader::is_news(const Parameters::Resolved& failed) {
  return failed.unknown.empty() || diagnostics_ != &all_ || undefined_.is_first(failed.unknown, all_);
}

void CardReader::missing(const DataLines& data, const std::string& what) {
  line_ = static_cast<int>(data.index());  // the last line that is there
  const std::string name = spec_->names[static_cast<std::size_t>(block_.match.name)];
  diagnostics_->error(here(1), fmt::format("*{}: {} is missing", name, what),
                      fmt::format("`courant keywords {}` shows its cards", name));
}

}  // namespace courant
