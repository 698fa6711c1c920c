#include "contact/facet_grid.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace courant {
namespace {

struct Range {
  std::array<Index, 3> first, last;
};

Range cells_of(const Facet& f, Real reach, const Vec& low, Real cell, const std::array<Index, 3>& cells) {
  Vec a = f.x[0], b = f.x[0];
  for (int e = 1; e < f.corners; ++e) {
    a = a.cwiseMin(f.x[e]);
    b = b.cwiseMax(f.x[e]);
  }
  Range r;
  for (int k = 0; k < 3; ++k) {
    r.first[k] = std::clamp(Index(std::floor((a[k] - reach - low[k]) / cell)), 0, cells[k] - 1);
    r.last[k] = std::clamp(Index(std::floor((b[k] + reach - low[k]) / cell)), 0, cells[k] - 1);
  }
  return r;
}

/// Whether all facets go along z over at least half of the scene, as the walls of plane flow do.
bool along_z(const std::vector<Facet>& facets, Real size) {
  constexpr Real round_off = 1e-9;
  return std::all_of(facets.begin(), facets.end(), [&](const Facet& f) {
    Real low = f.x[0][2], high = low;
    for (int e = 1; e < f.corners; ++e) low = std::min(low, f.x[e][2]), high = std::max(high, f.x[e][2]);
    return std::abs(f.n[2]) < round_off && high - low > 0.5 * size;
  });
}

}  // namespace

void FacetGrid::build(const std::vector<Facet>& facets, Real reach) {
  first_.clear();
  facet_.clear();
  cells_ = {0, 0, 0};
  if (facets.empty()) return;
  Vec low = Vec::Constant(std::numeric_limits<Real>::infinity()), high = -low;
  for (const Facet& f : facets)
    for (int e = 0; e < f.corners; ++e) {
      low = low.cwiseMin(f.x[e]);
      high = high.cwiseMax(f.x[e]);
    }
  const Real slack = reach * (1 + 1e-9);
  low_ = low - Vec::Constant(slack);
  const Vec size = high - low + Vec::Constant(2 * slack);
  // Cells of the size of the reach, but not many more than facets: a large box with few facets must not fill
  // the memory.
  const Real most = std::max<Real>(1e5, 50.0 * Real(facets.size()));
  cell_ = std::max(slack, size.maxCoeff() / 2000);
  const bool plane = along_z(facets, high[2] - low[2]);  // layers would all have the same facets
  const auto along = [&](int k) { return plane && k == 2 ? Real(1) : std::ceil(size[k] / cell_); };
  while (along(0) * along(1) * along(2) > most) cell_ *= 1.25;
  for (int k = 0; k < 3; ++k) cells_[k] = std::max<Index>(1, Index(along(k)));
  inverse_ = 1 / cell_;

  first_.assign(std::size_t(cells_[0]) * cells_[1] * cells_[2] + 1, 0);
  std::vector<Index> fill;
  for (int pass = 0; pass < 2; ++pass) {  // count, then fill
    for (Index s = 0; s < Index(facets.size()); ++s) {
      const Facet& f = facets[s];
      const Range r = cells_of(f, slack, low_, cell_, cells_);
      for (Index i = r.first[0]; i <= r.last[0]; ++i)
        for (Index j = r.first[1]; j <= r.last[1]; ++j)
          for (Index k = r.first[2]; k <= r.last[2]; ++k) {
            const Vec centre = low_ + cell_ * Vec(i + 0.5, j + 0.5, k + 0.5);
            if (std::abs(plane_distance(f, centre)) > slack + 0.5 * cell_ * f.n.cwiseAbs().sum()) continue;
            const std::size_t c = (std::size_t(i) * cells_[1] + j) * cells_[2] + k;
            if (pass == 0)
              ++first_[c + 1];
            else
              facet_[fill[c]++] = s;
          }
    }
    if (pass == 0) {
      for (std::size_t c = 1; c < first_.size(); ++c) first_[c] += first_[c - 1];
      facet_.resize(first_.back());
      fill.assign(first_.begin(), first_.end() - 1);
    }
  }
}

std::span<const Index> FacetGrid::near(const Vec& x) const {
  std::size_t c = 0;
  for (int k = 0; k < 3; ++k) {
    if (cells_[k] == 1) continue;
    const Real a = (x[k] - low_[k]) * inverse_;
    if (!(a >= 0 && a < cells_[k])) return {};
    c = c * cells_[k] + std::size_t(a);
  }
  return {facet_.data() + first_[c], std::size_t(first_[c + 1] - first_[c])};
}

}  // namespace courant
