#pragma once
#include <vector>

#include "model/cards.hpp"
#include "model/mesh/ply_rows.hpp"

namespace courant {

/// *PART_COMPOSITE: shells whose layers are defined with their part; it needs no section.
struct PartCompositeCard : PartCard, PlyRows {
  int elform = 0, thshel = 0;
  Real shrf = 1, nloc = 0, marea = 0;
  std::vector<Id> tmid1{}, tmid2{}, plyid{};
  std::vector<Real> shrfac{};
  bool is_long() const { return name == 1; }
  std::vector<ModelPly> plies() const { return PlyRows::plies(is_long()); }
};

}  // namespace courant
