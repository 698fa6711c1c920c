#include "search/cell_grid.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace courant {

void CellGrid::cover(const Vec& low, const Vec& high, Real row, Real bin, Real most) {
  origin_ = low;
  size_ = Vec(bin, row, row);
  const auto count = [&](int d) { return std::floor(std::min((high[d] - low[d]) / size_[d], 1e9)) + 1; };
  // A few far-flung particles must not make a grid larger than the particles themselves.
  while (count(0) * count(1) * count(2) > most) size_ *= 1.26;
  for (int d = 0; d < 3; ++d) {
    cells_[d] = static_cast<Index>(count(d));
    inverse_[d] = 1 / size_[d];
  }
}

CellFrame CellGrid::frame() const {
  CellFrame f;
  for (int d = 0; d < 3; ++d)
    f.origin[d] = origin_[d], f.inverse_size[d] = inverse_[d], f.cells[d] = cells_[d];
  return f;
}

void CellGrid::keep(Archive& archive) {
  archive("origin", origin_);
  archive("size", size_);
  archive("inverse", inverse_);
  archive.rows("cells", std::vector<Index*>{cells_.data()}, cells_.size());
  if (!archive.loading()) return;
  double cells = 1;
  for (const Index n : cells_) cells *= static_cast<double>(n);
  const bool negative = std::any_of(cells_.begin(), cells_.end(), [](Index n) { return n < 0; });
  if (negative || cells > std::numeric_limits<Index>::max() / 2)
    archive.stop("cells", "holds more cells than can be counted");
}

}  // namespace courant
