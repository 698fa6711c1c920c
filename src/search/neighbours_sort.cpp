// Sorting of particles: active, in the halo or dormant, and by cell.
#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include <fmt/format.h>

#include "base/run_error.hpp"
#include "parallel/counting_sort.hpp"
#include "search/most_cells.hpp"
#include "search/neighbours.hpp"

namespace courant {

namespace {

/// Where particles are, their h, and the sum of their volumes.
struct Extent {
  Vec low = Vec::Constant(std::numeric_limits<Real>::infinity()), high = -low;
  Real h_max = 0, h_min = std::numeric_limits<Real>::infinity(), volume = 0;
  Index count = 0;
  bool lost = false;  ///< a place or h is not a finite number
  void add(const Extent& other) {
    low = low.cwiseMin(other.low), high = high.cwiseMax(other.high);
    h_max = std::max(h_max, other.h_max), h_min = std::min(h_min, other.h_min);
    volume += other.volume, count += other.count;
    lost = lost || other.lost;
  }
};
struct Extents {
  Extent active, halo;
};

enum Group : signed char { group_active = 0, group_halo = 1, group_dormant = 2 };

/// Particles that wait or have gone are woken this many smoothing lengths before they can matter, so that
/// whole batches are.
constexpr Real waking_margin = 8;
/// By so much h may grow before it is worked out anew when dormant particles are due.
constexpr Real h_growth = 1.2;

/// Sums of volumes are multiples of this, of a particle's; so many are added without rounding as fit into 53
/// bits with it.
constexpr Real volume_unit = 1.0 / (1 << 20);

// Size and position of cells follow from active particles alone: how many others there are depends on when
// these woke and on ENDTIM.
void choose_cells(CellGrid& grid, int dim, Extent core, const Extent& halo, Real h_max, Real reach,
                  bool ghosts) {
  if (core.count == 0) core = halo;
  if (core.count == 0) core.low = core.high = Vec::Zero();
  // rows as wide as eight particles that stand together, so that groups are compact
  Real spacing = core.count > 0 ? std::min(std::pow(core.volume / core.count, 1.0 / dim), 1.2 * h_max) : 0;
  if (!(spacing >= 0.3 * h_max)) spacing = 0.3 * h_max;  // also where volumes are no numbers
  if (!(spacing > 0)) spacing = 1;
  grid.set_size(core.low, core.high, (dim == 2 ? std::sqrt(Real(Neighbours::lanes)) : 2) * spacing,
                0.5 * spacing, most_cells(core.count));
  // cells beyond them, where ghosts and the halo may be that they meet
  Vec more = Vec::Constant(reach);
  if (dim == 2) more[2] = 0;
  const Vec low = core.low - more, high = core.high + more;
  if (ghosts)
    grid.cover(low, high);
  else if (halo.count > 0)
    grid.cover(core.low.cwiseMin(halo.low.cwiseMax(low)), core.high.cwiseMax(halo.high.cwiseMin(high)));
  else
    grid.cover(core.low, core.high);
}

}  // namespace

Real Neighbours::largest_h(const Particles& p) {
  return p.size() > 0 ? maximum(p.size(), [&](Index i) { return p.h[i]; }) : 0;
}

/// To where it is at time t.
void Neighbours::move_dormant(Particles& p, Index i, Real t) const {
  if (p.state[i] == particle_waiting)
    p.x.set(i, start_->vec(i) + p.v.vec(i) * t);
  else if (rebuilds_ > 0)
    p.x.set(i, p.x.vec(i) + p.v.vec(i) * (t - p.dormant_time));
}

// Dormant particles stand in the order in which they wake.
Index Neighbours::take_due(World& world, Real t) {
  Particles& p = world.particles;
  Index n = 0;
  for (; first_due_ < waking_.size() && waking_[first_due_] <= t; ++first_due_, ++n)
    move_dormant(p, p.moving + n, t);
  return n;
}

/// Whether a particle that waits at an inlet stays dormant where all others are looked at again.
bool Neighbours::sleeps_on(const Particles& p, Index i, Real t) const {
  return i >= p.moving && p.state[i] == particle_waiting && waking_time(p, i) > t;
}

void Neighbours::wake_all(World& world, Real t) {
  Particles& p = world.particles;
  h_queued_ = largest_h(p);
  const Index first = p.moving;
  for_each(p.size() - first, [&](Index k) { move_dormant(p, first + k, t); });
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

/// Whether all particles [begin, end) are active, so that single ones need no test.
bool Neighbours::all_active(const Particles& p, Index begin, Index end) const {
  const Index* state = p.state.data();
  bool other = false;
  for (Index i = begin; i < end; ++i)
    other |= state[i] == particle_deactivated || state[i] == particle_waiting;
  if (other || !region_) return !other;
  const Real* const x[3] = {p.x.data(0), p.x.data(1), p.x.data(2)};
  return loops_.inside(region_->low.data(), region_->high.data(), x, begin, end) == end - begin;
}

void Neighbours::sort(World& world, const Clock& clock, Index n, bool all) {
  Particles& p = world.particles;
  if (all) h_max_ = h_queued_;
  const Real near = support_ * h_max_ + most_skin_ + waking_margin * h_max_;
  const Real unit = volume_unit * std::exp2(std::ceil(world.dim * std::log2(h_max_ > 0 ? h_max_ : 1)));
  group_.resize(n);
  const auto bounds_of = [&](Index begin, Index end) {
    const auto b = loops_.bounds(
        {{p.x.data(0), p.x.data(1), p.x.data(2)}, p.h.data(), p.m.data(), p.rho.data()}, unit, begin, end);
    return Extent{Vec(b.low), Vec(b.high), b.h_max, b.h_min, b.volume, 0, b.broken};
  };
  const auto extent_of = [&](Index begin, Index end) {
    if (all_active(p, begin, end)) {
      std::fill(group_.begin() + begin, group_.begin() + end, group_active);
      Extents e{bounds_of(begin, end), {}};
      e.active.count = end - begin;
      return e;
    }
    Extents e;
    for (Index i = begin; i < end; ++i) {
      Extent one = bounds_of(i, i + 1);
      const bool asleep = all && sleeps_on(p, i, clock.t), active = !asleep && is_solved_for(p, i);
      const bool far =
          !active && all && p.state[i] != particle_waiting && time_to_reach(p, i, p.x.vec(i), near) > 0;
      group_[i] = p.state[i] == particle_deactivated || far || asleep ? group_dormant
                  : active                                            ? group_active
                                                                      : group_halo;
      e.active.lost = e.active.lost || one.lost;
      if (group_[i] == group_dormant) continue;
      one.count = 1;
      (group_[i] == group_active ? e.active : e.halo).add(one);
    }
    return e;
  };
  Extents e = reduce(n, Extents{}, extent_of, [](Extents a, const Extents& b) {
    a.active.add(b.active), a.halo.add(b.halo);
    return a;
  });
  if (e.active.lost || e.halo.lost) stop_for_lost_particles(world, clock, n);
  const Index count = e.active.count + e.halo.count;
  if (count > 0) h_max_ = std::max(e.active.h_max, e.halo.h_max);
  h_min_ = count > 0 ? std::min(e.active.h_min, e.halo.h_min) : h_max_;
  if (rebuilds_ == 0 && count > 0) grid_.set_origin(e.active.count > 0 ? e.active.low : e.halo.low);
  choose_cells(grid_, world.dim, e.active, e.halo, h_max_, support_ * h_max_ + most_skin_, !ghosts_.empty());

  const Index cells = grid_.total();
  key_.resize(n);
  find_cells(p, 0, n, key_.data());
  const bool some_rest = e.active.count < n;
  if (some_rest)
    for_each(
        n, [&](Index i) { key_[i] = group_[i] == group_dormant ? 2 * cells : group_[i] * cells + key_[i]; });
  counting_sort(key_, some_rest ? 2 * cells + 1 : cells, starts_, order_);
  sort_cells_by_id(p, some_rest ? 2 * cells : cells);
  p.active = e.active.count;
  p.moving = count;
  take_cell_starts(cells);
  if (all) order_dormant(p);
}

/// Within each cell, so that nothing of the order of before is left. What is sorted is mostly in order
/// already.
void Neighbours::sort_cells_by_id(const Particles& p, Index cells) {
  constexpr Index few = 16;
  const Id* id = p.id.data();
  const Index* starts = starts_.data();
  Index* order = order_.data();
  for_each(cells, [=](Index c) {
    const Index begin = starts[c], end = starts[c + 1];
    if (end - begin > few)
      std::sort(order + begin, order + end, [id](Index a, Index b) { return id[a] < id[b]; });
    else
      for (Index k = begin + 1; k < end; ++k) {
        const Index one = order[k];
        Index to = k;
        for (; to > begin && id[order[to - 1]] > id[one]; --to) order[to] = order[to - 1];
        order[to] = one;
      }
  });
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
  const Real reach = support_ * (h_changes_ ? h_growth : 1) * h_queued_ + most_skin_;
  if (p.state[i] == particle_waiting) return time_to_reach(p, i, start_->vec(i), reach);
  return p.dormant_time + time_to_reach(p, i, p.x.vec(i), reach);
}

// From when on it may wake, by itself alone: which others there are depends on ENDTIM.
Real Neighbours::waking_time(const Particles& p, Index i) const {
  const Real due = due_time(p, i), speed = p.v.vec(i).norm();
  if (!(due < std::numeric_limits<Real>::infinity())) return std::numeric_limits<Real>::infinity();
  return speed > 0 ? due - waking_margin * h_queued_ / speed : due;
}

// Behind the moving particles: those first that wake first.
void Neighbours::order_dormant(const Particles& p) {
  std::vector<Real> waking(p.size());
  for (std::size_t k = p.moving; k < order_.size(); ++k) waking[order_[k]] = waking_time(p, order_[k]);
  std::sort(order_.begin() + p.moving, order_.end(), [&](Index a, Index b) {
    return waking[a] != waking[b] ? waking[a] < waking[b] : p.id[a] < p.id[b];
  });
}

void Neighbours::queue_dormant(const Particles& p) {
  first_due_ = 0;
  waking_.resize(static_cast<std::size_t>(p.size() - p.moving));
  due_.resize(waking_.size());
  Real next = std::numeric_limits<Real>::infinity();
  for (std::size_t k = due_.size(); k-- > 0;) {
    const Index i = p.moving + static_cast<Index>(k);
    waking_[k] = waking_time(p, i);
    due_[k] = next = std::min(next, due_time(p, i));
  }
}

/// After loading: with a later ENDTIM more particles wait, behind all others, than the state has.
void Neighbours::queue_more_that_wait(Particles& p) {
  for (Index i = p.moving; i < p.size(); ++i)
    if (p.state[i] == particle_waiting) move_dormant(p, i, p.dormant_time);
  order_.resize(static_cast<std::size_t>(p.size()));
  std::iota(order_.begin(), order_.end(), Index(0));
  order_dormant(p);
  if (!std::is_sorted(order_.begin(), order_.end())) p.fields.permute(order_);
  queue_dormant(p);
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
    if (i < p.moving && time_to_reach(p, i, p.x.vec(i), near) > 0) ++gone_;
  }
}

}  // namespace courant
