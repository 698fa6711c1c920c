#pragma once
// Edges near each other: a grid of cells in which each edge stands wherever its box reaches.
#include <cstdint>
#include <vector>

#include "contact/edges/edge.hpp"

namespace courant {

class EdgeSearch {
 public:
  /// Boxes around edges reach `reach` and their radius further. [L]
  void build(const std::vector<ContactEdge>& edges, const Field<Real>& x, Real reach);
  /// Edges behind `edge` in their order whose boxes meet its box; ascending, each once.
  void near(Index edge, std::vector<Index>& out) const;

 private:
  struct Box {
    Vec low = Vec::Zero(), high = Vec::Zero();
    bool meets(const Box& other) const {
      return (low.array() <= other.high.array()).all() && (other.low.array() <= high.array()).all();
    }
  };
  using Cell = std::array<std::int64_t, 3>;
  Cell place_of(const Vec& y) const;
  Index bucket(std::int64_t i, std::int64_t j, std::int64_t k) const;
  template <class Body>
  void for_cells(const Box& box, const Body& body) const;

  Real size_ = 1;
  Index buckets_ = 1;
  std::vector<Box> boxes_;
  std::vector<Index> start_, edge_;
};

}  // namespace courant
