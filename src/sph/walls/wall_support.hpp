#pragma once
// Wall support: completes the sums of particles whose kernel a wall of shells cuts off.
#include <memory>
#include <optional>
#include <vector>

#include "sph/sph.hpp"
#include "sph/walls/images/wall_visibility.hpp"
#include "sph/walls/wall_corner_tables.hpp"
#include "sph/walls/wall_surface.hpp"
#include "sph/walls/wall_tables.hpp"
#include "state/reports.hpp"
#include "state/restartable.hpp"

namespace courant {

/// Beside a wall, the kernel of a particle is cut off. By the divergence theorem the missing part is an
/// integral over the wall (De Leffe et al. 2009): b_i = int n W dS, n out of the water. Behind the wall is
/// the mirror image of particle i itself, with its pressure and the opposite normal velocity relative to
/// the wall velocity w:
///   d rho_i/dt += 2 rho_i int (v_i - w).n W dS,   f_i -= 2 V_i p_i b_i, p including bulk viscosity.
/// The force follows from the density rate, so energy is conserved. With renormalised gradients, walls add
/// int (x' - x_i) (x) n W dS + 1 int W dV (behind the wall) to the moment matrix, and its inverse B
/// multiplies b and n as it does other gradients. Friction: tau = CF rho |v - w|^2/2 along the wall,
/// shared by the particles in sight of it, whose kernels sum to 1/2 there. LAW 1: tau = rho u*^2 from the
/// distance and velocity of each particle (wall_law.hpp). LAW 2, no slip: tau = mu |v - w|/y, the viscous
/// part that pairs lack if v continues linearly behind the wall; METHOD 1 uses images for that.
///
/// Moving walls receive the reaction, point by point, on the nodes of their segments by interpolation.
///
/// Spray has too few neighbours to span the plane or space and is not completed; contact alone keeps it
/// off. Otherwise its own mirror image would bind a drop to the wall by tension, and the drop would
/// oscillate against the stiff contact until it penetrates.
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

  /// Force of the walls on a particle: pressure and friction.
  Vec force_on(const Particles& p, Index i) const;
  /// The part that `WallSupportForce` adds: without images, which are included already.
  Vec own_force_on(const Particles& p, Index i) const;
  void declare_force(const World& world, Accesses& a) const;
  void start_forces(const World& world);
  /// Adds the force of no-slip walls; METHOD 1 uses images for it.
  void hold(Particles& p, Index i);
  bool is_near(Index i) const { return view_[i] != nothing; }
  const WallSurface& surface() const { return *surface_; }
  bool any_moves() const { return any_moves_; }
  /// Range in which particle i can reach walls until the next neighbour search: no particle moves more
  /// than half the skin until then. [L]
  Real sight_until_search(const Particles& p, Index i) const {
    return sight(p, i) + 0.51 * neighbours_.skin();
  }
  /// Visibility by position; null unless all walls are fixed and all particles have one h.
  const WallVisibility* visibility() const { return visibility_ ? &*visibility_ : nullptr; }
  /// The sub-domain of a particle with walls in sight; null: none.
  const WallSubDomain* sub_domain(Index i) const {
    return visibility_ ? sub_domains_[static_cast<std::size_t>(i)] : nullptr;
  }
  /// Factors of moving surfaces in this step. [-]
  const std::vector<Real>& belt_factors() const { return belt_factors_; }

  /// Reaction of a particle on a moving segment.
  struct Reaction {
    Index segment;
    std::array<Vec, 4> on_node;  ///< forces [ML/T2]
  };
  /// Appends the reactions of particle i.
  void add_reactions(const Particles& p, Index i, std::vector<Reaction>& to) const;

  void refreshed(World& world, const Clock&, std::span<const Index>) override;
  void keep(Archive& archive) override;
  void relist(World& world) override;

  // Energy dissipated by friction in the step, from the mean of the velocities before and after the kick.
  void record(World& world, const Clock& clock, EnergyLedger& ledger) override;
  void sample(const World&, const Clock&, EnergyLedger&) const override {}

  InterfaceForce report(const World& world) const override;
  /// Distributes the force on a particle over the fixed shells in sight.
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
    Real weight = 0;          ///< of the force on a particle, not normalised
    Vec away = Vec::Zero();   ///< the same as a vector, along the normal of the segment
    Vec point = Vec::Zero();  ///< weighted sum of the points' positions, not normalised [L]
  };
  /// Calls `take(segment, point, force)` with the forces of particles on the segments in sight.
  template <class Take>
  void share_forces(const World& world, const Take& take);
  void find_sub_domains(const Particles& p);
  bool are_alike(Index face, Index other) const;
  /// Whether walls are evaluated in every step: they move, and integrals over them are needed.
  bool follows() const { return any_moves_ && (!image_force_ || integrates_ || rubs_); }
  void measure_h(const World& world);
  Index look(const Particles& p, Index i) const;
  bool is_spray(const Particles& p, Index i) const;
  void set(Index i, const Sums& sums);
  Vec corrected_slope(Index i) const;
  /// Velocity of particle i relative to the walls with friction.
  Vec over_wall(Index i, const Vec& v) const;
  Vec friction_on(const Particles& p, Index i, const Vec& v) const;
  const WallFriction& friction_of(Index face) const { return walls_.friction[surface_->segment_of(face)]; }
  Vec belt_velocity(const WallPoint& q) const;
  /// Force of no-slip walls, with its heat and the power of moving surfaces.
  struct Hold {
    Vec force = Vec::Zero();
    Real heat = 0, belt_power = 0;  ///< [ML2/T3]
  };
  Hold hold_on(const Particles& p, Index i) const;
  Real held_by(const Particles& p, Index i, const WallPoint& q, const Vec& away) const;
  /// Shear stress of a face over rho u^2/2 at a particle; `wall`: velocity of the face [L/T]
  Real friction_coefficient(const Particles& p, Index i, Index face, const Vec& wall) const;
  Sums sums_over_points(const Particles& p, Index i, Real half_step) const;
  Sums sums_over_plane(const Particles& p, Index i, Index face, Real half_step) const;
  Sums sums_in_sub_domain(const Particles& p, Index i, const WallSubDomain& domain, Real half_step) const;
  Real hold_in_sub_domain(const Particles& p, Index i, const WallSubDomain& domain) const;
  Real kernel(Real h, const Vec& d) const {
    return table_.kernel(d.norm() / h) / (dim_ == 2 ? power<2>(h) : power<3>(h));
  }
  Real volume_behind(Real h, const Vec& d, const Vec& away) const;
  /// `WallSurface::for_each_seen` of particle i.
  template <class F>
  void for_each_seen(const Particles& p, Index i, Real within, F&& f) const {
    const std::vector<Index>* const among = visibility_ ? &visibility_->of(i).points : nullptr;
    if (among && !among->empty())
      surface_->for_each_seen(p.x.vec(i), within, *among, std::forward<F>(f));
    else
      surface_->for_each_seen(p.x.vec(i), within, std::forward<F>(f));
  }
  /// Range of wall points of particle i. [L]
  Real sight(const Particles& p, Index i) const { return table_.support() * p.h[i]; }

  int dim_;
  bool evolving_h_, any_moves_ = false;
  Real past_edges_ = 0;     ///< additional range of METHOD 1 [L]
  bool integrates_ = true;  ///< integrals over walls serve more than friction
  WallTables table_;
  Real spacing_;  ///< of particles [L]
  std::optional<WallCornerTables> corners_;
  Field<Real>&slope_, &fill_;
  Field<Real>& pressure_;  ///< including bulk viscosity, as in pair forces
  Field<Real>& rubbing_;
  Field<Real>*velocity_ = nullptr,
  *slide_ = nullptr;  ///< with moving walls or surfaces; with moving surfaces
  Field<Real>*viscosity_ = nullptr, *viscous_ = nullptr;                    ///< with no-slip walls, METHOD 0
  Field<Real>* image_force_ = nullptr;                                      ///< METHOD 1
  Field<Real>*moment_ = nullptr, *gradient_ = nullptr, *excess_ = nullptr;  ///< with renormalised gradients
  const Neighbours& neighbours_;
  SupportedWalls walls_;
  std::vector<char> moves_;  ///< by segment
  Real least_y_ = 0;         ///< least distance for friction [L]
  std::vector<Real> belt_factors_;
  std::vector<Hold> holds_;        ///< sums of each block in this step
  Real least_h_ = 0, most_h_ = 0;  ///< at the last neighbour search [L]
  std::optional<WallSurface> surface_;
  std::optional<WallVisibility> visibility_;
  std::vector<const WallSubDomain*> sub_domains_;  ///< of active particles, from the last neighbour search
  std::vector<std::unique_ptr<WallSubDomain>> own_sub_domains_;
  std::vector<Real> mu_;  ///< per part, 0: none [M/LT]
  /// View of active particles until the next refresh, or the next step with moving walls: `nothing`,
  /// `pieces`, or the face of the only plane in sight.
  std::vector<Index> view_;
  static constexpr Index nothing = -2, pieces = -1;
  /// Density of wall points: the integral of the kernel over a plane is then correct to 1e-5 from 0.3 h
  /// on.
  static constexpr Real points_per_h = 4;
  bool one_law_ = true;       ///< all walls have the same law of friction
  bool rubs_ = false;         ///< any wall has friction
  std::vector<Index> shown_;  ///< segments with forces in this step
};

}  // namespace courant
