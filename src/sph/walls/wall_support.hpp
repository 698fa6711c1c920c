#pragma once
// What walls of shells add to the sums of particles that they cut off.
#include <memory>
#include <optional>
#include <vector>

#include "sph/sph.hpp"
#include "sph/walls/images/wall_outlooks.hpp"
#include "sph/walls/wall_corner_tables.hpp"
#include "sph/walls/wall_surface.hpp"
#include "sph/walls/wall_tables.hpp"
#include "state/reports.hpp"
#include "state/restartable.hpp"

namespace courant {

/// The sums of a particle beside a wall lack what is behind it. With the divergence theorem that is an
/// integral over the wall (De Leffe et al. 2009): b_i = int n W dS, n out of the water. Behind it stands the
/// mirror image of particle i itself, with its pressure and the opposite velocity through the wall, that of
/// the wall being w:
///   d rho_i/dt += 2 rho_i int (v_i - w).n W dS,   f_i -= 2 V_i p_i b_i, p with that of bulk viscosity.
/// The second is what belongs to the first, so that energy is kept. Where gradients are renormalised, walls
/// complete the moment matrix by int (x' - x_i) (x) n W dS + 1 int W dV behind the wall, and its inverse B
/// is before b and n as before other gradients. Friction: tau = CF rho |v - w|^2/2 along the wall, given
/// to the particles that see it, whose kernels make up half of 1 there. With LAW 1, tau = rho u*^2 by the
/// distance and velocity of each of them (wall_law.hpp). With LAW 2, no slip, tau = mu |v - w|/y: what
/// viscosity between pairs lacks if behind the wall v goes on linearly; with METHOD 1 images do that.
///
/// Walls that move get what particles lose, piece by piece, on the nodes of the segment as it interpolates.
///
/// Spray, which has fewer neighbours than it takes to span the plane or space, has no sums to complete;
/// contact alone holds it off. Else its own mirror image would hold a drop to the wall by tension, without
/// end, and the drop would swing against the stiff contact until it is driven through.
class WallSupport : public Rate,
                    public Refresh,
                    public EnergyTerm,
                    public Restartable,
                    public WallForceReporter,
                    public PointForceReporter {
 public:
  WallSupport(const SphSettings& s, World& world, const Neighbours& neighbours);
  std::string name() const override { return "wall support"; }
  void declare(const World& world, Accesses& a) const override;
  void start(World& world, const Clock& clock) override;
  void block(World& world, const Clock& clock, Index begin, Index end) override;

  /// Force of the walls on a particle, pressure and friction.
  Vec force_on(const Particles& p, Index i) const;
  /// What `WallSupportForce` adds of it: all but that of images, which is there already.
  Vec own_force_on(const Particles& p, Index i) const;
  void declare_force(const World& world, Accesses& a) const;
  void start_forces(const World& world);
  /// Adds the force of walls without slip; METHOD 1 has images for that.
  void hold(Particles& p, Index i);
  bool is_near(Index i) const { return view_[i] != nothing; }
  const WallSurface& surface() const { return *surface_; }
  bool any_moves() const { return any_moves_; }
  /// How far particle i sees walls until neighbours are searched next: nobody moves farther than half the
  /// skin until then. [L]
  Real sight_until_search(const Particles& p, Index i) const {
    return sight(p, i) + 0.51 * neighbours_.skin();
  }
  /// What particles see of walls, where it is known by positions: all are held, and reach one h.
  const WallOutlooks* outlooks() const { return outlooks_ ? &*outlooks_ : nullptr; }
  /// The sub-domain of a particle that sees any wall; null: none.
  const WallRoom* room(Index i) const { return outlooks_ ? rooms_[static_cast<std::size_t>(i)] : nullptr; }
  /// By which moving surfaces go in this step. [-]
  const std::vector<Real>& belt_factors() const { return belt_factors_; }

  /// What a particle does to a segment that moves.
  struct Reaction {
    Index segment;
    std::array<Vec, 4> on_node;  ///< forces [ML/T2]
  };
  /// Appends those of particle i.
  void add_reactions(const Particles& p, Index i, std::vector<Reaction>& to) const;

  void refreshed(World& world, const Clock&, std::span<const Index>) override;
  void keep(Archive& archive) override;
  void relist(World& world) override;

  // What friction takes over the step, by the mean of the velocities before and after the kick.
  void record(World& world, const Clock& clock, EnergyLedger& ledger) override;
  void sample(const World&, const Clock&, EnergyLedger&) const override {}

  InterfaceForce report(const World& world) const override;
  /// Shares the force on a particle among the shells that it sees and that do not move.
  void show_forces(World& world) override;
  void report_point_forces(const World& world, const std::function<void(const PointForce&)>& take) override;
  void take_back_forces(World& world);

 private:
  struct Sums {
    Vec slope = Vec::Zero(), wall_velocity = Vec::Zero(), wall_slide = Vec::Zero();
    Real squeeze = 0;  ///< int (v - w).n W dS in the middle of the step [1/T]
    Real fill = 0, rubbing = 0;
    Matrix moment = Matrix::Zero(), gradient = Matrix::Zero();
  };
  void rebuild(const World& world);
  struct Share {
    Index segment = -1;
    Real weight = 0;          ///< of the force on a particle, not normed
    Vec away = Vec::Zero();   ///< the same as a vector, along the normal of the segment
    Vec point = Vec::Zero();  ///< weighted sum of the pieces' positions, not normed [L]
  };
  /// Calls `take(segment, point, force)` with what particles that are near walls do to the segments they see.
  template <class Take>
  void share_forces(const World& world, const Take& take);
  void look_for_rooms(const Particles& p);
  bool are_alike(Index face, Index other) const;
  /// Whether walls are looked at in every step: they move, and something is summed over their pieces.
  bool follows() const { return any_moves_ && (!image_force_ || integrates_ || rubs_); }
  void measure_h(const World& world);
  Index look(const Particles& p, Index i) const;
  bool is_spray(const Particles& p, Index i) const;
  void set(Index i, const Sums& sums);
  Vec corrected_slope(Index i) const;
  /// A velocity of particle i less that of the walls that rub it.
  Vec over_wall(Index i, const Vec& v) const;
  Vec friction_on(const Particles& p, Index i, const Vec& v) const;
  const WallFriction& friction_of(Index face) const { return walls_.friction[surface_->segment_of(face)]; }
  Vec belt_velocity(const WallPoint& q) const;
  /// What walls without slip do, and what they turn into heat and get by moving surfaces.
  struct Hold {
    Vec force = Vec::Zero();
    Real heat = 0, belt_power = 0;  ///< [ML2/T3]
  };
  Hold hold_on(const Particles& p, Index i) const;
  Real held_by(const Particles& p, Index i, const WallPoint& q, const Vec& away) const;
  /// Shear stress of a face over rho u^2/2 for a particle there; `wall`: the velocity of the face [L/T]
  Real friction_coefficient(const Particles& p, Index i, Index face, const Vec& wall) const;
  Sums sums_over_points(const Particles& p, Index i, Real half_step) const;
  Sums sums_over_plane(const Particles& p, Index i, Index face, Real half_step) const;
  Sums sums_in_room(const Particles& p, Index i, const WallRoom& room, Real half_step) const;
  Real hold_in_room(const Particles& p, Index i, const WallRoom& room) const;
  Real kernel(Real h, const Vec& d) const {
    return table_.kernel(d.norm() / h) / (dim_ == 2 ? power<2>(h) : power<3>(h));
  }
  Real volume_behind(Real h, const Vec& d, const Vec& away) const;
  /// `WallSurface::for_each_seen` of particle i.
  template <class F>
  void for_each_seen(const Particles& p, Index i, Real within, F&& f) const {
    const std::vector<Index>* const among = outlooks_ ? &outlooks_->of(i).points : nullptr;
    if (among && !among->empty())
      surface_->for_each_seen(p.x.vec(i), within, *among, std::forward<F>(f));
    else
      surface_->for_each_seen(p.x.vec(i), within, std::forward<F>(f));
  }
  /// From how near pieces of wall have to do with particle i. [L]
  Real sight(const Particles& p, Index i) const { return table_.support() * p.h[i]; }

  int dim_;
  bool evolving_h_, any_moves_ = false;
  Real past_edges_ = 0;     ///< so much farther METHOD 1 looks [L]
  bool integrates_ = true;  ///< the integrals over walls are needed for more than friction
  WallTables table_;
  Real spacing_;  ///< of particles [L]
  std::optional<WallCornerTables> corners_;
  Field<Real>&slope_, &fill_;
  Field<Real>& pressure_;  ///< with that of bulk viscosity, as pair forces take it
  Field<Real>& rubbing_;
  Field<Real>*velocity_ = nullptr,
  *slide_ = nullptr;  ///< where walls move or moving surfaces; where moving surfaces do
  Field<Real>*viscosity_ = nullptr, *viscous_ = nullptr;  ///< where walls hold water fast, METHOD 0
  Field<Real>* image_force_ = nullptr;                    ///< METHOD 1
  Field<Real>*moment_ = nullptr, *gradient_ = nullptr, *excess_ = nullptr;  ///< where forms are renormalised
  const Neighbours& neighbours_;
  SupportedWalls walls_;
  std::vector<char> moves_;  ///< by segment
  Real least_y_ = 0;         ///< nearer particles rub as if they were there [L]
  std::vector<Real> belt_factors_;
  std::vector<Hold> holds_;        ///< sums of each block in this step
  Real least_h_ = 0, most_h_ = 0;  ///< when neighbours were searched last [L]
  std::optional<WallSurface> surface_;
  std::optional<WallOutlooks> outlooks_;
  std::vector<const WallRoom*> rooms_;  ///< of active particles, since neighbours were searched
  std::vector<std::unique_ptr<WallRoom>> own_rooms_;
  std::vector<Real> mu_;  ///< per part, 0: none [M/LT]
  /// Of active particles, until the next refresh, or where walls move the next step: `nothing`, `pieces` or a
  /// face of the one plane they see.
  std::vector<Index> view_;
  static constexpr Index nothing = -2, pieces = -1;
  /// Of pieces: the kernel's integral over a plane is then right to 1e-5 from 0.3 h on.
  static constexpr Real points_per_h = 4;
  bool one_law_ = true;       ///< of friction for all walls
  bool rubs_ = false;         ///< any wall
  std::vector<Index> shown_;  ///< segments that have forces of this step
};

}  // namespace courant
