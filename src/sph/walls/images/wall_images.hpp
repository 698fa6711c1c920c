#pragma once
// What walls of shells do as mirrors of the water beside them.
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

/// Sums over the images of particles in the walls (`WallPaths`), and what walls hide taken off plain sums;
/// j represents an image, w for the share of its path:
///   d rho_i/dt += rho_i sum w V_j (v_i - v_j) . grad W_ij,
///   f_i -= V_i sum w V_j (p_i + p_j) grad W_ij,
/// the second what belongs to the first, so that energy is kept; and since the path back is the same, forces
/// along a plane wall cancel between particles. The diffusion of density sees images, too, with the pressure
/// that is behind the wall at rest. Viscosity does where all walls of a way hold water fast (LAW 2), each
/// of which turns velocities round about its own, v_j -> 2 w - v_j:
///   f_i += V_i sum w V_j (mu_i + mu_j)(v_i - v_j) (dW/dr)/r,
/// and what walls hide of it is taken off. A wall gets, of a way and of the path back half, 2 f_i, with the
/// sign turned at each further wall: all that particles lose, and what it does to them is its work.
///
/// Where walls move as rigid bodies, v_j is that of the image, which goes along with the wall, and walls get
/// what particles lose by what each way changes with them (`WallPull`), on the nodes of the face that it goes
/// through: forces keep momentum and its moment, and what walls do to the water they lose.
///
/// Where a wall ends, w changes with the positions of i and j, and belongs to both sums:
///   d rho_i/dt += rho_i sum V_j W_ij dw/dt,   f_i -= V_i sum V_j (p_i + p_j) W_ij dw/dx_i,
/// so that density depends on where particles are, not on how they came there, and forces keep their energy.
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
  /// What the next step leaves out of changes of shares at edges: they belong to water that goes round an
  /// edge, where a way that walls throw no longer back sees water instead. Where that is missing the surface
  /// is free.
  void weigh_edges(World& world);
  /// Gives walls that move what blocks have for them.
  void give_reactions(World& world) const;

 private:
  void look(World& world);
  void search(const World& world);
  void find_room(const Particles& p, Index i);
  void find_held_room(const Particles& p, Index i);
  void find_flat(const Particles& p, Index i);
  void find_moving_edge(const Particles& p, Index i);
  /// What a segment that moves gets, on its nodes [ML/T2].
  struct Reaction {
    Index segment;
    std::array<Vec, 4> on_node{Vec::Zero(), Vec::Zero(), Vec::Zero(), Vec::Zero()};
  };
  /// From where particle i sees what it does, in the middle of the step and, if anybody asks, at its end.
  struct Outlook {
    Index i = -1;
    bool knows_end = false;
    WallPaths::Standpoint middle, end;
  };
  /// Of a block of particles.
  struct Block {
    std::vector<Outlook> outlooks;  ///< of a group, once any sees ways
    std::vector<WallPath> paths;    ///< in this step, by particles
    std::vector<WallPull> pulls;    ///< of paths
    std::vector<WallPull> now;      ///< of the path at hand
    WallPaths::Sheets in_middle;    ///< of the particle at hand, where walls are in the middle of the step
    std::vector<Reaction> reactions;
    Real belt_power = 0;       ///< of moving surfaces on water [ML2/T3]
    std::vector<Index> doubt;  ///< WallMirrorArrays
    std::vector<unsigned char> doubt_lanes;
    Index doubts = 0;
    bool has_moving_edges = false;
    std::vector<WallEdgePull> edge_pulls;  ///< of its particles
    std::vector<std::uint32_t> ways;       ///< WallMirrorArrays
  };
  Outlook& outlook(const Particles& p, Index i, Block& block) const;
  void add_ways(Particles& p, Index i, Index j, Block& block);
  void add_ways_at_end(const Particles& p, Index j, Outlook& from, std::vector<WallPath>& to,
                       std::vector<WallPull>* pulls = nullptr) const;
  void place_sheets(Index i, Block& block);
  void add_ways_of_moving(Particles& p, Index i, Index j, Block& block);
  void place_edges_in_middle(Index begin, Index end, Block& block);
  void place_edges_at_end(Index begin, Index end, const Block& block);
  void react_of_edges(const Particles& p, Index begin, Index end, Block& block) const;
  struct Flat;
  bool has_flat_to_itself(const Particles& p, Index i) const;
  void add_flat_rate(Particles& p, Index i) const;
  void add_flat_forces(Particles& p, Index i, Block& block) const;
  void react(const Particles& p, const WallPath& path, const Vec& force, Real per_share, Block& block) const;
  void give(const WallPull& pull, Real times, Block& block) const;
  const WallPaths& at_end() const { return any_moves_ ? *paths_from_ : support_->outlooks()->paths(); }
  const WallPaths::Sheets& sheets(Index i) const {
    return any_moves_ ? sheets_[static_cast<std::size_t>(i)] : support_->outlooks()->of(i).sheets;
  }
  /// Whether particle i sees walls that move.
  bool any_moves_among(Index i) const {
    return any_moves_ &&
           std::any_of(sheets(i).begin(), sheets(i).end(), [](const auto& s) { return s.body >= 0; });
  }
  bool sees(Index i) const { return support_->is_near(i) && !sheets(i).empty(); }
  /// Whether the loops over rooms and edges look at particle i in this step.
  bool in_room(Index i) const {
    const auto k = static_cast<std::size_t>(i);
    return (rooms_[k] || edges_[k]) && strange_[k] == 0;
  }
  WallMirrorArrays arrays(Particles& p, Index begin);
  WallMirrorArrays arrays_of_rates(Particles& p, Index begin);
  WallMirrorArrays arrays_of_forces(Particles& p, Index begin);
  void add_doubtful_ways(Particles& p, Index begin, Block& block);
  const WallSurface& surface() const { return surface_ ? *surface_ : support_->surface(); }
  /// (dW/dr)/r [1/L^(dim+2)]
  Real slope(Real h, const Vec& d) const;
  /// W [1/L^dim]
  Real kernel(Real h, const Vec& d) const;
  Vec speed(const Particles& p, const WallPath& path) const;
  void drag(Particles& p, const WallPath& path, Block& block) const;
  void add_rate(Particles& p, const WallPath& path, const std::vector<WallPull>& pulls);
  /// Of how its share changes, what is not left out.
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
  /// Where walls hold water fast; `viscous_` where there is no turbulence.
  Field<Real>*viscosity_ = nullptr, *heat_ = nullptr, *drag_ = nullptr, *viscous_ = nullptr;
  SupportedWalls walls_;
  bool mixed_ = false;            ///< walls that hold, rub or slide differently
  Real width_, spacing_, reach_;  ///< of edges; of pieces of wall that are searched; of anybody's look [L]
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
  WallMirrorLoop room_rates_, room_forces_, edge_rates_, edge_forces_;
  std::vector<const WallRoom*> rooms_;  ///< of those that see walls, since then
  std::vector<std::unique_ptr<WallRoom>> own_rooms_;
  std::vector<const WallEdge*> edges_;  ///< of those that are beside one and have no closed room
  std::vector<std::optional<WallEdge>> own_edges_;
  std::vector<std::optional<WallPaths::LoneEdge>> moving_edges_;  ///< where walls move: those that do
  std::vector<char> strange_;                                     ///< WallMirrorArrays
  std::vector<Block> blocks_;
};

/// What images do to forces; belongs behind the pair forces.
std::shared_ptr<Force> make_wall_image_forces(std::shared_ptr<WallImages> images);

}  // namespace courant
