// *COURANT_WALL_SUPPORT: what walls of shells add to sums that they cut off, and their skin friction.
#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "keyword/registry.hpp"
#include "model/named_parts.hpp"
#include "parallel/parallel.hpp"
#include "sph/cards.hpp"
#include "sph/fields.hpp"
#include "sph/kernel.hpp"
#include "sph/sph.hpp"
#include "sph/wall_surface.hpp"
#include "state/keeper.hpp"
#include "state/reports.hpp"

namespace courant {

namespace {

const RegisterKeyword<CourantWallSupport> wall_support_keyword{
    {.names = {"COURANT_WALL_SUPPORT"},
     .purpose = "completes the sums of particles beside shells that do not move; skin friction of the shells",
     .cards = {{.fields = {{"SURFB",
                            &CourantWallSupport::surfb,
                            "-",
                            "the shells: a part or a set of parts",
                            {.required = true, .check = Check::positive},
                            [](const CourantWallSupport& c) {
                              return c.surfbtyp == 2 ? IdSpace::part_set : IdSpace::part;
                            }},
                           {"SURFBTYP",
                            &CourantWallSupport::surfbtyp,
                            "-",
                            "2 part set, 3 part",
                            {.standard = 3, .allowed = {2, 3}}},
                           {"CF",
                            &CourantWallSupport::cf,
                            "-",
                            "skin friction: shear stress over rho v^2/2; 0: the wall is smooth",
                            {.check = Check::not_negative}}}}}}};

constexpr Real points_per_h = 4;  ///< the kernel's integral over a plane is then right to 1e-5 from 0.3 h on

/// What a kernel of h = 1 gives at distance R, in tables.
class WallTables {
 public:
  WallTables(KernelChoice kernel, int dim) : kernel_(n + 1), tail_(n + 1), plane_(n + 1), behind_(n + 1) {
    with_kernel(kernel, [&](auto k) {
      using Kernel = decltype(k);
      const auto theta = [&](Real R) { return Kernel::C(dim) * Kernel::shape(R); };
      support_ = Kernel::support;
      const Real step = support_ / n;
      for (int i = n; i >= 0; --i) {
        kernel_[i] = theta(i * step);
        if (i == n) continue;
        const Real s = (i + 0.5) * step;
        tail_[i] = tail_[i + 1] + theta(s) * (dim == 3 ? s * s : s) * step;
        // dS = 2 pi s ds on a plane; on a line the middle of each interval of t, s^2 = R^2 + t^2
        const Real R = i * step, most = std::sqrt(support_ * support_ - R * R);
        plane_[i] = dim == 3 ? plane_[i + 1] + 2 * pi * theta(s) * s * step : 0;
        for (int t = 0; dim == 2 && t < 200; ++t)
          plane_[i] += 2 * theta(std::hypot(R, most * (t + 0.5) / 200)) * most / 200;
        behind_[i] = behind_[i + 1] + 0.5 * (plane_[i] + plane_[i + 1]) * step;
      }
    });
  }
  Real support() const { return support_; }
  Real kernel(Real R) const { return at(kernel_, R); }
  /// int_R W s^(dim-1) ds
  Real tail(Real R) const { return at(tail_, R); }
  /// int W dS over a plane (2D: line) at distance R
  Real plane(Real R) const { return at(plane_, R); }
  /// int W dV behind it
  Real behind(Real R) const { return at(behind_, R); }

 private:
  static constexpr int n = 2000;
  Real at(const std::vector<Real>& table, Real R) const {
    const Real place = R / support_ * n;
    if (!(place < n)) return 0;
    const int i = static_cast<int>(place);
    return table[i] + (place - i) * (table[i + 1] - table[i]);
  }
  Real support_ = 2;
  std::vector<Real> kernel_, tail_, plane_, behind_;
};

/// The sums of a particle beside a wall lack what is behind it. With the divergence theorem that is an
/// integral over the wall (De Leffe et al. 2009): b_i = int n W dS, n out of the water. Behind it stands the
/// mirror image of particle i itself, with its pressure and the opposite velocity through the wall:
///   d rho_i/dt += 2 rho_i v_i.b_i,   f_i -= 2 V_i p_i b_i, p with that of bulk viscosity.
/// The second is what belongs to the first, so that energy is kept. Friction: tau = CF rho v^2/2 along the
/// wall, given to the particles that see it, whose kernels make up half of 1 there.
///
/// Spray, which has fewer neighbours than it takes to span the plane or space, has no sums to complete;
/// contact alone holds it off. Else its own mirror image would hold a drop to the wall by tension, for ever,
/// and the drop would swing against the stiff contact until it is driven through.
class WallSupport : public Rate, public Refresh, public EnergyTerm, public Keeper, public WallForceReporter {
 public:
  WallSupport(const SphSettings& s, World& world, const Neighbours& neighbours)
      : dim_(s.dim),
        table_(s.kernel, s.dim),
        slope_(sph_fields::wall_slope(world.particles)),
        fill_(sph_fields::wall_fill(world.particles)),
        pressure_(std::holds_alternative<BulkViscosity>(s.viscosity)
                      ? sph_fields::pressure_plus_q(world.particles)
                      : world.particles.p),
        rubbing_(sph_fields::wall_rubbing(world.particles)),
        neighbours_(neighbours),
        surface_(world, s.walls.segments, least_h(world) / points_per_h,
                 table_.support() * most_h(world) + neighbours.largest_skin(), s.walls.planes) {
    for (Index f = 0; f < surface_.faces(); ++f) {
      cf_.push_back(s.walls.cf[surface_.segment_of(f)]);
      one_cf_ &= cf_.back() == cf_.front();
      rubs_ |= cf_.back() > 0;
    }
  }
  std::string name() const override { return "wall support"; }
  void declare(const World& world, Accesses& a) const override {
    const Particles& p = world.particles;
    a.reads(p.x).reads(p.v).reads(p.h).reads_before(p.rho).updates(p.drhodt);
    a.updates(slope_).updates(fill_).updates(rubbing_);
  }

  void block(World& world, const Clock& clock, Index begin, Index end) override {
    Particles& p = world.particles;
    for (Index i = begin; i < end; ++i) {
      if (view_[i] == nothing) continue;
      const Vec x = p.x.vec(i), v = p.v.vec(i), middle = x - 0.5 * clock.dt_old * v;
      const Sums sums =
          view_[i] >= 0 ? sums_over_plane(view_[i], p.h[i], x, middle) : sums_over_points(p.h[i], x, middle);
      slope_.set(i, sums.slope);
      fill_[i] = sums.fill, rubbing_[i] = sums.rubbing;
      p.drhodt[i] += 2 * p.rho[i] * v.dot(sums.slope_before);
    }
  }

  /// Force of the walls on a particle, pressure and friction.
  Vec force_on(const Particles& p, Index i) const {
    return friction_on(p, i, p.v.vec(i)) - (2 * p.m[i] / p.rho[i] * pressure_[i]) * slope_.vec(i);
  }
  void declare_force(const World& world, Accesses& a) const {
    const Particles& p = world.particles;
    a.reads(p.v).reads(p.m).reads(p.rho).reads(pressure_).reads(slope_).reads(rubbing_).updates(p.f);
    const Segments& s = world.segments;
    a.in_start().reads(s.node0).reads(s.node1).reads(s.node2).reads(s.node3);
    a.updates(s.contact_force).updates(world.nodes.f);
  }
  bool is_near(Index i) const { return view_[i] != nothing; }

  void refreshed(World& world, const Clock&, std::span<const Index>) override {
    Particles& p = world.particles;
    view_.assign(p.active, nothing);
    for_each(p.active, [&](Index i) {
      const WallSurface::View view = surface_.view_from(p.x.vec(i));
      if (!view.nothing && !is_spray(p, i)) view_[i] = one_cf_ && view.flat >= 0 ? view.flat : pieces;
      slope_.set(i, Vec::Zero());
      fill_[i] = rubbing_[i] = 0;
    });
  }
  void keep(Archive& archive) override { archive("view", view_); }

  // What friction takes over the step, by the mean of the velocities before and after the kick.
  void record(World& world, const Clock& clock, EnergyLedger& ledger) override {
    if (!rubs_) return;
    const Particles& p = world.particles;
    const Real power = sum(p.active, [&](Index i) {
      const Vec v = p.v.vec(i) + 0.5 * clock.dt_mean() / p.m[i] * p.f.vec(i);
      return is_near(i) ? -friction_on(p, i, p.v.vec(i)).dot(v) : Real(0);
    });
    ledger.dissipated += power * clock.dt_mean();
    ledger.throughput += std::abs(power) * clock.dt_mean();
  }
  void sample(const World&, const Clock&, EnergyLedger&) const override {}

  InterfaceForce report(const World& world) const override {
    InterfaceForce out;
    out.title = name();
    for (Index i = 0; i < world.particles.active; ++i)
      if (is_near(i)) out.on_surfa += force_on(world.particles, i);
    return out;
  }
  /// Shares the force on a particle among the shells it sees as the kernel weighs them.
  void show_forces(World& world) override {
    if (!shown_.empty()) return;
    const Particles& p = world.particles;
    for (Index i = 0; i < p.active; ++i) {
      if (!is_near(i)) continue;
      const Vec force = force_on(p, i);
      Real weight = 0;
      surface_.for_each_seen(p.x.vec(i), [&](const WallPoint& q, const Vec& away) {
        weight += away.norm() * kernel(p.h[i], q.x - p.x.vec(i));
      });
      if (!(weight > 0)) continue;
      surface_.for_each_seen(p.x.vec(i), [&](const WallPoint& q, const Vec& away) {
        const Real share = away.norm() * kernel(p.h[i], q.x - p.x.vec(i)) / weight;
        give_to_wall(world, surface_.segment_of(q.face), -share * force);
      });
    }
  }
  void take_back_forces(World& world) {
    for (const Index s : shown_) {
      world.segments.contact_force.set(s, Vec::Zero());
      for (const Index n : world.segments.nodes(s)) world.nodes.f.set(n, Vec::Zero());
    }
    shown_.clear();
  }

 private:
  bool is_spray(const Particles& p, Index i) const {
    const Real reach2 = power<2>(table_.support() * p.h[i] + neighbours_.skin());
    int others = 0;
    for (const Index j : neighbours_.of_group(i / Neighbours::lanes)) {
      if (j != i && (p.x.vec(j) - p.x.vec(i)).squaredNorm() < reach2) ++others;
      if (others == dim_) return false;
    }
    return true;
  }
  Vec friction_on(const Particles& p, Index i, const Vec& v) const {
    if (!(rubbing_[i] > 0)) return Vec::Zero();
    const Vec n = slope_.vec(i).normalized(), along = v - v.dot(n) * n;
    return -(p.m[i] * rubbing_[i] * along.norm()) * along;
  }
  static Real least_h(const World& world) {
    return -maximum(world.particles.size(), [&](Index i) { return -world.particles.h[i]; });
  }
  static Real most_h(const World& world) {
    return maximum(world.particles.size(), [&](Index i) { return world.particles.h[i]; });
  }
  struct Sums {
    Vec slope = Vec::Zero(), slope_before = Vec::Zero();
    Real fill = 0, rubbing = 0;
  };
  Sums sums_over_points(Real h, const Vec& x, const Vec& middle) const {
    Sums s;
    surface_.for_each_seen(x, [&](const WallPoint& q, const Vec& away) {
      const Vec d = q.x - x;
      const Real W = kernel(h, d);
      s.slope += away * W;
      s.slope_before += away * kernel(h, q.x - middle);
      s.fill += volume_behind(h, d, away);
      s.rubbing += cf_[q.face] * away.norm() * W;
    });
    return s;
  }
  Sums sums_over_plane(Index face, Real h, const Vec& x, const Vec& middle) const {
    const Vec away = surface_.away(face, x);
    const Real d = surface_.distance(face, x), W = table_.plane(d / h) / h;
    return {.slope = W * away,
            .slope_before = table_.plane(surface_.distance(face, middle) / h) / h * away,
            .fill = table_.behind(d / h),
            .rubbing = cf_[face] * W};
  }
  Real kernel(Real h, const Vec& d) const {
    return table_.kernel(d.norm() / h) / (dim_ == 2 ? power<2>(h) : power<3>(h));
  }
  /// Of the kernel's integral, what lies in the shadow of a piece of wall. Nearer than the pieces are large,
  /// r is that of their edge.
  Real volume_behind(Real h, const Vec& d, const Vec& away) const {
    const Real r = std::max(d.norm(), 0.3 * h / points_per_h), R = r / h;
    return away.dot(d) / power<2>(r) * table_.tail(R) / (dim_ == 2 ? 1 : r);
  }
  void give_to_wall(World& world, Index segment, const Vec& force) {
    world.segments.contact_force.add(segment, force);
    const auto nodes = world.segments.nodes(segment);
    for (const Index n : nodes) world.nodes.f.add(n, 0.25 * force);
    if (shown_.empty() || shown_.back() != segment) shown_.push_back(segment);
  }

  int dim_;
  WallTables table_;
  Field<Real>&slope_, &fill_;
  Field<Real>& pressure_;  ///< with that of bulk viscosity, as pair forces take it
  Field<Real>& rubbing_;
  const Neighbours& neighbours_;
  WallSurface surface_;
  std::vector<Real> cf_;  ///< of each face
  /// Of active particles, until the next refresh: `nothing`, `pieces` or a face of the one plane they see.
  std::vector<Index> view_;
  static constexpr Index nothing = -2, pieces = -1;
  bool one_cf_ = true;        ///< of all walls
  bool rubs_ = false;         ///< any wall
  std::vector<Index> shown_;  ///< segments that have forces of this step
};

class WallSupportForce : public Force {
 public:
  explicit WallSupportForce(std::shared_ptr<WallSupport> support) : support_(std::move(support)) {}
  std::string name() const override { return "wall support (forces)"; }
  void declare(const World& world, Accesses& a) const override { support_->declare_force(world, a); }
  void start(World& world, const Clock&) override { support_->take_back_forces(world); }
  void block(World& world, const Clock&, Index begin, Index end) override {
    Particles& p = world.particles;
    for (Index i = begin; i < end; ++i)
      if (support_->is_near(i)) p.f.add(i, support_->force_on(p, i));
  }

 private:
  std::shared_ptr<WallSupport> support_;
};

/// Warns where contact, which acts at half the thickness, does not hold particles half a spacing from the
/// wall.
void check_thickness(const CourantWallSupport& c, Real thickness, const Deck& deck, const World& world,
                     Diagnostics& diagnostics) {
  const Particles& p = world.particles;
  const Real dx = p.size() > 0 ? std::pow(p.m[0] / p.rho[0], 1.0 / world.dim) : 0;
  if (std::abs(thickness / dx - 1) > 0.1)
    diagnostics.warning(
        deck.where(c),
        fmt::format("*COURANT_WALL_SUPPORT: contact holds particles {:g} off the middle of the "
                    "shells, where the sums are complete for {:g}, half a spacing",
                    0.5 * thickness, 0.5 * dx),
        "let the shells be one spacing of the particles thick");
}

}  // namespace

void read_supported_walls(const Deck& deck, const Model& model, const World& world, SphSettings& settings,
                          Diagnostics& diagnostics) {
  SupportedWalls& walls = settings.walls;
  walls.cf.assign(world.segments.size(), -1);
  for (const auto& c : deck.all<CourantWallSupport>()) {
    if (settings.evolving_h)
      return diagnostics.error(deck.where(c),
                               "*COURANT_WALL_SUPPORT: not beside smoothing lengths that evolve",
                               "HMIN = HMAX = 1 in *SECTION_SPH keeps them constant");
    if (settings.renormalised)
      return diagnostics.error(deck.where(c),
                               "*COURANT_WALL_SUPPORT: not beside a renormalised FORM of *CONTROL_SPH, which "
                               "completes the sums itself",
                               "use FORM 0, or leave the card out");
    const std::vector<char> chosen =
        shell_parts_named(deck, model, c, "SURFB", c.surfb, c.surfbtyp, diagnostics);
    Real thickness = 0;
    for (Index s = 0; s < world.segments.size(); ++s) {
      if (!chosen[world.segments.part[s]]) continue;
      thickness = world.segments.thickness[s];
      for (const Index n : world.segments.nodes(s))
        if (!world.nodes.held[n]) {
          deck.error(diagnostics, c, "SURFB",
                     fmt::format("part {} can move: only walls that stand still support particles",
                                 model.parts[world.segments.part[s]].id),
                     "hold the part by CMO, CON1 and CON2 of *MAT_RIGID, or leave it out here");
          return;
        }
      if (walls.cf[s] >= 0) {
        deck.error(diagnostics, c, "SURFB",
                   fmt::format("part {} is named twice", model.parts[world.segments.part[s]].id),
                   "name each part by one card");
        return;
      }
      walls.segments.push_back(s);
      walls.cf[s] = c.cf;
    }
    if (thickness > 0) check_thickness(c, thickness, deck, world, diagnostics);
  }
}

void add_wall_support(const SphSettings& s, World& world, Neighbours& neighbours) {
  neighbours.need_whole_lists();
  const auto support = world.passes.add(std::make_shared<WallSupport>(s, world, neighbours));
  world.passes.add(std::make_shared<WallSupportForce>(support));
}

}  // namespace courant
