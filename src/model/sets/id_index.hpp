#pragma once
#include <cstdint>
#include <unordered_map>
#include <vector>

#include "base/real.hpp"

namespace courant {

/// Index of the entity with an id. Ids without wide gaps, the usual case, are looked up in a plain table;
/// others in a hash table, which takes ten times the memory.
class IdIndex {
 public:
  IdIndex() = default;
  /// For `count` ids from `lowest` to `highest`; others are allowed, but never found.
  IdIndex(Id lowest, Id highest, std::size_t count) : lowest_(lowest) {
    const std::uint64_t range = place(highest);
    if (range < room_per_id * count)
      table_.assign(static_cast<std::size_t>(range) + 1, nowhere);
    else
      sparse_.reserve(count);
    is_table_ = !table_.empty();
  }

  /// Notes `index` for an id that is new and returns -1; else returns the index noted before.
  Index insert(Id id, Index index) {
    if (!is_table_) {
      const auto [it, is_new] = sparse_.try_emplace(id, index);
      return is_new ? nowhere : it->second;
    }
    const std::uint64_t at = place(id);
    if (at >= table_.size()) return nowhere;
    const Index before = table_[at];
    if (before == nowhere) table_[at] = index;
    return before;
  }
  /// -1 if there is no such id.
  Index find(Id id) const {
    if (!is_table_) {
      const auto it = sparse_.find(id);
      return it == sparse_.end() ? nowhere : it->second;
    }
    const std::uint64_t at = place(id);
    return at < table_.size() ? table_[at] : nowhere;
  }

 private:
  static constexpr Index nowhere = -1;
  static constexpr std::uint64_t room_per_id = 8;
  std::uint64_t place(Id id) const {  // ids below the lowest wrap round to the far end
    return static_cast<std::uint64_t>(id) - static_cast<std::uint64_t>(lowest_);
  }
  Id lowest_ = 0;
  bool is_table_ = false;
  std::vector<Index> table_;
  std::unordered_map<Id, Index> sparse_;
};

}  // namespace courant
