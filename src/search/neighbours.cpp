#include "search/neighbours.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "base/run_error.hpp"
#include "parallel/copy.hpp"
#include "parallel/counting_sort.hpp"

namespace courant {

namespace {

/// A step that moves a particle this many smoothing lengths has left every limit: TSSFAC h/(c + v) is less
/// than one.
constexpr Real longest_leap = 2;

}  // namespace

/// Looks whether something moved so far that lists may miss a pair.
class Neighbours::Watch : public Preparation {
 public:
  explicit Watch(const Neighbours& lists) : lists_(lists) {}
  std::string name() const override { return "neighbours"; }
  void declare(const World& world, Accesses& a) const override {
    const Particles& p = world.particles;
    a.reads(p.x).reads(p.h);
    if (lists_.inlet_) a.reads(p.state).reads(*lists_.inlet_);
  }

  void start(World& world, const Clock&) override { prepare(world); }
  void block(World& world, const Clock&, Index begin, Index end) override {
    look(world.particles, begin, end);
  }
  void finish(World&, const Clock&) override { looked_ = true; }

  bool stale(World& world, const Clock& clock) {
    if (!looked_) {
      prepare(world);
      for_each_block(world.particles.moving,
                     [&](Index begin, Index end) { look(world.particles, begin, end); });
    }
    looked_ = false;
    const bool due = lists_.first_due_ < lists_.due_.size() && lists_.due_[lists_.first_due_] <= clock.t;
    return due || std::find(stale_.begin(), stale_.end(), 1) != stale_.end() || lists_.nodes_moved(world);
  }
  /// Since the lists were built [L]
  Real largest_move() const {
    return moved2_.empty() ? 0 : std::sqrt(*std::max_element(moved2_.begin(), moved2_.end()));
  }

 private:
  void prepare(const World& world) {
    stale_.resize(block_count(world.particles.moving));
    moved2_.resize(stale_.size());
  }
  void look(const Particles& p, Index begin, Index end) {
    const Real* const x[3] = {p.x.data(0), p.x.data(1), p.x.data(2)};
    const auto [most2, within] =
        lists_.loops_.moved({{x[0], x[1], x[2]},
                             p.h.data(),
                             {lists_.x_built_.data(), lists_.y_built_.data(),
                              lists_.z_built_.empty() ? nullptr : lists_.z_built_.data()},
                             lists_.h_built_.empty() ? nullptr : lists_.h_built_.data(),
                             lists_.support_},
                            0.5 * lists_.skin_, begin, end);
    bool stale = !within;
    const auto inside = [&](Index first, Index last) {
      return lists_.loops_.inside(lists_.region_->low.data(), lists_.region_->high.data(), x, first, last);
    };
    const Index active_end = std::clamp(p.active, begin, end);
    if (lists_.region_) stale |= inside(begin, active_end) != active_end - begin;
    if (lists_.inlet_)
      for (Index i = active_end; i < end; ++i) stale |= lists_.is_solved_for(p, i);
    else if (lists_.region_)
      stale |= inside(active_end, end) != 0;
    stale_[begin / block_size] = stale;
    moved2_[begin / block_size] = most2;
  }
  const Neighbours& lists_;
  bool looked_ = false;
  std::vector<char> stale_;
  std::vector<Real> moved2_;
};

Neighbours::Neighbours(Real skin, std::optional<Region> region, Real support)
    : skin_(skin),
      least_skin_(skin),
      most_skin_(skin),
      support_(support),
      region_(std::move(region)),
      watch_(std::make_shared<Watch>(*this)) {}

void Neighbours::adapt_skin(Real least, Real most, Real weight) {
  skin_weight_ = weight;
  least_skin_ = least;
  most_skin_ = most;
  skin_ = std::clamp(skin_, least, most);
}

void Neighbours::set_inlets(std::vector<InletPlane> planes, const Field<Index>& inlet,
                            const Field<Real>& start) {
  inlets_ = std::move(planes);
  inlet_ = &inlet;
  start_ = &start;
}

/// Where it is now. Particles that MAXV switched off are not asked about.
bool Neighbours::is_solved_for(const Particles& p, Index i) const {
  const Vec x = p.x.vec(i);
  return (!region_ || region_->contains(x[0], x[1], x[2])) &&
         (p.state[i] != particle_waiting || inlets_[(*inlet_)[i]].behind(x));
}

/// How long until a particle at x that is not solved for, with constant velocity, can be within `reach` of
/// where it would be. [T]
Real Neighbours::time_to_reach(const Particles& p, Index i, const Vec& x, Real reach) const {
  const Vec v = p.v.vec(i);
  Real time = region_ ? region_->time_to_reach(x, v, reach) : 0;
  if (p.state[i] == particle_waiting) time = std::max(time, inlets_[(*inlet_)[i]].time_to_reach(x, v, reach));
  return time;
}

std::shared_ptr<Preparation> Neighbours::watch() {
  return watch_;
}

bool Neighbours::refresh(World& world, const Clock& clock) {
  if (built_ && !watch_->stale(world, clock)) return false;
  if (built_) stop_for_leaps(world, clock);
  Particles& p = world.particles;
  const Index active_before = p.active;
  bool all = !built_ || must_wake_all(world);
  if (all) wake_all(world, clock.t);
  const Index n = all ? p.size() : p.moving + take_due(world, clock.t);
  // the last ones were due: those that are still far sleep on from where they are now. How many wait at
  // inlets depends on ENDTIM
  if (!all && n == p.size() && !inlet_) {
    all = true;
    h_queued_ = largest_h(p);
    p.dormant_time = clock.t;
  }
  choose_skin(clock);
  for (const GhostRange& range : ghosts_) range.ghosts->bring_back(world, n);
  sort(world, clock, n, all);
  p.fields.permute(order_);
  note_changes(p, active_before);
  if (all) queue_dormant(p);
  build_ghosts(world);
  build_lists(world);
  remember_places(world, clock);
  built_ = true;
  ++rebuilds_;
  for (Refresh* r : world.passes.all<Refresh>()) r->refreshed(world, clock, order_);
  return true;
}

// Before their last step particles had moved half a skin at most, or the lists would be younger. Who goes
// further in one step passes others and walls unseen.
void Neighbours::stop_for_leaps(const World& world, const Clock& clock) const {
  const Particles& p = world.particles;
  if (!(watch_->largest_move() > longest_leap * h_max_)) return;
  for (Index i = 0; i < p.active; ++i) {
    const Vec before(x_built_[i], y_built_[i], world.dim == 3 ? z_built_[i] : p.x.vec(i)[2]);
    const Real moved = (p.x.vec(i) - before).norm();
    if (!(moved - 0.5 * skin_ > longest_leap * p.h[i]) || !std::isfinite(moved)) continue;
    throw RunError(
        fmt::format("particle {} of part {} moved {:.4g} smoothing lengths in the step to time {:.6g}, "
                    "cycle {}: no pair and no wall on its path was found",
                    p.id[i], world.part_id(i), moved / p.h[i], clock.t, clock.cycle),
        StopCause::leap);
  }
}

Real Neighbours::room(const Clock& clock) const {
  return 0.5 * skin_ - (clock.cycle > built_cycle_ ? watch_->largest_move() : 0);
}

// A skin s costs pairs out of reach, about 0.7 s/h of those within, which take half the time of others, in
// every step, and a rebuild, some two to three steps' pairs, every s/(2 move) steps. The sum is least for s
// of about sqrt(2 x 2.5/0.35 move h).
void Neighbours::choose_skin(const Clock& clock) {
  if (least_skin_ == most_skin_ || !built_ || clock.cycle <= built_cycle_) return;
  const Real move = watch_->largest_move() / static_cast<Real>(clock.cycle - built_cycle_);
  skin_ = std::clamp(std::sqrt(skin_weight_ * move * h_max_), least_skin_, most_skin_);
}

void Neighbours::GroupNeighbours::make_room(Index more) {
  const auto grow = [more](std::vector<Index>& to, Index count) {
    if (static_cast<Index>(to.size()) <= count + more) to.resize(2 * (count + more) + 64);
  };
  grow(within, found.within_count), grow(beyond, found.beyond_count);
  found.within = within.data(), found.beyond = beyond.data();
}

/// The box around the entities of a query.
static std::pair<Vec, Vec> box_of(const Particles& p, const NearQuery& q) {
  Vec low = p.x.vec(q.first), high = low;
  for (Index k = 1; k < q.count; ++k) {
    const Vec x = p.x.vec(q.first + k);
    low = low.cwiseMin(x);
    high = high.cwiseMax(x);
  }
  return {low, high};
}

void Neighbours::find_list_of_group(const World& world, const NearQuery& q, Scratch& scratch) const {
  const auto [low, high] = box_of(world.particles, q);
  for (GroupNeighbours* to : {&scratch.other, &scratch.later, &scratch.earlier}) to->found = {};
  const auto look = [&](Index begin, Index end, GroupNeighbours& to) {
    if (begin >= end) return;
    to.make_room(end - begin);
    near_.find(q, begin, end, to.found);
  };
  const Index last = q.first + q.count;
  grid_.near(low, high, support_ * h_max_ + skin_, [&](Index first_cell, Index last_cell) {
    const Index begin = active_start_[first_cell], end = active_start_[last_cell + 1];
    if (whole()) look(begin, std::min(end, q.first), scratch.earlier);
    look(std::max(begin, q.first), std::min(end, last), scratch.other);
    look(std::max(begin, last), end, scratch.later);
    if (!halo_start_.empty()) look(halo_start_[first_cell], halo_start_[last_cell + 1], scratch.other);
    for (const GhostRange& range : ghosts_)
      look(range.starts[first_cell], range.starts[last_cell + 1], scratch.other);
  });
}

void Neighbours::add_active_near(const World& world, Index first, Index count, std::vector<Index>& to) const {
  const Particles& p = world.particles;
  const NearQuery q{p.x.data(0), p.x.data(1), world.dim == 3 ? p.x.data(2) : nullptr,
                    p.h.data(),  first,       count,
                    skin_,       support_,    h_min_ == h_max_};
  const auto [low, high] = box_of(p, q);
  thread_local GroupNeighbours near;
  near.found = {};
  const auto look = [&](Index begin, Index end) {
    if (begin >= end) return;
    near.make_room(end - begin);
    near_.find(q, begin, end, near.found);
  };
  grid_.near(low, high, support_ * h_max_ + skin_, [&](Index first_cell, Index last_cell) {
    look(active_start_[first_cell], active_start_[last_cell + 1]);
    for (const GhostRange& range : ghosts_)
      if (range.ghosts->first() + range.ghosts->count() <= first)
        look(range.starts[first_cell], range.starts[last_cell + 1]);
  });
  to.insert(to.end(), near.within.begin(), near.within.begin() + near.found.within_count);
  to.insert(to.end(), near.beyond.begin(), near.beyond.begin() + near.found.beyond_count);
}

void Neighbours::build_ghosts(World& world) {
  Particles& p = world.particles;
  Index first = p.size();
  std::vector<Index> order;
  for (auto& [ghosts, starts] : ghosts_) {
    ghosts->set_first(first);
    ghosts->build(world, support_ * h_max_, skin_);
    const Index n = ghosts->count();
    key_.resize(n);
    find_cells(p, first, first + n, key_.data());
    counting_sort(key_, grid_.total(), starts, order);
    for (Index& start : starts) start += first;
    ghosts->sort(world, order);
    first += n;
  }
}

std::map<Index, Vec> Neighbours::brought_back() const {
  std::map<Index, Vec> all;
  for (const GhostRange& range : ghosts_)
    for (const auto& [part, shift] : range.ghosts->brought_back())
      all.try_emplace(part, Vec::Zero()).first->second += shift;
  return all;
}

Index Neighbours::particle_of(const Particles& p, Index j) const {
  for (auto range = ghosts_.rbegin(); range != ghosts_.rend() && j >= p.size(); ++range)
    if (j >= range->ghosts->first()) j = range->ghosts->source(j - range->ghosts->first());
  return j;
}

void Neighbours::build_lists(World& world) {
  const Particles& p = world.particles;
  const Index n = p.active;
  blocks_.resize(block_count(n));
  for_each_block(n, [&](Index begin, Index end) {
    Block& b = blocks_[begin / block_size];
    NearQuery q{p.x.data(0), p.x.data(1),     world.dim == 3 ? p.x.data(2) : nullptr, p.h.data(), 0, 0, skin_,
                support_,    h_min_ == h_max_};
    thread_local Scratch scratch;
    std::vector<Index>& all = scratch.all;
    all.clear();
    b.reach = end;
    const auto add = [&all](const std::vector<Index>& from, Index count) {
      all.insert(all.end(), from.begin(), from.begin() + count);
      return static_cast<Index>(all.size());
    };
    for (Index k = 0; k < groups_per_block; ++k) {
      const auto start = static_cast<Index>(all.size());
      ListSections& at = b.sections[k] = {start, start, start, start, start};
      b.start[k] = start;
      q.first = begin + k * lanes;
      q.count = std::min(lanes, end - q.first);
      if (q.count <= 0) continue;
      find_list_of_group(world, q, scratch);
      const GroupNeighbours &other = scratch.other, &later = scratch.later, &earlier = scratch.earlier;
      at.later = add(other.within, other.found.within_count);
      at.beyond = add(later.within, later.found.within_count);
      at.later_end = add(later.beyond, later.found.beyond_count);
      if (at.later_end > at.later)
        b.reach = std::max(b.reach, 1 + *std::max_element(all.begin() + at.later, all.end()));
      at.earlier = add(other.beyond, other.found.beyond_count);
      at.earlier_beyond = add(earlier.within, earlier.found.within_count);
      add(earlier.beyond, earlier.found.beyond_count);
    }
    b.start[groups_per_block] = static_cast<Index>(all.size());
    std::copy(all.begin(), all.end(), b.list.grow_to(all.size()));
  });
  std::vector<Index> reach;
  entries_ = entries_once_ = 0;
  for (Index b = 0; b < blocks(); ++b) {
    entries_ += entries(b), entries_once_ += entries_once(b);
    reach.push_back(blocks_[b].reach);
  }
  if (tasks_wanted_) tasks_.cut(n, block_costs(), reach);
  share_blocks(world);
}

std::vector<double> Neighbours::block_costs() const {
  std::vector<double> cost;
  for (Index b = 0; b < blocks(); ++b)
    cost.push_back((tasks_wanted_ ? entries_once(b) : entries(b)) + 2.0 * block_size);
  return cost;
}

void Neighbours::share_blocks(World& world) const {
  world.shares = tasks_wanted_ ? tasks_.shares() : Shares::of(block_costs());
  world.moving_shares = Shares::even(block_count(world.particles.moving));
}

void Neighbours::cut_tasks() {
  if (built_ && !tasks_wanted_) throw std::logic_error("tasks are asked for too late");
  tasks_wanted_ = true;
}

void Neighbours::need_whole_lists() {
  if (built_ && !whole()) throw std::logic_error("whole lists are asked for too late");
  whole_needed_ = true;
}

Index Neighbours::entries_once(Index b) const {
  const Block& block = blocks_[b];
  Index n = 0;
  for (Index k = 0; k < groups_per_block; ++k) n += block.sections[k].earlier - block.start[k];
  return n;
}

void Neighbours::remember_places(const World& world, const Clock& clock) {
  const Particles& p = world.particles;
  const Index n = p.moving;
  copy(p.x.data(0), n, x_built_), copy(p.x.data(1), n, y_built_);
  z_built_.clear(), h_built_.clear();
  if (world.dim == 3) copy(p.x.data(2), n, z_built_);
  if (h_changes_) copy(p.h.data(), n, h_built_);
  built_cycle_ = clock.cycle;
  if (rebuilds_ == 0) find_moving_nodes(world);
  nodes_built_.clear();
  for (const Index k : moving_nodes_) nodes_built_.push_back(world.nodes.x.vec(k));
}

void Neighbours::find_moving_nodes(const World& world) {
  std::vector<char> on_face(static_cast<std::size_t>(world.nodes.size()), 0);
  for (Index s = 0; s < world.segments.size(); ++s)
    for (const Index k : world.segments.nodes(s)) on_face[static_cast<std::size_t>(k)] = 1;
  moving_nodes_.clear();
  for (Index k = 0; k < world.nodes.size(); ++k)
    if (!world.nodes.held[k] && on_face[static_cast<std::size_t>(k)]) moving_nodes_.push_back(k);
}

bool Neighbours::nodes_moved(const World& world) const {
  for (const GhostRange& range : ghosts_)
    if (!(range.ghosts->largest_move(world) < 0.5 * skin_)) return true;
  for (std::size_t k = 0; k < moving_nodes_.size(); ++k)
    if (!((world.nodes.x.vec(moving_nodes_[k]) - nodes_built_[k]).norm() < 0.5 * skin_)) return true;
  return false;
}

std::vector<Index> Neighbours::of(const Particles& p, Index i) const {
  std::vector<Index> out;
  const auto add_if_near = [&](Index j) {
    if (j != i && (p.x.vec(i) - p.x.vec(j)).norm() < support_ * std::max(p.h[i], p.h[j])) out.push_back(j);
  };
  for (const Index j : listed(i / lanes)) add_if_near(j);
  if (whole()) return out;
  const Tasks::Task& first = tasks_[tasks_[tasks_.of_block(i / block_size)].earliest];
  for (Index g = first.begin / lanes; g < i / lanes; ++g) {
    const Block& b = blocks_[g / groups_per_block];
    const ListSections& at = b.sections[g % groups_per_block];
    const Index *later = b.list.data() + at.later, *end = b.list.data() + at.later_end;
    if (std::find(later, end, i) == end) continue;
    for (Index j = g * lanes; j < (g + 1) * lanes; ++j) add_if_near(j);
  }
  return out;
}

}  // namespace courant
