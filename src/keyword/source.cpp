#include "keyword/source.hpp"

#include <algorithm>
#include <cctype>

#include "keyword/read/number.hpp"

namespace courant {

namespace {

Slice slice_of(std::string_view line, std::size_t begin, std::size_t end) {
  begin = std::min(begin, line.size());
  end = std::min(end, line.size());
  std::size_t first = begin;
  while (first < end && (line[first] == ' ' || line[first] == '\r')) ++first;
  if (first == end) return {{}, static_cast<int>(begin) + 1};
  while (end > first && (line[end - 1] == ' ' || line[end - 1] == '\r')) --end;
  return {line.substr(first, end - first), static_cast<int>(first) + 1};
}

/// Numbers other than 0 that stand by themselves in the columns from `first` up to `end`: values of fields
/// that the card has not, where comments behind the last column are words.
int values_behind(std::string_view line, std::size_t first, std::size_t end, std::size_t width) {
  int count = 0;
  for (std::size_t column = first; column < std::min(line.size(), end); column += width) {
    Real value = 0;
    const Slice slice = slice_of(line, column, std::min(column + width, end));
    if (!slice.text.empty() && parse_real(slice.text, value) && value != 0) ++count;
  }
  return count;
}

void split_commas(std::string_view line, std::vector<Slice>& slices) {
  const bool brackets = has_brackets(line);
  std::size_t begin = 0;
  while (true) {
    const std::size_t comma = next_comma(line, begin, brackets);
    slices.push_back(slice_of(line, begin, std::min(comma, line.size())));
    if (comma == std::string_view::npos) return;
    begin = comma + 1;
  }
}

}  // namespace

std::string_view trimmed(std::string_view text) {
  return slice_of(text, 0, text.size()).text;
}

std::string upper_case(std::string_view text) {
  std::string out(text);
  for (char& c : out) c = static_cast<char>(std::toupper(static_cast<unsigned char>(c)));
  return out;
}

KeywordLine parse_keyword_line(std::string_view line, CardFormat file_format) {
  line.remove_prefix(1);
  const std::size_t end = std::min(line.find(' '), line.size());
  KeywordLine out{upper_case(line.substr(0, end)), file_format, trimmed(line.substr(end))};
  char suffix = 0;
  const std::string_view marks = "+-%";
  if (!out.name.empty() && marks.find(out.name.back()) != std::string_view::npos) {
    suffix = out.name.back();
    out.name.pop_back();
  } else if (!out.rest.empty() && marks.find(out.rest[0]) != std::string_view::npos &&
             (out.rest.size() == 1 || out.rest[1] == ' ')) {
    suffix = out.rest[0];
  }
  if (suffix == '+') out.format = CardFormat::long_fields;
  if (suffix == '-') out.format = CardFormat::standard;
  if (suffix == '%') out.format = CardFormat::i10;
  return out;
}

bool DataLines::only_blanks_left() const {
  DataLines ahead = *this;
  while (!ahead.done()) {
    if (!trimmed(ahead.line()).empty()) return false;
    ahead.step();
  }
  return true;
}

bool holds_file_name(const CardSpec& card) {
  return card.fields.size() == 1 && card.fields[0].name == "FILENAME";
}

std::string read_file_name(DataLines& data) {
  std::string name;
  for (bool more = true; more && !data.done(); data.step()) {
    std::string_view part = trimmed(data.line());
    more = part.size() >= 2 && part.substr(part.size() - 2) == " +";
    if (more) part.remove_suffix(2);
    name += trimmed(part);
  }
  const auto quoted = [&](char quote) {
    return name.size() >= 2 && name.front() == quote && name.back() == quote;
  };
  return quoted('"') || quoted('\'') ? std::string(trimmed(name.substr(1, name.size() - 2))) : name;
}

void skip_card(DataLines& data, const CardSpec& card) {
  if (holds_file_name(card))
    read_file_name(data);
  else
    data.step();
}

bool has_brackets(std::string_view line) {
  if (line.find_first_of("(<") == std::string_view::npos) return false;
  int depth = 0;
  for (const char c : line) {
    if (c == '(' || c == '<') ++depth;
    if ((c == ')' || c == '>') && depth > 0) --depth;
  }
  return depth == 0;
}

std::size_t next_comma(std::string_view line, std::size_t from, bool brackets) {
  if (!brackets) return line.find(',', from);
  int depth = 0;
  for (std::size_t k = from; k < line.size(); ++k) {
    const char c = line[k];
    if (c == '(' || c == '<') ++depth;
    if ((c == ')' || c == '>') && depth > 0) --depth;
    if (c == ',' && depth == 0) return k;
  }
  return std::string_view::npos;
}

bool is_comma_line(std::string_view line, std::size_t columns) {
  // most lines have no comma at all
  return line.substr(0, columns).find(',') != std::string_view::npos &&
         next_comma(line, 0, has_brackets(line)) < columns;
}

int field_width(const FieldSpec& field, CardFormat format) {
  const int width = field.rules.width;
  if (format == CardFormat::i10) return std::max(width, 10);
  if (format == CardFormat::long_fields) return width > 20 ? 2 * width : 20;
  return width;
}

std::size_t last_column(const CardSpec& card, CardFormat format) {
  std::size_t total = 0;
  for (const FieldSpec& field : card.fields) total += static_cast<std::size_t>(field_width(field, format));
  const bool list = !card.fields.empty() && card.fields.back().takes_rest;
  const std::size_t columns = format == CardFormat::long_fields ? 160 : 80;
  return list ? std::max(total, columns) : total;
}

void split_card(std::string_view line, const CardSpec& card, CardFormat format, std::vector<Slice>& slices,
                int* too_many) {
  slices.clear();
  const bool list = !card.fields.empty() && card.fields.back().takes_rest;
  const std::size_t total = last_column(card, format);
  // what is behind the last column is ignored, so a comma there does not make this a comma line
  if (is_comma_line(line, total)) {
    split_commas(line, slices);
    if (!list && slices.size() > card.fields.size()) {
      const auto extra = slices.begin() + static_cast<std::ptrdiff_t>(card.fields.size());
      if (too_many)
        *too_many = static_cast<int>(
            std::count_if(extra, slices.end(), [](const Slice& s) { return !s.text.empty(); }));
      slices.erase(extra, slices.end());
    }
    for (std::size_t i = slices.size(); i < card.fields.size(); ++i)
      slices.push_back({{}, static_cast<int>(line.size()) + 1});
    return;
  }
  std::size_t column = 0;
  for (const FieldSpec& field : card.fields) {
    const auto width = static_cast<std::size_t>(field_width(field, format));
    slices.push_back(slice_of(line, column, column + width));
    if (slices.back().text.empty()) slices.back().column = static_cast<int>(column) + 1;
    column += width;
  }
  const std::size_t cell = format == CardFormat::long_fields ? 20 : 10;
  if (too_many && line.size() > total && !(list && card.fields.back().type == FieldType::texts))
    *too_many = values_behind(line, total, list ? line.size() : 8 * cell, cell);
  if (!list) return;
  const auto width = static_cast<std::size_t>(field_width(card.fields.back(), format));
  for (; column < std::min(line.size(), total); column += width)
    slices.push_back(slice_of(line, column, column + width));
  if (too_many && card.fields.back().type == FieldType::texts)
    for (; column < line.size(); column += width)
      *too_many += slice_of(line, column, column + width).text.empty() ? 0 : 1;
}

std::vector<Slice> split_equal(std::string_view line, int width, int limit) {
  std::vector<Slice> slices;
  if (is_comma_line(line, static_cast<std::size_t>(limit))) {
    split_commas(line, slices);
    return slices;
  }
  const std::size_t end = std::min(line.size(), static_cast<std::size_t>(limit));
  for (std::size_t column = 0; column < end; column += static_cast<std::size_t>(width))
    slices.push_back(slice_of(line, column, column + static_cast<std::size_t>(width)));
  return slices;
}

}  // namespace courant
