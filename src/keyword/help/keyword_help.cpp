// Texts about keywords for the user: messages, `courant keywords`, docs/keywords.md; all from the tables.
#include <fmt/format.h>
#include <algorithm>
#include <string>
#include <string_view>

#include "base/json_text.hpp"
#include "keyword/help/keyword_state.hpp"
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
      return field.takes_rest ? "I, list" : "I, column";
    case FieldType::reals:
      return field.takes_rest ? "F, list" : "F, column";
    case FieldType::text:
      return "A";
    case FieldType::texts:
      return field.takes_rest ? "A, list" : "A, column";
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
  if (card.until_entry) out += ", or to the next line with all that card 1 requires";
  if (card.optional) out += ", optional";
  if (card.when) out += ", only where the cards before it ask for it";
  return out;
}

std::string options_line(const KeywordSpec& spec) {
  std::string out;
  if (spec.heading) out += "Each set begins with a heading line. ";
  if (spec.title_option) out += "Option _TITLE: a title line comes first. ";
  if (spec.id_option) out += "Option _ID: a line with ID (columns 1-10) and heading (11-80) comes first. ";
  if (spec.mpp_option) out += "Option _MPP: one or two lines for parallel runs come first, without effect. ";
  if (spec.collect_option) out += "Option _COLLECT: adds to the set that has the same id already. ";
  if (spec.once) out += "Where it is given more than once, the last counts. ";
  if (!out.empty()) out.pop_back();
  return out;
}

constexpr const char* markdown_introduction =
    "# Keywords\n\n"
    "Written by `courant keywords --markdown` from the tables that the reader itself works with; do not "
    "edit. "
    "`courant keywords NAME` shows one of them.\n\n"
    "How to read the tables:\n\n"
    "- Columns are those of the standard format. With `*KEYWORD LONG=Y`, or `+` behind a name, every field "
    "is 20 columns "
    "wide; with `I10=Y`, or `%`, ids that are 8 wide become 10 wide. Fields may also be separated by "
    "commas.\n"
    "- Type: I integer, F number, A text; a list takes all columns up to the end of the line, and of the "
    "lines below.\n"
    "- A blank field has its default, and so has a 0 unless the field must not be 0. A `required` field must "
    "be given.\n"
    "- Dimension: M mass, L length, T time in whatever consistent units the deck uses; `-` has none. In 2D "
    "(IDIM 2) masses, "
    "forces and energies are per unit of depth.\n"
    "- Accepted: the values that are. *Only the default*: other values ask for physics that Courant lacks, "
    "and the deck is "
    "refused. *No effect*: read and left unused, because it cannot change results here. *Warning*: another "
    "value asks for "
    "output that Courant lacks; the run goes on without it.\n"
    "- Behind a name is its state, and below its heading in full. Honoured: all fields count. Partly: of "
    "some "
    "fields only the default, or some values, are taken, and a deck with others is refused. No effect: "
    "output and "
    "the like that changes no result. Refused: the cards are read and checked, and the deck is refused. All "
    "that is "
    "refused: [cannot_do.md](cannot_do.md).\n"
    "- A keyword that is not on this page is an error, except requests for output (`*DATABASE_...`, "
    "`*CONTROL_OUTPUT`, "
    "`*CONTROL_PARALLEL`, `*CONTROL_MPP_...`, `*CONTROL_UNITS`), which give a warning.\n";

std::string escaped(std::string_view text) {
  std::string out;
  for (const char c : text) {
    if (c == '|' || c == '*' || c == '_' || c == '<') out += '\\';
    out += c;
  }
  return out;
}

std::string sentence(std::string text) {
  if (text.empty()) return text;
  text[0] = upper_case(text.substr(0, 1))[0];
  return text + ".";
}

std::string anchor(std::string out) {
  std::transform(out.begin(), out.end(), out.begin(),
                 [](char c) { return c >= 'A' && c <= 'Z' ? char(c + 'a' - 'A') : c; });
  return out;
}

std::string first_word(const KeywordSpec& spec) {
  return spec.names[0].substr(0, spec.names[0].find('_'));
}

std::string accepted(const FieldSpec& field) {
  switch (field.rules.honour) {
    case Honour::no:
      return "only the default";
    case Honour::output_only:
      return "warning, no effect";
    case Honour::ignored:
      return "no effect";
    default:
      break;
  }
  const char* check[] = {"", "> 0", ">= 0", "<= 0"};
  std::string out = check[static_cast<int>(field.rules.check)];
  if (!field.rules.allowed.empty())
    out += fmt::format("{}{}", out.empty() ? "" : ", ", fmt::join(field.rules.allowed, ", "));
  return out.empty() ? "any" : out;
}

std::string markdown_card(const CardSpec& card, std::size_t number) {
  std::string out = fmt::format(
      "\n{}\n\n| Field | Columns | Type | Default | Meaning | Dimension | Accepted "
      "|\n|---|---|---|---|---|---|---|\n",
      card_line(card, number));
  for (const FieldSpec& f : card.fields)
    if (f.type != FieldType::skip)
      out += fmt::format("| {} | {} | {} | {} | {} | {} | {} |\n", escaped(f.name), columns(f), type_name(f),
                         standard_value(f), escaped(f.meaning), f.dimension, accepted(f));
  return out;
}

std::vector<const KeywordSpec*> sorted_registry() {
  std::vector<const KeywordSpec*> out;
  for (const auto& spec : keyword_registry()) out.push_back(spec.get());
  std::sort(out.begin(), out.end(), [](const auto* a, const auto* b) { return a->names < b->names; });
  return out;
}

const char* numbered_by(IdSpace space) {
  return space == IdSpace::none ? "" : id_word(space);
}

void add_field(const FieldSpec& field, JsonText& json) {
  json.open(nullptr, '{');
  json.text("name", field.name);
  json.whole("column", field.column);
  json.whole("width", field.takes_rest ? 80 - field.column : field.rules.width);
  json.text("type", type_name(field).substr(0, 1));
  json.flag("list", field.is_vector());
  json.text("meaning", field.meaning);
  json.text("dimension", field.dimension);
  json.text("default", standard_value(field));
  json.text("accepted", accepted(field));
  json.text("refers", field.refers ? "varies" : numbered_by(field.rules.refers));
  json.open("allowed", '[');
  for (const int value : field.rules.allowed) json.whole(nullptr, value);
  json.close();
  json.close();
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
  out += support_text(spec) + "\n";
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
    for (const std::string& name : spec->names)
      out += fmt::format("*{:<44} {:<10} {}\n", name, state_word(support_of(*spec).state), spec->purpose);
  return out + "\n" + state_legend();
}

std::string keyword_json() {
  JsonText json;
  json.open(nullptr, '[');
  for (const KeywordSpec* spec : sorted_registry()) {
    json.open(nullptr, '{');
    json.open("names", '[');
    for (const std::string& name : spec->names) json.text(nullptr, name);
    json.close();
    json.text("purpose", spec->purpose);
    json.text("state", state_word(support_of(*spec).state));
    json.text("support", support_text(*spec));
    json.text("defines", numbered_by(spec->id_space));
    json.open("options", '[');
    if (spec->title_option) json.text(nullptr, "TITLE");
    if (spec->id_option) json.text(nullptr, "ID");
    if (spec->mpp_option) json.text(nullptr, "MPP");
    if (spec->collect_option) json.text(nullptr, "COLLECT");
    json.close();
    json.flag("heading", spec->heading);
    json.flag("many", spec->many);
    json.open("cards", '[');
    for (const CardSpec& card : spec->cards) {
      json.open(nullptr, '{');
      json.flag("optional", card.optional);
      json.flag("conditional", static_cast<bool>(card.when));
      json.flag("repeated", card.repeat);
      json.open("fields", '[');
      for (const FieldSpec& field : card.fields)
        if (field.type != FieldType::skip) add_field(field, json);
      json.close();
      json.close();
    }
    json.close();
    json.close();
  }
  json.close();
  return json.take();
}

std::string keyword_markdown() {
  std::string out = markdown_introduction;
  std::string group;
  const auto specs = sorted_registry();
  for (const KeywordSpec* spec : specs) {
    const std::string word = first_word(*spec);
    out += word == group ? ", " : "\n- ";
    group = word;
    for (std::size_t n = 0; n < spec->names.size(); ++n)
      out += fmt::format("{}[{}](#{}) {}", n > 0 ? ", " : "", spec->names[n], anchor(spec->names[n]),
                         state_word(support_of(*spec).state));
  }
  out += "\n";
  for (const KeywordSpec* spec : specs) {
    out += "\n";
    for (const std::string& name : spec->names) out += fmt::format("<a id=\"{}\"></a>", anchor(name));
    out += fmt::format("\n\n## *{}\n\n", spec->names[0]);
    if (spec->names.size() > 1)
      out += fmt::format("Also: `*{}`. ", fmt::join(spec->names.begin() + 1, spec->names.end(), "`, `*"));
    out += escaped(sentence(spec->purpose)) + "\n\n" + escaped(sentence(support_text(*spec))) + "\n";
    if (const std::string options = options_line(*spec); !options.empty()) out += "\n" + options + "\n";
    for (std::size_t c = 0; c < spec->cards.size(); ++c) out += markdown_card(spec->cards[c], c + 1);
  }
  return out;
}

}  // namespace courant
