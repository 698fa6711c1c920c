// Texts about keywords for the user: messages, `courant keywords`, docs/keywords.md; all from the tables.
#include <fmt/format.h>
#include <algorithm>

#include "keyword/registry.hpp"
#include "keyword/source.hpp"

namespace courant {

namespace {

std::string type_name(const FieldSpec& field) {
  switch (field.type) {
    case FieldType::integer:
    case FieldType::id:
      return "I";
    case FieldType::real:
      return "F";
    case FieldType::ids:
      return "I, list";
    case FieldType::reals:
      return field.takes_rest ? "F, list" : "F, column";
    case FieldType::text:
      return "A";
    default:
      return "-";
  }
}

std::string columns(const FieldSpec& field) {
  const int last = field.takes_rest ? 80 : field.column + field.rules.width;
  return fmt::format("{}-{}", field.column + 1, last);
}

std::string standard_value(const FieldSpec& field) {
  if (field.rules.required) return "required";
  if (field.type == FieldType::text) return "blank";
  return field.is_vector() ? "-" : fmt::format("{:g}", field.rules.standard);
}

std::string remark(const FieldSpec& field) {
  std::string out;
  const char* check[] = {"", "> 0", ">= 0", "<= 0"};
  out += check[static_cast<int>(field.rules.check)];
  if (!field.rules.allowed.empty())
    out += (out.empty() ? "one of " : ", one of ") + fmt::format("{}", fmt::join(field.rules.allowed, " "));
  switch (field.rules.honour) {
    case Honour::yes:
      break;
    case Honour::no:
      out += out.empty() ? "other values are refused" : ", other values are refused";
      break;
    case Honour::output_only:
      out += out.empty() ? "not supported (warning)" : ", not supported (warning)";
      break;
    case Honour::ignored:
      out += out.empty() ? "no effect" : ", no effect";
      break;
  }
  return out;
}

std::string card_line(const CardSpec& card, std::size_t number) {
  std::string out = fmt::format("Card {}", number);
  if (card.repeat) out += ", repeated up to the next keyword";
  if (card.optional) out += ", optional";
  if (card.conditional) out += ", only where the cards before it ask for it";
  return out;
}

std::string options_line(const KeywordSpec& spec) {
  std::string out;
  if (spec.heading) out += "Each set begins with a heading line. ";
  if (spec.title_option) out += "Option _TITLE: a title line comes first. ";
  if (spec.id_option) out += "Option _ID: a line with ID (columns 1-10) and heading (11-80) comes first. ";
  if (spec.once) out += "May stand only once in a deck. ";
  return out;
}

std::vector<const KeywordSpec*> sorted_registry() {
  std::vector<const KeywordSpec*> out;
  for (const auto& spec : keyword_registry()) out.push_back(spec.get());
  std::sort(out.begin(), out.end(), [](const auto* a, const auto* b) { return a->names < b->names; });
  return out;
}

}  // namespace

std::string describe_field(const KeywordSpec& spec, int name, std::size_t card, std::size_t field) {
  const FieldSpec& f = spec.cards[card].fields[field];
  const std::string where = spec.cards.size() > 1 ? fmt::format("card {} ", card + 1) : "";
  return fmt::format("*{} {}field {} ({}, {} [{}])", spec.names[static_cast<std::size_t>(name)], where,
                     field + 1, f.name, f.meaning, f.dimension);
}

std::string keyword_help(const std::string& name) {
  std::string wanted = upper_case(trimmed(name));
  if (!wanted.empty() && wanted[0] == '*') wanted.erase(0, 1);
  const KeywordMatch match = KeywordIndex().match(wanted);
  if (match.keyword < 0) return {};
  const KeywordSpec& spec = *keyword_registry()[static_cast<std::size_t>(match.keyword)];
  std::string out = fmt::format("*{}: {}\n", fmt::join(spec.names, ", *"), spec.purpose);
  if (const std::string options = options_line(spec); !options.empty()) out += options + "\n";
  for (std::size_t c = 0; c < spec.cards.size(); ++c) {
    out += "\n" + card_line(spec.cards[c], c + 1) + "\n";
    for (const FieldSpec& f : spec.cards[c].fields)
      if (f.type != FieldType::skip)
        out += fmt::format("  {:<8} {:>7}  {:<8} {:>9}  {} [{}]{}\n", f.name, columns(f), type_name(f),
                           standard_value(f), f.meaning, f.dimension,
                           remark(f).empty() ? "" : " (" + remark(f) + ")");
  }
  return out;
}

std::string keyword_list() {
  std::string out;
  for (const KeywordSpec* spec : sorted_registry())
    for (const std::string& name : spec->names) out += fmt::format("*{:<44} {}\n", name, spec->purpose);
  return out;
}

std::string keyword_markdown() {
  std::string out =
      "# Keywords\n\nWritten by `courant keywords --markdown` from the tables in the source; do not edit.\n\n"
      "Dimensions are in M, L, T. \"required\" fields must not be blank. 0 and blank are the same unless "
      "noted.\n";
  for (const KeywordSpec* spec : sorted_registry()) {
    out += fmt::format("\n## *{}\n\n{}\n", fmt::join(spec->names, ", *"), spec->purpose);
    if (const std::string options = options_line(*spec); !options.empty()) out += "\n" + options + "\n";
    for (std::size_t c = 0; c < spec->cards.size(); ++c) {
      out += fmt::format(
          "\n{}\n\n| Field | Columns | Type | Default | Meaning | Remark |\n|---|---|---|---|---|---|\n",
          card_line(spec->cards[c], c + 1));
      for (const FieldSpec& f : spec->cards[c].fields)
        if (f.type != FieldType::skip)
          out += fmt::format("| {} | {} | {} | {} | {} [{}] | {} |\n", f.name, columns(f), type_name(f),
                             standard_value(f), f.meaning, f.dimension, remark(f));
    }
  }
  return out;
}

}  // namespace courant
