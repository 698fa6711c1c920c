#include "search/nearest_distance.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>
#include <memory>

#include "parallel/array.hpp"
#include "parallel/parallel.hpp"

namespace courant {

namespace {

constexpr Real infinity = std::numeric_limits<Real>::infinity();

/// The cloud of points: shape n each.
struct Cloud {
  const Real *x, *y, *z;
  Index n;
  Vec low, high;
  Vec at(Index i) const { return {x[i], y[i], z[i]}; }
  Real extent() const { return (high - low).maxCoeff(); }
};

Cloud cloud_of(const Real* x, const Real* y, const Real* z, Index n) {
  Cloud cloud{x, y, z, n, Vec(x[0], y[0], z[0]), Vec(x[0], y[0], z[0])};
  for (Index i = 1; i < n; ++i) {
    cloud.low = cloud.low.cwiseMin(cloud.at(i));
    cloud.high = cloud.high.cwiseMax(cloud.at(i));
  }
  return cloud;
}

/// Space cut into cubes that are numbered with few gaps: row by row where there is memory for all of them,
/// else by a hash, so that cubes far apart may share a number.
class Cubes {
 public:
  using Place = std::array<std::int64_t, 3>;
  Cubes(const Cloud& cloud, Real size) : low_(cloud.low), size_(size) {
    slack_ =
        1e-9 * size + 1e-15 * std::max(cloud.low.cwiseAbs().maxCoeff(), cloud.high.cwiseAbs().maxCoeff());
    Real total = 1;
    for (int d = 0; d < 3; ++d) {
      count_[d] = static_cast<std::int64_t>((cloud.high[d] - low_[d]) / size) + 1;
      total *= static_cast<Real>(count_[d]);
    }
    const std::uint64_t numbers = std::bit_ceil(static_cast<std::uint64_t>(cloud.n));
    mask_ = numbers - 1;
    if (total <= static_cast<Real>(numbers)) {
      row_ = static_cast<std::uint64_t>(count_[0]);
      layer_ = row_ * static_cast<std::uint64_t>(count_[1]);
    }
  }
  std::size_t numbers() const { return static_cast<std::size_t>(mask_) + 1; }
  std::int64_t widest() const { return std::max({count_[0], count_[1], count_[2]}); }
  Place place(const Vec& p) const {
    Place c{};
    for (int d = 0; d < 3; ++d)
      c[d] = std::clamp(static_cast<std::int64_t>((p[d] - low_[d]) / size_), std::int64_t(0), count_[d] - 1);
    return c;
  }
  Index number(const Place& c) const {
    const auto k = [&](int d) { return static_cast<std::uint64_t>(c[d]); };
    return static_cast<Index>((k(0) + row_ * k(1) + layer_ * k(2)) & mask_);
  }
  bool contains(int d, std::int64_t k) const { return k >= 0 && k < count_[d]; }
  /// Distance along axis d from p in cube c to layer k of cubes, less what round-off may make of it.
  Real gap(const Vec& p, const Place& c, int d, std::int64_t k) const {
    if (k == c[d]) return 0;
    const Real face = low_[d] + static_cast<Real>(k > c[d] ? k : k + 1) * size_;
    return std::max(std::abs(face - p[d]) - slack_, Real(0));
  }

 private:
  Vec low_;
  Real size_, slack_;
  Place count_{1, 1, 1};
  std::uint64_t mask_ = 0, row_ = 0x9E3779B1, layer_ = 0x85EBCA77C2B2AE63;  // the hash's: large odd numbers
};

/// All points sorted by the number of their cube. The lists hold copies, so a search reads memory in order.
class Lists {
 public:
  Lists(const Cloud& cloud, Real size)
      : cubes_(cloud, size), points_(static_cast<std::size_t>(cloud.n)), index_(points_.size()) {
    Array<Index> number(points_.size());
    for_each(cloud.n, [&](Index i) { number[i] = cubes_.number(cubes_.place(cloud.at(i))); });
    start_.assign(cubes_.numbers() + 2, 0);
    for (const Index k : number) ++start_[k + 2];
    for (std::size_t k = 2; k < start_.size(); ++k) start_[k] += start_[k - 1];
    for (Index i = 0; i < cloud.n; ++i) {  // start_[k + 1] moves from the begin of list k to its end
      const Index at = start_[number[i] + 1]++;
      points_[at] = cloud.at(i);
      index_[at] = i;
    }
  }
  Index index(Index at) const { return index_[at]; }  ///< of the point at a position in the lists

  /// Points in the list of a point, on average over the points.
  Real crowd() const {
    Real sum = 0;
    for (std::size_t k = 0; k < cubes_.numbers(); ++k) {
      const auto count = static_cast<Real>(start_[k + 1] - start_[k]);
      sum += count * count;
    }
    return sum / static_cast<Real>(points_.size());
  }

  /// Nearest distance to p, which is at `self` in the lists, in ever wider shells of cubes until none
  /// nearer can come. -1 if more than `rings` shells would be needed.
  Real nearest(Index self) const {
    constexpr std::int64_t rings = 2;
    const Vec p = points_[self];
    const Cubes::Place c = cubes_.place(p);
    const std::int64_t widest = cubes_.widest();
    Real best2 = infinity;
    for (std::int64_t ring = 0; ring <= widest; ++ring) {
      Real gap = ring == 0 ? 0 : infinity;
      for (int d = 0; d < 3 && ring > 0; ++d)
        gap = std::min({gap, cubes_.gap(p, c, d, c[d] + ring), cubes_.gap(p, c, d, c[d] - ring)});
      if (best2 <= gap * gap) break;
      if (ring > rings) return -1;
      search_ring(self, p, c, ring, best2);
    }
    return std::sqrt(best2);
  }

 private:
  void search_ring(Index self, const Vec& p, const Cubes::Place& c, std::int64_t ring, Real& best2) const {
    for (std::int64_t k = c[2] - ring; k <= c[2] + ring; ++k) {
      if (!cubes_.contains(2, k)) continue;
      const Real gz = cubes_.gap(p, c, 2, k);
      for (std::int64_t j = c[1] - ring; j <= c[1] + ring; ++j) {
        if (!cubes_.contains(1, j)) continue;
        const Real gy = cubes_.gap(p, c, 1, j);
        if (gy * gy + gz * gz >= best2) continue;
        const bool whole_row = std::abs(k - c[2]) == ring || std::abs(j - c[1]) == ring;
        for (std::int64_t i = c[0] - ring; i <= c[0] + ring; i += whole_row ? 1 : 2 * ring) {
          if (!cubes_.contains(0, i)) continue;
          const Real gx = cubes_.gap(p, c, 0, i);
          if (gx * gx + gy * gy + gz * gz < best2) search_list(self, p, cubes_.number({i, j, k}), best2);
        }
      }
    }
  }
  void search_list(Index self, const Vec& p, Index list, Real& best2) const {
    for (Index q = start_[list]; q < start_[list + 1]; ++q)
      if (q != self) best2 = std::min(best2, (p - points_[q]).squaredNorm());
  }

  Cubes cubes_;
  Array<Vec> points_;
  Array<Index> index_;
  std::vector<Index> start_;  ///< points of list k: [start_[k], start_[k + 1])
};

/// Size of cubes for about two points in each if the points fill their bounding box, whatever its dimension.
Real even_size(const Cloud& cloud) {
  const Vec extent = cloud.high - cloud.low;
  Real volume = 1;
  int dimensions = 0;
  for (int d = 0; d < 3; ++d)
    if (extent[d] > 1e-9 * cloud.extent()) volume *= extent[d], ++dimensions;
  return std::pow(2 * volume / static_cast<Real>(cloud.n), 1.0 / dimensions);
}

/// Lists of a few points each. `size` of the cubes becomes smaller where that of an even cloud makes some too
/// full: a few points far off enlarge the box, but not the cloud.
std::unique_ptr<Lists> short_lists(const Cloud& cloud, Real& size) {
  constexpr Real too_crowded = 16, finest = 1e-9;
  size = std::max(even_size(cloud), finest * cloud.extent());
  auto lists = std::make_unique<Lists>(cloud, size);
  while (lists->crowd() > too_crowded && size > finest * cloud.extent()) {
    size *= 0.5;
    lists = nullptr;  // gives its memory back first
    lists = std::make_unique<Lists>(cloud, size);
  }
  return lists;
}

Real by_trying_all(const Cloud& cloud, Index i) {
  Real best2 = infinity;
  for (Index j = 0; j < cloud.n; ++j)
    if (j != i) best2 = std::min(best2, (cloud.at(i) - cloud.at(j)).squaredNorm());
  return std::sqrt(best2);
}

}  // namespace

std::vector<Real> nearest_distance(const Real* x, const Real* y, const Real* z, Index n) {
  constexpr Real unknown = -1;
  constexpr std::ptrdiff_t few = 8;
  if (n < 2) return std::vector<Real>(static_cast<std::size_t>(n), infinity);
  const Cloud cloud = cloud_of(x, y, z, n);
  if (cloud.extent() <= 0) return std::vector<Real>(static_cast<std::size_t>(n), 0);
  std::vector<Real> nearest(static_cast<std::size_t>(n), unknown);
  Real size = 0;
  auto lists = short_lists(cloud, size);
  std::ptrdiff_t left = n;
  for (bool again = false; left > few; again = true) {
    if (again) {  // particles without a neighbour search again, with larger cubes
      size *= 4;
      lists = nullptr;
      lists = std::make_unique<Lists>(cloud, size);
    }
    for_each(n, [&](Index at) {
      Real& d = nearest[lists->index(at)];
      if (d == unknown) d = lists->nearest(at);
    });
    left = std::count(nearest.begin(), nearest.end(), unknown);
  }
  for_each(n, [&](Index i) {
    if (nearest[i] == unknown) nearest[i] = by_trying_all(cloud, i);
  });
  return nearest;
}

}  // namespace courant
