#include "keyword/read/table_lines.hpp"

#include <algorithm>
#include <cstring>
#include <limits>

#include "keyword/read/number.hpp"

namespace courant {

namespace {

template <class Number>
void store(std::byte* entry, std::size_t offset, Number number) {
  std::memcpy(entry + offset, &number, sizeof number);
}

}  // namespace

TableLines::TableLines(const KeywordSpec& spec, CardFormat format) {
  for (const FieldSpec& field : spec.cards[0].fields) {
    const bool number = field.type == FieldType::integer || field.type == FieldType::id ||
                        field.type == FieldType::real || field.type == FieldType::skip;
    if (!number) {
      columns_.clear();
      return;
    }
    Column column;
    column.width = static_cast<std::size_t>(field_width(field, format));
    column.offset = field.offset;
    column.type = field.type;
    column.check = field.rules.check;
    column.required = field.rules.required;
    column.zero_is_standard = field.rules.zero_is_standard && !field.rules.required;
    column.any_value = field.rules.honour == Honour::yes || field.rules.honour == Honour::ignored;
    column.standard = field.rules.standard;
    column.allowed = field.rules.allowed;
    total_ += column.width;
    columns_.push_back(column);
  }
}

bool TableLines::read(std::string_view line, std::byte* entry) const {
  const std::size_t used = std::min(line.size(), total_);
  if (std::memchr(line.data(), ',', used)) return read_commas(line, entry);
  return !runs_across(line, total_) && read_columns(line.substr(0, used), entry);
}

bool TableLines::read_columns(std::string_view line, std::byte* entry) const {
  const char* begin = line.data();
  const char* const end = begin + line.size();
  for (const Column& column : columns_) {
    const char* const next = begin + std::min(column.width, static_cast<std::size_t>(end - begin));
    if (!read_field(column, begin, next, entry)) return false;
    begin = next;
  }
  return true;
}

bool TableLines::read_commas(std::string_view line, std::byte* entry) const {
  const char* begin = line.data();
  const char* const end = begin + line.size();
  for (const Column& column : columns_) {
    const auto* comma =
        begin < end ? static_cast<const char*>(std::memchr(begin, ',', static_cast<std::size_t>(end - begin)))
                    : nullptr;
    if (!read_field(column, begin, comma ? comma : end, entry)) return false;
    begin = comma ? comma + 1 : end;
  }
  return std::all_of(begin, end, [](char c) { return c == ' ' || c == ','; });
}

bool TableLines::read_field(const Column& column, const char* begin, const char* end, std::byte* entry) {
  if (column.type == FieldType::skip)  // CardReader notes that parameters are used
    return std::none_of(begin, end, [](char c) { return c == '&' || c == '<' || c == '('; });
  while (begin < end && *begin == ' ') ++begin;
  if (begin == end) return !column.required;
  while (end[-1] == ' ') --end;
  return column.type == FieldType::real ? read_real(column, begin, end, entry)
                                        : read_integer(column, begin, end, entry);
}

bool TableLines::read_integer(const Column& column, const char* begin, const char* end, std::byte* entry) {
  Id value = 0;
  if (!parse_plain_integer(begin, end, value)) return false;
  if (value == 0) {
    if (column.required) return false;
    if (column.zero_is_standard) return true;
  }
  const Id largest = column.type == FieldType::integer ? std::numeric_limits<int>::max() : largest_id;
  if (value > largest || value < -largest || !satisfies(column.check, static_cast<Real>(value))) return false;
  if (!column.any_value && static_cast<Real>(value) != column.standard) return false;
  if (!column.allowed.takes(value)) return false;
  if (column.type == FieldType::integer)
    store(entry, column.offset, static_cast<int>(value));
  else
    store(entry, column.offset, value);
  return true;
}

bool TableLines::read_real(const Column& column, const char* begin, const char* end, std::byte* entry) {
  Real value = 0;
  if (!parse_plain_real(begin, end, value)) return false;
  if (value == 0 && column.zero_is_standard) return true;
  if (!satisfies(column.check, value) || (!column.any_value && value != column.standard)) return false;
  store(entry, column.offset, value);
  return true;
}

}  // namespace courant
