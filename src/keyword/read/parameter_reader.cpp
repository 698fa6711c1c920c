// *PARAMETER and its kin: their lines.
#include <fmt/format.h>
#include <algorithm>
#include <utility>

#include "keyword/read/deck_reader.hpp"

namespace courant {

namespace {

/// What the words behind *PARAMETER ask for, in whatever order they stand.
struct ParameterOptions {
  bool known = true, expression = false, local = false, global = false, can_change = false, typed = false;
};

ParameterOptions options_of(std::string_view words) {
  ParameterOptions out;
  while (!words.empty()) {
    const std::size_t end = std::min(words.find('_', 1), words.size());
    const std::string_view word = words.substr(0, end);
    bool* flag = word == "_EXPRESSION" ? &out.expression
                 : word == "_LOCAL"    ? &out.local
                 : word == "_GLOBAL"   ? &out.global
                 : word == "_MUTABLE"  ? &out.can_change
                 : word == "_TYPE"     ? &out.typed
                                       : nullptr;
    if (flag)
      *flag = true;
    else if (word != "_NOECHO")  // what is echoed has no influence
      out.known = false;
    words.remove_prefix(end);
  }
  if (out.typed && out.expression) out.known = false;
  return out;
}

/// "R dx, 1.0": the comma that separates name and expression; npos in fixed columns, where commas belong to
/// functions, on whichever line these end, or to a text.
std::size_t comma_behind_name(std::string_view line) {
  const std::size_t comma = line.find(',');
  if (comma == std::string_view::npos || comma > line.find('(')) return std::string_view::npos;
  const std::string_view declaration = trimmed(line.substr(0, comma));
  const std::string_view name = declaration.empty() ? declaration : trimmed(declaration.substr(1));
  return name.find(' ') == std::string_view::npos ? comma : std::string_view::npos;
}

bool is_blank(std::string_view text) {
  return text.find_first_not_of(" \r") == std::string_view::npos;
}

}  // namespace

bool DeckReader::read_parameter_keyword(const File& file, std::size_t line, const KeywordLine& keyword) {
  constexpr std::string_view stem = "PARAMETER";
  if (keyword.name == "PARAMETER_DUPLICATION") {
    read_cards(file, line, keyword);
    if (const auto* choice = deck_.last<ParameterDuplication>()) parameters_.set_duplication(choice->dflag);
    return true;
  }
  if (keyword.name.compare(0, stem.size(), stem) != 0) return false;
  const ParameterOptions options = options_of(std::string_view(keyword.name).substr(stem.size()));
  if (!options.known) return false;
  if (options.local && options.global) {
    diagnostics_.error(place(file, line),
                       fmt::format("*{}: LOCAL and GLOBAL exclude each other", keyword.name));
    return true;
  }
  const std::string name = "*" + keyword.name;
  Parameters::Definition definition;
  definition.keyword = name;
  definition.is_expression = options.expression;
  definition.local = options.local;
  definition.can_change = options.can_change;
  if (options.expression)
    read_parameter_expressions(file, line, keyword.format, definition);
  else
    read_parameters(file, line, keyword.format, options.typed, definition);
  return true;
}

/// `typed`: *PARAMETER_TYPE has one name, its value and a word for pre-processors on each line.
void DeckReader::read_parameters(const File& file, std::size_t line, CardFormat format, bool typed,
                                 Parameters::Definition& definition) {
  const int width = format == CardFormat::long_fields ? 20 : 10;
  for (DataLines data(*file.source, line + 1); !data.done() && !cards_.full(); data.step()) {
    std::vector<Slice> slices = split_equal(data.line(), width, 8 * width);
    if (typed && slices.size() > 2) slices.resize(2);
    if (slices.size() % 2 == 1) slices.push_back({{}, static_cast<int>(data.line().size()) + 1});
    for (std::size_t i = 0; i < slices.size(); i += 2) {
      const Slice& name = slices[i];
      const Slice& value = slices[i + 1];
      if (name.text.empty()) {
        if (!value.text.empty())
          diagnostics_.error(place(file, data.index(), value.column),
                             fmt::format("{}: the value '{}' has no name", definition.keyword, value.text),
                             "the type letter and name come before the value");
        continue;
      }
      definition.declaration = name.text;
      definition.value = value.text;
      definition.where = place(file, data.index(), name.column);
      definition.place_in_value = [&](std::size_t at) {
        return place(file, data.index(), value.column + static_cast<int>(at));
      };
      parameters_.define(definition, diagnostics_);
    }
  }
}

void DeckReader::read_parameter_expressions(const File& file, std::size_t line, CardFormat format,
                                            Parameters::Definition& definition) {
  const std::size_t width = format == CardFormat::long_fields ? 20 : 10, last = 8 * width;
  DataLines data(*file.source, line + 1);
  while (!data.done() && !cards_.full()) {
    const std::string_view text = data.line();
    const std::size_t first = data.index();
    if (is_blank(text)) {
      data.step();
      continue;
    }
    const std::size_t comma = comma_behind_name(text);
    const bool fixed = comma == std::string_view::npos;
    const std::size_t begin = fixed ? std::min(width, text.size()) : comma + 1;
    std::vector<ExpressionPiece> pieces = {{0, first, begin}};
    std::string expression(text.substr(begin));
    refuse_text_behind(file, first, fixed ? last : text.size(), definition.keyword);
    for (data.step(); !data.done() && is_blank(data.line().substr(0, width)); data.step()) {
      const std::size_t from = std::min(width, data.line().size());
      pieces.push_back({expression.size(), data.index(), from});
      expression += data.line().substr(from);
      refuse_text_behind(file, data.index(), last, definition.keyword);
    }
    while (!expression.empty() && expression.back() == ' ') expression.pop_back();
    const std::string_view declaration = trimmed(text.substr(0, fixed ? begin : comma));
    const std::size_t indent = std::min(text.find_first_not_of(' '), text.size());
    definition.declaration = declaration;
    definition.where = place(file, first, static_cast<int>(indent) + 1);
    const std::size_t blanks = std::min(expression.find_first_not_of(' '), expression.size());
    definition.value = std::string_view(expression).substr(blanks);
    definition.place_in_value = [&, blanks](std::size_t at) {
      const auto piece = std::prev(
          std::upper_bound(pieces.begin(), pieces.end(), at + blanks,
                           [](std::size_t offset, const ExpressionPiece& p) { return offset < p.offset; }));
      return place(file, piece->line, static_cast<int>(piece->column + at + blanks - piece->offset) + 1);
    };
    if (declaration.empty())
      diagnostics_.error(
          definition.where,
          fmt::format("{}: there is no expression above that this line could continue", definition.keyword),
          "the type letter and name are in the first columns");
    else
      parameters_.define(definition, diagnostics_);
  }
}

/// What LS-DYNA would not read must not change the value here, nor be dropped.
void DeckReader::refuse_text_behind(const File& file, std::size_t line, std::size_t columns,
                                    std::string_view keyword) {
  const std::string_view text = file.source->lines[line];
  if (text.size() <= columns || is_blank(text.substr(columns))) return;
  diagnostics_.error(place(file, line, static_cast<int>(columns) + 1),
                     fmt::format("{}: the expression goes on behind column {}", keyword, columns),
                     "continue it on the next line, behind blank first columns");
}

}  // namespace courant
