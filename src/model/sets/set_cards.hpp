#pragma once
// Cards of all *SET_ keywords. They differ in what a set holds (SetKind) and in how its members are given
// (SetForm); everything else is one.
#include <cmath>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "keyword/card.hpp"
#include "keyword/id_space.hpp"

namespace courant {

/// What a set holds.
enum class SetKind : std::uint8_t { node, part, shell, solid, segment };

/// How the members are given.
enum class SetForm : std::uint8_t {
  list,       ///< their ids; segments: four nodes per row
  generate,   ///< ranges of ids: first, last, first, last, ...
  increment,  ///< rows of first id, last id, step
  column,     ///< one id per row, with attributes
  add,        ///< all members of other sets of the kind
  advanced,   ///< all nodes of other sets of any kind: rows of four pairs (set, kind)
  intersect,  ///< what several sets of the kind share
  general,    ///< rows of a word and what it takes: ALL, PART 3 4, DBOX 1, ...
};

struct SetCard : Entry {
  std::string title;
  Id sid = 0;
  Real da1 = 0, da2 = 0, da3 = 0, da4 = 0;
  std::string solver;
  int its = 1;
  std::vector<Id> ids;                         ///< ids of a list; the first column of a table
  std::vector<Id> e2, e3, e4, e5, e6, e7, e8;  ///< further columns of a table
  std::vector<Real> r4;                        ///< _GENERAL of segments: E4, a node of SEG or an attribute
  /// Node of SEG in r4; nothing where that is no whole number that an id may be.
  std::optional<Id> fourth_node(std::size_t row) const {
    const Real number = row < r4.size() ? r4[row] : 0;
    if (!(number == std::floor(number) && std::abs(number) <= static_cast<Real>(largest_id)))
      return std::nullopt;
    return static_cast<Id>(number);
  }
  std::vector<std::string> option;  ///< _GENERAL: the word of each row
};

/// A cell of a table's column; 0 where a faulty field, which was refused, left the column short.
inline Id cell(const std::vector<Id>& column, std::size_t row) {
  return row < column.size() ? column[row] : 0;
}

/// Every keyword has a type of its own, as the deck stores its entries by type.
template <SetKind K, SetForm F>
struct SetCardOf : SetCard {
  static constexpr SetKind kind = K;
  static constexpr SetForm form = F;
};

/// The set keywords that exist. `Use` is a template over the card types.
template <template <class...> class Use>
using AllSetCards =
    Use<SetCardOf<SetKind::node, SetForm::list>, SetCardOf<SetKind::node, SetForm::generate>,
        SetCardOf<SetKind::node, SetForm::increment>, SetCardOf<SetKind::node, SetForm::column>,
        SetCardOf<SetKind::node, SetForm::add>, SetCardOf<SetKind::node, SetForm::advanced>,
        SetCardOf<SetKind::node, SetForm::intersect>, SetCardOf<SetKind::node, SetForm::general>,
        SetCardOf<SetKind::part, SetForm::list>, SetCardOf<SetKind::part, SetForm::generate>,
        SetCardOf<SetKind::part, SetForm::increment>, SetCardOf<SetKind::part, SetForm::column>,
        SetCardOf<SetKind::part, SetForm::add>, SetCardOf<SetKind::part, SetForm::general>,
        SetCardOf<SetKind::shell, SetForm::list>, SetCardOf<SetKind::shell, SetForm::generate>,
        SetCardOf<SetKind::shell, SetForm::increment>, SetCardOf<SetKind::shell, SetForm::column>,
        SetCardOf<SetKind::shell, SetForm::add>, SetCardOf<SetKind::shell, SetForm::intersect>,
        SetCardOf<SetKind::shell, SetForm::general>, SetCardOf<SetKind::solid, SetForm::list>,
        SetCardOf<SetKind::solid, SetForm::generate>, SetCardOf<SetKind::solid, SetForm::increment>,
        SetCardOf<SetKind::solid, SetForm::add>, SetCardOf<SetKind::solid, SetForm::intersect>,
        SetCardOf<SetKind::solid, SetForm::general>, SetCardOf<SetKind::segment, SetForm::list>,
        SetCardOf<SetKind::segment, SetForm::add>, SetCardOf<SetKind::segment, SetForm::intersect>,
        SetCardOf<SetKind::segment, SetForm::general>>;

/// Names of the first field on the card behind the set's own, for messages.
const char* member_field(SetKind kind, SetForm form);

/// "node", "part", ...
const char* set_word(SetKind kind);
IdSpace set_space(SetKind kind);
IdSpace member_space(SetKind kind);

}  // namespace courant
