#pragma once
#include <vector>

#include "model/cards.hpp"
#include "model/model.hpp"

namespace courant {

/// *PART_COMPOSITE: shells whose layers stand with their part; it needs no section.
struct PartCompositeCard : PartCard {
  int elform = 2, thshel = 0;
  Real shrf = 1, nloc = 0, marea = 0;
  /// Of the layers 1, 3, 5, ...; with _LONG of all. The second: of the layers 2, 4, 6, ...
  std::vector<Id> mid1{}, mid2{}, tmid1{}, tmid2{}, plyid{};
  std::vector<Real> thick1{}, thick2{}, b1{}, b2{}, shrfac{};
  bool is_long() const { return name == 1; }
  /// From the lower face to the upper.
  std::vector<ModelPly> plies() const;
};

}  // namespace courant
