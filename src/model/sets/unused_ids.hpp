#pragma once
// What a deck defines and never refers to: often a sign that a number was mistyped.
#include <vector>

#include "keyword/deck.hpp"

namespace courant {

struct UnusedId {
  IdSpace space = IdSpace::none;
  Id id = 0;
  Entry entry;  ///< which defines it
};

struct UnusedIds {
  std::vector<UnusedId> named;  ///< parts, sections, materials, sets, curves, ...: everything but nodes
  std::vector<Id> nodes;        ///< no element, set or condition names them
  bool any() const { return !named.empty() || !nodes.empty(); }
};

/// By the tables: FieldRules::refers states what a field's ids number. Particles use their nodes. Call before
/// the cards of the mesh are released.
UnusedIds find_unused_ids(const Deck& deck);

}  // namespace courant
