// Makes C++ of files that describe keywords, while the library is built. docs/contributing.md has the format
// of files of cards, keywords_only_read.yaml its own. What is wrong in a file is reported with its line.
//
// keyword_tables NAME_cards.yaml NAME_cards.hpp: structs of the entries, and tables for RegisterKeyword
//
// keyword_tables keywords_only_read.yaml tables.cpp: tables of keywords without code of their own
#include <fmt/format.h>
#include <yaml-cpp/yaml.h>

#include <algorithm>
#include <cctype>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <map>
#include <set>
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

std::string in_quotes(const std::string& text) {
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

std::string lower(std::string text) {
  for (char& c : text)
    c = std::isalnum(static_cast<unsigned char>(c)) ? static_cast<char>(std::tolower(c)) : '_';
  return text;
}

/// Of a group of fields, the meaning of one: of "lower|upper bound" the word in its place.
std::string meaning_of(const YAML::Node& node, std::size_t place, std::size_t fields) {
  std::string out;
  if (fields == 1 || node.Scalar().find('|') == std::string::npos) return node.Scalar();
  for (const std::string& word : split(node.Scalar(), ' ')) {
    const Words choices = split(word, '|');
    if (choices.size() > 1 && choices.size() != fields)
      fail(node, fmt::format("'{}' is not one word for each field", word));
    out += (out.empty() ? "" : " ") + (choices.size() > 1 ? choices[place] : word);
  }
  return out;
}

/// "-" or powers of M, L, T with at most one stroke, like ML2/T2 and 1/T.
bool is_dimension(const std::string& word) {
  if (word == "-") return true;
  std::size_t strokes = 0;
  for (const char c : word) {
    if (c == '/')
      ++strokes;
    else if (std::string("MLT").find(c) == std::string::npos && !std::isdigit(static_cast<unsigned char>(c)))
      return false;
  }
  return strokes <= 1 && word.find_first_of("MLT") != std::string::npos;
}

/// Types of the fields, and how the members that hold them begin in structs that keywords share.
const std::vector<std::pair<std::string, char>> types = {
    {"Id", 'd'}, {"Real", 'r'}, {"int", 'i'}, {"std::string", 't'}};

/// How many fields of each type entries have room for. Keywords that are only read share the struct of their
/// entries: each one more would take a second to compile.
using Room = std::map<char, std::size_t>;

struct Member {
  std::string type, name, value, field;
  YAML::Node where{};
};

/// The table of one keyword. With `struct` its entries have a struct of their own, else they are only read.
class Table {
 public:
  Table(const YAML::Node& entry, std::string lacking, bool only_read)
      : entry_(entry), lacking_(std::move(lacking)), only_read_(only_read) {
    if (!entry.IsMap()) fail(entry, "not NAME: purpose");
    expect_keys(entry, {entry.begin()->first.Scalar(), "also", "combine", "defines", "options", "once",
                        "many", "cards", "struct", "local", "convert", "move", "lacking"});
    names_ = split(entry.begin()->first.Scalar(), ',');
    for (const std::string& name : list(entry["also"])) names_.push_back(name);
    names_ = combined(names_, list(entry["combine"]));
    if (entry["lacking"]) lacking_ = entry["lacking"].Scalar();
    if (!entry["cards"]) fail(entry, "no cards");
    if (names_.size() > 64) fail(entry, "more than 64 names");
    if (!only_read && !entry["struct"]) fail(entry, "no struct");
    for (const YAML::Node& card : entry["cards"])
      for (const YAML::Node& field : card)
        if (field.IsSequence()) find_members(field);
    if (!only_read) find_functions();
  }

  const Room& room() const { return room_; }
  bool is_long() const { return members_.size() > 20; }
  std::string struct_name() const {
    return !only_read_ ? entry_["struct"].Scalar() : is_long() ? "LongEntry" : "ShortEntry";
  }
  /// Of a struct of its own.
  std::vector<Member> members() const {
    std::vector<Member> out;
    if (has_title()) out.push_back({"std::string", "title", "", "", entry_});
    if (has(defines(), "ID")) out.push_back({"Id", "id", "0", "", entry_});
    out.insert(out.end(), declared_.begin(), declared_.end());
    return out;
  }
  /// Declarations of the functions that the entry names.
  const Words& functions() const { return functions_; }
  std::string function_name() const { return lower(names_.front()) + "_table"; }

  /// An initialiser of KeywordTable; T is the struct.
  std::string text() const {
    const Words defined = defines(), options = list(entry_["options"]);
    std::string out = "{.names = {";
    for (const std::string& name : names_) out += in_quotes(name) + ", ";
    out += fmt::format("}}, .purpose = {}", in_quotes(entry_.begin()->second.Scalar()));
    if (!lacking_.empty()) out += fmt::format(", .lacking = {}", in_quotes(lacking_));
    if (!defined.empty() && std::islower(static_cast<unsigned char>(defined[0][0])))
      out += ", .id_space = IdSpace::" + defined[0];
    if (has(defined, "TITLE")) out += ", .title_option = true";
    if (has(defined, "ID")) out += ", .id_option = true";
    for (const char* option : {"mpp_option", "collect_option", "id_may_repeat"})
      if (has(options, option)) out += fmt::format(", .{} = true", option);
    if (has(defined, "HEADING")) out += ", .heading = true";
    if (entry_["once"]) out += ", .once = true";
    if (entry_["once"] || entry_["many"]) out += fmt::format(", .many = {}", entry_["many"].as<bool>(false));
    if (has_title()) out += ", .title = member(&T::title).offset";
    if (has(defined, "ID"))
      out += fmt::format(", .id = member(&T::{}).offset", only_read_ ? "entry_id" : "id");
    if (entry_["local"])
      out += fmt::format(", .local = member(&T::{}).offset", member(entry_, entry_["local"].Scalar()));
    out += ",\n  .cards = {";
    for (const YAML::Node& card : entry_["cards"]) out += card_text(card);
    out += "}";
    for (const char* hook : {"convert", "move"})
      if (entry_[hook])
        out += fmt::format(
            ",\n  .{}_rest = [](Entry& e, const auto& by) {{ return {}(static_cast<T&>(e), by); }}", hook,
            entry_[hook].Scalar());
    return out + "}";
  }

 private:
  Words defines() const { return list(entry_["defines"]); }
  bool has_title() const {
    const Words defined = defines();
    return has(defined, "TITLE") || has(defined, "ID") || has(defined, "HEADING");
  }
  static std::string type_of(const YAML::Node& kind) {
    if (kind.IsMap()) return "Id";
    const std::string& word = kind.Scalar();
    if (word == "real" || (word != "-" && is_dimension(word))) return "Real";
    return word == "int" ? "int" : word == "text" ? "std::string" : "Id";
  }
  /// What an id may refer to: src/keyword/id_space.hpp.
  static bool is_kind(const std::string& word) {
    static const Words spaces = split(
        "node solid shell beam discrete mass part material eos section hourglass node_set part_set solid_set "
        "shell_set beam_set segment_set curve box coordinate_system vector transformation definition contact "
        "boundary rigid_wall joint joint_stiffness",
        ' ');
    return is_dimension(word) || has({"int", "text", "real", "id"}, word) || has(spaces, word);
  }
  static YAML::Node rule_of(const YAML::Node& field, const char* key) {
    for (std::size_t r = 3; r < field.size(); ++r)
      if (field[r].IsMap() && field[r][key]) return field[r][key];
    return YAML::Node(YAML::NodeType::Undefined);
  }
  static bool has_rule(const YAML::Node& field, const std::string& word) {
    for (std::size_t r = 3; r < field.size(); ++r)
      if (field[r].IsScalar() && field[r].Scalar() == word) return true;
    return false;
  }

  void find_members(const YAML::Node& field) {
    if (field.size() < 3) fail(field, "not [NAMES, KIND, MEANING, RULES ...]");
    const std::string type = type_of(field[1]);
    if (field[1].IsScalar() && !is_kind(field[1].Scalar()))
      fail(field, fmt::format("'{}' is no kind of field", field[1].Scalar()));
    const Words names = split(field[0].Scalar(), ' '), given = list(rule_of(field, "member"));
    if (!given.empty() && given.size() != names.size()) fail(field, "not one member for each field");
    for (std::size_t k = 0; k < names.size(); ++k) {
      if (only_read_) {
        for (const auto& [of, begin] : types)
          if (of == type && members_.count(names[k]) == 0)
            members_[names[k]] = begin + std::to_string(room_[begin]++);
        continue;
      }
      const std::string name = given.empty() ? lower(names[k]) : given[k];
      members_[names[k]] = name;
      const bool is_list = has_rule(field, "list");
      const Member one{is_list ? "std::vector<" + type + ">" : type, name,
                       is_list || type == "std::string" ? "" : standard_of(field), names[k], field};
      declared_.push_back(one);
    }
  }

  void find_functions() {
    const auto add = [this](const char* result, const YAML::Node& name, const std::string& rest = "") {
      if (name)
        functions_.push_back(fmt::format("{} {}({}{}&{})", result, name.Scalar(),
                                         rest.empty() ? "const " : "", struct_name(), rest));
    };
    for (const YAML::Node& card : entry_["cards"])
      for (const YAML::Node& field : card) {
        if (field.IsMap() && field["when"] && split(field["when"].Scalar(), ' ').size() == 1)
          add("bool", field["when"]);
        if (field.IsMap()) add("bool", field["more"]);
        if (!field.IsSequence()) continue;
        if (field[1].IsMap() && field[1].size() == 1) add("IdSpace", field[1]["by"]);
        add("CurveOf", rule_of(field, "curve_of"));
      }
    add("std::string", entry_["convert"], ", const Conversion&"),
        add("std::string", entry_["move"], ", const Affine&");
  }

  static std::string standard_of(const YAML::Node& field) {
    double number = 0;
    for (std::size_t r = 3; r < field.size(); ++r)
      if (field[r].IsScalar() && YAML::convert<double>::decode(field[r], number)) return field[r].Scalar();
    return "0";
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
        expect_keys(whole = field,
                    {"with", "when", "more", "optional", "width", "repeat", "until_entry", "whole_lines"});
      else
        fields += field.IsScalar() ? "{}, " : group(field, whole["width"].as<int>(10));
    }
    std::string out = fmt::format("\n{{.fields = {{{}}}", fields);
    for (const char* flag : {"optional", "repeat", "until_entry", "whole_lines"})
      if (whole[flag]) out += fmt::format(", .{} = true", flag);
    const std::string begin =
        "[]([[maybe_unused]] const Entry& entry) { [[maybe_unused]] const T& e = static_cast<const "
        "T&>(entry); return ";
    if (whole["with"] || whole["when"]) out += ", .when = " + begin + condition(whole) + "; }";
    if (whole["more"]) out += ", .more = " + begin + whole["more"].Scalar() + "(e); }";
    return out + "},";
  }

  std::string condition(const YAML::Node& card) const {
    std::string out;
    unsigned long long mask = 0;
    for (const std::string& word : list(card["with"])) {
      bool found = false;
      for (std::size_t n = 0; n < names_.size(); ++n)
        if (names_[n] == word || has(split(names_[n], '_'), word)) mask |= 1ull << n, found = true;
      if (!found) fail(card, "no name has the word '" + word + "'");
    }
    if (mask != 0) out = fmt::format("(({}ull >> e.name) & 1) != 0", mask);
    if (!card["when"]) return out;
    const Words words = split(card["when"].Scalar(), ' ');
    const std::string and_then = out.empty() ? "" : " && ";
    if (words.size() == 1 && !only_read_) return out + and_then + words[0] + "(e)";
    if (words.size() != 3 || !has({"==", "!=", "<", ">", "<=", ">="}, words[1]))
      fail(card, "not FIELD == NUMBER, FIELD != NUMBER or the like");
    return out + fmt::format("{}e.{} {} {}", and_then, member(card, words[0]), words[1], words[2]);
  }

  /// Fields that stand side by side and differ in nothing but their names, or a word of their meaning.
  std::string group(const YAML::Node& field, int width) const {
    const YAML::Node& kind = field[1];
    const std::string& word = kind.IsMap() ? "id" : kind.Scalar();
    const Words names = split(field[0].Scalar(), ' ');
    std::map<std::string, std::string> rules;
    if (type_of(kind) == "Id" && word != "id") rules["refers"] = "IdSpace::" + word;
    if (only_read_ && lacking_.empty()) rules["honour"] = "Honour::ignored";
    for (std::size_t r = 3; r < field.size(); ++r) add_rule(field[r], rules, width);
    if (width != 10) rules["width"] = std::to_string(width);
    const YAML::Node hook = rule_of(field, "curve_of");
    std::string out;
    for (std::size_t i = 0; i < names.size(); ++i) {
      out += fmt::format("\n#line {} {}\n{{member(&T::{}), {}, {}, {}, {{", field.Mark().line + 1,
                         in_quotes(file_name), member(field, names[i]), in_quotes(names[i]),
                         in_quotes(type_of(kind) == "Real" && word != "real" ? word : "-"),
                         in_quotes(meaning_of(field[2], i, names.size())));
      for (const char* rule : {"standard", "zero_is_standard", "required", "check", "honour", "allowed",
                               "width", "refers", "spatial", "pairs", "curve"})  // as FieldRules has them
        if (rules.count(rule) != 0) out += fmt::format(".{} = {}, ", rule, rules[rule]);
      rules.erase("spatial");
      out += "}, " + (kind.IsMap() ? space(kind) : "{}");
      if (hook)
        out += fmt::format(", [](const Entry& e) {{ return {}(static_cast<const T&>(e)); }}", hook.Scalar());
      out += "}, ";
    }
    return out;
  }

  void add_rule(const YAML::Node& rule, std::map<std::string, std::string>& rules, int& width) const {
    double number = 0;
    if (rule.IsMap()) return add_rules(rule, rules, width);
    const std::string& word = rule.Scalar();
    if (YAML::convert<double>::decode(rule, number)) {
      rules["standard"] = word;
    } else if (word == "required") {
      rules["required"] = "true", rules["check"] = "Check::positive";
    } else if (has({"positive", "not_negative", "not_positive"}, word)) {
      rules["check"] = "Check::" + word;
    } else if (word == "point" || word == "direction") {
      rules["spatial"] = "Spatial::" + word;
    } else if (word == "output" || word == "unsupported") {
      rules["honour"] = word == "output" ? "Honour::output_only" : "Honour::no";
    } else if (only_read_) {
      fail(rule, "unknown rule '" + word + "'");
    } else if (word == "ignored") {
      rules["honour"] = "Honour::ignored";
    } else if (word == "given") {
      rules["required"] = "true";
    } else if (word == "zero_counts") {
      rules["zero_is_standard"] = "false";
    } else if (word == "pairs") {
      rules["pairs"] = "true";
    } else if (word != "list") {
      fail(rule, "unknown rule '" + word + "'");
    }
  }

  void add_rules(const YAML::Node& rule, std::map<std::string, std::string>& rules, int& width) const {
    expect_keys(rule, only_read_ ? Words{"width"} : Words{"width", "member", "allowed", "curve", "curve_of"});
    if (rule["width"]) width = rule["width"].as<int>();
    if (rule["allowed"]) {
      std::string values;
      for (const std::string& value : list(rule["allowed"])) values += (values.empty() ? "" : ", ") + value;
      rules["allowed"] = "{" + values + "}";
    }
    if (rule["curve"]) {
      const Words both = list(rule["curve"]);
      if (both.size() != 2) fail(rule, "not [dimension of the abscissa, of the ordinate]");
      for (const std::string& one : both)
        if (!is_dimension(one)) fail(rule, fmt::format("'{}' is no dimension", one));
      rules["curve"] = fmt::format("{{{}, {}}}", in_quotes(both[0]), in_quotes(both[1]));
    }
  }

  /// What the ids number where another field decides, {by: TYPE, 1: part, else: part_set}, `name` being which
  /// of the names it is; or a function, {by: function}.
  std::string space(const YAML::Node& kind) const {
    const std::string by = kind["by"] ? kind["by"].Scalar() : "";
    std::string out = "[](const Entry& entry) { const T& e = static_cast<const T&>(entry); return ";
    if (!only_read_ && kind.size() == 1 && kind["by"]) return out + by + "(e); }";
    if (!kind["by"] || !kind["else"]) fail(kind, "not {by: FIELD, NUMBER: SPACE, else: SPACE}");
    for (const auto& choice : kind)
      if (const std::string& key = choice.first.Scalar(); key != "by" && key != "else")
        out += fmt::format("e.{} == {} ? IdSpace::{} : ", by == "name" ? by : member(kind, by), key,
                           choice.second.Scalar());
    return out + "IdSpace::" + kind["else"].Scalar() + "; }";
  }

  YAML::Node entry_;
  std::string lacking_;
  bool only_read_;
  Words names_;
  Room room_;
  std::map<std::string, std::string> members_;  ///< of each field
  std::vector<Member> declared_;                ///< of a struct of its own
  Words functions_;
};

std::string shared_struct(const char* name, const std::vector<Table>& tables, bool is_long) {
  Room most;
  for (const Table& table : tables)
    for (const auto& [begin, count] : table.room())
      if (table.is_long() == is_long) most[begin] = std::max(most[begin], count);
  std::string out = fmt::format("struct {} : Entry {{\n  std::string title;\n  Id entry_id = 0;\n", name);
  for (const auto& [type, begin] : types)
    for (std::size_t k = 0; k < most[begin]; ++k) out += fmt::format("  {} {}{}{{}};\n", type, begin, k);
  return out + "};\n\n";
}

void write_only_read(const YAML::Node& file, std::ostream& out) {
  expect_keys(file, {"refused", "idle"});
  std::vector<Table> tables;
  for (const auto& lacking : file["refused"])
    for (const YAML::Node& entry : lacking.second) tables.emplace_back(entry, lacking.first.Scalar(), true);
  for (const YAML::Node& entry : file["idle"]) tables.emplace_back(entry, "", true);
  out << "#include <string>\n\n#include \"keyword/registry.hpp\"\n\nnamespace courant {\n\nnamespace {\n\n"
      << shared_struct("ShortEntry", tables, false) << shared_struct("LongEntry", tables, true)
      << "template <class T>\nvoid register_table(KeywordTable table) {\n"
      << "  const RegisterKeyword<T> registered(std::move(table));\n}\n\n";
  std::size_t count = 0;
  for (const Table& table : tables)
    out << "[[maybe_unused]] const bool table" << count++ << " = [] {\n  using T = " << table.struct_name()
        << ";\n  register_table<T>(" << table.text() << ");\n  return true;\n}();\n";
  out << "}  // namespace\n\n}  // namespace courant\n";
}

/// A struct that has the members of all its tables, and the functions that they name.
std::string struct_text(const std::string& name, const std::vector<Table>& tables) {
  std::string members, functions;
  std::map<std::string, std::string> types_of, member_of;
  std::set<std::string> declared;
  for (const Table& table : tables) {
    if (table.struct_name() != name) continue;
    for (const Member& one : table.members()) {
      const auto [before, is_new] = types_of.try_emplace(one.name, one.type);
      if (const auto& other = member_of.try_emplace(one.field, one.name).first->second;
          !one.field.empty() && other != one.name)
        fail(one.where, fmt::format("{} was the member '{}' before", one.field, other));
      if (before->second != one.type)
        fail(one.where, fmt::format("'{}' was {} before", one.name, before->second));
      if (is_new)
        members +=
            fmt::format("  {} {}{};\n", one.type, one.name, one.value.empty() ? "" : " = " + one.value);
    }
    for (const std::string& function : table.functions())
      if (declared.insert(function).second) functions += function + ";\n";
  }
  return fmt::format("struct {} : Entry {{\n{}}};\n{}\n", name, members, functions);
}

/// Tables are functions of a type that may derive from their struct.
void write_cards(const YAML::Node& file, std::ostream& out) {
  std::vector<Table> tables;
  Words structs;
  for (const YAML::Node& entry : file) {
    tables.emplace_back(entry, "", false);
    if (!has(structs, tables.back().struct_name())) structs.push_back(tables.back().struct_name());
  }
  out << "// Made of " << std::filesystem::path(file_name).filename().string() << ".\n#pragma once\n"
      << "#include <string>\n#include <vector>\n\n#include \"keyword/keyword_table.hpp\"\n\nnamespace "
         "courant {\n\n";
  for (const std::string& name : structs) out << struct_text(name, tables);
  for (const Table& table : tables)
    out << "template <class T = " << table.struct_name() << ">\nKeywordTable " << table.function_name()
        << "() {\n  return " << table.text() << ";\n}\n\n";
  out << "}  // namespace courant\n";
}

}  // namespace

int main(int count, char** arguments) {
  try {
    if (count != 3) throw std::runtime_error("usage: keyword_tables CARDS.yaml OUT.hpp|OUT.cpp");
    file_name = arguments[1];
    const YAML::Node file = YAML::LoadFile(file_name);
    std::ostringstream text;
    file.IsMap() ? write_only_read(file, text) : write_cards(file, text);
    std::ofstream out(arguments[2]);
    if (!(out << text.str() << std::flush))
      throw std::runtime_error(fmt::format("{} cannot be written", arguments[2]));
  } catch (const std::exception& error) {
    std::cerr << error.what() << '\n';
    return 1;
  }
}
