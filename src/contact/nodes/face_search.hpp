#pragma once
// Faces near a place: a grid of cells in which each face stands wherever its box reaches.
#include <vector>

#include "contact/nodes/face.hpp"

namespace courant {

class FaceSearch {
 public:
  /// `reach`: of the boxes around the faces; faces with a depth beyond `least` reach further by the
  /// difference [L]. On all threads; the order within a cell is that of the faces.
  void build(const std::vector<ContactFace>& faces, const Field<Real>& x, Real reach, Real least);
  /// Calls `found(face)` for each face whose box, widened by the reach, holds y; ascending.
  template <class Found>
  void near(const Vec& y, const Found& found) const {
    if (start_.empty()) return;
    const Index cell = cell_of(y);
    Index last = -1;
    for (Index k = start_[static_cast<std::size_t>(cell)]; k < start_[static_cast<std::size_t>(cell) + 1];
         ++k) {
      const Index f = face_[static_cast<std::size_t>(k)];
      const Box& box = boxes_[static_cast<std::size_t>(f)];
      if (f == last || (y.array() < box.low.array()).any() || (y.array() > box.high.array()).any()) continue;
      last = f;
      found(f);
    }
  }

 private:
  struct Box {
    Vec low = Vec::Zero(), high = Vec::Zero();
  };
  using Cell = std::array<std::int64_t, 3>;
  Cell place_of(const Vec& y) const;
  Index bucket(std::int64_t i, std::int64_t j, std::int64_t k) const;
  Index cell_of(const Vec& y) const;
  std::size_t choose_size(Real usual);

  Vec low_ = Vec::Zero();
  Real size_ = 1;
  Index buckets_ = 1;
  std::vector<Box> boxes_;
  std::vector<Index> start_, face_;
};

}  // namespace courant
