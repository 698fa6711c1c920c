#include "model/sets/unused_ids.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <cstdlib>
#include <functional>
#include <system_error>
#include <unordered_set>
#include <utility>

#include "keyword/registry.hpp"
#include "keyword/source.hpp"
#include "model/cards.hpp"

namespace courant {

namespace {

using Range = std::pair<Id, Id>;

/// Ids and ranges of ids of one space that something refers to.
class UsedIds {
 public:
  /// Ids from `lowest` to `highest`, where they are dense, are noted in a bit each.
  void expect(Id lowest, Id highest, std::size_t count) {
    lowest_ = lowest;
    const auto range = static_cast<std::uint64_t>(highest) - static_cast<std::uint64_t>(lowest);
    constexpr std::uint64_t room_per_id = 64;
    if (range < room_per_id * count) dense_.assign(static_cast<std::size_t>(range) + 1, false);
  }
  void add(Id id) {
    const std::uint64_t at = static_cast<std::uint64_t>(id) - static_cast<std::uint64_t>(lowest_);
    if (at < dense_.size())
      dense_[at] = true;
    else if (dense_.empty())
      sparse_.insert(id);
  }
  void add_range(Id first, Id last) {
    if (first <= last) ranges_.emplace_back(first, last);
  }
  /// Call once before `has`.
  void finish() {
    std::sort(ranges_.begin(), ranges_.end());
    std::vector<Range> merged;
    for (const Range& r : ranges_) {
      if (!merged.empty() && r.first <= merged.back().second)
        merged.back().second = std::max(merged.back().second, r.second);
      else
        merged.push_back(r);
    }
    ranges_ = std::move(merged);
  }
  bool has(Id id) const {
    const std::uint64_t at = static_cast<std::uint64_t>(id) - static_cast<std::uint64_t>(lowest_);
    if (at < dense_.size() ? dense_[at] : sparse_.count(id) > 0) return true;
    const auto behind = std::upper_bound(ranges_.begin(), ranges_.end(), id,
                                         [](Id value, const Range& r) { return value < r.first; });
    return behind != ranges_.begin() && std::prev(behind)->second >= id;
  }

 private:
  Id lowest_ = 0;
  std::vector<bool> dense_;
  std::unordered_set<Id> sparse_;
  std::vector<Range> ranges_;
};

using Spaces = std::array<bool, static_cast<std::size_t>(IdSpace::count)>;

/// Spaces that some table refers to: in others nothing could be used.
Spaces spaces_in_use() {
  Spaces out{};
  for (const auto& spec : keyword_registry())
    for (const CardSpec& card : spec->cards)
      for (const FieldSpec& field : card.fields) out[static_cast<std::size_t>(field.rules.refers)] = true;
  return out;
}

/// Spaces whose ids exist to be referred to. Contacts, boundary conditions and elements act by themselves.
bool wants_use(IdSpace space) {
  switch (space) {
    case IdSpace::part:
    case IdSpace::material:
    case IdSpace::eos:
    case IdSpace::section:
    case IdSpace::hourglass:
    case IdSpace::node_set:
    case IdSpace::part_set:
    case IdSpace::solid_set:
    case IdSpace::shell_set:
    case IdSpace::beam_set:
    case IdSpace::segment_set:
    case IdSpace::curve:
    case IdSpace::box:
    case IdSpace::coordinate_system:
    case IdSpace::vector:
    case IdSpace::transformation:
      return true;
    default:
      return false;
  }
}

class UseFinder {
 public:
  explicit UseFinder(const Deck& deck) : deck_(deck) {}

  UnusedIds find() {
    const auto& nodes = deck_.all<NodeCard>();
    const auto ends = std::minmax_element(nodes.begin(), nodes.end(),
                                          [](const NodeCard& a, const NodeCard& b) { return a.nid < b.nid; });
    if (!nodes.empty()) {
      used(IdSpace::node).expect(ends.first->nid, ends.second->nid, nodes.size());
      last_node_ = ends.second->nid;
    }
    const auto& registry = keyword_registry();
    for (std::size_t k = 0; k < registry.size(); ++k)
      if (registry[k]->names[0] != "NODE") visit(*registry[k], static_cast<std::int32_t>(k));
    // a particle has the id of its node; NEND: up to that node
    for (const ElementSphCard& card : deck_.all<ElementSphCard>()) {
      used(IdSpace::node).add(card.nid);
      if (card.nend > card.nid) used(IdSpace::node).add_range(card.nid, card.nend);
    }
    for (const DeckFile& file : deck_.files)
      for (const Id id : file.conversion.transformations) used(IdSpace::transformation).add(id);
    return unused();
  }

 private:
  UsedIds& used(IdSpace space) { return used_[static_cast<std::size_t>(space)]; }

  void visit(const KeywordSpec& spec, std::int32_t keyword) {
    const auto named = [&](const char* option) { return spec.names[0].find(option) != std::string::npos; };
    const bool generates = named("_GENERATE"), by_words = named("_GENERAL") || named("_ADVANCED");
    const bool acts = spec.names[0].rfind("CONSTRAINED_", 0) == 0;  // by itself, though numbered as a part
    std::vector<std::vector<Id>> columns;                           // of a set that is generated
    std::size_t column = 0;
    IdSpace column_space = IdSpace::none;
    const Entry* entry = nullptr;
    const std::function<void(const IdUse&)> see = [&](const IdUse& use) {
      if (use.defines) {
        if (!acts && wants_use(use.space) && in_use_[static_cast<std::size_t>(use.space)] && use.id > 0)
          defined_.push_back({use.space, use.id, *entry});
      } else if (generates && use.card > 0) {
        if (columns.empty() || use.field != column) columns.emplace_back();
        columns.back().push_back(use.id);
        column = use.field;
        column_space = use.space;
      } else if (use.id != 0) {
        used(use.space).add(std::abs(use.id));  // a negative id is a flagged one
      }
    };
    spec.for_each(deck_, keyword, [&](const Entry& one) {
      entry = &one;
      columns.clear();
      spec.for_each_id(one, see);
      if (!columns.empty()) add_ranges(used(column_space), columns);
      if (by_words) add_numbers_of(one);
    });
  }

  /// *SET_..._GENERATE: first and last ids in turn; with _INCREMENT in columns of their own.
  static void add_ranges(UsedIds& ids, const std::vector<std::vector<Id>>& columns) {
    const std::vector<Id>& first = columns[0];
    if (columns.size() > 1)
      for (std::size_t k = 0; k < std::min(first.size(), columns[1].size()); ++k)
        ids.add_range(first[k], columns[1][k]);
    else
      for (std::size_t k = 0; k + 1 < first.size(); k += 2) ids.add_range(first[k], first[k + 1]);
  }

  /// *SET_..._GENERAL, _ADD_ADVANCED: what a row's ids number is given by a word or a number in it, not by
  /// the table. They are taken for uses of whatever has such an id: none is called unused wrongly.
  void add_numbers_of(const Entry& entry) {
    const DeckFile& file = deck_.files[static_cast<std::size_t>(entry.file)];
    if (!file.source) return;
    for (DataLines data(*file.source, static_cast<std::size_t>(entry.line - 1)); !data.done(); data.step()) {
      const std::string_view line = data.line();
      if (upper_case(line).find("ALL") != std::string::npos) used(IdSpace::node).add_range(1, last_node_);
      for (std::size_t k = 0; k < line.size();) {
        Id id = 0;
        const auto end = std::from_chars(line.data() + k, line.data() + line.size(), id);
        if (end.ec == std::errc() && id != 0) add_everywhere(std::abs(id), file.conversion.offsets);
        k = std::max(k + 1, static_cast<std::size_t>(end.ptr - line.data()));
      }
    }
  }

  void add_everywhere(Id id, const IdOffsets& offsets) {
    for (std::size_t k = 0; k < used_.size(); ++k)
      used_[k].add(offsets.any() ? offsets.shifted(static_cast<IdSpace>(k), id) : id);
  }

  UnusedIds unused() {
    UnusedIds out;
    for (UsedIds& space : used_) space.finish();
    for (UnusedId& one : defined_)
      if (!used(one.space).has(one.id)) out.named.push_back(one);
    std::stable_sort(out.named.begin(), out.named.end(),
                     [](const UnusedId& a, const UnusedId& b) { return a.space < b.space; });
    if (!in_use_[static_cast<std::size_t>(IdSpace::node)] || elements_not_read()) return out;
    for (const NodeCard& card : deck_.all<NodeCard>())
      if (!used(IdSpace::node).has(card.nid)) out.nodes.push_back(card.nid);
    return out;
  }

  /// Whether elements without a table may use any node.
  bool elements_not_read() const {
    return std::any_of(deck_.keywords.begin(), deck_.keywords.end(), [](const auto& keyword) {
      return keyword.first.rfind("ELEMENT_", 0) == 0 && keyword.second.lines > 0;
    });
  }

  const Deck& deck_;
  const Spaces in_use_ = spaces_in_use();
  std::array<UsedIds, static_cast<std::size_t>(IdSpace::count)> used_;
  std::vector<UnusedId> defined_;
  Id last_node_ = 0;
};

}  // namespace

UnusedIds find_unused_ids(const Deck& deck) {
  return UseFinder(deck).find();
}

}  // namespace courant
