#pragma once
// The members of all *SET_ keywords, found once the mesh is there. Sets may be made of others; each is found
// when it is first asked for.
#include <algorithm>
#include <functional>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <unordered_map>
#include <utility>
#include <vector>

#include "keyword/deck.hpp"
#include "model/model.hpp"
#include "model/sets/id_index.hpp"
#include "model/sets/set_cards.hpp"

namespace courant {

/// Words that a _GENERAL row of this kind of set may begin with, without those that take out.
std::vector<std::string> set_words(SetKind kind);

/// What the id in column k (E1 is 0) of a _GENERAL row numbers.
IdSpace row_space(SetKind kind, std::string_view word, std::size_t k);

/// What the code beside a set id of *SET_NODE_ADD_ADVANCED represents.
IdSpace advanced_space(Id type);

inline void sort_unique(std::vector<Index>& members) {
  std::sort(members.begin(), members.end());
  members.erase(std::unique(members.begin(), members.end()), members.end());
}

/// Gives back the cards of all sets, once the model holds their members.
void release_set_cards(Deck& deck);

class SetResolver {
 public:
  using Report = std::function<void(Severity, const Entry&, std::string_view field, Deck::Repeat repeat,
                                    std::string message, std::string hint)>;
  /// Nodes, parts, elements and boxes of `model` must be there. Faults go to `report`.
  SetResolver(const Deck& deck, Model& model, const IdIndex& node_of_id, Report report);

  /// Finds the members of all sets and stores them in the model.
  void resolve_all();

 private:
  enum class State { open, busy, done };
  struct Definition {  // one keyword; several with one id are collected
    const SetCard* card = nullptr;
    SetForm form = SetForm::list;
  };
  struct Slot {
    std::vector<Definition> definitions;
    State state = State::open;
  };
  using Members = std::vector<Index>;    // sorted, without repetition
  using Found = std::optional<Members>;  // nothing after a fault, which was reported

  template <class... Cards>
  struct Collect;

  void resolve(SetKind kind, Id id, Slot& slot);
  Found members(SetKind kind, const Definition& definition);
  Found listed(SetKind kind, const SetCard& card, SetForm form);
  Found segments_listed(const SetCard& card);
  Found ranges(SetKind kind, const SetCard& card, SetForm form);
  bool add_range(SetKind kind, const SetCard& card, SetForm form, Id begin, Id end, Id step, Members& out);
  Found combined(SetKind kind, const SetCard& card, SetForm form);
  Found advanced(const SetCard& card);
  Found general(SetKind kind, const SetCard& card);
  Found row(SetKind kind, const SetCard& card, std::string_view word, const std::vector<Id>& ids);

  // what the words of a row take
  Found everything(SetKind kind, const SetCard& card);
  Found elements(SetKind kind, const SetCard& card, const std::vector<Id>& ids);
  Found of_parts(SetKind kind, const SetCard& card, const std::vector<Id>& ids);
  Found in_boxes(SetKind kind, const SetCard& card, std::string_view word, const std::vector<Id>& ids);
  /// Segments on the faces of solids that no other of them in the same part has, if their corners are
  /// `inside`; normals point outwards.
  Found skin(const SetCard& card, const Members& solids, const std::function<bool(Index)>& inside);
  Found of_sets(SetKind kind, SetKind from, const SetCard& card, const std::vector<Id>& ids);
  Members turned_around(const Members& segments);
  Index segment(const std::array<Index, 4>& corners);
  Index segment_of_ids(const SetCard& card, std::string_view field, const std::array<Id, 4>& ids);

  /// Another set's members; nullptr after an error.
  const Members* other(const SetCard& card, std::string_view field, SetKind kind, Id id);
  std::map<Id, Members>& target(SetKind kind);
  /// Nodes or segments of elements.
  Members converted(SetKind from, SetKind to, const Members& members);

  std::size_t count(SetKind kind) const;
  Id id_of(SetKind kind, std::size_t index) const;
  Index find(SetKind kind, Id id);
  /// `value`: the id at fault, 0 if it is not one alone.
  void error(const Entry& entry, std::string_view field, Id value, std::string message,
             std::string hint = {}) {
    report_(Severity::error, entry, field, {row_, value}, std::move(message), std::move(hint));
  }

  /// A member of the set being found that is not there: an error, unless nothing names the set.
  void missing(const Entry& entry, std::string_view field, Id value, std::string message, std::string hint);

  const Deck& deck_;
  Model& model_;
  const IdIndex& node_of_id_;
  Report report_;
  std::map<Id, Slot> slots_[5];
  std::vector<std::pair<SetKind, Id>> path_;  // sets being found, each for the one before
  std::size_t row_ = 0;                       // of the table being read, for messages
  std::optional<IdIndex> shell_of_id_, solid_of_id_;
  std::map<std::array<Index, 4>, Index> segment_of_corners_;
  std::optional<std::set<std::pair<IdSpace, Id>>> unused_;  ///< found with the first member that is missing
  std::set<std::pair<SetKind, Id>> left_out_;               ///< of those the ones that lack a member
};

}  // namespace courant
