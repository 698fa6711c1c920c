#include "model/unused_ids.hpp"

#include <algorithm>
#include <array>
#include <cstdlib>
#include <functional>
#include <unordered_set>
#include <utility>

#include "keyword/registry.hpp"
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
    if (!nodes.empty()) used(IdSpace::node).expect(ends.first->nid, ends.second->nid, nodes.size());
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
    // *SET_..._GENERATE: pairs of a first and a last id; with an increment behind them, three numbers
    const bool generates = spec.names[0].find("_GENERATE") != std::string::npos;
    const bool increment = spec.names[0].find("_INCREMENT") != std::string::npos;
    std::vector<Id> row;
    IdSpace row_space = IdSpace::none;
    const Entry* entry = nullptr;
    const std::function<void(const IdUse&)> see = [&](const IdUse& use) {
      if (use.defines) {
        if (wants_use(use.space) && in_use_[static_cast<std::size_t>(use.space)] && use.id > 0)
          defined_.push_back({use.space, use.id, *entry});
      } else if (generates && use.card > 0) {
        row.push_back(use.id);
        row_space = use.space;
        if (row.size() < (increment ? 3u : 2u)) return;
        used(row_space).add_range(row[0], row[1]);
        row.clear();
      } else if (use.id != 0) {
        used(use.space).add(std::abs(use.id));  // a negative id is a flagged one
      }
    };
    spec.for_each(deck_, keyword, [&](const Entry& one) {
      entry = &one;
      row.clear();
      spec.for_each_id(one, see);
    });
  }

  UnusedIds unused() {
    UnusedIds out;
    for (UsedIds& space : used_) space.finish();
    for (UnusedId& one : defined_)
      if (!used(one.space).has(one.id)) out.named.push_back(one);
    std::stable_sort(out.named.begin(), out.named.end(),
                     [](const UnusedId& a, const UnusedId& b) { return a.space < b.space; });
    if (!in_use_[static_cast<std::size_t>(IdSpace::node)]) return out;
    for (const NodeCard& card : deck_.all<NodeCard>())
      if (!used(IdSpace::node).has(card.nid)) out.nodes.push_back(card.nid);
    return out;
  }

  const Deck& deck_;
  const Spaces in_use_ = spaces_in_use();
  std::array<UsedIds, static_cast<std::size_t>(IdSpace::count)> used_;
  std::vector<UnusedId> defined_;
};

}  // namespace

UnusedIds find_unused_ids(const Deck& deck) {
  return UseFinder(deck).find();
}

}  // namespace courant
