// Parameters in fields and texts: look-up, references, expressions. Definitions: parameter_definitions.cpp.
#include "keyword/read/parameters.hpp"

#include <fmt/format.h>
#include <algorithm>
#include <cctype>
#include <limits>
#include <optional>
#include <utility>

#include "base/nearest_word.hpp"
#include "base/utf8.hpp"
#include "keyword/source.hpp"

namespace courant {

namespace {

bool is_word(char c) {
  return std::isalnum(static_cast<unsigned char>(c)) || c == '_';
}

std::string name_of(std::string_view reference) {
  return upper_case(trimmed(reference.substr(reference.find('&') + 1)));
}

std::string_view word_at(std::string_view text, std::size_t at) {
  std::size_t end = at;
  while (end < text.size() && is_word(text[end])) ++end;
  return text.substr(at, end - at);
}

/// The smallest integer has no positive counterpart; as a real it has.
Number negated(const Number& number) {
  const bool whole = number.is_integer && number.integer != std::numeric_limits<Id>::min();
  return whole ? Number::of(-number.integer) : Number::of(-number.value());
}

}  // namespace

std::string place_of(const Location& where) {
  return fmt::format("{}:{}", where.file, where.line);
}

Parameters::Parameters(const ReadOptions& options) {
  for (const auto& [name, text] : options.parameters) overrides_[upper_case(name)] = {name, text};
}

bool Parameters::is_name(std::string_view text) {
  if (!text.empty() && text[0] == '-') text.remove_prefix(1);
  return text.size() > 1 && text[0] == '&' && word_at(text, 1).size() == text.size() - 1;
}

bool Parameters::look_up(std::string_view name, std::size_t& index) const {
  const std::string key = upper_case(name);
  for (auto scope = scopes_.rbegin(); scope != scopes_.rend(); ++scope) {
    const auto it = scope->find(key);
    if (it == scope->end()) continue;
    index = it->second;
    return true;
  }
  return false;
}

void Parameters::mark_used(std::size_t index) {
  std::vector<std::size_t> waiting = {index};
  while (!waiting.empty()) {
    Value& value = values_[waiting.back()];
    waiting.pop_back();
    if (value.used) continue;
    value.used = true;
    waiting.insert(waiting.end(), value.made_of.begin(), value.made_of.end());
  }
}

std::string Parameters::nearest(std::string_view reference) const {
  const std::string name = name_of(reference);
  for (const Value& value : values_)
    if (upper_case(value.name) == name)
      return fmt::format("&{} is local to the file that defines it, at {}", value.name,
                         place_of(value.where));
  if (name.find_first_of("+*/()-") != std::string::npos) return "an expression is between < and >";
  std::vector<std::string> names;
  std::map<std::string, std::string> as_declared;
  for (const Scope& scope : scopes_) {
    for (const auto& [key, index] : scope) {
      names.push_back(key);
      as_declared[key] = values_[index].name;
    }
  }
  const std::string near = nearest_word(name, names);
  return near.empty() ? "define it with *PARAMETER above its use"
                      : fmt::format("did you mean &{}?", as_declared[near]);
}

Parameters::Resolved Parameters::resolve(std::string_view text) {
  std::vector<std::size_t> uses;
  Resolved out = resolve_with(text, uses);
  for (const std::size_t index : uses) mark_used(index);
  return out;
}

Parameters::Resolved Parameters::resolve_with(std::string_view text, std::vector<std::size_t>& uses) const {
  const bool negative = text[0] == '-';
  return text[negative] == '&' ? resolve_name(text, negative, uses)
                               : resolve_expression(text, negative, uses);
}

Parameters::Resolved Parameters::resolve_name(std::string_view text, bool negative,
                                              std::vector<std::size_t>& uses) const {
  Resolved out;
  std::size_t index = 0;
  if (!look_up(name_of(text), index)) {
    out.failed = true;
    out.unknown = name_of(text);
    out.error = fmt::format("parameter '{}' is not defined", text);
    out.hint = nearest(text);
    return out;
  }
  uses.push_back(index);
  const Value& value = values_[index];
  out.type = value.type;
  out.text = value.text;
  out.number = value.number;
  out.failed = value.faulty;
  out.origin = fmt::format("&{} is {}, {}", value.name, value.text,
                           value.given ? "by --param" : "defined at " + place_of(value.where));
  if (!negative || value.faulty) return out;
  if (value.type == 'C') {
    out.failed = true;
    out.error = fmt::format("'{}' is a text parameter (C): it has no sign", text);
    out.hint = std::move(out.origin);
  } else {
    out.number = negated(value.number);
    out.text = out.number.text();
  }
  return out;
}

Parameters::Resolved Parameters::resolve_expression(std::string_view text, bool negative,
                                                    std::vector<std::size_t>& uses) const {
  Resolved out;
  if (text.back() != '>') {
    out.failed = true;
    out.error = fmt::format("'>' is missing in '{}'", text);
    out.hint = "an expression must fit its field; between commas it may be longer";
    return out;
  }
  const std::size_t begin = negative ? 2 : 1;
  std::string inside(text.substr(begin, text.size() - begin - 1));
  const ExpressionResult result = evaluate(inside, uses, out.failed, out.unknown);
  if (out.failed) return out;
  if (!result.ok()) {
    out.failed = true;
    out.error = fmt::format("in '{}': {}", text, result.error);
    out.hint = result.hint;
    out.at = begin + result.at;
    return out;
  }
  out.number = result.value;
  if (negative) out.number = negated(out.number);
  out.type = out.number.is_integer ? 'I' : 'R';
  out.text = out.number.text();
  return out;
}

ExpressionResult Parameters::evaluate(std::string_view text, std::vector<std::size_t>& uses, bool& faulty,
                                      std::string& unknown) const {
  ExpressionNames names;
  names.find = [&](std::string_view name, std::string& reason) -> std::optional<Number> {
    std::size_t index = 0;
    if (!look_up(name, index)) {
      unknown = upper_case(name);
      return std::nullopt;
    }
    const Value& value = values_[index];
    uses.push_back(index);
    faulty = faulty || value.faulty;
    if (value.type == 'C') {
      reason = fmt::format("'{}' is a text parameter (C), defined at {}", value.name, place_of(value.where));
      return std::nullopt;
    }
    return value.number;
  };
  ExpressionResult result = evaluate_expression(text, names);
  if (!unknown.empty()) result.hint = nearest(unknown);
  return result;
}

std::string Parameters::with_texts(std::string_view text) {
  if (text.find('&') == std::string_view::npos) return std::string(text);
  std::vector<std::size_t> uses;
  std::string out = replaced(text, uses);
  for (const std::size_t index : uses) mark_used(index);
  return out;
}

std::string Parameters::title(std::string_view text) {
  const std::string whole = with_texts(cut_utf8(trimmed(text), 2 * longest_title));
  return without_controls(cut_utf8(whole, longest_title));
}

std::string Parameters::replaced(std::string_view text, std::vector<std::size_t>& uses) const {
  std::string out;
  std::size_t at = 0;
  while (at < text.size()) {
    const std::size_t mark = std::min(text.find('&', at), text.size());
    out += text.substr(at, mark - at);
    if (mark == text.size()) break;
    const std::string_view name = word_at(text, mark + 1);
    std::size_t index = 0;
    const bool known = !name.empty() && look_up(name, index) && values_[index].type == 'C';
    if (known) uses.push_back(index);
    out += known ? std::string_view(values_[index].text) : text.substr(mark, name.size() + 1);
    at = mark + 1 + name.size();
  }
  return out;
}

void Parameters::note_mentions(std::string_view text) {
  if (values_.empty() ||
      (text.find('&') == std::string_view::npos && text.find('<') == std::string_view::npos))
    return;
  bool inside = false;  // of <...>, where & may be left out
  for (std::size_t at = 0; at < text.size(); ++at) {
    if (text[at] == '<') inside = true;
    if (text[at] == '>') inside = false;
    const bool begins = text[at] == '&' || (inside && (at == 0 || !is_word(text[at - 1])));
    if (!begins) continue;
    const std::string_view name = word_at(text, at + (text[at] == '&'));
    std::size_t index = 0;
    if (!name.empty() && look_up(name, index)) mark_used(index);
  }
}

std::vector<DeckParameter> Parameters::list() const {
  return {values_.begin(), values_.end()};
}

}  // namespace courant
