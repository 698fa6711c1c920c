#include "search/nearest_distance.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "parallel/array.hpp"
#include "parallel/parallel.hpp"

namespace courant {

namespace {

constexpr Real infinity = std::numeric_limits<Real>::infinity();

/// Points sorted into cubes. Each cube holds copies of its points, so a search reads memory in order.
class Cubes {
 public:
  Cubes(const Real* x, const Real* y, const Real* z, Index n, const Vec& low, const Vec& high, Real size)
      : low_(low), size_(size), points_(static_cast<std::size_t>(n)), index_(static_cast<std::size_t>(n)) {
    for (int d = 0; d < 3; ++d) cubes_[d] = static_cast<Index>((high[d] - low[d]) / size) + 1;
    Array<Index> cube(static_cast<std::size_t>(n));
    for_each(n, [&](Index i) { cube[i] = number(cube_of({x[i], y[i], z[i]})); });
    start_.assign(static_cast<std::size_t>(cubes_[0]) * cubes_[1] * cubes_[2] + 2, 0);
    for (Index i = 0; i < n; ++i) ++start_[cube[i] + 2];
    for (std::size_t k = 2; k < start_.size(); ++k) start_[k] += start_[k - 1];
    for (Index i = 0; i < n; ++i) {  // start_[k + 1] moves on from the begin of cube k to its end
      const Index at = start_[cube[i] + 1]++;
      points_[at] = {x[i], y[i], z[i]};
      index_[at] = i;
    }
  }

  Index index(Index at) const { return index_[at]; }

  /// For the point at `at`, in ever wider shells of cubes until none nearer can come.
  Real nearest(Index at) const {
    const Vec p = points_[at];
    const auto c = cube_of(p);
    const Index widest = std::max({cubes_[0], cubes_[1], cubes_[2]});
    Real best2 = infinity;
    for (Index ring = 0; ring <= widest; ++ring) {
      if (ring > 0) {
        const Real gap = gap_to_ring(p, c, ring);
        if (best2 <= gap * gap) break;
      }
      search_ring(at, p, c, ring, best2);
    }
    return std::sqrt(best2);
  }

 private:
  std::array<Index, 3> cube_of(const Vec& p) const {
    std::array<Index, 3> c{};
    for (int d = 0; d < 3; ++d)
      c[d] = std::clamp(static_cast<Index>((p[d] - low_[d]) / size_), Index(0), cubes_[d] - 1);
    return c;
  }
  Index number(const std::array<Index, 3>& c) const { return (c[2] * cubes_[1] + c[1]) * cubes_[0] + c[0]; }
  /// Distance along axis d from p to layer k of cubes, a round-off less; 0 for p's own layer.
  Real gap_to_layer(const Vec& p, const std::array<Index, 3>& c, int d, Index k) const {
    if (k == c[d]) return 0;
    const Real face = low_[d] + static_cast<Real>(k > c[d] ? k : k + 1) * size_;
    return std::max(std::abs(face - p[d]) - 1e-9 * size_, Real(0));
  }
  Real gap_to_ring(const Vec& p, const std::array<Index, 3>& c, Index ring) const {
    Real gap = infinity;
    for (int d = 0; d < 3; ++d)
      gap = std::min({gap, gap_to_layer(p, c, d, c[d] + ring), gap_to_layer(p, c, d, c[d] - ring)});
    return gap;
  }
  void search_ring(Index at, const Vec& p, const std::array<Index, 3>& c, Index ring, Real& best2) const {
    const auto first = [&](int d) { return std::max(c[d] - ring, Index(0)); };
    const auto last = [&](int d) { return std::min(c[d] + ring, cubes_[d] - 1); };
    for (Index k = first(2); k <= last(2); ++k) {
      const Real gz = gap_to_layer(p, c, 2, k);
      for (Index j = first(1); j <= last(1); ++j) {
        const Real gy = gap_to_layer(p, c, 1, j);
        if (gy * gy + gz * gz >= best2) continue;
        const bool whole_row = std::abs(k - c[2]) == ring || std::abs(j - c[1]) == ring;
        for (Index i = c[0] - ring; i <= c[0] + ring; i += whole_row ? 1 : 2 * ring) {
          if (i < 0 || i >= cubes_[0]) continue;
          const Real gx = gap_to_layer(p, c, 0, i);
          if (gx * gx + gy * gy + gz * gz < best2) search_cube(at, p, number({i, j, k}), best2);
        }
      }
    }
  }
  void search_cube(Index at, const Vec& p, Index cube, Real& best2) const {
    for (Index q = start_[cube]; q < start_[cube + 1]; ++q)
      if (q != at) best2 = std::min(best2, (p - points_[q]).squaredNorm());
  }

  Vec low_;
  Real size_;
  std::array<Index, 3> cubes_{1, 1, 1};
  Array<Vec> points_;
  Array<Index> index_;
  std::vector<Index> start_;  ///< points of cube k: [start_[k], start_[k + 1])
};

}  // namespace

std::vector<Real> nearest_distance(const Real* x, const Real* y, const Real* z, Index n) {
  std::vector<Real> nearest(static_cast<std::size_t>(n), infinity);
  if (n < 2) return nearest;
  Vec low{x[0], y[0], z[0]}, high = low;
  for (Index i = 1; i < n; ++i) {
    const Vec p{x[i], y[i], z[i]};
    low = low.cwiseMin(p);
    high = high.cwiseMax(p);
  }
  // about two points in a cube, whatever the dimension of the cloud
  const Vec extent = high - low;
  const Real largest = extent.maxCoeff();
  if (largest <= 0) return std::vector<Real>(static_cast<std::size_t>(n), 0);
  Real volume = 1;
  int dimensions = 0;
  for (int d = 0; d < 3; ++d)
    if (extent[d] > 1e-9 * largest) volume *= extent[d], ++dimensions;
  const Real size = std::pow(2 * volume / static_cast<Real>(n), 1.0 / dimensions);
  const Cubes cubes(x, y, z, n, low, high, std::max(size, largest * 1e-3));
  for_each(n, [&](Index at) { nearest[cubes.index(at)] = cubes.nearest(at); });
  return nearest;
}

}  // namespace courant
