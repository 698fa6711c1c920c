// Writes the C++ tables (src/keyword/card.hpp) of the keywords that are only read, from
// src/keyword/keywords_only_read.yaml, where the format is told. Run while the library is built; what is
// wrong in the file is said with its line, by this program or, of an id space, by the compiler.
//
//   keyword_tables keywords_only_read.yaml keywords_only_read.cpp
#include <fmt/format.h>
#include <yaml-cpp/yaml.h>

#include <algorithm>
#include <cctype>
#include <fstream>
#include <iostream>
#include <map>
#include <sstream>
#include <stdexcept>
#include <string>
#include <vector>

namespace {

using Words = std::vector<std::string>;

std::string file_name;

[[noreturn]] void fail(const YAML::Node& node, const std::string& what) {
  throw std::runtime_error(fmt::format("{}:{}: {}", file_name, node.Mark().line + 1, what));
}

std::string quoted(const std::string& text) {
  std::ostringstream out;
  out << '"';
  for (const char c : text) out << (c == '"' || c == '\\' ? "\\" : "") << c;
  out << '"';
  return out.str();
}

Words split(const std::string& text, char separator) {
  Words words;
  std::istringstream in(text);
  for (std::string word; std::getline(in, word, separator);)
    if (!(word = word.substr(std::min(word.find_first_not_of(' '), word.size()))).empty())
      words.push_back(word);
  return words;
}

/// One value or a list of them.
Words list(const YAML::Node& node) {
  return !node ? Words() : node.IsScalar() ? Words{node.Scalar()} : node.as<Words>();
}

bool has(const Words& words, const std::string& word) {
  return std::find(words.begin(), words.end(), word) != words.end();
}

void expect_keys(const YAML::Node& map, const Words& known) {
  for (const auto& item : map)
    if (!has(known, item.first.Scalar())) fail(item.first, "unknown key '" + item.first.Scalar() + "'");
}

/// With every choice of the words of `combine` behind them, the first word changing quickest.
Words combined(Words names, const Words& combine) {
  for (const std::string& word : combine)
    for (std::size_t n = names.size(), i = 0; i < n; ++i) names.push_back(names[i] + "_" + word);
  return names;
}

/// Of a group of fields, the meaning of one: of "lower|upper bound" the word in its place.
std::string meaning_of(const YAML::Node& node, std::size_t place, std::size_t fields) {
  std::string out;
  if (node.Scalar().find('|') == std::string::npos) return node.Scalar();
  for (const std::string& word : split(node.Scalar(), ' ')) {
    const Words choices = split(word, '|');
    if (choices.size() > 1 && choices.size() != fields)
      fail(node, fmt::format("'{}' is not one word for each field", word));
    out += (out.empty() ? "" : " ") + (choices.size() > 1 ? choices[place] : word);
  }
  return out;
}

/// Types of the fields, and how the members that hold them begin.
const std::vector<std::pair<std::string, char>> types = {
    {"Id", 'd'}, {"Real", 'r'}, {"int", 'i'}, {"std::string", 't'}};

/// How many fields of each type entries have room for. Keywords share the struct of their entries: each one
/// more would take a second to compile.
using Room = std::map<char, std::size_t>;

/// The table of one keyword.
class Table {
 public:
  Table(const YAML::Node& entry, std::string lacking) : entry_(entry), lacking_(std::move(lacking)) {
    expect_keys(entry, {entry.begin()->first.Scalar(), "also", "combine", "defines", "once", "cards"});
    names_ = split(entry.begin()->first.Scalar(), ',');
    for (const std::string& name : list(entry["also"])) names_.push_back(name);
    names_ = combined(names_, list(entry["combine"]));
    if (!entry["cards"]) fail(entry, "no cards");
    if (names_.size() > 64) fail(entry, "more than 64 names");
    for (const YAML::Node& card : entry["cards"])
      for (const YAML::Node& field : card)
        if (field.IsSequence()) find_room(field);
  }

  const Room& room() const { return room_; }
  bool is_long() const { return members_.size() > 20; }

  std::string text() const {
    const Words defines = list(entry_["defines"]);
    std::string out = fmt::format("{{\n  using T = {};\n  register_table<T>({{.names = {{",
                                  is_long() ? "LongEntry" : "ShortEntry");
    for (const std::string& name : names_) out += quoted(name) + ", ";
    out += fmt::format("}}, .purpose = {}", quoted(entry_.begin()->second.Scalar()));
    if (!defines.empty()) out += ", .id_space = IdSpace::" + defines[0];
    if (has(defines, "TITLE")) out += ", .title_option = true";
    if (has(defines, "ID")) out += ", .id_option = true";
    if (has(defines, "HEADING")) out += ", .heading = true";
    if (defines.size() > 1) out += ", .title = &T::title";
    if (has(defines, "ID")) out += ", .id = &T::entry_id";
    if (entry_["once"]) out += ", .once = true, .many = false";
    out += fmt::format(", .lacking = {},\n  .cards = {{", quoted(lacking_));
    for (const YAML::Node& card : entry_["cards"]) out += card_text(card);
    return out + "}});\n  return true;\n";
  }

 private:
  static std::string type_of(const YAML::Node& kind) {
    if (kind.IsMap()) return "Id";
    const std::string& word = kind.Scalar();
    if (word == "real" || is_dimension(word)) return "Real";
    return word == "int" ? "int" : word == "text" ? "std::string" : "Id";
  }
  static bool is_dimension(const std::string& word) { return word.find_first_of("MLT") != std::string::npos; }

  void find_room(const YAML::Node& field) {
    if (field.size() < 3) fail(field, "not [NAMES, KIND, MEANING, RULES ...]");
    const std::string type = type_of(field[1]);
    for (const std::string& name : split(field[0].Scalar(), ' '))
      for (const auto& [of, begin] : types)
        if (of == type && members_.count(name) == 0) members_[name] = begin + std::to_string(room_[begin]++);
  }

  std::string member(const YAML::Node& where, const std::string& field) const {
    const auto it = members_.find(field);
    if (it == members_.end()) fail(where, "no field has the name '" + field + "'");
    return it->second;
  }

  std::string card_text(const YAML::Node& card) const {
    YAML::Node whole(YAML::NodeType::Map);
    std::string fields;
    for (const YAML::Node& field : card) {
      if (field.IsMap())
        expect_keys(whole = field, {"with", "when", "optional", "width"});
      else
        fields += field.IsScalar() ? "{}, " : group(field, whole["width"].as<int>(10));
    }
    std::string out = fmt::format("\n{{.fields = {{{}}}", fields);
    if (whole["optional"]) out += ", .optional = true";
    if (whole["with"] || whole["when"])
      out += ", .when = [](const T& e) { return " + condition(whole) + "; }";
    return out + "},";
  }

  std::string condition(const YAML::Node& card) const {
    std::string out;
    unsigned long long mask = 0;
    for (const std::string& word : list(card["with"])) {
      bool found = false;
      for (std::size_t n = 0; n < names_.size(); ++n)
        if (has(split(names_[n], '_'), word)) mask |= 1ull << n, found = true;
      if (!found) fail(card, "no name has the word '" + word + "'");
    }
    if (mask != 0) out = fmt::format("(({}ull >> e.name) & 1) != 0", mask);
    if (card["when"]) {
      const Words words = split(card["when"].Scalar(), ' ');
      if (words.size() != 3 || (words[1] != "==" && words[1] != "!="))
        fail(card, "not FIELD == NUMBER or FIELD != NUMBER");
      out +=
          fmt::format("{}e.{} {} {}", out.empty() ? "" : " && ", member(card, words[0]), words[1], words[2]);
    }
    return out;
  }

  /// Fields that stand side by side and differ in nothing but their names, or a word of their meaning.
  std::string group(const YAML::Node& field, int width) const {
    const YAML::Node& kind = field[1];
    const std::string& word = kind.IsMap() ? "id" : kind.Scalar();
    const Words names = split(field[0].Scalar(), ' ');
    std::map<std::string, std::string> rules;
    if (type_of(kind) == "Id" && word != "id") rules["refers"] = "IdSpace::" + word;
    if (lacking_.empty()) rules["honour"] = "Honour::ignored";
    for (std::size_t r = 3; r < field.size(); ++r) add_rule(field[r], rules, width);
    if (width != 10) rules["width"] = std::to_string(width);
    std::string out;
    for (std::size_t i = 0; i < names.size(); ++i) {
      out += fmt::format("\n#line {} {}\n{{{}, &T::{}, {}, {}, {{", field.Mark().line + 1, quoted(file_name),
                         quoted(names[i]), member(field, names[i]), quoted(is_dimension(word) ? word : "-"),
                         quoted(meaning_of(field[2], i, names.size())));
      for (const char* rule : {"standard", "required", "check", "honour", "width", "refers",
                               "spatial"})  // as FieldRules has them
        if (rules.count(rule) != 0) out += fmt::format(".{} = {}, ", rule, rules[rule]);
      rules.erase("spatial");
      out += "}" + (kind.IsMap() ? ", " + space(kind) : "") + "}, ";
    }
    return out;
  }

  static void add_rule(const YAML::Node& rule, std::map<std::string, std::string>& rules, int& width) {
    double number = 0;
    if (rule.IsMap()) {
      expect_keys(rule, {"width"});
      width = rule["width"].as<int>();
    } else if (YAML::convert<double>::decode(rule, number)) {
      rules["standard"] = rule.Scalar();
    } else if (const std::string& word = rule.Scalar(); word == "required") {
      rules["required"] = "true", rules["check"] = "Check::positive";
    } else if (word == "not_negative") {
      rules["check"] = "Check::not_negative";
    } else if (word == "point" || word == "direction") {
      rules["spatial"] = "Spatial::" + word;
    } else if (word == "output" || word == "unsupported") {
      rules["honour"] = word == "output" ? "Honour::output_only" : "Honour::no";
    } else {
      fail(rule, "unknown rule '" + word + "'");
    }
  }

  /// What the ids number where another field tells: {by: TYPE, 1: part, else: part_set}.
  std::string space(const YAML::Node& kind) const {
    if (!kind["by"] || !kind["else"]) fail(kind, "not {by: FIELD, NUMBER: SPACE, else: SPACE}");
    std::string out = "[](const T& e) { return ";
    for (const auto& choice : kind)
      if (const std::string& key = choice.first.Scalar(); key != "by" && key != "else")
        out += fmt::format("e.{} == {} ? IdSpace::{} : ", member(kind, kind["by"].Scalar()), key,
                           choice.second.Scalar());
    return out + "IdSpace::" + kind["else"].Scalar() + "; }";
  }

  YAML::Node entry_;
  std::string lacking_;
  Words names_;
  Room room_;
  std::map<std::string, std::string> members_;  ///< of each field
};

std::string struct_text(const char* name, const std::vector<Table>& tables, bool is_long) {
  Room most;
  for (const Table& table : tables)
    for (const auto& [begin, count] : table.room())
      if (table.is_long() == is_long) most[begin] = std::max(most[begin], count);
  std::string out = fmt::format("struct {} : Entry {{\n  std::string title;\n  Id entry_id = 0;\n", name);
  for (const auto& [type, begin] : types)
    for (std::size_t k = 0; k < most[begin]; ++k) out += fmt::format("  {} {}{}{{}};\n", type, begin, k);
  return out + "};\n\n";
}

}  // namespace

int main(int, char** arguments) {
  try {
    file_name = arguments[1];
    const YAML::Node file = YAML::LoadFile(file_name);
    expect_keys(file, {"refused", "idle"});
    std::vector<Table> tables;
    for (const auto& lacking : file["refused"])
      for (const YAML::Node& entry : lacking.second) tables.emplace_back(entry, lacking.first.Scalar());
    for (const YAML::Node& entry : file["idle"]) tables.emplace_back(entry, "");
    std::ofstream out(arguments[2]);
    out << "#include <string>\n\n#include \"keyword/registry.hpp\"\n\nnamespace courant {\n\nnamespace {\n\n"
        << struct_text("ShortEntry", tables, false) << struct_text("LongEntry", tables, true)
        << "template <class T>\nvoid register_table(KeywordOf<T> keyword) {\n"
        << "  const RegisterKeyword<T> registered(std::move(keyword));\n}\n\n";
    std::size_t count = 0;
    for (const Table& table : tables)
      out << "[[maybe_unused]] const bool table" << count++ << " = [] " << table.text() << "}();\n";
    out << "}  // namespace\n\n}  // namespace courant\n";
  } catch (const std::exception& error) {
    std::cerr << error.what() << '\n';
    return 1;
  }
}
