#include "search/box_grid.hpp"

#include <algorithm>
#include <cmath>

#include "parallel/counting_sort.hpp"

namespace courant {

BoxGrid::Cell BoxGrid::place_of(const Vec& y) const {
  Cell out;
  for (int k = 0; k < 3; ++k)
    out[static_cast<std::size_t>(k)] = static_cast<std::int64_t>(std::floor((y[k] - low_[k]) / size_));
  return out;
}

// Cells share buckets, so that no memory goes to empty space; boxes tell those of a bucket apart.
Index BoxGrid::bucket(std::int64_t i, std::int64_t j, std::int64_t k) const {
  std::uint64_t h = static_cast<std::uint64_t>(i) * 0x9E3779B97F4A7C15U;
  h = (h ^ (h >> 29)) + static_cast<std::uint64_t>(j) * 0xBF58476D1CE4E5B9U;
  h = (h ^ (h >> 31)) + static_cast<std::uint64_t>(k) * 0x94D049BB133111EBU;
  return static_cast<Index>((h ^ (h >> 30)) % static_cast<std::uint64_t>(buckets_));
}

template <class Body>
void BoxGrid::for_cells(const Box& box, const Body& body) const {
  const Cell a = place_of(box.low), b = place_of(box.high);
  for (auto i = a[0]; i <= b[0]; ++i)
    for (auto j = a[1]; j <= b[1]; ++j)
      for (auto k = a[2]; k <= b[2]; ++k) body(bucket(i, j, k));
}

// Cells are as large as a usual box; where a few boxes are so large that they would fill very many, larger.
// Returns how often boxes are in cells.
std::size_t BoxGrid::choose_size(Real usual) {
  const std::size_t enough = 64 * boxes_.size() + 100000;
  for (size_ = usual;; size_ *= 2) {
    Real count = 0;
    for (const Box& box : boxes_) {
      Real cells = 1;
      for (int k = 0; k < 3; ++k) cells *= std::floor((box.high[k] - box.low[k]) / size_) + 2;
      count += cells;
    }
    if (count <= static_cast<Real>(enough)) return static_cast<std::size_t>(count);
  }
}

void BoxGrid::build(std::vector<Box> boxes) {
  boxes_ = std::move(boxes);
  const auto n = static_cast<Index>(boxes_.size());
  if (n == 0) return;
  Real usual = 0;
  low_ = boxes_[0].low;
  for (const Box& box : boxes_) {
    usual += (box.high - box.low).maxCoeff() / static_cast<Real>(n);
    low_ = low_.cwiseMin(box.low);
  }
  const std::size_t expected = choose_size(usual);
  buckets_ = 2 * n + 1;
  std::vector<Index> key, of, order;
  key.reserve(expected), of.reserve(expected);
  for (Index b = 0; b < n; ++b)
    for_cells(boxes_[static_cast<std::size_t>(b)], [&](Index cell) { key.push_back(cell), of.push_back(b); });
  counting_sort(key, buckets_, start_, order);
  box_.resize(order.size());
  for (std::size_t k = 0; k < order.size(); ++k) box_[k] = of[static_cast<std::size_t>(order[k])];
}

void BoxGrid::near(Index box, std::vector<Index>& out) const {
  const Box& one = boxes_[static_cast<std::size_t>(box)];
  const std::size_t from = out.size();
  for_cells(one, [&](Index cell) {
    for (Index k = start_[static_cast<std::size_t>(cell)]; k < start_[static_cast<std::size_t>(cell) + 1];
         ++k) {
      const Index other = box_[static_cast<std::size_t>(k)];
      if (other > box && one.meets(boxes_[static_cast<std::size_t>(other)])) out.push_back(other);
    }
  });
  const auto begin = out.begin() + static_cast<std::ptrdiff_t>(from);
  std::sort(begin, out.end());
  out.erase(std::unique(begin, out.end()), out.end());
}

}  // namespace courant
