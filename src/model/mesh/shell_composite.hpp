#pragma once
#include <vector>

#include "model/cards.hpp"
#include "model/mesh/ply_rows.hpp"

namespace courant {

/// *ELEMENT_SHELL_COMPOSITE and similar keywords: shells whose layers are defined with each of them.
struct ElementShellCompositeCard : ElementShellCard, PlyRows {
  std::vector<Id> plyid{};
  bool is_long() const { return name % 2 == 1; }
  bool has_offset() const { return name >= 2; }
  std::vector<ModelPly> plies() const { return PlyRows::plies(is_long()); }
};

}  // namespace courant
