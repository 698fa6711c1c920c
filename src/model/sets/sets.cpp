// Sets told by ids, ranges and other sets; the rows of _GENERAL are in sets_general.cpp.
#include "model/sets/sets.hpp"

#include <fmt/format.h>
#include <algorithm>
#include <iterator>

#include "model/mesh/mesh_cards.hpp"
#include "model/sets/unused_ids.hpp"

namespace courant {

namespace {

constexpr const char* usual_keyword[] = {"*SET_NODE_LIST", "*SET_PART_LIST", "*SET_SHELL_LIST", "*SET_SOLID",
                                         "*SET_SEGMENT"};

/// The ranges of first and last ids in turn, those that overlap taken together, so that what lies in many is
/// looked at once. One that runs backwards stays as it is.
std::vector<std::pair<Id, Id>> without_overlap(const std::vector<Id>& ids) {
  std::vector<std::pair<Id, Id>> given, out;
  for (std::size_t r = 0; r + 1 < ids.size(); r += 2)
    if (ids[r] != 0) given.emplace_back(ids[r], ids[r + 1]);
  std::sort(given.begin(), given.end());
  for (const auto& [begin, end] : given)
    if (out.empty() || begin > out.back().second || end < begin)
      out.emplace_back(begin, end);
    else
      out.back().second = std::max(out.back().second, end);
  return out;
}

template <class Entity>
IdIndex index_of_ids(const std::vector<Entity>& entities) {
  if (entities.empty()) return {};
  const auto ends = std::minmax_element(entities.begin(), entities.end(),
                                        [](const Entity& a, const Entity& b) { return a.id < b.id; });
  IdIndex out(ends.first->id, ends.second->id, entities.size());
  for (std::size_t i = 0; i < entities.size(); ++i) out.insert(entities[i].id, static_cast<Index>(i));
  return out;
}

/// "its nodes", "its sets", ...: what a set lacks.
std::string nothing_listed(SetKind kind, SetForm form) {
  if (form == SetForm::general) return "give a row such as ALL or PART below the first card";
  const bool sets = form == SetForm::add || form == SetForm::advanced || form == SetForm::intersect;
  return fmt::format("list its {}s below the first card", sets ? "set" : set_word(kind));
}

}  // namespace

template <class... Cards>
struct SetResolver::Collect {
  explicit Collect(SetResolver& resolver) { (all_of<Cards>(resolver), ...); }
  template <class T>
  static void all_of(SetResolver& r) {
    for (const T& card : r.deck_.template all<T>())
      r.slots_[static_cast<std::size_t>(T::kind)][card.sid].definitions.push_back({&card, T::form});
  }
};

SetResolver::SetResolver(const Deck& deck, Model& model, const IdIndex& node_of_id, Report report)
    : deck_(deck), model_(model), node_of_id_(node_of_id), report_(std::move(report)) {
  AllSetCards<Collect> collect(*this);
}

namespace {

/// Lists of parts are short and stay: *CONTACT_INTERIOR reads their attributes.
template <class... Cards>
struct Release {
  explicit Release(Deck& deck) { (release<Cards>(deck), ...); }
  template <class T>
  static void release(Deck& deck) {
    if constexpr (T::kind != SetKind::part || T::form != SetForm::list) deck.release<T>();
  }
};

}  // namespace

void release_set_cards(Deck& deck) {
  AllSetCards<Release> release(deck);
}

void SetResolver::resolve_all() {
  for (std::size_t k = 0; k < std::size(slots_); ++k)
    for (auto& [id, slot] : slots_[k]) resolve(static_cast<SetKind>(k), id, slot);
}

void SetResolver::resolve(SetKind kind, Id id, Slot& slot) {
  if (slot.state != State::open) return;
  slot.state = State::busy;
  const std::size_t row_of_caller = std::exchange(row_, 0);
  path_.emplace_back(kind, id);
  Members all;
  for (const Definition& definition : slot.definitions) {
    const SetCard& card = *definition.card;
    const bool told = !card.ids.empty() || !card.option.empty();
    Found found = told ? members(kind, definition) : Members{};
    row_ = 0;
    if (found && found->empty())
      error(card, member_field(kind, definition.form), 0, "the set is empty",
            told ? definition.form == SetForm::intersect ? fmt::format("its sets share no {}", set_word(kind))
                   : definition.form == SetForm::general ? fmt::format("its rows leave no {}", set_word(kind))
                                                         : std::string()
                 : nothing_listed(kind, definition.form));
    if (!found) continue;
    if (all.empty())
      all = std::move(*found);
    else
      all.insert(all.end(), found->begin(), found->end());
  }
  sort_unique(all);
  all.shrink_to_fit();
  target(kind)[id] = std::move(all);
  path_.pop_back();
  row_ = row_of_caller;
  slot.state = State::done;
}

SetResolver::Found SetResolver::members(SetKind kind, const Definition& definition) {
  const SetCard& card = *definition.card;
  Found found;
  switch (definition.form) {
    case SetForm::list:
    case SetForm::column:
      found = kind == SetKind::segment ? segments_listed(card) : listed(kind, card, definition.form);
      break;
    case SetForm::generate:
    case SetForm::increment:
      found = ranges(kind, card, definition.form);
      break;
    case SetForm::add:
    case SetForm::intersect:
      found = combined(kind, card, definition.form);
      break;
    case SetForm::advanced:
      found = advanced(card);
      break;
    case SetForm::general:
      found = general(kind, card);
      break;
  }
  if (found) sort_unique(*found);
  return found;
}

void SetResolver::missing(const Entry& entry, std::string_view field, Id value, std::string message,
                          std::string hint) {
  constexpr IdSpace spaces[] = {IdSpace::node_set, IdSpace::part_set, IdSpace::shell_set, IdSpace::solid_set,
                                IdSpace::segment_set};
  if (!unused_) {
    unused_.emplace();
    for (const UnusedId& one : find_unused_ids(deck_).named) unused_->emplace(one.space, one.id);
  }
  const auto& [kind, id] = path_.back();
  if (!unused_->contains({spaces[static_cast<std::size_t>(kind)], id}))
    return error(entry, field, value, std::move(message), std::move(hint));
  if (left_out_.emplace(kind, id).second)
    report_(Severity::warning, entry, field, {row_, value}, message + ", and nothing names the set",
            "the set is left out");
}

SetResolver::Found SetResolver::listed(SetKind kind, const SetCard& card, SetForm form) {
  Members out;
  out.reserve(card.ids.size());
  bool whole = true;
  for (const Id id : card.ids) {
    const Index found = find(kind, id);
    if (found >= 0) {
      out.push_back(found);
      continue;
    }
    if (kind == SetKind::part) {  // of a model of which only some parts are here
      report_(Severity::warning, card, member_field(kind, form), {row_, id},
              fmt::format("part {} does not exist", id), "leave it out, or define it with *PART");
      continue;
    }
    whole = false;
    if (kind == SetKind::node)
      missing(card, member_field(kind, form), id, fmt::format("node {} has no coordinates", id),
              "define it with *NODE");
    else
      missing(card, member_field(kind, form), id, fmt::format("{} {} does not exist", set_word(kind), id),
              fmt::format("define it with {}", kind == SetKind::shell ? "*ELEMENT_SHELL" : "*ELEMENT_SOLID"));
  }
  if (!whole) return std::nullopt;
  return out;
}

SetResolver::Found SetResolver::segments_listed(const SetCard& card) {
  Members out;
  bool whole = true;
  for (std::size_t row = 0; row < card.ids.size(); ++row) {
    const Index found = segment_of_ids(
        card, "N1", {card.ids[row], cell(card.e2, row), cell(card.e3, row), cell(card.e4, row)});
    if (found >= 0)
      out.push_back(found);
    else
      whole = false;
  }
  if (!whole) return std::nullopt;
  return out;
}

SetResolver::Found SetResolver::ranges(SetKind kind, const SetCard& card, SetForm form) {
  const char* field = member_field(kind, form);
  Members out;
  if (form == SetForm::increment) {
    for (std::size_t row = 0; row < card.ids.size(); ++row) {
      row_ = row;
      if (!add_range(kind, card, form, card.ids[row], cell(card.e2, row), std::max<Id>(cell(card.e3, row), 1),
                     out))
        return std::nullopt;
    }
    return out;
  }
  for (std::size_t r = 0; r + 1 < card.ids.size(); r += 2) {
    const Id begin = card.ids[r], end = card.ids[r + 1];
    if ((begin == 0) == (end == 0)) continue;
    error(card, field, begin + end,
          begin == 0 ? fmt::format("the range to {} has no first id", end)
                     : fmt::format("the range from {} has no last id", begin));
    return std::nullopt;
  }
  for (const auto& [begin, end] : without_overlap(card.ids))
    if (!add_range(kind, card, form, begin, end, 1, out)) return std::nullopt;
  return out;
}

bool SetResolver::add_range(SetKind kind, const SetCard& card, SetForm form, Id begin, Id end, Id step,
                            Members& out) {
  const char* field = member_field(kind, form);
  if (end < begin) {
    error(card, field, begin, fmt::format("the range {} to {} runs backwards", begin, end));
    return false;
  }
  const std::size_t before = out.size();
  // whichever is shorter: the range of ids or the list of entities
  if ((end - begin) / step < static_cast<Id>(count(kind))) {
    for (Id id = begin; id <= end; id += step)
      if (const Index found = find(kind, id); found >= 0) out.push_back(found);
  } else {
    for (std::size_t i = 0; i < count(kind); ++i)
      if (const Id id = id_of(kind, i); id >= begin && id <= end && (id - begin) % step == 0)
        out.push_back(static_cast<Index>(i));
  }
  if (out.size() > before) {
    if (out.size() > 8 * count(kind) + 1000) sort_unique(out);  // ranges in steps may overlap many times
    return true;
  }
  const std::string what = fmt::format("there is no {} with an id from {} to {}{}", set_word(kind), begin,
                                       end, step == 1 ? "" : fmt::format(" in steps of {}", step));
  if (kind == SetKind::part) {  // as where they are listed
    report_(Severity::warning, card, field, {row_, begin}, what, "leave the range out");
    return true;
  }
  error(card, field, begin, what);
  return false;
}

SetResolver::Found SetResolver::combined(SetKind kind, const SetCard& card, SetForm form) {
  const char* field = member_field(kind, form);
  Members out;
  for (std::size_t i = 0; i < card.ids.size(); ++i) {
    const Members* next = other(card, field, kind, card.ids[i]);
    if (!next) return std::nullopt;
    if (i == 0 || form != SetForm::intersect) {
      out.insert(out.end(), next->begin(), next->end());
      if (out.size() > 8 * count(kind) + 1000) sort_unique(out);  // sets may share many members
      continue;
    }
    Members both;
    std::set_intersection(out.begin(), out.end(), next->begin(), next->end(), std::back_inserter(both));
    out = std::move(both);
  }
  return out;
}

IdSpace advanced_space(Id type) {
  constexpr IdSpace spaces[] = {IdSpace::none,     IdSpace::node_set,  IdSpace::shell_set,
                                IdSpace::beam_set, IdSpace::solid_set, IdSpace::segment_set};
  return type > 0 && type < static_cast<Id>(std::size(spaces)) ? spaces[type] : IdSpace::none;
}

SetResolver::Found SetResolver::advanced(const SetCard& card) {
  const std::vector<Id>* columns[][2] = {
      {&card.ids, &card.e2}, {&card.e3, &card.e4}, {&card.e5, &card.e6}, {&card.e7, &card.e8}};
  Members out;
  for (std::size_t row = 0; row < card.ids.size(); ++row) {
    row_ = row;
    for (const auto& [ids, types] : columns) {
      const Id id = cell(*ids, row);
      if (id == 0) continue;
      SetKind kind = SetKind::node;
      switch (advanced_space(cell(*types, row))) {
        case IdSpace::node_set:
          break;
        case IdSpace::shell_set:
          kind = SetKind::shell;
          break;
        case IdSpace::solid_set:
          kind = SetKind::solid;
          break;
        case IdSpace::segment_set:
          kind = SetKind::segment;
          break;
        default:  // the card allows 0 besides, for pairs that are left out
          error(card, "SID1", id, fmt::format("set {} has no kind beside it", id),
                "1 node, 2 shell, 4 solid, 5 segment set");
          return std::nullopt;
      }
      const Members* from = other(card, "SID1", kind, id);
      if (!from) return std::nullopt;
      const Members nodes = converted(kind, SetKind::node, *from);
      out.insert(out.end(), nodes.begin(), nodes.end());
    }
  }
  return out;
}

const SetResolver::Members* SetResolver::other(const SetCard& card, std::string_view field, SetKind kind,
                                               Id id) {
  auto& slots = slots_[static_cast<std::size_t>(kind)];
  const auto it = slots.find(id);
  if (it == slots.end()) {
    error(card, field, id, fmt::format("{} set {} does not exist", set_word(kind), id),
          fmt::format("define it with {}", usual_keyword[static_cast<std::size_t>(kind)]));
    return nullptr;
  }
  if (it->second.state == State::busy) {
    std::string chain;
    const auto first = std::find(path_.begin(), path_.end(), std::make_pair(kind, id));
    for (auto step = first; step != path_.end(); ++step)
      chain += fmt::format("{} set {} needs ", set_word(step->first), step->second);
    error(card, field, id,
          fmt::format("a set cannot be made of itself: {}{} set {}", chain, set_word(kind), id),
          "leave one of them out");
    return nullptr;
  }
  constexpr std::size_t deepest = 1000;
  if (it->second.state == State::open && path_.size() >= deepest) {
    error(card, field, id, fmt::format("sets are nested more than {} deep", deepest),
          "name the sets at the bottom themselves");
    return nullptr;
  }
  resolve(kind, id, it->second);
  if (left_out_.contains({kind, id}))  // by a number in the text of a row that a parameter represents
    error(card, field, id, fmt::format("{} set {} has members that are not there", set_word(kind), id),
          "the warning names them");
  const Members& found = target(kind)[id];
  return found.empty() ? nullptr : &found;  // an empty set was refused already
}

std::map<Id, SetResolver::Members>& SetResolver::target(SetKind kind) {
  std::map<Id, Members>* targets[] = {&model_.node_sets, &model_.part_sets, &model_.shell_sets,
                                      &model_.solid_sets, &model_.segment_sets};
  return *targets[static_cast<std::size_t>(kind)];
}

std::size_t SetResolver::count(SetKind kind) const {
  const std::size_t counts[] = {model_.nodes.size(), model_.parts.size(), model_.shells.size(),
                                model_.solids.size(), model_.segments.size()};
  return counts[static_cast<std::size_t>(kind)];
}

Id SetResolver::id_of(SetKind kind, std::size_t index) const {
  switch (kind) {
    case SetKind::node:
      return model_.nodes[index].id;
    case SetKind::part:
      return model_.parts[index].id;
    case SetKind::shell:
      return model_.shells[index].id;
    case SetKind::solid:
      return model_.solids[index].id;
    case SetKind::segment:
      break;
  }
  return 0;
}

Index SetResolver::find(SetKind kind, Id id) {
  switch (kind) {
    case SetKind::node:
      return node_of_id_.find(id);
    case SetKind::part: {
      const auto it = model_.part_of_id.find(id);
      return it == model_.part_of_id.end() ? -1 : it->second;
    }
    case SetKind::shell:
      if (!shell_of_id_) shell_of_id_ = index_of_ids(model_.shells);
      return shell_of_id_->find(id);
    case SetKind::solid:
      if (!solid_of_id_) solid_of_id_ = index_of_ids(model_.solids);
      return solid_of_id_->find(id);
    case SetKind::segment:
      break;
  }
  return -1;
}

Index SetResolver::segment_of_ids(const SetCard& card, std::string_view field, const std::array<Id, 4>& ids) {
  std::vector<Index> corners;
  for (const Id id : ids) {
    if (id == 0) continue;
    const Index n = node_of_id_.find(id);
    if (n < 0) {
      missing(card, field, id, fmt::format("node {} has no coordinates", id), "define it with *NODE");
      return -1;
    }
    if (std::find(corners.begin(), corners.end(), n) == corners.end()) corners.push_back(n);
  }
  if (corners.size() < 2) {
    error(card, field, 0,
          fmt::format("the segment of nodes {} has less than two corners", fmt::join(ids, " ")));
    return -1;
  }
  std::array<Index, 4> all{};
  for (std::size_t k = 0; k < all.size(); ++k) all[k] = corners[std::min(k, corners.size() - 1)];
  return segment(all);
}

/// A segment is one and the same wherever its corners begin, but not with the other side up.
Index SetResolver::segment(const std::array<Index, 4>& corners) {
  const std::size_t n = corners[3] != corners[2] ? 4 : corners[2] != corners[1] ? 3 : 2;
  std::array<Index, 4> key = corners;
  std::rotate(key.begin(), std::min_element(key.begin(), key.begin() + n), key.begin() + n);
  for (std::size_t k = n; k < key.size(); ++k) key[k] = key[n - 1];
  const auto [it, is_new] = segment_of_corners_.try_emplace(key, static_cast<Index>(model_.segments.size()));
  if (is_new) model_.segments.push_back({corners});
  return it->second;
}

SetResolver::Members SetResolver::converted(SetKind from, SetKind to, const Members& members) {
  if (from == to) return members;
  Members out;
  for (const Index m : members) {
    const auto i = static_cast<std::size_t>(m);
    if (to == SetKind::segment) {
      out.push_back(segment(model_.shells[i].node));
    } else if (from == SetKind::shell) {
      out.insert(out.end(), model_.shells[i].node.begin(), model_.shells[i].node.end());
    } else if (from == SetKind::segment) {
      out.insert(out.end(), model_.segments[i].node.begin(), model_.segments[i].node.end());
    } else {
      std::copy_if(model_.solids[i].node.begin(), model_.solids[i].node.end(), std::back_inserter(out),
                   [](Index n) { return n >= 0; });
    }
  }
  sort_unique(out);
  return out;
}

}  // namespace courant
