#pragma once
// Rigid parts that are one body: *CONSTRAINED_RIGID_BODIES, LRB of *DEFORMABLE_TO_RIGID.
#include <map>
#include <set>
#include <vector>

#include "keyword/deck.hpp"
#include "model/model.hpp"

namespace courant {

/// A part that is merged into another one.
struct Merge {
  Index lead = 0;       ///< index into Model::parts; it may be merged into another one, too
  bool counts = false;  ///< IFLAG 1: its mass counts besides that of *PART_INERTIA of the lead
  Entry card{};
};

/// Merges by the part that is merged (index into Model::parts).
class BodyMerges {
 public:
  BodyMerges() = default;
  explicit BodyMerges(std::map<Index, Merge> merges) : merges_(std::move(merges)) {}
  bool merged(Index part) const { return merges_.contains(part); }
  const Merge& of(Index part) const { return merges_.at(part); }
  /// The part that gives the body its name: the end of the chain of leads.
  Index lead(Index part) const;
  /// That part first, then all that are merged into it, ascending; `part` alone where there are none.
  std::vector<Index> group(Index lead) const;
  /// Whether mass and inertia of a part count. `given`: parts with *PART_INERTIA, which represent what is
  /// merged into them unless IFLAG says otherwise.
  bool counts(Index part, const std::set<Index>& given) const;

 private:
  std::map<Index, Merge> merges_;
};

/// Refuses by name: parts that are not there or not rigid, a part merged into itself, into two parts, or in a
/// ring.
BodyMerges body_merges(const Deck& deck, const Model& model, Diagnostics& diagnostics);

}  // namespace courant
