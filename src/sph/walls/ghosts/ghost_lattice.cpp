#include "sph/walls/ghosts/ghost_lattice.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <map>
#include <unordered_map>
#include <utility>

#include "sph/walls/ghosts/shell_facets.hpp"

namespace courant {

namespace {

constexpr double most_points = 5e8;     ///< of the lattice: two bytes each
constexpr Real on_wall = 0.02;          ///< of a spacing: points so near a shell are on it
constexpr Real widened = 0.25;          ///< of a spacing: shells block so far beyond their edges
constexpr Real most_in_front = 0.49;    ///< of a spacing: water keeps half a spacing off
constexpr Real level_tolerance = 1e-6;  ///< of a spacing
constexpr Real cone_cosine = 0.5;       ///< water in sight of a shell is before it within 60 degrees
constexpr Real least_thickness = 0.9;   ///< of the reach: water acts through thinner walls

using Facet = WallFacet;

class Layer {
 public:
  Layer(const World& world, const std::vector<Index>& segments, const std::vector<char>& moves,
        const GhostLattice& lattice)
      : world_(world),
        moves_(moves),
        to_(lattice),
        dx_(lattice.spacing),
        facets_(facets_of_shells(world, segments, lattice)),
        closed_(closed_parts(facets_, lattice)) {}

  LaidGhosts lay() {
    LaidGhosts out;
    if (facets_.empty() || !cover()) {
      out.too_large = !facets_.empty();
      return out;
    }
    // held walls, then those that move: they see other water
    std::vector<std::int8_t> taken(state_.size(), 0);
    for (const bool moving : {false, true}) {
      std::vector<Facet*> mine;
      for (Facet& f : facets_)
        if (is_moving(f) == moving) mine.push_back(&f);
      if (mine.empty()) continue;
      flood(moving);
      for (Facet* f : mine)
        if (f->copy_of < 0) look_at_sides(*f);
      for (Facet* f : mine)
        if (f->copy_of >= 0) std::copy_n(facets_[static_cast<std::size_t>(f->copy_of)].wet, 2, f->wet);
      report(mine, out);
      for (const Facet* f : mine)
        if (moving && f->copy_of < 0 && f->used() && !closed_.at(f->part)) out.open.push_back(f->segment);
      fill(mine, taken, out);
    }
    return out;
  }

 private:
  bool is_moving(const Facet& f) const { return moves_[static_cast<std::size_t>(f.segment)] != 0; }
  Vec flat(const Vec& x) const { return to_.dim == 2 ? Vec(x[0], x[1], 0) : x; }
  /// Whether copies of ghosts fill x: of what is on periodic planes one has ghosts, on mirrors they would be
  /// there twice.
  bool is_of_copies(const Vec& x) const {
    return std::any_of(to_.planes.begin(), to_.planes.end(), [&](const GhostPlane& plane) {
      const Real d = depth(plane, x), on = on_wall * dx_;
      return plane.kind == GhostPlane::Kind::mirror ? d < on : d < -on || d > plane.period - on;
    });
  }

  /// The lattice around shells and water. False where it would be too large.
  bool cover() {
    const Particles& p = world_.particles;
    low_ = high_ = facets_[0].x[0];
    const auto take = [&](const Vec& x) { low_ = low_.cwiseMin(x), high_ = high_.cwiseMax(x); };
    for (const Facet& f : facets_)
      for (const Vec& x : f.x)
        if (f.copy_of < 0) take(x);
    level_ = -1e300;
    for (Index i = 0; i < p.size(); ++i) {
      if (p.state[i] == particle_waiting || p.state[i] == particle_deactivated) continue;
      take(flat(p.x.vec(i)));
      level_ = std::max(level_, flat(p.x.vec(i)).dot(to_.up));
    }
    const Real around = to_.reach + 2 * dx_;
    double total = 1;
    for (Index k = 0; k < to_.dim; ++k) {
      first_[k] = static_cast<std::int64_t>(std::floor((low_[k] - around - to_.origin[k]) / dx_));
      const auto last = static_cast<std::int64_t>(std::ceil((high_[k] + around - to_.origin[k]) / dx_));
      count_[k] = last - first_[k] + 1;
      total *= static_cast<double>(count_[k]);
    }
    if (!(total < most_points)) return false;
    stride_[0] = 1, stride_[1] = count_[0], stride_[2] = count_[0] * count_[1];
    state_.assign(static_cast<std::size_t>(total), 0);
    return true;
  }

  using Cell = std::array<std::int64_t, 3>;
  std::size_t index(const Cell& c) const {
    return static_cast<std::size_t>(c[0] * stride_[0] + c[1] * stride_[1] + c[2] * stride_[2]);
  }
  Cell cell(std::size_t i) const {
    auto rest = static_cast<std::int64_t>(i);
    Cell c{};
    for (int k = 2; k >= 0; --k) c[static_cast<std::size_t>(k)] = rest / stride_[k], rest %= stride_[k];
    return c;
  }
  Vec point_of(const Cell& c) const {
    Vec x = Vec::Zero();
    for (Index k = 0; k < to_.dim; ++k)
      x[k] = to_.origin[k] + dx_ * static_cast<Real>(first_[k] + c[static_cast<std::size_t>(k)]);
    return x;
  }
  bool holds(const Cell& c) const {
    for (std::size_t k = 0; k < 3; ++k)
      if (c[k] < 0 || c[k] >= (static_cast<Index>(k) < to_.dim ? count_[k] : 1)) return false;
    return true;
  }
  /// Cells from `low` to `high`, within the lattice.
  std::pair<Cell, Cell> cells_between(const Vec& low, const Vec& high) const {
    Cell a{}, b{};
    for (Index k = 0; k < to_.dim; ++k) {
      const auto at = [&](Real x) {
        return std::clamp(static_cast<std::int64_t>(std::floor((x - to_.origin[k]) / dx_)) - first_[k],
                          std::int64_t(0), count_[k] - 1);
      };
      a[static_cast<std::size_t>(k)] = at(low[k]);
      b[static_cast<std::size_t>(k)] = std::min(at(high[k]) + 1, count_[k] - 1);
    }
    return {a, b};
  }
  template <class F>
  void for_each_cell(const std::pair<Cell, Cell>& range, F&& f) const {
    const auto& [a, b] = range;
    for (Cell c = a; c[2] <= b[2]; ++c[2])
      for (c[1] = a[1]; c[1] <= b[1]; ++c[1])
        for (c[0] = a[0]; c[0] <= b[0]; ++c[0]) f(c);
  }

  // ---- where water gets ----

  static constexpr std::uint8_t wet = 1, on_shell = 2, occupied = 32,
                                blocked = 4;  ///< blocked << k: on the step to the next one

  /// Whether the line along axis k through x meets a facet, and where.
  bool meets(const Facet& f, Index k, const Vec& x, Real& at) const {
    if (std::abs(f.n[k]) < 1e-9) return false;
    at = x[k] + f.n.dot(f.x[0] - x) / f.n[k];
    Vec q = x;
    q[k] = at;
    return f.past_edges(q) <= widened * dx_;
  }
  void block(const Facet& f) {
    const Vec low = f.x[0].cwiseMin(f.x[1]).cwiseMin(f.x[2]), high = f.x[0].cwiseMax(f.x[1]).cwiseMax(f.x[2]);
    const Vec margin = Vec::Constant(1.01 * dx_);
    const auto range = cells_between(low - margin, high + margin);
    for (Index k = 0; k < to_.dim; ++k) {
      auto lines = range;
      const auto axis = static_cast<std::size_t>(k);
      lines.second[axis] = lines.first[axis];
      for_each_cell(lines, [&](const Cell& start) {
        Real at = 0;
        if (!meets(f, k, point_of(start), at)) return;
        const Real steps = (at - to_.origin[k]) / dx_ - static_cast<Real>(first_[k]);
        const auto before = static_cast<std::int64_t>(std::floor(steps));
        const Real past = steps - static_cast<Real>(before);
        const auto block_from = [&](std::int64_t from) {
          Cell c = start;
          c[axis] = from;
          if (holds(c)) state_[index(c)] |= static_cast<std::uint8_t>(blocked << k);
        };
        const auto mark = [&](std::int64_t point) {
          Cell c = start;
          c[axis] = point;
          if (holds(c)) state_[index(c)] |= on_shell;
        };
        block_from(before);
        if (past < on_wall) block_from(before - 1), mark(before);
        if (past > 1 - on_wall) block_from(before + 1), mark(before + 1);
      });
    }
  }

  /// Whether water may be there at all.
  bool is_in_scene(const Vec& x) const {
    for (Index k = 0; k < to_.dim; ++k) {
      if (x[k] < low_[k] - level_tolerance * dx_ && to_.up[k] > -0.5) return false;
      if (x[k] > high_[k] + level_tolerance * dx_ && to_.up[k] < 0.5) return false;
    }
    return !is_beyond(to_.planes, x, level_tolerance * dx_);
  }

  void flood(bool moving) {
    std::fill(state_.begin(), state_.end(), std::uint8_t(0));
    for (const Facet& f : facets_)
      if (moving || !is_moving(f) || closed_.at(f.part)) block(f);
    std::vector<std::size_t> open;
    const auto reach = [&](std::size_t i) {
      if ((state_[i] & (wet | on_shell)) != 0) return;
      state_[i] |= wet;
      open.push_back(i);
    };
    const Particles& p = world_.particles;
    for (Index i = 0; i < p.size(); ++i) {
      if (p.state[i] == particle_waiting || p.state[i] == particle_deactivated) continue;
      Cell c{};
      for (Index k = 0; k < to_.dim; ++k)
        c[static_cast<std::size_t>(k)] = std::llround((p.x.vec(i)[k] - to_.origin[k]) / dx_) - first_[k];
      if (holds(c)) state_[index(c)] |= occupied;
      if (holds(c) && can_see(flat(p.x.vec(i)), point_of(c))) reach(index(c));
    }
    const Real most = level_ + 0.5 * dx_;
    while (!open.empty()) {
      const std::size_t i = open.back();
      open.pop_back();
      const Cell c = cell(i);
      const Real height = point_of(c).dot(to_.up);
      for (Index k = 0; k < to_.dim; ++k)
        for (const int step : {-1, 1}) {
          Cell next = c;
          next[static_cast<std::size_t>(k)] += step;
          if (!holds(next)) continue;
          const std::size_t j = index(next);
          if ((state_[step > 0 ? i : j] & (blocked << k)) != 0) continue;
          const Vec x = point_of(next);
          const Real to = x.dot(to_.up);
          if (!is_in_scene(x) || (to > most && to < height - level_tolerance * dx_)) continue;
          reach(j);
        }
    }
  }

  /// Whether no facet is between a particle and the lattice point next to it. Particles of the lattice
  /// are the point.
  bool can_see(const Vec& from, const Vec& to) const {
    if ((to - from).norm() < facet_tolerance * dx_) return true;
    bool is = true;
    for_facets_near(0.5 * (from + to), [&](const Facet& f) { is = is && !f.crosses(from, to); });
    return is;
  }

  // ---- sides of shells ----

  /// Which sides of a shell water can reach: it does where a wet point of the lattice is within two spacings
  /// of it, straight in front; what is farther off may be around a corner. Shells shorter than the spacing
  /// may have no point of the lattice over them: then within a cone about the normal.
  void look_at_sides(Facet& f) {
    f.wet[0] = f.wet[1] = false;
    for (const bool straight : {true, false}) {
      for (const Vec& x : f.samples(dx_)) look_from(f, x, straight);
      if (f.wet[0] || f.wet[1]) return;
    }
  }
  void look_from(Facet& f, const Vec& x, bool straight) {
    const Real far = 1.75 * dx_;
    const Vec margin = Vec::Constant(far);
    for_each_cell(cells_between(x - margin, x + margin), [&](const Cell& c) {
      if ((state_[index(c)] & wet) == 0) return;
      const Vec d = point_of(c) - x;
      const Real height = f.n.dot(d);
      const std::size_t side = height > 0 ? 0 : 1;
      if (f.wet[side] || !(std::abs(height) > on_wall * dx_) || d.norm() > far) return;
      // along the normal no other shell can be met but one that is nearer
      const Vec foot = point_of(c) - height * f.n;
      if (straight ? f.past_edges(foot) > 0 : !(std::abs(height) > cone_cosine * d.norm())) return;
      if (!between(f, straight ? foot : x, point_of(c))) f.wet[side] = true;
    });
  }

  /// Whether another facet is between a foot on facet f and a point over it.
  bool between(const Facet& f, const Vec& foot, const Vec& x) const {
    const Vec from = foot + on_wall * (x - foot);
    bool is = false;
    for_facets_near(0.5 * (from + x),
                    [&](const Facet& other) { is = is || (&other != &f && other.crosses(from, x)); });
    return is;
  }

  /// Facets that may be within two spacings of x.
  template <class F>
  void for_facets_near(const Vec& x, F&& f) const {
    if (buckets_.empty()) sort_facets();
    const auto found = buckets_.find(bucket(x));
    if (found == buckets_.end()) return;
    for (const Index k : found->second) f(facets_[static_cast<std::size_t>(k)]);
  }
  static constexpr Real bucket_size = 4;  ///< spacings
  Cell bucket(const Vec& x) const {
    Cell c{};
    for (Index k = 0; k < to_.dim; ++k)
      c[static_cast<std::size_t>(k)] = static_cast<std::int64_t>(std::floor(x[k] / (bucket_size * dx_)));
    return c;
  }
  void sort_facets() const {
    const Vec margin = Vec::Constant(2 * dx_);
    for (std::size_t k = 0; k < facets_.size(); ++k) {
      const Facet& f = facets_[k];
      const Vec low = f.x[0].cwiseMin(f.x[1]).cwiseMin(f.x[2]),
                high = f.x[0].cwiseMax(f.x[1]).cwiseMax(f.x[2]);
      const Real half = 0.5 * bucket_size * dx_ * std::sqrt(Real(to_.dim));
      const Cell a = bucket(low - margin), b = bucket(high + margin);
      for_each_cell({a, b}, [&](const Cell& c) {
        Vec middle = Vec::Zero();
        for (Index d = 0; d < to_.dim; ++d)
          middle[d] = (static_cast<Real>(c[static_cast<std::size_t>(d)]) + 0.5) * bucket_size * dx_;
        if (std::abs(f.n.dot(middle - f.x[0])) < half + 2 * dx_) buckets_[c].push_back(static_cast<Index>(k));
      });
    }
  }

  static void report(const std::vector<Facet*>& mine, LaidGhosts& out) {
    const auto note = [](std::vector<Index>& to, Index segment) {
      if (to.empty() || to.back() != segment) to.push_back(segment);
    };
    for (const Facet* f : mine) {
      if (f->copy_of >= 0) continue;
      if (f->wet[0] && f->wet[1]) note(out.wet_on_both_sides, f->segment);
      if (!f->wet[0] && !f->wet[1]) note(out.dry, f->segment);
    }
  }

  // ---- ghosts ----

  struct Candidate {
    Real distance = 1e300;
    Vec foot = Vec::Zero();      ///< the nearest point of the walls
    std::vector<Vec> normals{};  ///< out of the water, of the facets that meet there
    Index segment = -1;
    Real distance_behind = 1e300;  ///< from the nearest facet that it is right behind
    Index right_behind = -1;       ///< the segment of that
  };

  /// A dry point is a ghost where it is right behind a facet, at any distance within the reach; or where the
  /// nearest point of the walls is on an edge or in a corner, if its direction from there is between the
  /// normals of the facets that meet: beyond the free edge of a plate is no wall. A wet point is one where it
  /// is so near a wall in front of it that no water is there.
  void fill(const std::vector<Facet*>& mine, std::vector<std::int8_t>& taken, LaidGhosts& out) {
    std::unordered_map<std::size_t, Candidate> near;
    const Vec margin = Vec::Constant(to_.reach);
    for (const Facet* f : mine) {
      if (!f->used()) continue;
      const Vec low = f->x[0].cwiseMin(f->x[1]).cwiseMin(f->x[2]) - margin,
                high = f->x[0].cwiseMax(f->x[1]).cwiseMax(f->x[2]) + margin;
      const Vec n = f->outwards() * f->n;
      for_each_cell(cells_between(low, high), [&](const Cell& c) {
        const std::size_t i = index(c);
        if (taken[i] != 0 || (state_[i] & (wet | occupied)) == (wet | occupied)) return;
        const Vec x = point_of(c);
        if (is_of_copies(x)) return;
        const Real height = n.dot(x - f->x[0]);
        if (std::abs(height) > ((state_[i] & wet) != 0 ? most_in_front * dx_ : to_.reach)) return;
        const Vec foot = f->nearest(x);
        const Real distance = (x - foot).norm();
        if (distance > to_.reach) return;
        Candidate& known = near[i];
        if (height > -on_wall * dx_ && distance < known.distance_behind &&
            distance - std::abs(height) < facet_tolerance * dx_)
          known.distance_behind = distance, known.right_behind = f->segment;
        if (distance < known.distance - facet_tolerance * dx_)
          known.distance = distance, known.foot = foot, known.normals = {n}, known.segment = f->segment;
        else if (distance < known.distance + facet_tolerance * dx_)
          known.normals.push_back(n);
      });
    }
    std::vector<std::size_t> order;
    for (const auto& [i, candidate] : near) order.push_back(i);
    std::sort(order.begin(), order.end());
    for (const std::size_t i : order) {
      const Candidate& c = near.at(i);
      const bool is_wet = (state_[i] & wet) != 0;
      if (is_wet && !(c.distance < most_in_front * dx_)) continue;
      const Vec x = point_of(cell(i)),
                away = (is_wet ? -1 : 1) * (x - c.foot) / std::max(c.distance, on_wall * dx_);
      const bool right = !is_wet && c.right_behind >= 0;
      if (!right && c.distance > on_wall * dx_ && !in_cone(away, c.normals)) continue;
      taken[i] = 1;
      out.ghosts.push_back({x, right ? c.right_behind : c.segment});
    }
    for (const Facet* f : mine)
      if (f->copy_of < 0 && f->used() && water_behind(*f)) out.thin.push_back(f->segment);
  }

  /// Whether water begins again within the reach behind a facet: all points of the lattice around one there
  /// are wet.
  bool water_behind(const Facet& f) const {
    bool is = false;
    for (const Vec& x : f.samples(dx_))
      for (Real s = 0.5; !is && s * dx_ < least_thickness * to_.reach; s += 0.5) {
        const Vec q = x + s * dx_ * f.outwards() * f.n;
        is = true;
        for_each_cell(cells_between(q, q), [&](const Cell& c) { is = is && (state_[index(c)] & wet) != 0; });
      }
    return is;
  }

  const World& world_;
  const std::vector<char>& moves_;
  const GhostLattice& to_;
  Real dx_, level_ = 0;
  std::vector<Facet> facets_;
  std::map<Index, bool> closed_;  ///< by part
  Vec low_ = Vec::Zero(), high_ = Vec::Zero();
  std::array<std::int64_t, 3> first_{0, 0, 0}, count_{1, 1, 1}, stride_{1, 1, 1};
  std::vector<std::uint8_t> state_;
  mutable std::map<Cell, std::vector<Index>> buckets_;
};

}  // namespace

LaidGhosts lay_wall_ghosts(const World& world, const std::vector<Index>& segments,
                           const std::vector<char>& moves, const GhostLattice& lattice) {
  return Layer(world, segments, moves, lattice).lay();
}

}  // namespace courant
