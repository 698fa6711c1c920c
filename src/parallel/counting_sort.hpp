#pragma once
#include <span>
#include <vector>

#include "base/real.hpp"

namespace courant {

/// Sorts 0, 1, 2, ... by small numbers, equal ones in their order: afterwards those i with key[i] = k are
/// order[start[k]] to order[start[k + 1] - 1]. Shapes: key and order (n), start (keys + 1). Every key is in
/// [0, keys).
void counting_sort(std::span<const Index> key, Index keys, std::vector<Index>& start,
                   std::vector<Index>& order);

}  // namespace courant
