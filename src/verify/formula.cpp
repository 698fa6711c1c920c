#include "verify/formula.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <limits>
#include <optional>
#include <string_view>

namespace courant {
namespace {

bool is_word(char c) {
  return std::isalnum(static_cast<unsigned char>(c)) || c == '_';
}

/// The dataset whose name starts at `begin`, if one does: global/NAME, or GROUP/NUMBER/NAME, with .x, .y or
/// .z where it is a vector. So fixed a form leaves a division a division: `global/total/2`.
std::optional<HistoryName> history_name_at(std::string_view text, std::size_t begin) {
  std::size_t at = begin;
  const auto word = [&] {
    const std::size_t first = at;
    while (at < text.size() && is_word(text[at])) ++at;
    return text.substr(first, at - first);
  };
  const auto slash = [&] { return at < text.size() && text[at] == '/' && ++at > 0; };
  const std::string_view group = word();
  const bool numbered =
      group == "parts" || group == "contacts" || group == "rigid_bodies" || group == "particles";
  if (!numbered && group != "global") return std::nullopt;
  if (!slash()) return std::nullopt;
  if (numbered) {
    const std::string_view id = word();
    if (id.empty() || !std::all_of(id.begin(), id.end(), [](unsigned char c) { return std::isdigit(c); }))
      return std::nullopt;
    if (!slash()) return std::nullopt;
  }
  if (word().empty()) return std::nullopt;
  HistoryName name;
  name.path = fmt::format("/{}", text.substr(begin, at - begin));
  if (at + 1 < text.size() && text[at] == '.' && text[at + 1] >= 'x' && text[at + 1] <= 'z' &&
      (at + 2 == text.size() || !is_word(text[at + 2]))) {
    name.component = text[at + 1] - 'x';
    at += 2;
  }
  name.text = text.substr(begin, at - begin);
  return name;
}

}  // namespace

const std::vector<std::string>& particle_variables() {
  static const std::vector<std::string> names = {"x", "y", "z", "vx", "vy",   "vz", "speed",  "p", "rho",
                                                 "h", "m", "V", "e",  "part", "id", "active", "t"};
  return names;
}

HistoryText find_history_names(const std::string& text) {
  HistoryText out;
  for (std::size_t at = 0; at < text.size();) {
    const bool starts_word = is_word(text[at]) && (at == 0 || !is_word(text[at - 1]));
    const auto name = starts_word ? history_name_at(text, at) : std::nullopt;
    if (!name) {
      out.text += text[at++];
      continue;
    }
    at += name->text.size();
    const auto same = std::find_if(out.names.begin(), out.names.end(),
                                   [&](const HistoryName& other) { return other.text == name->text; });
    const auto index = static_cast<std::size_t>(same - out.names.begin());
    if (same == out.names.end()) {
      out.names.push_back(*name);
      out.words.push_back(fmt::format("history_dataset_{}", index));
    }
    out.text += out.words[index];
  }
  return out;
}

Formula::Formula(const std::string& text, const std::vector<std::string>& variables,
                 const Variables& parameters)
    : variables_(variables.size()) {
  std::vector<std::string> names = variables;
  values_.assign(variables.size(), 0);
  for (const auto& [name, value] : parameters) {
    names.push_back(name);
    values_.push_back(value);
  }
  compiled_ = CompiledExpression(text, names);
  error_ = compiled_.error();
  hint_ = compiled_.hint();
  for (std::size_t k = 0; k < variables.size() && ok(); ++k) {
    if (!compiled_.uses(k) || !parameters.contains(variables[k])) continue;
    error_ = fmt::format("'{}' is both a parameter and a variable here", variables[k]);
    hint_ = "give the parameter another name";
  }
}

Real Formula::operator()(const Real* values) {
  std::copy(values, values + variables_, values_.begin());
  return compiled_(values_.data());
}

Real constant_value(const std::string& text, const Variables& parameters, std::string& why) {
  const Evaluation value = evaluate(text, parameters);
  if (value.ok()) return value.value;
  why = fmt::format("{}, got '{}'", value.error, text);
  return std::numeric_limits<Real>::quiet_NaN();
}

}  // namespace courant
