#include "contact/edges/edge_search.hpp"

#include <algorithm>
#include <cmath>

#include "parallel/counting_sort.hpp"

namespace courant {

EdgeSearch::Cell EdgeSearch::place_of(const Vec& y) const {
  Cell out;
  for (int k = 0; k < 3; ++k)
    out[static_cast<std::size_t>(k)] = static_cast<std::int64_t>(std::floor(y[k] / size_));
  return out;
}

// Cells share buckets, so that no memory goes to empty space; boxes tell the edges of a bucket apart.
Index EdgeSearch::bucket(std::int64_t i, std::int64_t j, std::int64_t k) const {
  std::uint64_t h = static_cast<std::uint64_t>(i) * 0x9E3779B97F4A7C15U;
  h = (h ^ (h >> 29)) + static_cast<std::uint64_t>(j) * 0xBF58476D1CE4E5B9U;
  h = (h ^ (h >> 31)) + static_cast<std::uint64_t>(k) * 0x94D049BB133111EBU;
  return static_cast<Index>((h ^ (h >> 30)) % static_cast<std::uint64_t>(buckets_));
}

template <class Body>
void EdgeSearch::for_cells(const Box& box, const Body& body) const {
  const Cell a = place_of(box.low), b = place_of(box.high);
  for (auto i = a[0]; i <= b[0]; ++i)
    for (auto j = a[1]; j <= b[1]; ++j)
      for (auto k = a[2]; k <= b[2]; ++k) body(bucket(i, j, k));
}

// Cells are as large as a usual box; where a few edges are so long that they would fill very many, larger.
void EdgeSearch::build(const std::vector<ContactEdge>& edges, const Field<Real>& x, Real reach) {
  const auto n = static_cast<Index>(edges.size());
  boxes_.resize(edges.size());
  if (n == 0) return;
  Real usual = 0;
  for (std::size_t e = 0; e < edges.size(); ++e) {
    const EdgeEnds ends = ends_of(edges[e], x);
    const Real around = 0.5 * reach + edges[e].r;  // of two boxes: both
    boxes_[e].low = ends[0].cwiseMin(ends[1]).array() - around;
    boxes_[e].high = ends[0].cwiseMax(ends[1]).array() + around;
    usual += (boxes_[e].high - boxes_[e].low).maxCoeff() / static_cast<Real>(n);
  }
  const Real enough = 64 * static_cast<Real>(n) + 100000;
  for (size_ = usual;; size_ *= 2) {
    Real count = 0;
    for (const Box& box : boxes_) {
      Real cells = 1;
      for (int k = 0; k < 3; ++k) cells *= std::floor((box.high[k] - box.low[k]) / size_) + 2;
      count += cells;
    }
    if (count <= enough) break;
  }
  buckets_ = 2 * n + 1;
  std::vector<Index> key, of, order;
  for (Index e = 0; e < n; ++e)
    for_cells(boxes_[static_cast<std::size_t>(e)], [&](Index b) { key.push_back(b), of.push_back(e); });
  counting_sort(key, buckets_, start_, order);
  edge_.resize(order.size());
  for (std::size_t k = 0; k < order.size(); ++k) edge_[k] = of[static_cast<std::size_t>(order[k])];
}

void EdgeSearch::near(Index edge, std::vector<Index>& out) const {
  const Box& box = boxes_[static_cast<std::size_t>(edge)];
  const std::size_t from = out.size();
  for_cells(box, [&](Index b) {
    for (Index k = start_[static_cast<std::size_t>(b)]; k < start_[static_cast<std::size_t>(b) + 1]; ++k) {
      const Index other = edge_[static_cast<std::size_t>(k)];
      if (other > edge && box.meets(boxes_[static_cast<std::size_t>(other)])) out.push_back(other);
    }
  });
  const auto begin = out.begin() + static_cast<std::ptrdiff_t>(from);
  std::sort(begin, out.end());
  out.erase(std::unique(begin, out.end()), out.end());
}

}  // namespace courant
