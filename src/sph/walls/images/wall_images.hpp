#pragma once
// METHOD 1 of *COURANT_WALL_SUPPORT: walls of shells act as mirrors.
#include <algorithm>
#include <cstdint>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

#include "sph/core/pair_volumes.hpp"
#include "sph/walls/images/wall_paths.hpp"
#include "sph/walls/wall_edge_loops.hpp"
#include "sph/walls/wall_support.hpp"

namespace courant {

/// Sums over the image particles behind walls (see `WallPaths`), less the part of plain pair sums that
/// walls hide. Here j is an image particle and w the visible share of its path:
///   d rho_i/dt += rho_i sum w V_j (v_i - v_j) . grad W_ij,
///   f_i -= V_i sum w V_j (p_i + p_j) grad W_ij.
/// The force follows from the density rate, so energy is conserved. The path from j to i is the reverse of
/// the path from i to j, so forces along a plane wall cancel between particles. Density diffusion includes
/// image particles, with the hydrostatic pressure behind the wall. Viscosity includes them where every
/// wall on the path is a no-slip wall (LAW 2). Each wall mirrors the velocity about its own, v_j -> 2 w -
/// v_j:
///   f_i += V_i sum w V_j (mu_i + mu_j)(v_i - v_j) (dW/dr)/r.
/// A wall receives 2 f_i per path and its reverse (half from each), with opposite sign for each further
/// wall. The work of the walls is the work of these forces.
///
/// Moving walls are rigid bodies. Then v_j is the velocity of the image, which follows the wall. Walls
/// receive the reaction of each path through its derivatives with respect to their positions
/// (`WallDerivative`), on the nodes of the face that the path meets. Linear and angular momentum are
/// conserved.
///
/// At the edge of a wall, w depends on the positions of i and j and enters both sums:
///   d rho_i/dt += rho_i sum V_j W_ij dw/dt,   f_i -= V_i sum V_j (p_i + p_j) W_ij dw/dx_i.
/// Density then depends on positions alone, not on the history, and the forces conserve energy.
class WallImages : public Rate, public Refresh, public EnergyTerm, public Restartable {
 public:
  WallImages(const SphSettings& s, World& world, std::shared_ptr<Neighbours> neighbours,
             std::shared_ptr<PairVolumes> volumes, std::shared_ptr<WallSupport> support);
  std::string name() const override { return "wall images (rates)"; }
  void declare(const World& world, Accesses& a) const override;
  void start(World& world, const Clock& clock) override;
  void block(World& world, const Clock&, Index begin, Index end) override;
  void refreshed(World& world, const Clock&, std::span<const Index>) override;
  void keep(Archive& archive) override;
  void relist(World& world) override;
  /// Work of moving surfaces.
  void record(World& world, const Clock& clock, EnergyLedger& ledger) override;
  void sample(const World&, const Clock&, EnergyLedger&) const override {}

  void declare_forces(const World& world, Accesses& a) const;
  void start_forces(const Clock& clock);
  void forces(World& world, Index begin, Index end);
  /// Computes the fraction of dw/dx at edges that the next step ignores. The edge terms are for water that
  /// flows around an edge: a path that the wall no longer reflects reaches water on the other side.
  /// Without water there, the surface is free.
  void weigh_edges(World& world);
  /// Adds the reactions of all blocks to the nodes of moving walls.
  void give_reactions(World& world) const;

 private:
  void look(World& world);
  void search(const World& world);
  void find_sub_domain(const Particles& p, Index i);
  void find_held_sub_domain(const Particles& p, Index i);
  void find_flat(const Particles& p, Index i);
  void find_moving_edge(const Particles& p, Index i);
  /// Forces on the nodes of a moving segment [ML/T2].
  struct Reaction {
    Index segment;
    std::array<Vec, 4> on_node{Vec::Zero(), Vec::Zero(), Vec::Zero(), Vec::Zero()};
  };
  /// Viewpoints of particle i in the middle of the step and, where needed, at its end.
  struct Viewpoints {
    Index i = -1;
    bool knows_end = false;
    WallPaths::Viewpoint middle, end;
  };
  /// Work arrays of a block of particles.
  struct Block {
    std::vector<Viewpoints> viewpoints;       ///< of a group of particles, filled on demand
    std::vector<WallPath> paths;              ///< in this step, by particles
    std::vector<WallDerivative> derivatives;  ///< of paths
    std::vector<WallDerivative> now;          ///< of the current path
    WallPaths::Sheets in_middle;              ///< of the current particle, at the middle of the step
    std::vector<Reaction> reactions;
    Real belt_power = 0;       ///< of moving surfaces on water [ML2/T3]
    std::vector<Index> doubt;  ///< WallMirrorArrays
    std::vector<unsigned char> doubt_lanes;
    Index doubts = 0;
    bool has_moving_edges = false;
    std::vector<WallEdgeReaction> edge_reactions;  ///< of its particles
    std::vector<std::uint32_t> edge_paths;         ///< WallMirrorArrays
  };
  Viewpoints& viewpoints(const Particles& p, Index i, Block& block) const;
  void add_paths(Particles& p, Index i, Index j, Block& block);
  void add_paths_at_end(const Particles& p, Index j, Viewpoints& from, std::vector<WallPath>& to,
                        std::vector<WallDerivative>* derivatives = nullptr) const;
  void update_sheets(Index i, Block& block);
  void add_paths_of_moving(Particles& p, Index i, Index j, Block& block);
  void update_edges_in_middle(Index begin, Index end, Block& block);
  void update_edges_at_end(Index begin, Index end, const Block& block);
  void react_of_edges(const Particles& p, Index begin, Index end, Block& block) const;
  struct Flat;
  bool has_flat_to_itself(const Particles& p, Index i) const;
  void add_flat_rate(Particles& p, Index i) const;
  void add_flat_forces(Particles& p, Index i, Block& block) const;
  void react(const Particles& p, const WallPath& path, const Vec& force, Real per_share, Block& block) const;
  void give(const WallDerivative& derivative, Real times, Block& block) const;
  const WallPaths& at_end() const { return any_moves_ ? *paths_from_ : support_->visibility()->paths(); }
  const WallPaths::Sheets& sheets(Index i) const {
    return any_moves_ ? sheets_[static_cast<std::size_t>(i)] : support_->visibility()->of(i).sheets;
  }
  /// Whether moving walls are in sight of particle i.
  bool any_moves_among(Index i) const {
    return any_moves_ &&
           std::any_of(sheets(i).begin(), sheets(i).end(), [](const auto& s) { return s.body >= 0; });
  }
  bool sees(Index i) const { return support_->is_near(i) && !sheets(i).empty(); }
  /// Whether particle i is computed by the loops over sub-domains and edges in this step.
  bool in_sub_domain(Index i) const {
    const auto k = static_cast<std::size_t>(i);
    return (sub_domains_[k] || edges_[k]) && skipped_[k] == 0;
  }
  WallMirrorArrays arrays(Particles& p, Index begin);
  WallMirrorArrays arrays_of_rates(Particles& p, Index begin);
  WallMirrorArrays arrays_of_forces(Particles& p, Index begin);
  void add_doubtful_paths(Particles& p, Index begin, Block& block);
  const WallSurface& surface() const { return surface_ ? *surface_ : support_->surface(); }
  /// (dW/dr)/r [1/L^(dim+2)]
  Real slope(Real h, const Vec& d) const;
  /// W [1/L^dim]
  Real kernel(Real h, const Vec& d) const;
  Vec speed(const Particles& p, const WallPath& path) const;
  void drag(Particles& p, const WallPath& path, Block& block) const;
  void add_rate(Particles& p, const WallPath& path, const std::vector<WallDerivative>& derivatives);
  /// Fraction of the change of w that is not ignored (see `weigh_edges`). [-]
  Real kept(const WallPath& path) const;

  int dim_;
  Real delta_, half_step_ = 0;
  BodyAcceleration loads_;
  BodyAcceleration::At now_;
  std::shared_ptr<Neighbours> neighbours_;
  std::shared_ptr<PairVolumes> volumes_;
  std::shared_ptr<WallSupport> support_;
  Field<Real>&pressure_, &force_, &edge_loss_;
  std::array<std::vector<Real>, 2> edge_sum_;  ///< of this step, by particles
  Field<Real>*diffusion_, *potential_ = nullptr;
  /// With no-slip walls; `viscous_` without turbulence.
  Field<Real>*viscosity_ = nullptr, *heat_ = nullptr, *drag_ = nullptr, *viscous_ = nullptr;
  SupportedWalls walls_;
  bool mixed_ = false;            ///< walls differ in their friction law
  Real width_, spacing_, reach_;  ///< of edge transitions; of wall points; of the search [L]
  bool any_moves_;
  std::optional<WallSurface> surface_;     ///< where walls move: at the last refresh
  std::vector<Index> nodes_;               ///< of walls that move
  std::vector<Vec> searched_at_;           ///< where these were then
  std::optional<WallPaths> paths_from_;    ///< where walls move: now
  std::optional<WallPaths> in_middle_;     ///< where walls move: in the middle of the step
  std::vector<WallPaths::Sheets> sheets_;  ///< where walls move: of active particles, since the last refresh
  std::vector<Index> flats_;  ///< a face of the one flat wall that is in sight and moves, since then; else -1
  std::vector<char> before_flat_;  ///< whether the sums of this step are those over its images alone
  const AnyKernel* kernel_;
  WallMirrorLoop sub_domain_rates_, sub_domain_forces_, edge_rates_, edge_forces_;
  std::vector<const WallSubDomain*> sub_domains_;  ///< of those that see walls, since then
  std::vector<std::unique_ptr<WallSubDomain>> own_sub_domains_;
  std::vector<const WallEdge*> edges_;  ///< of those that are beside one and have no closed sub-domain
  std::vector<std::optional<WallEdge>> own_edges_;
  std::vector<std::optional<WallPaths::LoneEdge>> moving_edges_;  ///< where walls move: those that do
  std::vector<char> skipped_;                                     ///< WallMirrorArrays
  std::vector<Block> blocks_;
};

/// Forces of image particles; comes after the pair forces.
std::shared_ptr<Force> make_wall_image_forces(std::shared_ptr<WallImages> images);

}  // namespace courant
