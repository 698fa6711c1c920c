#include "search/neighbours.hpp"

#include <cmath>

#include <fmt/format.h>

#include "base/run_error.hpp"
#include "parallel/parallel.hpp"

namespace courant {

namespace {
enum Group : signed char { group_active = 0, group_rim = 1, group_dormant = 2 };
}

Real Neighbours::Region::distance(Real x, Real y, Real z) const {
  const Real dx = std::max({low[0] - x, x - high[0], Real(0)});
  const Real dy = std::max({low[1] - y, y - high[1], Real(0)});
  const Real dz = std::max({low[2] - z, z - high[2], Real(0)});
  return std::sqrt(dx * dx + dy * dy + dz * dz);
}

bool Neighbours::refresh(World& world, const Clock& clock) {
  if (built_ && !must_refresh(world, clock)) return false;
  Particles& p = world.particles;
  move_dormant(world, clock.t);
  stop_for_lost_particles(world, clock);
  const Index active_before = p.active;
  std::vector<signed char> group(p.size());
  classify(world, group);
  make_grid(world, group, 2 * h_max_ + skin_);
  const std::vector<Index> old_of_new = sorted_order(world, group);
  p.fields.permute(old_of_new);

  entered_.clear();
  left_.clear();
  for (Index i = 0; i < p.size(); ++i) {  // not by the state field: what MAXV switched off leaves, too
    const bool now = i < p.active;
    const bool before = old_of_new[i] < active_before;
    if (now && !before) entered_.push_back(i);
    if (!now && before) left_.push_back(i);
    if (p.state[i] != particle_deactivated) p.state[i] = now ? particle_active : particle_outside;
  }
  build_lists(world);

  remember_places(world);
  built_ = true;
  built_at_ = clock.t;
  ++rebuilds_;
  for (auto& r : world.refreshes) r->refreshed(world, clock, old_of_new);
  return true;
}

void Neighbours::remember_places(const World& world) {
  const Particles& p = world.particles;
  const Index n = p.moving;
  for (auto* copy : {&x_built_, &y_built_, &z_built_, &h_built_}) copy->resize(n);
  std::copy_n(p.x.data(0), n, x_built_.data());
  std::copy_n(p.x.data(1), n, y_built_.data());
  std::copy_n(p.x.data(2), n, z_built_.data());
  std::copy_n(p.h.data(), n, h_built_.data());
  if (rebuilds_ == 0)
    for (Index k = 0; k < world.nodes.size(); ++k)
      if (!world.nodes.held[k]) moving_nodes_.push_back(k);
  nodes_built_.clear();
  for (const Index k : moving_nodes_) nodes_built_.push_back(world.nodes.x.vec(k));
}

bool Neighbours::must_refresh(const World& world, const Clock& clock) const {
  const Particles& p = world.particles;
  if (dormant_speed_ * (clock.t - built_at_) > 0.5 * skin_) return true;
  const Real *x = p.x.data(0), *y = p.x.data(1), *z = p.x.data(2), *h = p.h.data();
  const Real* region_low = region_ ? region_->low.data() : nullptr;
  const Real* region_high = region_ ? region_->high.data() : nullptr;
  const Real reach = 0.5 * skin_;
  for (std::size_t k = 0; k < moving_nodes_.size(); ++k)
    if (!((world.nodes.x.vec(moving_nodes_[k]) - nodes_built_[k]).norm() < reach)) return true;
  // 1 where a particle moved too far, grew too much, or crossed the border of the box
  const Real moved = maximum(p.moving, [&](Index i) -> Real {
    const Real dx = x[i] - x_built_[i], dy = y[i] - y_built_[i], dz = z[i] - z_built_[i];
    const Real room = reach - std::max(h[i] - h_built_[i], Real(0));
    bool stale = room <= 0 || !(dx * dx + dy * dy + dz * dz < room * room);
    if (region_low) {
      const bool inside = x[i] >= region_low[0] && x[i] <= region_high[0] && y[i] >= region_low[1] &&
                          y[i] <= region_high[1] && z[i] >= region_low[2] && z[i] <= region_high[2];
      stale |= inside != (i < p.active);
    }
    return stale ? 1 : 0;
  });
  return moved > 0;
}

void Neighbours::move_dormant(World& world, Real t) {
  Particles& p = world.particles;
  if (!built_ && rebuilds_ == 0) return;
  const Real dt = t - built_at_;
  const Index first = p.moving;
  for_each(p.size() - first, [&](Index k) {
    const Index i = first + k;
    for (int d = 0; d < 3; ++d) p.x.data(d)[i] += p.v.data(d)[i] * dt;
  });
}

void Neighbours::stop_for_lost_particles(const World& world, const Clock& clock) const {
  const Particles& p = world.particles;
  for (Index i = 0; i < p.size(); ++i) {
    const Vec x = p.x.vec(i);
    if (x.allFinite() && std::isfinite(p.h[i])) continue;
    throw RunError(
        fmt::format("particle {} went to x = ({:.5g}, {:.5g}, {:.5g}) with h = {:.5g} [L] at time {:.6g}, "
                    "cycle {}: the run is "
                    "unstable",
                    p.id[i], x[0], x[1], x[2], p.h[i], clock.t, clock.cycle));
  }
}

void Neighbours::classify(World& world, std::vector<signed char>& group) {
  Particles& p = world.particles;
  h_max_ = p.size() ? maximum(p.size(), [&](Index i) { return p.h[i]; }) : 0;
  const Real reach = 2 * h_max_ + skin_;
  for_each(p.size(), [&](Index i) {
    const Real x = p.x.data(0)[i], y = p.x.data(1)[i], z = p.x.data(2)[i];
    if (p.state[i] == particle_deactivated)
      group[i] = group_dormant;
    else if (!region_ || region_->contains(x, y, z))
      group[i] = group_active;
    else
      group[i] = region_->distance(x, y, z) <= reach ? group_rim : group_dormant;
  });
  dormant_speed_ = 0;
  for (Index i = 0; i < p.size(); ++i)
    if (group[i] == group_dormant && p.state[i] != particle_deactivated)
      dormant_speed_ = std::max(dormant_speed_, p.v.vec(i).norm());
}

void Neighbours::make_grid(const World& world, const std::vector<signed char>& group, Real cell_size) {
  const Particles& p = world.particles;
  Vec low = Vec::Constant(std::numeric_limits<Real>::infinity()), high = -low;
  Index n = 0;
  for (Index i = 0; i < p.size(); ++i) {
    if (group[i] == group_dormant) continue;
    const Vec x = p.x.vec(i);
    low = low.cwiseMin(x);
    high = high.cwiseMax(x);
    ++n;
  }
  if (n == 0) low = high = Vec::Zero();
  grid_.origin = low;
  // A few far-flung particles must not make a grid larger than the particles themselves: then cells grow
  // instead.
  const Real most = 16.0 * n + 4096;
  Real size = cell_size > 0 ? cell_size : 1;
  while (((high - low) / size).array().floor().cwiseMin(1e9).unaryExpr([](Real c) { return c + 1; }).prod() >
         most)
    size *= 1.26;
  grid_.inverse_size = 1 / size;
  for (int d = 0; d < 3; ++d) grid_.cells[d] = static_cast<Index>((high[d] - low[d]) / size) + 1;
}

std::array<Index, 3> Neighbours::cell_of(Real x, Real y, Real z) const {
  const Real at[3] = {x, y, z};
  std::array<Index, 3> c{};
  for (int d = 0; d < 3; ++d) {
    const Real k = (at[d] - grid_.origin[d]) * grid_.inverse_size;
    c[d] = k > 0 ? (k < grid_.cells[d] - 1 ? static_cast<Index>(k) : grid_.cells[d] - 1) : 0;
  }
  return c;
}

std::vector<Index> Neighbours::sorted_order(World& world, const std::vector<signed char>& group) {
  Particles& p = world.particles;
  const Index n = p.size(), cells = grid_.total();
  std::vector<Index> key(n);
  for_each(n, [&](Index i) {
    const auto c = cell_of(p.x.data(0)[i], p.x.data(1)[i], p.x.data(2)[i]);
    key[i] = group[i] == group_dormant
                 ? 2 * cells
                 : group[i] * cells + (c[2] * grid_.cells[1] + c[1]) * grid_.cells[0] + c[0];
  });
  std::vector<Index> start(2 * cells + 2,
                           0);  // counting sort, stable: the same order on any number of threads
  for (Index i = 0; i < n; ++i) ++start[key[i] + 1];
  for (std::size_t k = 1; k < start.size(); ++k) start[k] += start[k - 1];
  active_start_.assign(start.begin(), start.begin() + cells + 1);
  rim_start_.assign(start.begin() + cells, start.begin() + 2 * cells + 1);
  p.active = start[cells];
  p.moving = start[2 * cells];
  std::vector<Index> old_of_new(n);
  for (Index i = 0; i < n; ++i) old_of_new[start[key[i]]++] = i;
  return old_of_new;
}

void Neighbours::search_around(const World& world, Index i, std::vector<Index>& found, Index& count) const {
  const Particles& p = world.particles;
  const Real *x = p.x.data(0), *y = p.x.data(1), *z = p.x.data(2), *h = p.h.data();
  const Real xi = x[i], yi = y[i], zi = z[i], hi = h[i];
  const auto c = cell_of(xi, yi, zi);
  const Index x0 = std::max(c[0] - 1, Index(0)), x1 = std::min(c[0] + 1, grid_.cells[0] - 1);
  count = 0;
  for (Index cz = std::max(c[2] - 1, Index(0)); cz <= std::min(c[2] + 1, grid_.cells[2] - 1); ++cz)
    for (Index cy = std::max(c[1] - 1, Index(0)); cy <= std::min(c[1] + 1, grid_.cells[1] - 1); ++cy) {
      const Index row = (cz * grid_.cells[1] + cy) * grid_.cells[0];
      for (const auto* start : {&active_start_, &rim_start_}) {
        const Index begin = (*start)[row + x0], end = (*start)[row + x1 + 1];
        if (static_cast<Index>(found.size()) < count + (end - begin) + 1)
          found.resize(2 * (count + (end - begin)) + 64);
        for (Index j = begin; j < end; ++j) {
          const Real dx = xi - x[j], dy = yi - y[j], dz = zi - z[j];
          const Real reach = 2 * std::max(hi, h[j]) + skin_;
          found[count] = j;
          count += (dx * dx + dy * dy + dz * dz < reach * reach) & (j != i);
        }
      }
    }
}

void Neighbours::build_lists(const World& world) {
  const Particles& p = world.particles;
  const Index n = p.active;
  const Index padding = p.size();
  blocks_.resize((n + block_size - 1) / block_size);
  for_each_block(n, [&](Index begin, Index end) {
    Block& b = blocks_[begin / block_size];
    b.list.clear();
    std::vector<Index> found(256);
    for (Index i = begin; i < end; ++i) {
      Index count = 0;
      search_around(world, i, found, count);
      b.start[i - begin] = static_cast<Index>(b.list.size());
      b.count[i - begin] = count;
      b.list.insert(b.list.end(), found.begin(), found.begin() + count);
      b.list.resize((b.list.size() + lanes - 1) / lanes * lanes, padding);
    }
    for (Index k = end - begin; k <= block_size; ++k) b.start[k] = static_cast<Index>(b.list.size());
  });
}

std::int64_t Neighbours::pairs() const {
  std::int64_t n = 0;
  for (std::size_t b = 0; b < blocks_.size(); ++b)
    for (Index k = 0; k < block_size; ++k)
      if (blocks_[b].start[k] < blocks_[b].start[k + 1]) n += blocks_[b].count[k];
  return n;
}

}  // namespace courant
