#pragma once
// Boxes near a position, or near each other: a grid of cells in which each box stands wherever it reaches.
#include <array>
#include <cstdint>
#include <vector>

#include "state/world.hpp"

namespace courant {

class BoxGrid {
 public:
  struct Box {
    Vec low = Vec::Zero(), high = Vec::Zero();  ///< [L]
    bool holds(const Vec& y) const {
      return (y.array() >= low.array()).all() && (y.array() <= high.array()).all();
    }
    bool meets(const Box& other) const {
      return (low.array() <= other.high.array()).all() && (other.low.array() <= high.array()).all();
    }
  };

  void build(std::vector<Box> boxes);
  /// Calls `found(box)` for each box that holds y; ascending.
  template <class Found>
  void near(const Vec& y, const Found& found) const {
    if (start_.empty()) return;
    const Cell c = place_of(y);
    const auto cell = static_cast<std::size_t>(bucket(c[0], c[1], c[2]));
    Index last = -1;
    for (Index k = start_[cell]; k < start_[cell + 1]; ++k) {
      const Index b = box_[static_cast<std::size_t>(k)];
      if (b == last || !boxes_[static_cast<std::size_t>(b)].holds(y)) continue;
      last = b;
      found(b);
    }
  }
  /// Boxes behind `box` in their order that meet it, after what `out` has; ascending, each once.
  void near(Index box, std::vector<Index>& out) const;

 private:
  using Cell = std::array<std::int64_t, 3>;
  Cell place_of(const Vec& y) const;
  Index bucket(std::int64_t i, std::int64_t j, std::int64_t k) const;
  template <class Body>
  void for_cells(const Box& box, const Body& body) const;
  std::size_t choose_size(Real usual);

  Vec low_ = Vec::Zero();
  Real size_ = 1;
  Index buckets_ = 1;
  std::vector<Box> boxes_;
  std::vector<Index> start_, box_;
};

}  // namespace courant
