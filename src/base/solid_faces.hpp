#pragma once
// Faces of solids, by their nodes.
#include <algorithm>
#include <array>

#include "base/real.hpp"

namespace courant {

/// Corners of the faces of a hexahedron, counter-clockwise seen from outside.
inline constexpr std::array<std::array<int, 4>, 6> hexahedron_faces{
    {{0, 3, 2, 1}, {4, 5, 6, 7}, {0, 1, 5, 4}, {1, 2, 6, 5}, {2, 3, 7, 6}, {3, 0, 4, 7}}};

/// The nodes of a face of a solid, each once; of a triangle the third again. Less than three are no face:
/// false.
template <class Nodes>
bool nodes_of_face(const Nodes& solid, const std::array<int, 4>& face, std::array<Index, 4>& out) {
  std::size_t count = 0;
  for (const int c : face) {
    const Index n = solid[static_cast<std::size_t>(c)];
    if (std::find(out.begin(), out.begin() + count, n) == out.begin() + count) out[count++] = n;
  }
  if (count == 3) out[3] = out[2];
  return count >= 3;
}

/// One and the same for a face however its corners are listed; the last one again where some repeat.
inline std::array<Index, 4> sorted_corners(std::array<Index, 4> corner) {
  std::sort(corner.begin(), corner.end());
  const auto end = std::unique(corner.begin(), corner.end());
  std::fill(end, corner.end(), *(end - 1));
  return corner;
}

}  // namespace courant
