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
                                       IdSpace::node};  // a segment is named by its nodes
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
/// thermal and airbag loads; *CONTACT_INTERIOR alone reads those of parts.
CardOf<SetCard> set_card(SetKind kind) {
  const FieldRules of_parts = kind == SetKind::part ? FieldRules{} : no_effect;
  if (kind == SetKind::solid)  // solids have no attributes
    return {.fields = {{"SID", &SetCard::sid, "-", "set id", required_id},
                       {"SOLVER", &SetCard::solver, "-", "solver that owns the set", no_effect}}};
  return {
      .fields = {
          {"SID", &SetCard::sid, "-", "set id", required_id},
          {"DA1", &SetCard::da1, "-",
           kind == SetKind::part ? "attribute 1; of *CONTACT_INTERIOR scale of the stiffness" : "attribute 1",
           of_parts},
          {"DA2", &SetCard::da2, "-",
           kind == SetKind::part
               ? "attribute 2; of *CONTACT_INTERIOR share of the thickness at which it begins"
               : "attribute 2",
           of_parts},
          {"DA3", &SetCard::da3, "-",
           kind == SetKind::part ? "attribute 3; of *CONTACT_INTERIOR a modulus" : "attribute 3", of_parts},
          {"DA4", &SetCard::da4, "-", "attribute 4", no_effect},
          {"SOLVER", &SetCard::solver, "-", "solver that owns the set", no_effect},
          {"ITS", &SetCard::its, "-", "two-scale flag", no_effect_but(1)}}};
}

CardOf<SetCard> list_card(SetKind kind, SetForm form, const char* meaning, IdSpace space,
                          bool pairs = false) {
  FieldRules rules = optional_id_of(space);
  rules.pairs = pairs;
  return {.fields = {{member_field(kind, form), &SetCard::ids, "-", meaning, rules}}, .repeat = true};
}

CardOf<SetCard> increment_card(SetKind kind) {
  const FieldRules id = optional_id_of(member_space(kind));
  return {.fields = {{"BBEG", &SetCard::ids, "-", "first id", id},
                     {"BEND", &SetCard::e2, "-", "last id", id},
                     {"INCR", &SetCard::e3, "-", "step, 0 means 1", {.check = Check::not_negative}}},
          .repeat = true};
}

CardOf<SetCard> column_card(SetKind kind) {
  static constexpr const char* meanings[] = {"node id", "part id", "shell id"};
  return {.fields = {{member_field(kind, SetForm::column), &SetCard::ids, "-",
                      meanings[static_cast<std::size_t>(kind)], optional_id_of(member_space(kind))},
                     {},  // A1 to A4, attributes
                     {},
                     {},
                     {}},
          .repeat = true};
}

CardOf<SetCard> segment_card() {
  const FieldRules corner = optional_id_of(IdSpace::node);
  return {.fields = {{"N1", &SetCard::ids, "-", "corner node 1", corner},
                     {"N2", &SetCard::e2, "-", "corner node 2", corner},
                     {"N3", &SetCard::e3, "-", "corner node 3; 0 with N4 = 0: a line, in 2D", corner},
                     {"N4", &SetCard::e4, "-", "corner node 4; N3 or 0: a triangle", corner},
                     {},  // A1 to A4, attributes
                     {},
                     {},
                     {}},
          .repeat = true};
}

CardOf<SetCard> advanced_card() {
  const FieldRules set{.check = Check::not_negative};
  const FieldRules kind{.check = Check::not_negative, .allowed = {0, 1, 2, 4, 5}};
  const char* words = "its kind: 1 node, 2 shell, 4 solid, 5 segment set";
  return {.fields = {{"SID1", &SetCard::ids, "-", "set id", set},
                     {"TYPE1", &SetCard::e2, "-", words, kind},
                     {"SID2", &SetCard::e3, "-", "set id", set},
                     {"TYPE2", &SetCard::e4, "-", "its kind", kind},
                     {"SID3", &SetCard::e5, "-", "set id", set},
                     {"TYPE3", &SetCard::e6, "-", "its kind", kind},
                     {"SID4", &SetCard::e7, "-", "set id", set},
                     {"TYPE4", &SetCard::e8, "-", "its kind", kind}},
          .repeat = true};
}

CardOf<SetCard> general_card(SetKind kind) {
  const FieldRules id{.check = Check::not_negative};
  CardOf<SetCard> card{.fields = {{"OPTION", &SetCard::option, "-", "what to take in; with D in front: out"},
                                  {"E1", &SetCard::ids, "-", "id", id},
                                  {"E2", &SetCard::e2, "-", "id", id},
                                  {"E3", &SetCard::e3, "-", "id", id}},
                       .repeat = true};
  if (kind == SetKind::segment) {
    card.fields.push_back(
        {"E4", &SetCard::r4, "-", "corner node 4 of SEG, else an attribute without effect"});
    for (int attribute = 5; attribute <= 7; ++attribute) card.fields.push_back({});
    return card;
  }
  card.fields.push_back({"E4", &SetCard::e4, "-", "id", id});
  card.fields.push_back({"E5", &SetCard::e5, "-", "id", id});
  card.fields.push_back({"E6", &SetCard::e6, "-", "id", id});
  card.fields.push_back({"E7", &SetCard::e7, "-", "id", id});
  return card;
}

CardOf<SetCard> members_card(SetKind kind, SetForm form) {
  static constexpr const char* members[] = {"node ids", "part ids", "shell ids", "solid ids"};
  static constexpr const char* sets[] = {"ids of node sets", "ids of part sets", "ids of shell sets",
                                         "ids of solid sets", "ids of segment sets"};
  const auto k = static_cast<std::size_t>(kind);
  switch (form) {
    case SetForm::list:
      if (kind == SetKind::segment) return segment_card();
      return list_card(kind, form, members[k], member_space(kind));
    case SetForm::generate:
      return list_card(kind, form, "first id, last id, first id, last id, ...", member_space(kind), true);
    case SetForm::increment:
      return increment_card(kind);
    case SetForm::column:
      return column_card(kind);
    case SetForm::add:
    case SetForm::intersect:
      return list_card(kind, form, sets[k], set_space(kind));
    case SetForm::advanced:
      return advanced_card();
    case SetForm::general:
      break;
  }
  return general_card(kind);
}

constexpr std::vector<Id> SetCard::*columns[] = {&SetCard::ids, &SetCard::e2, &SetCard::e3, &SetCard::e4,
                                                 &SetCard::e5,  &SetCard::e6, &SetCard::e7, &SetCard::e8};

/// Shifts the ids of sets, whose kind is beside them.
std::string shift_pairs(SetCard& card, const Conversion& conversion) {
  for (std::size_t row = 0; row < card.ids.size(); ++row)
    for (std::size_t k = 0; k < std::size(columns); k += 2) {
      std::vector<Id>& column = card.*columns[k];
      if (row < column.size())
        column[row] =
            conversion.offsets.shifted(advanced_space(cell(card.*columns[k + 1], row)), column[row]);
    }
  return {};
}

/// Shifts the ids that depend on a word in their row.
template <SetKind kind>
std::string shift_rows(SetCard& card, const Conversion& conversion) {
  for (std::size_t row = 0; row < card.option.size(); ++row) {
    const IdSpace fourth = row_space(kind, card.option[row], 3);
    if (const auto node = card.fourth_node(row); node && row < card.r4.size() && fourth != IdSpace::none)
      card.r4[row] = static_cast<Real>(conversion.offsets.shifted(fourth, *node));
    for (std::size_t k = 0; k + 1 < std::size(columns); ++k) {
      std::vector<Id>& column = card.*columns[k];
      if (row < column.size())
        column[row] = conversion.offsets.shifted(row_space(kind, card.option[row], k), column[row]);
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
      return fmt::format("{}s that are in every one of several sets", word);
    case SetForm::general:
      break;
  }
  return fmt::format(
      "set of {}s, taken in row by row with {}, or out with D in front of the word (not DALL); an element is "
      "in a box if all its nodes are{}",
      word, fmt::join(set_words(kind), ", "),
      kind == SetKind::segment ? "; of solids the faces that no other of the part shares, outward" : "");
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

KeywordOf<SetCard> keyword_of(SetKind kind, SetForm form) {
  return {.names = names_of(kind, form),
          .purpose = purpose_of(kind, form),
          .id_space = set_space(kind),
          .title_option = true,
          .collect_option = true,
          .title = &SetCard::title,
          .cards = {set_card(kind), members_card(kind, form)}};
}

template <class T>
void register_set() {
  KeywordOf<SetCard> keyword = keyword_of(T::kind, T::form);
  if constexpr (T::form == SetForm::advanced) keyword.convert = shift_pairs;
  if constexpr (T::form == SetForm::general) keyword.convert = shift_rows<T::kind>;
  register_keyword(make_keyword_spec<T>(std::move(keyword)));
}

template <class... Cards>
struct RegisterAll {
  RegisterAll() { (register_set<Cards>(), ...); }
};
const AllSetCards<RegisterAll> all_sets;

}  // namespace

}  // namespace courant
