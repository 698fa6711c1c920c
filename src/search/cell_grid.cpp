#include "search/cell_grid.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace courant {

void CellGrid::set_size(const Vec& low, const Vec& high, Real row, Real bin, Real most) {
  Vec size(bin, row, row);
  constexpr Real more = 3;  // where borders of cells are not at low
  const auto count = [&](int d) { return std::floor(std::min((high[d] - low[d]) / size[d], 1e9)) + more; };
  // A few far-flung particles must not make a grid larger than the particles themselves.
  while (count(0) * count(1) * count(2) > most) size *= 1.26;
  inverse_ = size.cwiseInverse();
}

void CellGrid::cover(const Vec& low, const Vec& high) {
  const auto cell = [this](const Vec& x, int d) { return std::floor((x[d] - origin_[d]) * inverse_[d]); };
  for (int d = 0; d < 3; ++d) {
    first_[d] = 2 * std::floor(0.5 * cell(low, d));
    cells_[d] = static_cast<Index>(std::min(cell(high, d) - first_[d], 1e9)) + 1;
  }
}

CellFrame CellGrid::frame() const {
  CellFrame f;
  for (int d = 0; d < 3; ++d)
    f.origin[d] = origin_[d], f.inverse_size[d] = inverse_[d], f.first[d] = first_[d], f.cells[d] = cells_[d];
  return f;
}

void CellGrid::keep(Archive& archive) {
  archive("origin", origin_);
  archive("first", first_);
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
