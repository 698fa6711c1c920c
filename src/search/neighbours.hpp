#pragma once
#include <array>
#include <optional>
#include <span>
#include <vector>

#include "parallel/parallel.hpp"
#include "state/world.hpp"

namespace courant {

/// Sorts particles by cell, sets which of them are active, and keeps a Verlet list for each active particle:
/// every particle within 2 max(h_i, h_j) + skin. The lists hold until something (particles, or shell nodes
/// that contact looks at) moved or grew by half the skin. Each list is filled up with the padding particle
/// (index `particles.size()`) to a multiple of `lanes`, so that pair loops need no remainder.
class Neighbours {
 public:
  static constexpr Index lanes = 8;

  struct Region {  ///< the computational box (CONTROL_SPH BOXID); without one, every particle is active
    Vec low, high;
    bool contains(Real x, Real y, Real z) const {
      return x >= low[0] && x <= high[0] && y >= low[1] && y <= high[1] && z >= low[2] && z <= high[2];
    }
    Real distance(Real x, Real y, Real z) const;
  };

  /// skin: dimension L, > 0.
  Neighbours(Real skin, std::optional<Region> region) : skin_(skin), region_(std::move(region)) {}

  /// Sorts and rebuilds if it must. Returns true if it did; then every Refresh of the world was told.
  /// Throws RunError naming a particle whose place is no longer a finite number.
  bool refresh(World& world, const Clock& clock);
  void force_refresh() { built_ = false; }

  std::span<const Index> padded(Index i) const {
    const Block& b = blocks_[i / block_size];
    const Index k = i % block_size;
    return {b.list.data() + b.start[k], static_cast<std::size_t>(b.start[k + 1] - b.start[k])};
  }
  std::span<const Index> of(Index i) const {
    return padded(i).first(blocks_[i / block_size].count[i % block_size]);
  }

  Real skin() const { return skin_; }
  const std::optional<Region>& region() const { return region_; }
  /// Particles that became active or stopped being so (by leaving the box or by MAXV) at the last refresh;
  /// indices after sorting.
  const std::vector<Index>& entered() const { return entered_; }
  const std::vector<Index>& left() const { return left_; }
  std::int64_t rebuilds() const { return rebuilds_; }
  std::int64_t pairs() const;  ///< list entries without padding

 private:
  struct Block {
    std::vector<Index> list;
    std::array<Index, block_size + 1> start;
    std::array<Index, block_size> count;
  };
  struct Grid {
    Vec origin;
    Real inverse_size = 0;
    std::array<Index, 3> cells{1, 1, 1};
    Index total() const { return cells[0] * cells[1] * cells[2]; }
  };

  bool must_refresh(const World& world, const Clock& clock) const;
  void move_dormant(World& world, Real t);
  void stop_for_lost_particles(const World& world, const Clock& clock) const;
  void classify(World& world, std::vector<signed char>& group);
  void make_grid(const World& world, const std::vector<signed char>& group, Real cell_size);
  std::vector<Index> sorted_order(World& world, const std::vector<signed char>& group);
  void build_lists(const World& world);
  void remember_places(const World& world);
  void search_around(const World& world, Index i, std::vector<Index>& found, Index& count) const;
  std::array<Index, 3> cell_of(Real x, Real y, Real z) const;

  Real skin_;
  std::optional<Region> region_;
  bool built_ = false;
  Real built_at_ = 0;
  Real h_max_ = 0;
  Real dormant_speed_ = 0;
  Grid grid_;
  std::vector<Index> active_start_,
      rim_start_;  ///< first sorted particle of each cell, one longer than the cells
  std::vector<Block> blocks_;
  std::vector<Index> moving_nodes_;  ///< shell nodes that are not held: contact relies on the skin, too
  std::vector<Vec> nodes_built_;
  Array<Real> x_built_, y_built_, z_built_, h_built_;
  std::vector<Index> entered_, left_;
  std::int64_t rebuilds_ = 0;
};

}  // namespace courant
