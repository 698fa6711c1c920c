// Tables of all *SET_ keywords.
#include <fmt/format.h>
#include <iterator>
#include <utility>

#include "keyword/common_rules.hpp"
#include "keyword/registry.hpp"
#include "keyword/source.hpp"
#include "model/sets/set_cards.hpp"
#include "model/sets/sets.hpp"

namespace courant {

const char* set_word(SetKind kind) {
  static constexpr const char* words[] = {"node", "part", "shell", "solid", "segment"};
  return words[static_cast<std::size_t>(kind)];
}

IdSpace set_space(SetKind kind) {
  static constexpr IdSpace spaces[] = {IdSpace::node_set, IdSpace::part_set, IdSpace::shell_set,
                                       IdSpace::solid_set, IdSpace::segment_set};
  return spaces[static_cast<std::size_t>(kind)];
}

IdSpace member_space(SetKind kind) {
  static constexpr IdSpace spaces[] = {IdSpace::node, IdSpace::part, IdSpace::shell, IdSpace::solid,
                                       IdSpace::node};  // a segment is told by its nodes
  return spaces[static_cast<std::size_t>(kind)];
}

const char* member_field(SetKind kind, SetForm form) {
  switch (form) {
    case SetForm::generate:
      return "BNBEG";
    case SetForm::increment:
      return "BBEG";
    case SetForm::add:
    case SetForm::advanced:
    case SetForm::intersect:
      return "SID1";
    case SetForm::general:
      return "OPTION";
    case SetForm::list:
    case SetForm::column:
      break;
  }
  static constexpr const char* names[] = {"NID", "PID", "EID", "EID", "N1"};
  return names[static_cast<std::size_t>(kind)];
}

namespace {

using namespace rules;

/// The first card of all sets. The attributes are defaults for what members carry into tiebreak contacts,
/// thermal and airbag loads; nothing that is computed here reads them.
template <class T>
CardOf<T> set_card() {
  if (T::kind == SetKind::solid)  // solids have no attributes
    return {.fields = {{"SID", &T::sid, "-", "set id", required_id},
                       {"SOLVER", &T::solver, "-", "solver that owns the set", no_effect}}};
  return {.fields = {{"SID", &T::sid, "-", "set id", required_id},
                     {"DA1", &T::da1, "-", "attribute 1", no_effect},
                     {"DA2", &T::da2, "-", "attribute 2", no_effect},
                     {"DA3", &T::da3, "-", "attribute 3", no_effect},
                     {"DA4", &T::da4, "-", "attribute 4", no_effect},
                     {"SOLVER", &T::solver, "-", "solver that owns the set", no_effect},
                     {"ITS", &T::its, "-", "two-scale flag", no_effect_but(1)}}};
}

template <class T>
CardOf<T> list_card(const char* meaning, IdSpace space, bool pairs = false) {
  FieldRules rules = optional_id_of(space);
  rules.pairs = pairs;
  return {.fields = {{member_field(T::kind, T::form), &T::ids, "-", meaning, rules}}, .repeat = true};
}

template <class T>
CardOf<T> increment_card() {
  const FieldRules id = optional_id_of(member_space(T::kind));
  return {.fields = {{"BBEG", &T::ids, "-", "first id", id},
                     {"BEND", &T::e2, "-", "last id", id},
                     {"INCR", &T::e3, "-", "step, 0 means 1", {.check = Check::not_negative}}},
          .repeat = true};
}

template <class T>
CardOf<T> column_card() {
  static constexpr const char* meanings[] = {"node id", "part id", "shell id"};
  return {.fields = {{member_field(T::kind, T::form), &T::ids, "-",
                      meanings[static_cast<std::size_t>(T::kind)], optional_id_of(member_space(T::kind))},
                     {},  // A1 to A4, attributes
                     {},
                     {},
                     {}},
          .repeat = true};
}

template <class T>
CardOf<T> segment_card() {
  const FieldRules corner = optional_id_of(IdSpace::node);
  return {.fields = {{"N1", &T::ids, "-", "corner node 1", corner},
                     {"N2", &T::e2, "-", "corner node 2", corner},
                     {"N3", &T::e3, "-", "corner node 3; 0 with N4 = 0: a line, in 2D", corner},
                     {"N4", &T::e4, "-", "corner node 4; N3 or 0: a triangle", corner},
                     {},  // A1 to A4, attributes
                     {},
                     {},
                     {}},
          .repeat = true};
}

template <class T>
CardOf<T> advanced_card() {
  const FieldRules set{.check = Check::not_negative};
  const FieldRules kind{.check = Check::not_negative, .allowed = {0, 1, 2, 4, 5}};
  const char* words = "its kind: 1 node, 2 shell, 4 solid, 5 segment set";
  return {.fields = {{"SID1", &T::ids, "-", "set id", set},
                     {"TYPE1", &T::e2, "-", words, kind},
                     {"SID2", &T::e3, "-", "set id", set},
                     {"TYPE2", &T::e4, "-", "its kind", kind},
                     {"SID3", &T::e5, "-", "set id", set},
                     {"TYPE3", &T::e6, "-", "its kind", kind},
                     {"SID4", &T::e7, "-", "set id", set},
                     {"TYPE4", &T::e8, "-", "its kind", kind}},
          .repeat = true};
}

template <class T>
CardOf<T> general_card() {
  const FieldRules id{.check = Check::not_negative};
  CardOf<T> card{.fields = {{"OPTION", &T::option, "-", "what to take in; with D in front: out"},
                            {"E1", &T::ids, "-", "id", id},
                            {"E2", &T::e2, "-", "id", id},
                            {"E3", &T::e3, "-", "id", id}},
                 .repeat = true};
  if (T::kind == SetKind::segment) {
    card.fields.push_back({"E4", &T::r4, "-", "corner node 4 of SEG, else an attribute without effect"});
    for (int attribute = 5; attribute <= 7; ++attribute) card.fields.push_back({});
    return card;
  }
  card.fields.push_back({"E4", &T::e4, "-", "id", id});
  card.fields.push_back({"E5", &T::e5, "-", "id", id});
  card.fields.push_back({"E6", &T::e6, "-", "id", id});
  card.fields.push_back({"E7", &T::e7, "-", "id", id});
  return card;
}

template <class T>
CardOf<T> members_card() {
  static constexpr const char* members[] = {"node ids", "part ids", "shell ids", "solid ids"};
  static constexpr const char* sets[] = {"ids of node sets", "ids of part sets", "ids of shell sets",
                                         "ids of solid sets", "ids of segment sets"};
  constexpr auto kind = static_cast<std::size_t>(T::kind);
  switch (T::form) {
    case SetForm::list:
      if constexpr (T::kind == SetKind::segment)
        return segment_card<T>();
      else
        return list_card<T>(members[kind], member_space(T::kind));
    case SetForm::generate:
      return list_card<T>("first id, last id, first id, last id, ...", member_space(T::kind), true);
    case SetForm::increment:
      return increment_card<T>();
    case SetForm::column:
      return column_card<T>();
    case SetForm::add:
    case SetForm::intersect:
      return list_card<T>(sets[kind], set_space(T::kind));
    case SetForm::advanced:
      return advanced_card<T>();
    case SetForm::general:
      break;
  }
  return general_card<T>();
}

/// Shifts the ids that depend on a word in their row.
template <class T>
std::string shift_rows(T& card, const Conversion& conversion) {
  std::vector<Id> T::*columns[] = {&T::ids, &T::e2, &T::e3, &T::e4, &T::e5, &T::e6, &T::e7};
  if constexpr (T::form == SetForm::advanced) {
    constexpr std::size_t pairs = 4;
    std::vector<Id> T::*types[] = {&T::e2, &T::e4, &T::e6, &T::e8};
    for (std::size_t row = 0; row < card.ids.size(); ++row)
      for (std::size_t p = 0; p < pairs; ++p) {
        std::vector<Id>& column = card.*columns[2 * p];
        if (row < column.size())
          column[row] = conversion.offsets.shifted(advanced_space(cell(card.*types[p], row)), column[row]);
      }
  } else {
    for (std::size_t row = 0; row < card.option.size(); ++row) {
      const IdSpace fourth = row_space(T::kind, card.option[row], 3);
      if (const auto node = card.fourth_node(row); node && row < card.r4.size() && fourth != IdSpace::none)
        card.r4[row] = static_cast<Real>(conversion.offsets.shifted(fourth, *node));
      for (std::size_t k = 0; k < std::size(columns); ++k) {
        std::vector<Id>& column = card.*columns[k];
        if (row < column.size())
          column[row] = conversion.offsets.shifted(row_space(T::kind, card.option[row], k), column[row]);
      }
    }
  }
  return {};
}

std::string purpose_of(SetKind kind, SetForm form) {
  const std::string word = set_word(kind);
  switch (form) {
    case SetForm::list:
      return kind == SetKind::segment ? "set of segments, by their corner nodes"
                                      : fmt::format("set of {0}s, by their ids", word);
    case SetForm::generate:
      return fmt::format("set of all {}s with ids in given ranges", word);
    case SetForm::increment:
      return fmt::format("set of {}s with ids in steps", word);
    case SetForm::column:
      return fmt::format("set of {}s, one per line; their attributes have no effect", word);
    case SetForm::add:
      return fmt::format("all members of other {} sets", word);
    case SetForm::advanced:
      return "all nodes of other sets of several kinds";
    case SetForm::intersect:
      return fmt::format("{}s that stand in every one of several sets", word);
    case SetForm::general:
      break;
  }
  return fmt::format(
      "set of {}s, taken in row by row with {}, or out with D in front of the word (not DALL); an element is "
      "in a box if all its nodes are",
      word, fmt::join(set_words(kind), ", "));
}

std::vector<std::string> names_of(SetKind kind, SetForm form) {
  static constexpr const char* suffixes[] = {"",     "_GENERATE",     "_GENERATE_INCREMENT", "_COLUMN",
                                             "_ADD", "_ADD_ADVANCED", "_INTERSECT",          "_GENERAL"};
  const std::string base = "SET_" + upper_case(set_word(kind));
  const std::string suffix = suffixes[static_cast<std::size_t>(form)];
  const bool listed = form == SetForm::list || form == SetForm::generate || form == SetForm::increment;
  if (!listed || kind == SetKind::solid || kind == SetKind::segment) return {base + suffix};
  return {base + "_LIST" + suffix, base + suffix};
}

template <class T>
void register_set() {
  KeywordOf<T> keyword{.names = names_of(T::kind, T::form),
                       .purpose = purpose_of(T::kind, T::form),
                       .id_space = set_space(T::kind),
                       .title_option = true,
                       .collect_option = true,
                       .title = &T::title,
                       .cards = {set_card<T>(), members_card<T>()}};
  if constexpr (T::form == SetForm::advanced || T::form == SetForm::general) keyword.convert = shift_rows<T>;
  register_keyword(make_keyword_spec<T>(std::move(keyword)));
}

template <class... Cards>
struct RegisterAll {
  RegisterAll() { (register_set<Cards>(), ...); }
};
const AllSetCards<RegisterAll> all_sets;

}  // namespace

}  // namespace courant
