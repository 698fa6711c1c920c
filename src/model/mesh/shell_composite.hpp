#pragma once
#include <vector>

#include "model/cards.hpp"
#include "model/model.hpp"

namespace courant {

/// *ELEMENT_SHELL_COMPOSITE and its like: shells whose layers stand with each of them.
struct ElementShellCompositeCard : ElementShellCard {
  Real offset = 0;
  /// Of the layers 1, 3, 5, ...; with _LONG of all. The second: of the layers 2, 4, 6, ...
  std::vector<Id> mid1{}, mid2{}, plyid{};
  std::vector<Real> thick1{}, thick2{}, b1{}, b2{};
  bool is_long() const { return name % 2 == 1; }
  bool has_offset() const { return name >= 2; }
  /// From the lower face to the upper.
  std::vector<ModelPly> plies() const;
};

}  // namespace courant
