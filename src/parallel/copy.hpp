#pragma once
#include <algorithm>

#include "parallel/array.hpp"
#include "parallel/parallel.hpp"

namespace courant {

/// Each thread copies, and touches first, what it works on later.
template <class T>
void copy(const T* from, Index n, Array<T>& to) {
  to.resize(n);
  for_each_block(n, [&](Index begin, Index end) { std::copy(from + begin, from + end, to.data() + begin); });
}

}  // namespace courant
