// How particles are sorted: who is active, in the halo or dormant, and in which cell.
#include <algorithm>
#include <cmath>
#include <limits>

#include <fmt/format.h>

#include "base/run_error.hpp"
#include "parallel/counting_sort.hpp"
#include "search/most_cells.hpp"
#include "search/neighbours.hpp"

namespace courant {

namespace {

/// What decides how particles are sorted.
struct Extent {
  Vec low = Vec::Constant(std::numeric_limits<Real>::infinity()), high = -low;
  Real h_max = 0, h_min = std::numeric_limits<Real>::infinity(), volume = 0;
  Index active = 0, halo = 0;
  bool lost = false;  ///< a place or h is not a finite number
  void add(const Extent& other) {
    low = low.cwiseMin(other.low), high = high.cwiseMax(other.high);
    h_max = std::max(h_max, other.h_max), h_min = std::min(h_min, other.h_min);
    volume += other.volume, active += other.active, halo += other.halo;
    lost = lost || other.lost;
  }
};

enum Group : signed char { group_active = 0, group_halo = 1, group_dormant = 2 };

/// Particles that wait or have gone are woken this many smoothing lengths before they can matter, so that
/// whole batches are.
constexpr Real waking_margin = 8;
/// By so much h may grow before it is worked out anew when dormant particles are due.
constexpr Real h_growth = 1.2;

}  // namespace

// Dormant particles stand in the order in which they can come within reach, so the first ones are due first.
Index Neighbours::take_due(World& world, Real t) {
  Particles& p = world.particles;
  Index n = 0;
  while (first_due_ < due_.size() && due_[first_due_] <= t + waking_time_) {
    const Index i = p.moving + n;
    p.x.set(i, p.x.vec(i) + p.v.vec(i) * (t - p.dormant_time));
    ++first_due_;
    ++n;
  }
  return n;
}

void Neighbours::wake_all(World& world, Real t) {
  Particles& p = world.particles;
  if (rebuilds_ > 0) {
    const Real dt = t - p.dormant_time;
    const Index first = p.moving;
    for (int d = 0; d < 3; ++d) {
      Real* x = p.x.data(d);
      const Real* v = p.v.data(d);
      for_each(p.size() - first, [=](Index k) { x[first + k] += v[first + k] * dt; });
    }
  }
  p.dormant_time = t;
}

/// Too many are far from the box, or h grew, with room for what grows until next time.
bool Neighbours::must_wake_all(const World& world) const {
  return gone_ > 64 + world.particles.moving / 4 || h_max_ > 0.5 * (1 + h_growth) * h_queued_;
}

void Neighbours::stop_for_lost_particles(const World& world, const Clock& clock, Index n) const {
  const Particles& p = world.particles;
  for (Index i = 0; i < n; ++i) {
    const Vec x = p.x.vec(i);
    if (x.allFinite() && std::isfinite(p.h[i])) continue;
    throw RunError(
        fmt::format(
            "particle {} of part {} went to x = ({:.5g}, {:.5g}, {:.5g}) with h = {:.5g} [L] at time {:.6g}, "
            "cycle {}: the run is "
            "unstable",
            p.id[i], world.part_id(i), x[0], x[1], x[2], p.h[i], clock.t, clock.cycle),
        StopCause::not_finite);
  }
}

/// Whether particles [begin, end) are active, so that nobody need ask each of them.
bool Neighbours::all_active(const Particles& p, Index begin, Index end) const {
  const Index* state = p.state.data();
  bool other = false;
  for (Index i = begin; i < end; ++i)
    other |= state[i] == particle_deactivated || state[i] == particle_waiting;
  if (other || !region_) return !other;
  const Real* const x[3] = {p.x.data(0), p.x.data(1), p.x.data(2)};
  return loops_.inside(region_->low.data(), region_->high.data(), x, begin, end) == end - begin;
}

void Neighbours::sort(World& world, const Clock& clock, Index n) {
  Particles& p = world.particles;
  const bool all = n == p.size();
  if (all) h_max_ = n > 0 ? maximum(n, [&](Index i) { return p.h[i]; }) : 0;
  const Real near = support_ * h_max_ + most_skin_ + waking_margin * h_max_;
  group_.resize(n);
  const auto bounds_of = [&](Index begin, Index end) {
    const auto b = loops_.bounds(
        {{p.x.data(0), p.x.data(1), p.x.data(2)}, p.h.data(), p.m.data(), p.rho.data()}, begin, end);
    return Extent{Vec(b.low), Vec(b.high), b.h_max, b.h_min, b.volume, 0, 0, b.broken};
  };
  const auto extent_of = [&](Index begin, Index end) {
    if (all_active(p, begin, end)) {
      std::fill(group_.begin() + begin, group_.begin() + end, group_active);
      Extent e = bounds_of(begin, end);
      e.active = end - begin;
      return e;
    }
    Extent e;
    for (Index i = begin; i < end; ++i) {
      Extent one = bounds_of(i, i + 1);
      const bool active = is_solved_for(p, i);
      const bool far = !active && all && time_to_reach(p, i, near) > 0;
      group_[i] = p.state[i] == particle_deactivated || far ? group_dormant
                  : active                                  ? group_active
                                                            : group_halo;
      e.lost = e.lost || one.lost;
      if (group_[i] == group_dormant) continue;
      (group_[i] == group_active ? one.active : one.halo) = 1;
      e.add(one);
    }
    return e;
  };
  Extent e = reduce(n, Extent{}, extent_of, [](Extent a, const Extent& b) {
    a.add(b);
    return a;
  });
  if (e.lost) stop_for_lost_particles(world, clock, n);
  const Index count = e.active + e.halo;
  if (count == 0) e.low = e.high = Vec::Zero(), e.h_min = e.h_max = h_max_;
  h_max_ = e.h_max;
  h_min_ = e.h_min;

  // rows as wide as eight particles that stand together, so that groups are compact
  Real spacing = count > 0 ? std::min(std::pow(e.volume / count, 1.0 / world.dim), 1.2 * h_max_) : 0;
  if (!(spacing >= 0.3 * h_max_)) spacing = 0.3 * h_max_;  // also where volumes are no numbers
  if (!(spacing > 0)) spacing = 1;
  if (!ghosts_.empty()) {  // cells beyond the particles, where ghosts may stand
    const Vec reach = Vec::Constant(support_ * h_max_ + most_skin_);
    e.low -= reach, e.high += reach;
    if (world.dim == 2) e.low[2] += reach[2], e.high[2] -= reach[2];
  }
  grid_.cover(e.low, e.high, (world.dim == 2 ? std::sqrt(Real(lanes)) : 2) * spacing, 0.5 * spacing,
              most_cells(count));
  const Index cells = grid_.total();
  key_.resize(n);
  find_cells(p, 0, n, key_.data());
  const bool some_rest = e.active < n;
  if (some_rest)
    for_each(
        n, [&](Index i) { key_[i] = group_[i] == group_dormant ? 2 * cells : group_[i] * cells + key_[i]; });
  counting_sort(key_, some_rest ? 2 * cells + 1 : cells, starts_, order_);
  p.active = e.active;
  p.moving = count;
  take_cell_starts(cells);
  if (all) order_dormant(p);
}

/// cell[0] is that of particle `first`.
void Neighbours::find_cells(const Particles& p, Index first, Index last, Index* cell) const {
  const Real* const x[3] = {p.x.data(0), p.x.data(1), p.x.data(2)};
  const CellFrame frame = grid_.frame();
  for_each_block(last - first, [&](Index begin, Index end) {
    near_.cells(frame, x, first + begin, first + end, cell + begin);
  });
}

/// starts_ holds where the active particles of each cell start, then, unless there are none, those of the
/// halo.
void Neighbours::take_cell_starts(Index cells) {
  const auto starts = std::span<const Index>(starts_);
  active_start_ = starts.first(cells + 1);
  halo_start_ = {};
  if (Index(starts.size()) > cells + 1) halo_start_ = starts.subspan(cells, cells + 1);
}

// When a dormant particle can be within reach of the box.
Real Neighbours::due_time(const Particles& p, Index i) const {
  if (p.state[i] == particle_deactivated) return std::numeric_limits<Real>::infinity();
  const Real reach = support_ * h_growth * h_max_ + most_skin_;
  return p.dormant_time + time_to_reach(p, i, reach);
}

// Behind the moving particles: those first that can be within reach first.
void Neighbours::order_dormant(const Particles& p) {
  std::vector<Real> due(p.size());
  for (std::size_t k = p.moving; k < order_.size(); ++k) due[order_[k]] = due_time(p, order_[k]);
  std::stable_sort(order_.begin() + p.moving, order_.end(),
                   [&](Index a, Index b) { return due[a] < due[b]; });
}

void Neighbours::queue_dormant(const Particles& p) {
  due_.clear();
  first_due_ = 0;
  Real fastest = 0;
  for (Index i = p.moving; i < p.size(); ++i) {
    due_.push_back(due_time(p, i));
    if (p.state[i] != particle_deactivated) fastest = std::max(fastest, p.v.vec(i).norm());
  }
  h_queued_ = h_max_;
  waking_time_ = fastest > 0 ? waking_margin * h_max_ / fastest : 0;
}

// Not by the state field: what MAXV switched off leaves, too.
void Neighbours::note_changes(Particles& p, Index active_before) {
  collect(p.active, entered_, [&](Index begin, Index end, std::vector<Index>& entered) {
    for (Index i = begin; i < end; ++i) {
      if (order_[i] >= active_before) entered.push_back(i);
      p.state[i] = particle_active;
    }
  });
  left_.clear();
  gone_ = 0;
  const Real near = 2 * (support_ * h_max_ + most_skin_ + waking_margin * h_max_);
  for (Index i = p.active; i < static_cast<Index>(order_.size()); ++i) {
    if (order_[i] < active_before) left_.push_back(i);
    if (p.state[i] == particle_active) p.state[i] = particle_outside;
    if (i < p.moving && time_to_reach(p, i, near) > 0) ++gone_;
  }
}

}  // namespace courant
