#pragma once
#include <vector>

#include "model/model.hpp"

namespace courant {

/// Layers as cards have them: of the layers 1, 3, 5, ..., where one is on a line of all; the second: of
/// 2, 4, 6, ...
struct PlyRows {
  std::vector<Id> mid1{}, mid2{};
  std::vector<Real> thick1{}, thick2{}, b1{}, b2{};
  /// From the lower face to the upper. `one_on_a_line`: _LONG.
  std::vector<ModelPly> plies(bool one_on_a_line) const {
    std::vector<ModelPly> out;
    for (std::size_t row = 0; row < mid1.size(); ++row) {
      out.push_back({mid1[row], thick1[row], b1[row]});
      const bool second = !one_on_a_line && (mid2[row] != 0 || thick2[row] != 0);
      if (second) out.push_back({mid2[row], thick2[row], b2[row]});
    }
    return out;
  }
};

}  // namespace courant
