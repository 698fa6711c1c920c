// Wall support of shells, and their skin friction.
#include <algorithm>
#include <cmath>
#include <utility>

#include <fmt/format.h>

#include "parallel/parallel.hpp"
#include "sph/core/fields.hpp"
#include "sph/walls/images/wall_images.hpp"
#include "sph/walls/wall_support.hpp"
#include "surfaces/face_forces.hpp"

namespace courant {

namespace {

constexpr Real most_points_per_h = 16;  ///< of the largest h, where h differs

}  // namespace

WallSupport::WallSupport(const SphSettings& s, World& world, const Neighbours& neighbours)
    : dim_(s.dim),
      evolving_h_(s.evolving_h),
      table_(s.kernel, s.dim),
      spacing_(s.spacing),
      slope_(sph_fields::wall_slope(world.particles)),
      fill_(sph_fields::wall_fill(world.particles)),
      pressure_(std::holds_alternative<BulkViscosity>(s.viscosity)
                    ? sph_fields::pressure_plus_q(world.particles)
                    : world.particles.p),
      rubbing_(sph_fields::wall_rubbing(world.particles)),
      neighbours_(neighbours),
      walls_(s.walls),
      least_y_(least_distance * s.spacing),
      mu_(s.mu) {
  world.segments.keep_contact_force();
  moves_.assign(static_cast<std::size_t>(world.segments.size()), 0);
  for (const Index segment : walls_.segments)
    moves_[static_cast<std::size_t>(segment)] = segment_moves(world, segment);
  any_moves_ = std::count(moves_.begin(), moves_.end(), 1) > 0;
  if (s.walls.images) {
    past_edges_ = WallPaths::usual_width * s.spacing;
    image_force_ = &sph_fields::wall_force(world.particles);
    integrates_ = s.volume_tau > 0;
  }
  if (any_moves_ || walls_.belts.any()) velocity_ = &sph_fields::wall_velocity(world.particles);
  if (walls_.belts.any()) slide_ = &sph_fields::wall_slide(world.particles);
  if (walls_.hold && !s.walls.images) viscosity_ = &sph_fields::viscosity(world.particles);
  if (viscosity_ && !s.turbulence.on()) viscous_ = &sph_fields::viscous_force(world.particles);
  if (s.renormalised) {
    moment_ = &sph_fields::wall_moment(world.particles);
    gradient_ = &sph_fields::wall_gradient(world.particles);
    excess_ = &sph_fields::renormalisation(world.particles);
  }
  if (!any_moves_ && !evolving_h_ && (integrates_ || walls_.hold)) corners_.emplace(s.kernel, s.dim);
  measure_h(world);
  rebuild(world);
}

void WallSupport::rebuild(const World& world) {
  const Real spacing = std::max(least_h_ / points_per_h, most_h_ / most_points_per_h);
  const Real reach = table_.support() * most_h_ + neighbours_.largest_skin() + past_edges_;
  std::optional<OccupiedCells> from;  // rebuilt in each step, only for walls in sight of water
  if (any_moves_ && world.particles.active > 0) from.emplace(world.particles, reach, walls_.planes);
  const bool stays = !any_moves_ && !evolving_h_;
  const Real width = walls_.images ? WallPaths::usual_width * spacing_ : 0,
             beyond = 2 * WallVisibility::half_of(spacing_, dim_) + 0.5 * width + spacing;
  visibility_.reset();
  surface_.emplace(world, walls_.segments, spacing, reach, walls_.planes, from ? &*from : nullptr,
                   &walls_.belts, stays ? beyond : 0);
  if (stays)
    visibility_.emplace(*surface_, width, spacing_, table_.support() * most_h_ + neighbours_.largest_skin(),
                        [this](Index f, Index other) { return are_alike(f, other); });
  for (Index f = 0; f < surface_->faces(); ++f) {
    const WallFriction &law = friction_of(f), &first = friction_of(0);
    one_law_ &= law.cf == first.cf && law.log_law == first.log_law && law.ks == first.ks &&
                surface_->face(f).belt < 0;
    rubs_ |= law.rubs();
  }
}

void WallSupport::measure_h(const World& world) {
  const auto& h = world.particles.h;
  most_h_ = maximum(world.particles.size(), [&](Index i) { return h[i]; });
  least_h_ = -maximum(world.particles.size(), [&](Index i) { return -h[i]; });
}

void WallSupport::declare(const World& world, Accesses& a) const {
  const Particles& p = world.particles;
  a.reads(p.x).reads(p.v).reads(p.h).reads_before(p.rho).updates(p.drhodt);
  if (!mu_.empty()) a.reads(p.part);
  a.updates(slope_).updates(fill_).updates(rubbing_);
  if (velocity_) a.updates(*velocity_);
  if (slide_) a.updates(*slide_);
  if (moment_) a.updates(*moment_).updates(*gradient_);
  if (!any_moves_) return;
  a.reads(p.x, Reach::others);
  const Segments& s = world.segments;
  a.in_start().reads(world.nodes.x).reads(world.nodes.v).reads(world.nodes.held).reads(p.x, Reach::others);
  a.reads(s.node0).reads(s.node1).reads(s.node2).reads(s.node3).reads(s.part);
}

void WallSupport::start(World& world, const Clock& clock) {
  belt_factors_.clear();
  for (const WallBelts::Belt& belt : walls_.belts.belts) belt_factors_.push_back(belt.factor(clock.t));
  if (follows()) rebuild(world);
}

void WallSupport::block(World& world, const Clock& clock, Index begin, Index end) {
  Particles& p = world.particles;
  for (Index i = begin; i < end; ++i) {
    if (any_moves_ && !image_force_ && (view_[i] = look(p, i)) == nothing) set(i, {});
    if (view_[i] == nothing || !(integrates_ || rubs_)) continue;
    const Real half_step = 0.5 * clock.dt_old;
    const WallSubDomain* const domain = this->sub_domain(i);
    const Sums sums = domain          ? sums_in_sub_domain(p, i, *domain, half_step)
                      : view_[i] >= 0 ? sums_over_plane(p, i, view_[i], half_step)
                                      : sums_over_points(p, i, half_step);
    set(i, sums);
    if (!image_force_) p.drhodt[i] += 2 * p.rho[i] * sums.squeeze;
  }
}

void WallSupport::set(Index i, const Sums& sums) {
  slope_.set(i, sums.slope);
  fill_[i] = sums.fill, rubbing_[i] = sums.rubbing;
  if (velocity_) velocity_->set(i, sums.wall_velocity);
  if (slide_) slide_->set(i, sums.wall_slide);
  if (!moment_) return;
  moment_->set_tensor(i, sums.moment);
  gradient_->set_tensor(i, sums.gradient);
}

Vec WallSupport::corrected_slope(Index i) const {
  const Vec b = slope_.vec(i);
  return excess_ ? Vec(b + excess_->tensor(i) * b) : b;
}

Vec WallSupport::force_on(const Particles& p, Index i) const {
  const Vec own = own_force_on(p, i) + hold_on(p, i).force;
  return image_force_ ? Vec(own + image_force_->vec(i)) : own;
}

/// Shear stress of no-slip walls over viscosity and velocity, distributed over points.
Real WallSupport::held_by(const Particles& p, Index i, const WallPoint& q, const Vec& away) const {
  if (!friction_of(q.face).no_slip) return 0;
  const Real y = std::max(surface_->distance(q.face, p.x.vec(i)), least_y_);
  return 2 * away.norm() * kernel(p.h[i], q.x - p.x.vec(i)) / y;
}

WallSupport::Hold WallSupport::hold_on(const Particles& p, Index i) const {
  Hold hold;
  if (!viscosity_) return hold;
  const Real muV = p.m[i] / p.rho[i] * (*viscosity_)[i];
  if (const WallSubDomain* const domain = this->sub_domain(i)) {
    hold.force = -muV * hold_in_sub_domain(p, i, *domain) * p.v.vec(i),
    hold.heat = -hold.force.dot(p.v.vec(i));
    return hold;
  }
  for_each_seen(p, i, sight(p, i), [&](const WallPoint& q, const Vec& away) {
    const Vec slide = belt_velocity(q), u = p.v.vec(i) - q.v - slide,
              force = -muV * held_by(p, i, q, away) * u;
    hold.force += force, hold.heat -= force.dot(u), hold.belt_power += force.dot(slide);
  });
  return hold;
}

Vec WallSupport::own_force_on(const Particles& p, Index i) const {
  const Vec friction = friction_on(p, i, p.v.vec(i));
  if (image_force_) return friction;
  return friction - (2 * p.m[i] / p.rho[i] * pressure_[i]) * corrected_slope(i);
}

void WallSupport::start_forces(const World& world) {
  if (viscosity_) holds_.assign(static_cast<std::size_t>(block_count(world.particles.active)), {});
}

void WallSupport::hold(Particles& p, Index i) {
  if (!viscosity_) return;
  const Hold one = hold_on(p, i);
  p.f.add(i, one.force);
  if (viscous_) viscous_->add(i, one.force);
  Hold& block = holds_[static_cast<std::size_t>(i / block_size)];
  block.heat += one.heat, block.belt_power += one.belt_power;
}

void WallSupport::declare_force(const World& world, Accesses& a) const {
  const Particles& p = world.particles;
  a.reads(p.v).reads(p.m).reads(p.rho).reads(pressure_).reads(slope_).reads(rubbing_).updates(p.f);
  if (excess_) a.reads(*excess_);
  if (velocity_) a.reads(*velocity_);
  if (viscosity_) a.reads(*viscosity_).reads(p.x).reads(p.h);
  if (viscous_) a.updates(*viscous_);
  const Segments& s = world.segments;
  if (any_moves_) {
    a.reads(p.x).reads(p.h).reads(p.part);
    a.in_finish().updates(*s.contact_force).updates(world.nodes.f);
    a.reads(s.node0).reads(s.node1).reads(s.node2).reads(s.node3);
  }
  a.in_start().reads(s.node0).reads(s.node1).reads(s.node2).reads(s.node3);
  a.updates(*s.contact_force).updates(world.nodes.f);
}

void WallSupport::add_reactions(const Particles& p, Index i, std::vector<Reaction>& to) const {
  const Vec friction = friction_on(p, i, p.v.vec(i));
  if (image_force_ && !(rubbing_[i] > 0)) return;
  const Real muV = viscosity_ ? p.m[i] / p.rho[i] * (*viscosity_)[i] : 0;
  const Real twice_pV = image_force_ ? 0 : 2 * p.m[i] / p.rho[i] * pressure_[i];
  const Matrix B = excess_ ? Matrix(Matrix::Identity() + excess_->tensor(i)) : Matrix(Matrix::Identity());
  const std::size_t first = to.size();
  const auto rubbed_by = [&](const WallPoint& q, const Vec& away, Real W) {
    return friction_coefficient(p, i, q.face, q.v + belt_velocity(q)) * away.norm() * W;
  };
  Real rubbing = 0;  // with the updated densities
  if (rubbing_[i] > 0)
    for_each_seen(p, i, sight(p, i), [&](const WallPoint& q, const Vec& away) {
      rubbing += rubbed_by(q, away, kernel(p.h[i], q.x - p.x.vec(i)));
    });
  for_each_seen(p, i, sight(p, i), [&](const WallPoint& q, const Vec& away) {
    const Index segment = surface_->segment_of(q.face);
    if (!moves_[static_cast<std::size_t>(segment)]) return;
    const Real W = kernel(p.h[i], q.x - p.x.vec(i));
    Vec force = twice_pV * W * (B * away);
    if (rubbing > 0) force -= rubbed_by(q, away, W) / rubbing * friction;
    if (muV > 0) force += muV * held_by(p, i, q, away) * (p.v.vec(i) - q.v - belt_velocity(q));
    force = surface_->from_image(q.face, force);
    auto known = std::find_if(to.begin() + static_cast<std::ptrdiff_t>(first), to.end(),
                              [segment](const Reaction& r) { return r.segment == segment; });
    if (known == to.end()) {
      to.push_back({segment, {Vec::Zero(), Vec::Zero(), Vec::Zero(), Vec::Zero()}});
      known = to.end() - 1;
    }
    for (std::size_t e = 0; e < 4; ++e) known->on_node[e] += q.weight[e] * force;
  });
}

void WallSupport::refreshed(World& world, const Clock&, std::span<const Index>) {
  Particles& p = world.particles;
  if (evolving_h_) measure_h(world);
  if (evolving_h_ || (any_moves_ && image_force_)) rebuild(world);
  find_sub_domains(p);
  view_.assign(p.active, nothing);
  for_each(p.active, [&](Index i) {
    view_[i] = look(p, i);
    set(i, {});
  });
}

void WallSupport::relist(World& world) {
  rebuild(world);
  find_sub_domains(world.particles);
}

void WallSupport::find_sub_domains(const Particles& p) {
  if (!visibility_) return;
  visibility_->look_from(p);
  sub_domains_.resize(static_cast<std::size_t>(p.active)),
      own_sub_domains_.resize(static_cast<std::size_t>(p.active));
  for_each(p.active, [&](Index i) {
    const auto k = static_cast<std::size_t>(i);
    sub_domains_[k] = visibility_->sub_domain(i, p.x.vec(i), sight_until_search(p, i), own_sub_domains_[k]);
  });
}

/// Whether faces have the same friction law and neither is a moving surface.
bool WallSupport::are_alike(Index face, Index other) const {
  const WallFriction &one = friction_of(face), &two = friction_of(other);
  return one.cf == two.cf && one.log_law == two.log_law && one.ks == two.ks && one.no_slip == two.no_slip &&
         surface_->face(face).belt < 0 && surface_->face(other).belt < 0;
}

Index WallSupport::look(const Particles& p, Index i) const {
  if (visibility_) return visibility_->of(i).nothing || is_spray(p, i) ? nothing : pieces;
  const WallSurface::View view = surface_->view_from(p.x.vec(i));
  if (view.nothing || is_spray(p, i)) return nothing;
  return one_law_ && !any_moves_ && view.flat >= 0 ? view.flat : pieces;
}

void WallSupport::keep(Archive& archive) {
  archive("view", view_);
  if (!evolving_h_) return;
  archive("least_h", least_h_);
  archive("most_h", most_h_);
}

void WallSupport::record(World& world, const Clock& clock, EnergyLedger& ledger) {
  for (const Hold& block : holds_) {
    ledger.dissipated += block.heat * clock.dt_mean();
    ledger.external_work += block.belt_power * clock.dt_mean();
    ledger.throughput += (block.heat + std::abs(block.belt_power)) * clock.dt_mean();
  }
  if (!rubs_) return;
  const Particles& p = world.particles;
  const Real power = sum(p.active, [&](Index i) {
    const Vec v = p.v.vec(i) + 0.5 * clock.dt_mean() / p.m[i] * p.f.vec(i);
    return is_near(i) ? -friction_on(p, i, p.v.vec(i)).dot(over_wall(i, v)) : Real(0);
  });
  ledger.dissipated += power * clock.dt_mean();
  ledger.throughput += std::abs(power) * clock.dt_mean();
  if (!slide_) return;
  const Real of_belts = sum(p.active, [&](Index i) {
    return is_near(i) ? friction_on(p, i, p.v.vec(i)).dot(slide_->vec(i)) : Real(0);
  });
  ledger.external_work += of_belts * clock.dt_mean();
  ledger.throughput += std::abs(of_belts) * clock.dt_mean();
}

InterfaceForce WallSupport::report(const World& world) const {
  InterfaceForce out;
  out.title = name();
  for (Index i = 0; i < world.particles.active; ++i)
    if (is_near(i)) out.on_surfa += force_on(world.particles, i);
  return out;
}

template <class Take>
void WallSupport::share_forces(const World& world, const Take& take) {
  if (any_moves_ && !follows()) rebuild(world);
  const Particles& p = world.particles;
  std::vector<Share> shares;
  for (Index i = 0; i < p.active; ++i) {
    if (!is_near(i)) continue;
    Real weight = 0;
    shares.clear();
    for_each_seen(p, i, sight(p, i), [&](const WallPoint& q, const Vec& away) {
      const Real one = away.norm() * kernel(p.h[i], q.x - p.x.vec(i));
      const Index segment = surface_->segment_of(q.face);
      const Vec normal = kernel(p.h[i], q.x - p.x.vec(i)) * away;
      weight += one;
      if (shares.empty() || shares.back().segment != segment) shares.push_back({segment});
      shares.back().weight += one, shares.back().away += normal, shares.back().point += one * q.x;
    });
    if (!(weight > 0)) continue;
    // Pressure acts along normals: in a corner each wall has its own direction of it. With K = sum n n^T |a|,
    // a = |a| n of each wall, K^-1 F are the weights that add up to F. The rest, friction above all, is
    // shared by weight.
    constexpr Real least = 1e-3;  // of the trace: walls that are nearly in one plane have no second direction
    const Vec force = -force_on(p, i);
    Matrix K = Matrix::Zero();
    for (const Share& one : shares)
      if (one.weight > 0) K += one.away * one.away.transpose() / one.weight;
    const Vec alpha = (K + least * K.trace() * Matrix::Identity()).inverse() * force;
    const Vec rest = (force - K * alpha) / weight;
    for (const Share& one : shares)
      if (one.weight > 0)
        take(one.segment, Vec(one.point / one.weight),
             Vec(one.away * one.away.dot(alpha) / one.weight + one.weight * rest));
  }
}

void WallSupport::show_forces(World& world) {
  if (!shown_.empty()) return;
  share_forces(world, [&](Index segment, const Vec&, const Vec& force) {
    if (moves_[static_cast<std::size_t>(segment)]) return;  // its force is known already
    world.segments.contact_force->add(segment, force);
    for (const Index n : world.segments.nodes(segment)) world.nodes.f.add(n, 0.25 * force);
    if (shown_.empty() || shown_.back() != segment) shown_.push_back(segment);
  });
}

void WallSupport::report_point_forces(const World& world,
                                      const std::function<void(const PointForce&)>& take) {
  share_forces(world, [&](Index segment, const Vec& point, const Vec& force) {
    take({.segment = segment, .point = point, .force = force});
  });
}

void WallSupport::take_back_forces(World& world) {
  for (const Index s : shown_) {
    world.segments.contact_force->set(s, Vec::Zero());
    for (const Index n : world.segments.nodes(s)) world.nodes.f.set(n, Vec::Zero());
  }
  shown_.clear();
}

bool WallSupport::is_spray(const Particles& p, Index i) const {
  const Real reach2 = power<2>(table_.support() * p.h[i] + neighbours_.skin());
  int others = 0;
  for (const Index j : neighbours_.of_group(i / Neighbours::lanes)) {
    if (j != i && (p.x.vec(j) - p.x.vec(i)).squaredNorm() < reach2) ++others;
    if (others == dim_) return false;
  }
  return true;
}

Vec WallSupport::over_wall(Index i, const Vec& v) const {
  return velocity_ ? Vec(v - velocity_->vec(i)) : v;
}

Vec WallSupport::friction_on(const Particles& p, Index i, const Vec& v) const {
  if (!(rubbing_[i] > 0)) return Vec::Zero();
  const Vec u = over_wall(i, v), n = slope_.vec(i).normalized(), along = u - u.dot(n) * n;
  return -(p.m[i] * rubbing_[i] * along.norm()) * along;
}

Vec WallSupport::belt_velocity(const WallPoint& q) const {
  return surface_->face(q.face).slide_at(belt_factors_, q.x);
}

namespace {

/// Reactions on moving walls; sums over particles run on all threads and are added to the segments in
/// order.
class WallSupportForce : public Force {
 public:
  explicit WallSupportForce(std::shared_ptr<WallSupport> support) : support_(std::move(support)) {}
  std::string name() const override { return "wall support (forces)"; }
  void declare(const World& world, Accesses& a) const override { support_->declare_force(world, a); }
  void start(World& world, const Clock&) override {
    support_->take_back_forces(world);
    reactions_.resize(static_cast<std::size_t>(block_count(world.particles.active)));
    support_->start_forces(world);
  }
  void block(World& world, const Clock&, Index begin, Index end) override {
    Particles& p = world.particles;
    auto& reactions = reactions_[static_cast<std::size_t>(begin / block_size)];
    reactions.clear();
    for (Index i = begin; i < end; ++i) {
      if (!support_->is_near(i)) continue;
      p.f.add(i, support_->own_force_on(p, i));
      support_->hold(p, i);
      if (support_->any_moves()) support_->add_reactions(p, i, reactions);
    }
  }
  void finish(World& world, const Clock&) override {
    for (const auto& block : reactions_)
      for (const WallSupport::Reaction& r : block) {
        const auto nodes = world.segments.nodes(r.segment);
        for (std::size_t e = 0; e < 4; ++e) {
          world.segments.contact_force->add(r.segment, r.on_node[e]);
          world.nodes.f.add(nodes[e], r.on_node[e]);
        }
      }
  }

 private:
  std::shared_ptr<WallSupport> support_;
  std::vector<std::vector<WallSupport::Reaction>> reactions_;  ///< of each block
};

}  // namespace

std::shared_ptr<Force> add_wall_support(const SphSettings& s, World& world,
                                        std::shared_ptr<Neighbours> neighbours,
                                        std::shared_ptr<PairVolumes> volumes) {
  neighbours->need_whole_lists();
  const auto support = world.passes.add(std::make_shared<WallSupport>(s, world, *neighbours));
  if (support->any_moves()) add_clear_face_forces(world);
  world.passes.add(std::make_shared<WallSupportForce>(support));
  if (!s.walls.images) return nullptr;
  return make_wall_image_forces(world.passes.add(
      std::make_shared<WallImages>(s, world, std::move(neighbours), std::move(volumes), support)));
}

}  // namespace courant
