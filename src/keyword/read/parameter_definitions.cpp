// Definitions of parameters: types, values, second definitions, overrides, and what nothing uses.
#include <fmt/format.h>
#include <algorithm>
#include <cctype>
#include <utility>

#include "base/nearest_word.hpp"
#include "keyword/read/number.hpp"
#include "keyword/read/parameters.hpp"
#include "keyword/source.hpp"

namespace courant {

namespace {

constexpr std::size_t longest_text = 1000;  // texts made of texts made of texts must not fill the memory

bool same(const Parameters::Value& a, const Parameters::Value& b) {
  if (a.type != b.type) return false;
  if (a.type == 'I') return a.number.integer == b.number.integer;
  return a.type == 'R' ? a.number.real == b.number.real : a.text == b.text;
}

}  // namespace

void Parameters::define(const Definition& definition, Diagnostics& diagnostics) {
  Value value;
  value.where = definition.where;
  value.local = definition.local;
  value.can_change = definition.can_change;
  if (!read_declaration(definition, value, diagnostics)) return;
  const auto given = overrides_.find(upper_case(value.name));
  if (given == overrides_.end()) {
    read_value(definition, value, diagnostics);
  } else {
    given->second.used = true;
    Value of_deck = value;  // states what the definition is made of; its faults do not matter
    Diagnostics unheard;
    read_value(definition, of_deck, unheard);
    value.made_of = of_deck.made_of;
    value.given = true;
    read_literal(definition, given->second.text, value, diagnostics);
  }
  store(definition, std::move(value), diagnostics);
}

bool Parameters::read_declaration(const Definition& definition, Value& value,
                                  Diagnostics& diagnostics) const {
  const auto refuse = [&](const std::string& message, std::string hint = {}) {
    diagnostics.error(definition.where, fmt::format("{}: {}", definition.keyword, message), std::move(hint));
    return false;
  };
  const std::string_view text = definition.declaration;
  value.type = upper_case(text.substr(0, 1))[0];
  if (value.type != 'R' && value.type != 'I' && value.type != 'C')
    return refuse(fmt::format("'{}' begins with none of the types R, I and C", text),
                  "write the type letter before the name: R for a real, I for an integer, C for a text");
  value.name = trimmed(text.substr(1));
  if (value.name.empty()) return refuse(fmt::format("'{}' has no name after the type letter", text));
  if (value.name.find(' ') != std::string::npos)
    return refuse(fmt::format("the name '{}' contains a blank", value.name),
                  definition.is_expression
                      ? "the name is in columns 1-10 and the expression after them, or a comma separates"
                      : "names are in columns 1-10, 21-30, 41-50, 61-70 and values in the columns after "
                        "them, or commas separate");
  const auto odd = std::find_if(value.name.begin(), value.name.end(), [](char c) {
    return !std::isalnum(static_cast<unsigned char>(c)) && c != '_';
  });
  if (odd != value.name.end())
    return refuse(fmt::format("the name '{}' contains '{}'", value.name, *odd),
                  "letters, digits and _ make a name");
  return true;
}

void Parameters::read_value(const Definition& definition, Value& value, Diagnostics& diagnostics) {
  if (value.type == 'C') {
    value.text = replaced(definition.value, value.made_of);
    value.faulty = value.text.size() > longest_text;
    if (value.faulty)
      diagnostics.error(definition.where, fmt::format("{} {}: the text has more than {} characters",
                                                      definition.keyword, value.name, longest_text));
  } else if (definition.is_expression) {
    read_expression(definition, value, diagnostics);
  } else if (is_reference(definition.value)) {
    read_reference(definition, value, diagnostics);
  } else {
    read_literal(definition, definition.value, value, diagnostics);
  }
}

void Parameters::read_literal(const Definition& definition, std::string_view text, Value& value,
                              Diagnostics& diagnostics) const {
  value.text = text;
  if (value.type == 'C') return;
  Id i = 0;
  Real r = 0;
  const bool whole = value.type == 'I';
  value.faulty = whole ? !parse_integer(text, i) : !parse_real(text, r);
  value.number = whole ? Number::of(i) : Number::of(r);
  if (!value.faulty) return;
  std::string hint;
  if (value.given)
    hint = "the deck declares it with the type letter " + std::string(1, value.type);
  else if (text.find_first_of("+*/()") != std::string_view::npos)
    hint = "for an expression write *PARAMETER_EXPRESSION, or < and > around it";
  diagnostics.error(value.given ? definition.where : definition.place_in_value(0),
                    fmt::format("{} {}: expected {}, got '{}'{}", definition.keyword, value.name,
                                whole ? "an integer" : "a number", text, value.given ? " from --param" : ""),
                    std::move(hint));
}

void Parameters::read_expression(const Definition& definition, Value& value, Diagnostics& diagnostics) const {
  bool uses_faulty = false;
  std::string unknown;
  ExpressionResult result = evaluate(definition.value, value.made_of, uses_faulty, unknown);
  if (result.ok() && value.type == 'I') {
    const auto whole = result.value.is_integer ? result.value.integer : truncated(result.value.real);
    if (whole)
      result.value = Number::of(*whole);
    else
      result.error = fmt::format("the result {} is too large for an integer", result.value.text());
  }
  value.faulty = uses_faulty || !result.ok();
  if (!uses_faulty && !result.ok())
    diagnostics.error(definition.place_in_value(result.at),
                      fmt::format("{} {}: {}", definition.keyword, value.name, result.error), result.hint);
  value.number = value.type == 'R' ? Number::of(result.value.value()) : result.value;
  value.text = value.number.text();
}

void Parameters::read_reference(const Definition& definition, Value& value, Diagnostics& diagnostics) const {
  Resolved from = resolve_with(definition.value, value.made_of);
  value.faulty = from.failed;
  std::string fault = from.error, hint = from.hint;
  if (!from.failed && (from.type == 'C' || (value.type == 'I' && from.type == 'R'))) {
    value.faulty = true;
    fault = fmt::format("expected {}, got '{}', which is a {}", value.type == 'I' ? "an integer" : "a number",
                        definition.value, from.type == 'C' ? "text (C)" : "real (R)");
    hint = from.type == 'R' ? "int() or nint() in an expression makes it an integer" : from.origin;
  }
  if (!fault.empty())
    diagnostics.error(definition.place_in_value(from.at),
                      fmt::format("{} {}: {}", definition.keyword, value.name, fault), std::move(hint));
  value.number = value.type == 'R' ? Number::of(from.number.value()) : from.number;
  value.text = from.text;
}

void Parameters::store(const Definition& definition, Value value, Diagnostics& diagnostics) {
  Scope& scope = definition.local ? scopes_.back() : scopes_[0];
  const std::string key = upper_case(value.name);
  const auto [it, is_new] = scope.try_emplace(key, values_.size());
  if (is_new) {
    values_.push_back(std::move(value));
  } else if (Value& old = values_[it->second]; replaces(definition, old, value, diagnostics)) {
    const bool used = old.used;
    value.can_change = value.can_change || old.can_change;
    old = std::move(value);
    if (used) mark_used(it->second);
  } else {
    for (const std::size_t index : value.made_of) mark_used(index);
  }
  std::size_t visible = 0;
  if (!definition.local && look_up(key, visible) && visible != it->second)
    diagnostics.warning(
        definition.where,
        fmt::format("{} {}: in this file &{} remains the local parameter defined at {}", definition.keyword,
                    values_[it->second].name, values_[visible].name, place_of(values_[visible].where)),
        "give one of them another name");
}

bool Parameters::replaces(const Definition& definition, const Value& old, const Value& value,
                          Diagnostics& diagnostics) const {
  if (value.faulty || old.faulty) return !value.faulty;
  const std::string before = fmt::format("{} {}: defined before as {} = {}, at {}", definition.keyword,
                                         value.name, old.type, old.text, place_of(old.where));
  if (!old.can_change) {
    if (duplication_ == 3) {
      diagnostics.error(definition.where, before,
                        "*PARAMETER_DUPLICATION with DFLAG 3 allows one definition");
      return false;
    }
    if (same(old, value) || duplication_ == 5) return false;
    if (duplication_ == 1) {
      diagnostics.warning(definition.where,
                          fmt::format("{}; the new definition, {}, is ignored", before, value.text),
                          "*PARAMETER_MUTABLE allows another value, *PARAMETER_LOCAL keeps one to its file, "
                          "*PARAMETER_DUPLICATION chooses for all");
      return false;
    }
  }
  if (old.type != value.type) {
    diagnostics.error(definition.where,
                      fmt::format("{}; a new definition cannot make it {}", before, value.type));
    return false;
  }
  if (!old.can_change && duplication_ == 2 && !same(old, value))
    diagnostics.warning(definition.where, fmt::format("{}; from here on it is {}", before, value.text));
  return true;
}

void Parameters::check_overrides(const std::string& deck, Diagnostics& diagnostics) const {
  for (const auto& [key, given] : overrides_) {
    if (given.used) continue;
    std::vector<std::string> names;
    std::map<std::string, std::string> as_declared;
    for (const Value& value : values_) {
      names.push_back(upper_case(value.name));
      as_declared[names.back()] = value.name;
    }
    const std::string near = nearest_word(key, names);
    diagnostics.error({deck, 0, 0},
                      fmt::format("--param {}: the deck has no *PARAMETER of that name", given.name),
                      near.empty() ? "" : fmt::format("did you mean {}?", as_declared[near]));
  }
}

void Parameters::check_unused(Diagnostics& diagnostics) const {
  for (const Value& value : values_)
    if (!value.used)
      diagnostics.warning(value.where, fmt::format("parameter '{}' is never used", value.name),
                          value.given ? "--param has no effect on it" : "");
}

}  // namespace courant
