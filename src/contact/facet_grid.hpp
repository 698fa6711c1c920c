#pragma once
// Search for facets near a point: each facet is in all cells that it reaches, so one cell suffices.
#include <span>
#include <vector>

#include "contact/facet.hpp"

namespace courant {

class FacetGrid {
 public:
  /// Enters every facet in the cells within `reach` [L] of it.
  void build(const std::vector<Facet>& facets, Real reach);
  /// Facets that may be within reach of x, in ascending order; empty far from all.
  std::span<const Index> near(const Vec& x) const;

 private:
  Vec low_ = Vec::Zero();
  Real cell_ = 1, inverse_ = 1;
  std::array<Index, 3> cells_ = {0, 0, 0};
  std::vector<Index> first_, facet_;
};

}  // namespace courant
