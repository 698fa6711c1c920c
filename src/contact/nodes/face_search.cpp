#include "contact/nodes/face_search.hpp"

#include <algorithm>
#include <cmath>

#include "parallel/counting_sort.hpp"
#include "parallel/parallel.hpp"

namespace courant {

FaceSearch::Cell FaceSearch::place_of(const Vec& y) const {
  Cell out;
  for (int k = 0; k < 3; ++k)
    out[static_cast<std::size_t>(k)] = static_cast<std::int64_t>(std::floor((y[k] - low_[k]) / size_));
  return out;
}

// Cells share buckets, so that no memory goes to empty space; boxes tell the faces of a bucket apart.
Index FaceSearch::bucket(std::int64_t i, std::int64_t j, std::int64_t k) const {
  std::uint64_t h = static_cast<std::uint64_t>(i) * 0x9E3779B97F4A7C15U;
  h = (h ^ (h >> 29)) + static_cast<std::uint64_t>(j) * 0xBF58476D1CE4E5B9U;
  h = (h ^ (h >> 31)) + static_cast<std::uint64_t>(k) * 0x94D049BB133111EBU;
  return static_cast<Index>((h ^ (h >> 30)) % static_cast<std::uint64_t>(buckets_));
}

Index FaceSearch::cell_of(const Vec& y) const {
  const Cell c = place_of(y);
  return bucket(c[0], c[1], c[2]);
}

// Cells are as large as a usual box; where a few faces are so large that they would fill very many, larger.
// Returns how often faces stand in cells.
std::size_t FaceSearch::choose_size(Real usual) {
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

void FaceSearch::build(const std::vector<ContactFace>& faces, const Field<Real>& x, Real reach, Real least) {
  const auto n = static_cast<Index>(faces.size());
  boxes_.resize(faces.size());
  for_each(n, [&](Index f) {
    const ContactFace& face = faces[static_cast<std::size_t>(f)];
    const FaceCorners c = corners_of(face, x);
    Box& box = boxes_[static_cast<std::size_t>(f)];
    const Real around = reach + face.r + std::max(face.depth - least, Real(0));
    box.low = c[0].cwiseMin(c[1]).cwiseMin(c[2]).cwiseMin(c[3]).array() - around;
    box.high = c[0].cwiseMax(c[1]).cwiseMax(c[2]).cwiseMax(c[3]).array() + around;
  });
  if (n == 0) return;
  Real usual = 0;
  low_ = boxes_[0].low;
  for (const Box& box : boxes_) {
    usual += (box.high - box.low).maxCoeff() / static_cast<Real>(n);
    low_ = low_.cwiseMin(box.low);
  }
  const std::size_t expected = choose_size(usual);
  buckets_ = static_cast<Index>(2 * faces.size() + 1);
  std::vector<Index> key, of;
  key.reserve(expected), of.reserve(expected);
  for (Index f = 0; f < n; ++f) {
    const Cell a = place_of(boxes_[static_cast<std::size_t>(f)].low),
               b = place_of(boxes_[static_cast<std::size_t>(f)].high);
    for (auto i = a[0]; i <= b[0]; ++i)
      for (auto j = a[1]; j <= b[1]; ++j)
        for (auto k = a[2]; k <= b[2]; ++k) key.push_back(bucket(i, j, k)), of.push_back(f);
  }
  std::vector<Index> order;
  counting_sort(key, buckets_, start_, order);
  face_.resize(order.size());
  for (std::size_t k = 0; k < order.size(); ++k) face_[k] = of[static_cast<std::size_t>(order[k])];
}

}  // namespace courant
