#include "keyword/parameters.hpp"

#include <fmt/format.h>

#include "keyword/number.hpp"
#include "keyword/registry.hpp"
#include "keyword/source.hpp"

namespace courant {

namespace {

std::string name_of(std::string_view reference) {
  return upper_case(reference.substr(reference.find('&') + 1));
}

bool fits(char type, std::string_view text) {
  Id i = 0;
  Real r = 0;
  return type == 'I' ? parse_integer(text, i) : parse_real(text, r);
}

}  // namespace

Parameters::Parameters(const ReadOptions& options) {
  for (const auto& [name, text] : options.parameters) overrides_[upper_case(name)] = {name, text};
}

void Parameters::define(std::string_view declaration, std::string_view value, const Location& where,
                        Diagnostics& diagnostics) {
  const char type = upper_case(declaration.substr(0, 1))[0];
  const std::string_view name = trimmed(declaration.substr(1));
  if (type != 'R' && type != 'I') {
    diagnostics.error(where,
                      fmt::format("*PARAMETER: '{}' begins with none of the types R and I", declaration),
                      type == 'C' ? "text parameters (C) are not supported"
                                  : "write the type letter before the name: R for a real, I for an integer");
    return;
  }
  if (name.empty()) {
    diagnostics.error(where, fmt::format("*PARAMETER: '{}' has no name after the type letter", declaration));
    return;
  }
  if (name.find(' ') != std::string_view::npos) {
    diagnostics.error(where, fmt::format("*PARAMETER: the name '{}' contains a blank", name),
                      "names stand in columns 1-10, 21-30, 41-50, 61-70 and values in the columns behind "
                      "them, or commas separate");
    return;
  }
  Value out{std::string(name), type, std::string(value), where};
  if (is_reference(value)) {
    const Value* other = find(value);
    if (!other) {
      diagnostics.error(where, fmt::format("*PARAMETER {}: parameter '{}' is not defined", name, value),
                        nearest(value));
      return;
    }
    out.text = value[0] == '-'
                   ? (other->text[0] == '-' ? other->text.substr(1) : fmt::format("-{}", other->text))
                   : other->text;
  }
  std::string source = "the deck";
  if (const auto it = overrides_.find(upper_case(name)); it != overrides_.end()) {
    it->second.used = true;
    out.text = it->second.text;
    source = "--param";
  }
  if (!fits(type, out.text)) {
    diagnostics.error(where, fmt::format("*PARAMETER {}: expected {}, got '{}'{}", name,
                                         type == 'I' ? "an integer" : "a number", out.text,
                                         source == "--param" ? " from --param" : ""));
    return;
  }
  const auto [it, is_new] = values_.emplace(upper_case(name), out);
  if (!is_new && (it->second.type != type || it->second.text != out.text))
    diagnostics.error(where,
                      fmt::format("*PARAMETER {}: defined before with another value, '{}', at {}:{}", name,
                                  it->second.text, it->second.where.file, it->second.where.line),
                      "give each parameter one value");
}

const Parameters::Value* Parameters::find(std::string_view reference) const {
  const auto it = values_.find(name_of(reference));
  return it == values_.end() ? nullptr : &it->second;
}

std::string Parameters::nearest(std::string_view reference) const {
  std::vector<std::string> names;
  for (const auto& [name, value] : values_) names.push_back(name);
  const std::string near = nearest_word(name_of(reference), names);
  return near.empty() ? "define it with *PARAMETER above its use"
                      : fmt::format("did you mean &{}?", values_.at(near).name);
}

void Parameters::check_overrides(const std::string& deck, Diagnostics& diagnostics) const {
  for (const auto& [key, given] : overrides_) {
    if (given.used) continue;
    std::vector<std::string> names;
    for (const auto& [name, value] : values_) names.push_back(name);
    const std::string near = nearest_word(key, names);
    diagnostics.error({deck, 0, 0},
                      fmt::format("--param {}: the deck has no *PARAMETER of that name", given.name),
                      near.empty() ? "" : fmt::format("did you mean {}?", values_.at(near).name));
  }
}

}  // namespace courant
