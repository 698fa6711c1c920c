#pragma once
#include <memory>
#include <optional>
#include <span>
#include <stdexcept>
#include <vector>

#include "parallel/buffer.hpp"
#include "parallel/parallel.hpp"
#include "search/cell_grid.hpp"
#include "search/ghosts.hpp"
#include "search/inlet_plane.hpp"
#include "search/list_sections.hpp"
#include "search/near_loops.hpp"
#include "search/region.hpp"
#include "search/tasks.hpp"
#include "state/particle_loops.hpp"
#include "state/restartable.hpp"
#include "state/world.hpp"

namespace courant {

/// Sorts particles so that near ones stand together, sets which of them are active, and keeps a Verlet list
/// for every eight active particles in a row (a group): all particles within support max(h_i, h_j) + skin of
/// any of them, itself included. So a pair loop loads eight particles i at once and takes one j after the
/// other, without gathering; a kernel of zero sorts out those that only other lanes need. ListSections tells
/// which entries none of the eight had within its support when lists were built, and which pairs the list of
/// another group has, too: a loop may work out each pair but once, from the entries of later groups, if it
/// adds to both particles. The lists hold until something (particles, or shell nodes that contact looks at)
/// moved or grew by half the skin.
class Neighbours {
 public:
  static constexpr Index lanes = 8;
  static constexpr Index groups_per_block = block_size / lanes;
  using Region = courant::Region;

  /// `skin`: > 0 [L]. `support`: how far the kernel reaches, in h.
  Neighbours(Real skin, std::optional<Region> region, Real support = 2);
  /// Chooses the skin anew at each rebuild, between the given bounds [L], so that rebuilding and looking at
  /// pairs out of reach together cost least at the present speed of particles: sqrt(weight h d) where they
  /// move d in a step. `weight`: what rebuilding costs against looking at entries, by measurement.
  void adapt_skin(Real least, Real most, Real weight);

  /// Smoothing lengths never change, so their growth need not be checked.
  void keep_h() { h_changes_ = false; }

  /// From now on the lists also hold these ghosts, as entities behind those added before.
  void add_ghosts(std::shared_ptr<Ghosts> ghosts) { ghosts_.push_back({std::move(ghosts), {}}); }
  /// Of each part, sum of mass times shift of the active particles that the last refresh brought back. [ML]
  std::map<Index, Vec> brought_back() const;
  /// The particle that entity j is, or is a copy of; -1: it is a ghost of none.
  Index particle_of(const Particles& p, Index j) const;
  /// Particles in the state particle_waiting become active when they cross the plane that `inlet` counts from
  /// 0 (and are inside the box, where there is one). At time t they are at `start` + v t, so that their last
  /// bits do not depend on when they woke. Call before the first refresh.
  void set_inlets(std::vector<InletPlane> planes, const Field<Index>& inlet, const Field<Real>& start);

  /// Sorts and rebuilds if necessary, then calls every Refresh of the world. Returns whether it did. Throws
  /// RunError naming a particle whose position is not a finite number.
  bool refresh(World& world, const Clock& clock);
  void force_refresh() { built_ = false; }

  /// The data of the next rebuild, with the positions of the last one. Lists are not kept: `restore`
  /// rebuilds them from those positions, with the same entries in the same order.
  void keep(Archive& archive);
  /// After loading: lists and ghosts, and with them what `restartables` make of them.
  void restore(World& world, const std::vector<std::pair<std::string, Restartable*>>& restartables);

  /// Looks, as the last pass of the motion stage, whether the lists still hold, so that `refresh` need not.
  std::shared_ptr<Preparation> watch();

  /// From now on blocks are shared by whole tasks, for loops that work out each pair once, and lists lack
  /// particles of earlier groups where nobody needs them.
  void cut_tasks();
  const Tasks& tasks() const { return tasks_; }
  /// Whole lists must be requested before the first refresh; with_whole_lists does this.
  void need_whole_lists();
  bool whole() const { return whole_needed_ || !tasks_wanted_; }
  /// Shares blocks among as many threads as there are now; `refresh` does it, too.
  void share_blocks(World& world) const;

  /// The neighbours of group `g` = particles [8 g, 8 g + 8).
  std::span<const Index> of_group(Index g) const {
    expect_whole();
    return listed(g);
  }
  /// The same, or only those whose pairs no earlier group has.
  std::span<const Index> listed(Index g) const {
    const Block& b = blocks_[g / groups_per_block];
    const Index k = g % groups_per_block;
    return {b.list.data() + b.start[k], static_cast<std::size_t>(b.start[k + 1] - b.start[k])};
  }
  void expect_whole() const {
    if (!whole()) throw std::logic_error("lists of neighbours hold each pair once");
  }
  /// Entries of the lists of block `b`, and where the list of its k-th group starts among them.
  Index entries(Index b) const { return blocks_[b].start[groups_per_block]; }
  Index entries_once(Index b) const;  ///< of block `b`, but for those of particles of earlier groups
  Index blocks() const { return static_cast<Index>(blocks_.size()); }
  const Index* starts(Index b) const { return blocks_[b].start.data(); }
  const ListSections* sections(Index b) const { return blocks_[b].sections.data(); }
  const Index* list(Index b) const { return blocks_[b].list.data(); }

  Real skin() const { return skin_; }
  /// So far every particle may still move before the lists must be built anew, as of the last `refresh`. [L]
  Real room(const Clock& clock) const;
  Real largest_skin() const { return most_skin_; }
  Real support() const { return support_; }
  const std::optional<Region>& region() const { return region_; }
  /// Particles that became active or stopped being so (by leaving the box or by MAXV) at the last refresh;
  /// indices after sorting.
  const std::vector<Index>& entered() const { return entered_; }
  const std::vector<Index>& left() const { return left_; }
  std::int64_t rebuilds() const { return rebuilds_; }
  std::int64_t entries() const { return entries_; }  ///< of all lists
  std::int64_t entries_once() const { return entries_once_; }

  /// Appends the active particles within support + skin of any of `count` <= 8 ghosts from entity `first` on,
  /// as of the last rebuild, and such ghosts of those added before.
  void add_active_near(const World& world, Index first, Index count, std::vector<Index>& to) const;

  /// Calls `visit(begin, end)` with ranges of active particles that hold all within their support of the box
  /// low..high [L].
  template <class Visit>
  void active_near(const Vec& low, const Vec& high, const Visit& visit) const {
    if (active_start_.empty()) return;
    grid_.near(low, high, support_ * h_max_ + skin_, [&](Index first, Index last) {
      const Index begin = active_start_[first], end = active_start_[last + 1];
      if (begin < end) visit(begin, end);
    });
  }

  /// Others within support max(h_i, h_j) of particle i, active here. For tests and reports: slow.
  std::vector<Index> of(const Particles& p, Index i) const;

 private:
  struct Block {
    Buffer<Index> list;
    std::array<Index, groups_per_block + 1> start;
    std::array<ListSections, groups_per_block> sections;
    Index reach;  ///< behind the last particle that has a list among its entries
  };
  /// What the search finds for a group among particles of one kind.
  struct GroupNeighbours {
    std::vector<Index> within, beyond;
    NearFound found{};
    void make_room(Index more);
  };
  struct GhostRange {
    std::shared_ptr<Ghosts> ghosts;
    std::vector<Index> starts;  ///< as active_start_
  };
  struct Scratch {
    GroupNeighbours other, later, earlier;  ///< see ListSections
    std::vector<Index> all;                 ///< of a block
  };
  class Watch;

  bool is_solved_for(const Particles& p, Index i) const;
  Real time_to_reach(const Particles& p, Index i, const Vec& x, Real reach) const;
  Index take_due(World& world, Real t);
  void wake_all(World& world, Real t);
  bool sleeps_on(const Particles& p, Index i, Real t) const;
  void move_dormant(Particles& p, Index i, Real t) const;
  static Real largest_h(const Particles& p);
  bool must_wake_all(const World& world) const;
  void stop_for_leaps(const World& world, const Clock& clock) const;
  void stop_for_lost_particles(const World& world, const Clock& clock, Index n) const;
  void choose_skin(const Clock& clock);
  bool all_active(const Particles& p, Index begin, Index end) const;
  void sort(World& world, const Clock& clock, Index n, bool all);
  void sort_cells_by_id(const Particles& p, Index cells);
  void find_cells(const Particles& p, Index first, Index last, Index* cell) const;
  void take_cell_starts(Index cells);
  void order_dormant(const Particles& p);
  void queue_dormant(const Particles& p);
  void queue_more_that_wait(Particles& p);
  Real due_time(const Particles& p, Index i) const;
  Real waking_time(const Particles& p, Index i) const;
  void note_changes(Particles& p, Index active_before);
  void build_ghosts(World& world);
  void count_cells(const World& world);
  void build_lists(World& world);
  std::vector<double> block_costs() const;
  void find_list_of_group(const World& world, const NearQuery& query, Scratch& scratch) const;
  void remember_places(const World& world, const Clock& clock);
  bool nodes_moved(const World& world) const;
  void find_moving_nodes(const World& world);

  Real skin_, least_skin_, most_skin_;
  Real skin_weight_ = 0;
  Real support_;  ///< of the kernel, in h
  std::optional<Region> region_;
  std::vector<InletPlane> inlets_;
  const Field<Index>* inlet_ = nullptr;  ///< of waiting particles; null: there are none
  NearLoops near_ = near_loops();
  ParticleLoops loops_ = particle_loops();
  bool built_ = false, h_changes_ = true;
  std::int64_t built_cycle_ = 0;
  Real h_max_ = 0, h_min_ = 0;
  CellGrid grid_;
  std::vector<GhostRange> ghosts_;
  /// First sorted particle of each cell, and the end: parts of starts_; empty: there are none.
  std::span<const Index> active_start_, halo_start_;
  std::vector<Index> starts_;
  std::vector<Block> blocks_;
  std::int64_t entries_ = 0, entries_once_ = 0;
  bool tasks_wanted_ = false, whole_needed_ = false;
  Tasks tasks_;
  std::vector<Real> due_;               ///< when one of waking_[k] and those behind may come within reach [T]
  std::size_t first_due_ = 0;           ///< the entry of waking_ and due_ that belongs to particle `moving`
  const Field<Real>* start_ = nullptr;  ///< where waiting particles were at t = 0 [L]
  Real h_queued_ = 0;                   ///< the largest h when these were made [L]
  Index gone_ = 0;                      ///< halo particles that are far from the box
  std::vector<Index> order_, key_;      // of sorting: before, by position; cells
  std::vector<signed char> group_;
  std::vector<Index> moving_nodes_;  ///< shell nodes that are not held: contact relies on the skin, too
  std::vector<Vec> nodes_built_;
  Array<Real> x_built_, y_built_, z_built_, h_built_;  ///< z and h: empty where they do not change
  std::shared_ptr<Watch> watch_;
  std::vector<Index> entered_, left_;
  std::int64_t rebuilds_ = 0;
  std::vector<Real> waking_;  ///< when dormant particles wake if lists are built then, ascending [T]
};

inline std::shared_ptr<Neighbours> with_whole_lists(std::shared_ptr<Neighbours> neighbours) {
  neighbours->need_whole_lists();
  return neighbours;
}

}  // namespace courant
