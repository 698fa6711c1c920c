#pragma once
// Hexahedra split into what becomes of them where nodes stand several times.
#include <array>
#include <vector>

#include "base/real.hpp"

namespace courant::test {

enum class CellShape { hexahedron, wedges, wedges_from_quads, pyramids, tetrahedra };

/// Corners, in LS-DYNA's order, of what a cell is split into: two wedges (in one of the two ways to write
/// them), six pyramids about a node in its middle, or six tetrahedra about its diagonal.
inline std::vector<std::array<Index, 8>> split(CellShape shape, const std::array<Index, 8>& n,
                                               Index middle = -1) {
  switch (shape) {
    case CellShape::wedges:
      return {{n[0], n[1], n[2], n[2], n[4], n[5], n[6], n[6]},
              {n[0], n[2], n[3], n[3], n[4], n[6], n[7], n[7]}};
    case CellShape::wedges_from_quads:
      return {{n[1], n[0], n[4], n[5], n[2], n[2], n[6], n[6]},
              {n[2], n[0], n[4], n[6], n[3], n[3], n[7], n[7]}};
    case CellShape::pyramids: {
      constexpr int from_inside[6][4] = {{0, 1, 2, 3}, {4, 7, 6, 5}, {0, 4, 5, 1},
                                         {1, 5, 6, 2}, {2, 6, 7, 3}, {3, 7, 4, 0}};
      std::vector<std::array<Index, 8>> out;
      for (const auto& f : from_inside)
        out.push_back({n[f[0]], n[f[1]], n[f[2]], n[f[3]], middle, middle, middle, middle});
      return out;
    }
    case CellShape::tetrahedra: {
      std::vector<std::array<Index, 8>> out;
      for (const auto& [a, b] : {std::array{1, 2}, {5, 1}, {2, 3}, {3, 7}, {4, 5}, {7, 4}})
        out.push_back({n[0], n[a], n[b], n[b], n[6], n[6], n[6], n[6]});
      return out;
    }
    default:
      return {n};
  }
}

}  // namespace courant::test
