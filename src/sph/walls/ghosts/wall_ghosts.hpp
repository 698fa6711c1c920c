#pragma once
// METHOD 2 of *COURANT_WALL_SUPPORT: fixed ghost particles behind shells.
#include <memory>
#include <vector>

#include "search/neighbours.hpp"
#include "sph/core/pair_volumes.hpp"
#include "sph/sph.hpp"
#include "sph/walls/ghosts/ghost_lattice.hpp"
#include "sph/walls/ghosts/ghost_loops.hpp"
#include "state/reports.hpp"
#include "state/restartable.hpp"

namespace courant {

/// The position and the axes of a rigid part, made of three of its nodes.
class PartFrame {
 public:
  /// `nodes`: those of its shells.
  PartFrame(const World& world, std::vector<Index> nodes);
  struct Pose {
    Vec x = Vec::Zero();
    Matrix axes = Matrix::Identity();
    Vec from(const Vec& local) const { return x + axes * local; }
    Vec to(const Vec& global) const { return axes.transpose() * (global - x); }
  };
  Pose pose(const World& world) const;
  WallMotion motion(const World& world) const;

 private:
  int dim_;
  std::array<Index, 3> node_{};  ///< far apart, and not on one line; in 2D two of them
};

/// Ghosts continue the lattice of the water behind the shells and move with these. Their volume is that of
/// a particle at rest; they have no mass, so artificial viscosity does not act on them. Before each force
/// pass they take the pressure of the water (Adami, Hu and Adams 2012), including the acceleration of
/// walls with prescribed motion. (The acceleration of other walls follows from the pressure and would
/// cause oscillations.) Ordinary pair loops do the rest. Compression of water against the wall compresses
/// the ghosts: their density rate is passed to the particles in proportion to their weight in the
/// pressure, so that walls at rest do no work. Moving parts receive the pair forces on their ghosts.
class WallGhosts : public Ghosts,
                   public Rate,
                   public Refresh,
                   public Restartable,
                   public EnergyTerm,
                   public WallForceReporter,
                   public PointForceReporter {
 public:
  /// `laid`: initial positions. `driven`, by part: prescribed motion.
  WallGhosts(const SphSettings& s, World& world, const std::vector<WallGhost>& laid,
             const std::vector<char>& driven);
  /// Call before the first refresh. `copies`: copies of these ghosts behind planes; null: no planes.
  void set_lists(const Neighbours& neighbours, std::shared_ptr<const GhostParticles> copies) {
    neighbours_ = &neighbours, copies_ = std::move(copies);
  }
  void set_volumes(std::shared_ptr<PairVolumes> volumes) { volumes_ = std::move(volumes); }

  std::string name() const override { return "wall ghosts"; }
  void build(World& world, Real support, Real skin) override;
  Index count() const override { return static_cast<Index>(here_.size()); }
  void sort(World& world, std::span<const Index> order) override;
  Real largest_move(const World& world) const override;
  void exchange(World& world, std::span<const FieldBase* const> fields) override;
  void exchange_all(World& world) override;

  void declare(const World& world, Accesses& a) const override;
  void start(World& world, const Clock& clock) override;
  void block(World& world, const Clock& clock, Index begin, Index end) override;

  void refreshed(World& world, const Clock&, std::span<const Index>) override { relist(world); }
  void keep(Archive& archive) override;
  void relist(World& world) override;

  /// Work of ghosts, from the mean pressure of particles, except for the weighting between these and the
  /// ghosts.
  void record(World& world, const Clock& clock, EnergyLedger& ledger) override;
  void sample(const World&, const Clock&, EnergyLedger&) const override {}

  bool any_moves() const { return frames_.size() > 1; }
  /// Pressure of particles as pair forces take it.
  const Field<Real>& pressure() const { return pressure_; }
  /// Adds the pair forces on ghosts to the nodes and faces of moving or fixed parts.
  void add_forces(World& world, bool moving) const;
  void take_back_forces(World& world);

  InterfaceForce report(const World& world) const override;
  void show_forces(World& world) override;
  void report_point_forces(const World& world, const std::function<void(const PointForce&)>& take) override;

 private:
  struct Ghost {
    Vec x;  ///< in the axes of its frame [L]
    Index segment;
    Index frame;  ///< 0: fixed
  };
  struct List {  ///< of a block, by groups
    std::vector<Index> entries;
    std::array<Index, Neighbours::groups_per_block + 1> start{};
  };
  struct Box {
    Vec low, high;
  };
  void find_poses(const World& world, std::vector<PartFrame::Pose>& poses) const;
  void set_positions(World& world, const std::vector<PartFrame::Pose>& poses) const;
  void set_velocities(World& world) const;
  void follow_driven(const World& world, const Clock& clock);
  void set_pressures(World& world);
  GhostArrays arrays(World& world);
  template <class Add>
  static void fill_lists(Index n, std::vector<List>& lists, const Add& add);
  template <class Loop>
  void run(Loop loop, const GhostArrays& a) const;
  const Ghost& ghost(Index k) const {
    return all_[static_cast<std::size_t>(here_[static_cast<std::size_t>(k)])];
  }
  Vec force(Index k) const { return {force_[0][k], force_[1][k], force_[2][k]}; }

  int dim_;
  KernelChoice kernel_;
  Real h_ = 0, volume_ = 0;
  Index part_ = 0;  ///< of the water, for loads
  BodyAcceleration loads_;
  BodyAcceleration::At loads_now_;
  Field<Real>& pressure_;
  Field<Real>* potential_ = nullptr;  ///< where density diffuses
  Field<Real>* stress_ = nullptr;
  GhostLoop rate_loop_, squeeze_loop_, pressure_loop_;
  const Neighbours* neighbours_ = nullptr;  ///< that include the ghosts
  std::shared_ptr<const GhostParticles> copies_;
  std::shared_ptr<PairVolumes> volumes_;
  std::vector<Ghost> all_;
  std::vector<PartFrame> frames_;            ///< the first one is fixed
  std::vector<char> driven_;                 ///< by frame
  std::vector<Vec> velocity_, omega_;        ///< of driven frames in the step before [L/T], [1/T]
  std::vector<Vec> acceleration_, angular_;  ///< of driven frames; 0 in the first step [L/T2], [1/T2]
  std::vector<Box> boxes_;                   ///< around the ghosts of each frame, in its axes
  std::vector<PartFrame::Pose> built_;       ///< frames at the last neighbour search
  bool loaded_ = false;                      ///< `built_` comes from a saved state
  std::vector<Index> here_;                  ///< ghosts within reach of the water, in the order of entities
  std::vector<List> lists_, seen_;  ///< of each block of ghosts, the particles near; of particles, the ghosts
  Array<Real> rise_[3], force_[3], value_, excess_, excess_before_, saved_excess_, squeeze_, volume_rate_;
  Real half_step_ = 0;        ///< half of the last step that was chosen [T]
  std::vector<Index> shown_;  ///< segments with forces in this step
};

/// *COURANT_WALL_SUPPORT with METHOD 2: lays the ghosts; null where the scene has none. Call while particles
/// are in the order of the model.
std::shared_ptr<WallGhosts> build_wall_ghosts(const Deck& deck, const Model& model, const SphSettings& s,
                                              World& world, Diagnostics& diagnostics);
/// Behind the pair passes.
void add_wall_ghost_forces(World& world, std::shared_ptr<WallGhosts> ghosts);

}  // namespace courant
