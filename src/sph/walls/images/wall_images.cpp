// METHOD 1 of *COURANT_WALL_SUPPORT: walls as mirrors.
#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "search/neighbours.hpp"
#include "sph/core/fields.hpp"
#include "sph/core/view.hpp"
#include "sph/walls/images/wall_images.hpp"

namespace courant {

namespace {

constexpr Real tiny = 1e-300;
constexpr Real rounded = 1 + 1e-9;  ///< times the reach: farther particles do not interact

}  // namespace

WallImages::WallImages(const SphSettings& s, World& world, std::shared_ptr<Neighbours> neighbours,
                       std::shared_ptr<PairVolumes> volumes, std::shared_ptr<WallSupport> support)
    : dim_(s.dim),
      delta_(s.density_diffusion),
      loads_(s.loads),
      neighbours_(std::move(neighbours)),
      volumes_(std::move(volumes)),
      support_(std::move(support)),
      pressure_(std::holds_alternative<BulkViscosity>(s.viscosity)
                    ? sph_fields::pressure_plus_q(world.particles)
                    : world.particles.p),
      force_(sph_fields::wall_force(world.particles)),
      edge_loss_(sph_fields::edge_loss(world.particles)),
      diffusion_(s.density_diffusion > 0 ? &sph_fields::density_diffusion(world.particles) : nullptr),
      walls_(s.walls),
      width_(WallPaths::usual_width * s.spacing),
      any_moves_(support_->any_moves()),
      kernel_(&any_kernel(s.kernel)),
      sub_domain_rates_(mirror_rates_loop(s.kernel, s.dim)),
      sub_domain_forces_(mirror_forces_loop(s.kernel, s.dim)),
      edge_rates_(edge_rates_loop(s.kernel, s.dim)),
      edge_forces_(edge_forces_loop(s.kernel, s.dim)) {
  if (diffusion_) potential_ = &sph_fields::potential(world.particles);
  spacing_ = support_->surface().spacing(), reach_ = support_->surface().reach();
  if (walls_.hold) {
    viscosity_ = &sph_fields::viscosity(world.particles);
    heat_ = &sph_fields::viscous_dissipation(world.particles);
    drag_ = &sph_fields::wall_drag(world.particles);
    if (!s.turbulence.on()) viscous_ = &sph_fields::viscous_force(world.particles);
    for (const Index segment : walls_.segments)
      mixed_ |= !walls_.friction[static_cast<std::size_t>(segment)].no_slip || walls_.belts.any();
  }
  if (!any_moves_) return;
  std::vector<char> known(static_cast<std::size_t>(world.nodes.size()), 0);
  for (const Index segment : walls_.segments)
    if (segment_moves(world, segment))
      for (const Index n : world.segments.nodes(segment))
        if (!std::exchange(known[static_cast<std::size_t>(n)], 1)) nodes_.push_back(n);
}

Real WallImages::slope(Real h, const Vec& d) const {
  const Real r = std::max(d.norm(), 1e-9 * h);
  return kernel_->gradient_factor * kernel_->C(dim_) * kernel_->gradient(r / h) /
         (r * h * (dim_ == 2 ? power<2>(h) : power<3>(h)));
}

Real WallImages::kernel(Real h, const Vec& d) const {
  return kernel_->C(dim_) * kernel_->shape(d.norm() / h) / (dim_ == 2 ? power<2>(h) : power<3>(h));
}

void WallImages::refreshed(World& world, const Clock&, std::span<const Index>) {
  searched_at_.clear();
  for (const Index n : nodes_) searched_at_.push_back(world.nodes.x.vec(n));
  look(world);
}

void WallImages::keep(Archive& archive) {
  if (any_moves_) archive("searched_at", searched_at_);
}

/// The search uses the wall positions of the last refresh.
void WallImages::relist(World& world) {
  std::vector<Vec> now;
  const bool known = searched_at_.size() == nodes_.size();
  for (const Index n : nodes_) now.push_back(world.nodes.x.vec(n));
  for (std::size_t k = 0; known && k < nodes_.size(); ++k) world.nodes.x.set(nodes_[k], searched_at_[k]);
  look(world);
  for (std::size_t k = 0; k < nodes_.size(); ++k) world.nodes.x.set(nodes_[k], now[k]);
}

void WallImages::search(const World& world) {
  if (!any_moves_) return;
  std::optional<OccupiedCells> from;
  if (world.particles.active > 0) from.emplace(world.particles, reach_, walls_.planes);
  surface_.emplace(world, walls_.segments, spacing_, reach_, walls_.planes, from ? &*from : nullptr,
                   &walls_.belts);
  paths_from_.emplace(*surface_, dim_, width_);
  in_middle_.emplace(*paths_from_);
}

void WallImages::look(World& world) {
  search(world);
  const Particles& p = world.particles;
  const auto n = static_cast<std::size_t>(p.active);
  if (any_moves_) sheets_.assign(n, {}), flats_.assign(n, -1), before_flat_.assign(n, 0);
  if (any_moves_) moving_edges_.assign(n, {});
  sub_domains_.assign(n, nullptr), own_sub_domains_.resize(n), skipped_.assign(n, 0);
  edges_.assign(n, nullptr), own_edges_.resize(n);
  for_each(p.active, [&](Index i) {
    force_.set(i, Vec::Zero());
    if (!support_->is_near(i)) return;
    if (!viscosity_ && support_->visibility()) find_sub_domain(p, i);
    if (!any_moves_) return;
    sheets_[i] = at_end().seen_from(p.x.vec(i));
    if (!viscosity_) any_moves_among(i) ? find_flat(p, i) : find_held_sub_domain(p, i);
    if (!viscosity_ && any_moves_among(i) && flats_[i] < 0) find_moving_edge(p, i);
    if (mixed_ && sheets_[i].size() == 1 && sheets_[i][0].endless)  // whose faces may not be alike
      sheets_[i][0].faces = surface().faces_around(p.x.vec(i));
  });
}

/// Finds a closed sub-domain, an isolated edge, or an open sub-domain.
void WallImages::find_sub_domain(const Particles& p, Index i) {
  const auto k = static_cast<std::size_t>(i);
  const WallVisibility& visibility = *support_->visibility();
  const Vec x = p.x.vec(i);
  const Real sight = support_->sight_until_search(p, i);
  if ((sub_domains_[k] = visibility.sub_domain(i, x, sight, own_sub_domains_[k]))) return;
  own_edges_[k] = visibility.paths().edge_about(visibility.of(i).sheets, x, sight);
  if (own_edges_[k])
    edges_[k] = &*own_edges_[k];
  else
    sub_domains_[k] = visibility.open_sub_domain(i, x, sight, own_sub_domains_[k]);
}

/// The same beside fixed walls while other walls, out of sight, move.
void WallImages::find_held_sub_domain(const Particles& p, Index i) {
  const auto k = static_cast<std::size_t>(i);
  const Vec x = surface().in_plane(p.x.vec(i));
  const Real sight = support_->sight_until_search(p, i);
  const WallPaths::Sheets around = at_end().sheets_around(x, sight + 0.5 * width_);
  own_sub_domains_[k] = at_end().closed_sub_domain_about(around, x, sight);
  if (!own_sub_domains_[k]) {
    own_edges_[k] = at_end().edge_about(around, x, sight);
    if (own_edges_[k])
      edges_[k] = &*own_edges_[k];
    else
      own_sub_domains_[k] = at_end().open_sub_domain_about(around, x, sight);
  }
  sub_domains_[k] = own_sub_domains_[k].get();
}

void WallImages::declare(const World& world, Accesses& a) const {
  const Particles& p = world.particles;
  a.reads(p.x, Reach::others).reads(p.v, Reach::others).reads(p.h);
  a.reads(volumes_->before(), Reach::others).reads_before(p.rho).updates(p.drhodt);
  a.reads(edge_loss_, Reach::others);
  if (viscosity_) a.reads(*viscosity_, Reach::others).updates(p.f).updates(*heat_).writes(*drag_);
  if (viscous_) a.updates(*viscous_);
  if (!any_moves_) return;
  const Segments& s = world.segments;
  a.in_start().reads(world.nodes.x).reads(world.nodes.v);
  a.reads(s.node0).reads(s.node1).reads(s.node2).reads(s.node3);
}

void WallImages::start(World& world, const Clock& clock) {
  half_step_ = 0.5 * clock.dt_old;
  blocks_.resize(static_cast<std::size_t>(block_count(world.particles.active)));
  for (auto& sum : edge_sum_) sum.assign(static_cast<std::size_t>(world.particles.active), 0);
  if (!any_moves_) return;
  paths_from_->take_along(world, 0);
  in_middle_->take_along(world, half_step_);
}

void WallImages::block(World& world, const Clock&, Index begin, Index end) {
  Block& block = blocks_[static_cast<std::size_t>(begin / block_size)];
  block.paths.clear(), block.derivatives.clear(), block.reactions.clear();
  block.belt_power = 0;
  for (Viewpoints& viewpoints : block.viewpoints) viewpoints.i = -1;
  if (!viscosity_) {
    update_edges_in_middle(begin, end, block);
    const WallMirrorArrays a = arrays_of_rates(world.particles, begin);
    sub_domain_rates_(a, lists_of(*neighbours_, begin, end));
    edge_rates_(a, lists_of(*neighbours_, begin, end));
    add_doubtful_paths(world.particles, begin, block);
  }
  for (Index i = begin; i < end; ++i) {
    if (!sees(i) || in_sub_domain(i)) continue;
    const bool moves = any_moves_among(i);
    if (any_moves_ && (before_flat_[i] = has_flat_to_itself(world.particles, i))) {
      add_flat_rate(world.particles, i);
      continue;
    }
    if (moves) update_sheets(i, block);
    for (const Index j : neighbours_->of_group(i / Neighbours::lanes))
      moves ? add_paths_of_moving(world.particles, i, j, block) : add_paths(world.particles, i, j, block);
  }
  if (!viscosity_) return;
  for (Index i = begin; i < end; ++i) drag_->set(i, Vec::Zero());
  for (const WallPath& path : block.paths) drag(world.particles, path, block);
}

/// Viewpoint of particle i in the middle of the step; sheets of moving walls must be updated before.
WallImages::Viewpoints& WallImages::viewpoints(const Particles& p, Index i, Block& block) const {
  block.viewpoints.resize(Neighbours::lanes);
  Viewpoints& out = block.viewpoints[static_cast<std::size_t>(i % Neighbours::lanes)];
  if (out.i == i) return out;
  out.i = i, out.knows_end = false;
  const bool moves = any_moves_among(i);
  (moves ? *in_middle_ : at_end())
      .look_from(moves ? block.in_middle : sheets(i), p.x.vec(i) - half_step_ * p.v.vec(i),
                 kernel_->support * p.h[i], out.middle);
  return out;
}

/// Paths are searched at the middle of the step, the time of the rates, and moved to its end, the time of
/// the forces. Paths near an edge are searched again there.
void WallImages::add_paths(Particles& p, Index i, Index j, Block& block) {
  const auto in_the_middle = [&](Index k) { return Vec(p.x.vec(k) - half_step_ * p.v.vec(k)); };
  const Real reach = kernel_->support * p.h[i];
  if ((in_the_middle(j) - in_the_middle(i)).squaredNorm() > power<2>(reach * rounded)) return;
  Viewpoints& from = viewpoints(p, i, block);
  std::vector<WallPath>& paths = block.paths;
  const std::size_t first = paths.size();
  at_end().add(from.middle, i, j, in_the_middle(j), paths);
  bool at_edge = false;
  for (std::size_t k = first; k < paths.size(); ++k) {
    add_rate(p, paths[k], block.derivatives);
    at_edge |= std::abs(paths[k].weight) < 1;
    paths[k].d += half_step_ * speed(p, paths[k]);
  }
  if (!at_edge) return;
  paths.resize(first);
  add_paths_at_end(p, j, from, paths);
}

void WallImages::add_paths_at_end(const Particles& p, Index j, Viewpoints& from, std::vector<WallPath>& to,
                                  std::vector<WallDerivative>* derivatives) const {
  if (!std::exchange(from.knows_end, true))
    at_end().look_from(sheets(from.i), p.x.vec(from.i), kernel_->support * p.h[from.i], from.end);
  at_end().add(from.end, from.i, j, p.x.vec(j), to, derivatives);
}

/// Updates the sheets of particle i to the middle and the end of the step.
void WallImages::update_sheets(Index i, Block& block) {
  block.in_middle = sheets_[i];
  in_middle_->update(block.in_middle);
  at_end().update(sheets_[i]);
}

/// The same beside moving walls.
void WallImages::add_paths_of_moving(Particles& p, Index i, Index j, Block& block) {
  const auto in_the_middle = [&](Index k) { return Vec(p.x.vec(k) - half_step_ * p.v.vec(k)); };
  const Real reach = kernel_->support * p.h[i];
  if ((in_the_middle(j) - in_the_middle(i)).squaredNorm() > power<2>(reach * rounded)) return;
  std::vector<WallPath>& paths = block.paths;
  const std::size_t first = paths.size(), first_derivative = block.derivatives.size();
  Viewpoints& from = viewpoints(p, i, block);
  in_middle_->add(from.middle, i, j, in_the_middle(j), paths, &block.derivatives);
  bool at_edge = false;
  for (std::size_t k = first; k < paths.size(); ++k) {
    add_rate(p, paths[k], block.derivatives);
    at_edge |= std::abs(paths[k].weight) < 1;
  }
  if (at_edge) {
    paths.resize(first), block.derivatives.resize(first_derivative);
    add_paths_at_end(p, j, from, paths, &block.derivatives);
  }
  for (std::size_t k = first; k < paths.size(); ++k)
    if (paths[k].moves)
      at_end().bring(sheets_[i], p.x.vec(i), p.x.vec(j), paths[k]);
    else if (!at_edge)
      paths[k].d += half_step_ * speed(p, paths[k]);
}

/// Velocity of particle i relative to the image of j. [L/T]
Vec WallImages::speed(const Particles& p, const WallPath& path) const {
  const Vec over = p.v.vec(path.i) - path.turn * p.v.vec(path.j);
  return path.moves ? Vec(over - path.drift) : over;
}

Real WallImages::kept(const WallPath& path) const {
  return (1 - edge_loss_[path.i]) * (1 - edge_loss_[path.j]);
}

void WallImages::add_rate(Particles& p, const WallPath& path,
                          const std::vector<WallDerivative>& derivatives) {
  const Real h = p.h[path.i], V = volumes_->current()[path.j], W = kernel(h, path.d);
  Real share_rate = path.by_i.dot(p.v.vec(path.i)) + path.by_j.dot(p.v.vec(path.j));
  for (Index k = path.derivatives; k < path.derivatives_end; ++k) {
    const WallDerivative& derivative = derivatives[static_cast<std::size_t>(k)];
    const Vec v = in_middle_->velocity(derivative.face, derivative.at);
    share_rate += derivative.force.dot(v);
    if (!derivative.lever.isZero())
      share_rate += in_middle_->face(derivative.face)
                        .n.dot(in_middle_->velocity(derivative.face, derivative.at + derivative.lever) - v);
  }
  p.drhodt[path.i] +=
      p.rho[path.i] * V *
      (path.weight * slope(h, path.d) * speed(p, path).dot(path.d) + kept(path) * W * share_rate);
  if (path.weight > 0 || path.across)
    edge_sum_[path.weight > 0 ? 0 : 1][static_cast<std::size_t>(path.i)] += V * W * path.by_i.norm();
}

/// Paths of pairs that may leave the sub-domain of particle i.
void WallImages::add_doubtful_paths(Particles& p, Index begin, Block& block) {
  const Index* const list = neighbours_->list(begin / block_size);
  const Index* const start = neighbours_->starts(begin / block_size);
  Index group = 0;
  for (Index k = 0; k < block.doubts; ++k) {
    const Index entry = block.doubt[static_cast<std::size_t>(k)];
    while (entry >= start[group + 1]) ++group;
    for (Index l = 0; l < Neighbours::lanes; ++l) {
      if ((block.doubt_lanes[static_cast<std::size_t>(k)] >> l & 1) == 0) continue;
      add_paths(p, begin + group * Neighbours::lanes + l, list[entry], block);
    }
  }
}

/// Arrays common to rates and forces.
WallMirrorArrays WallImages::arrays(Particles& p, Index begin) {
  Block& block = blocks_[static_cast<std::size_t>(begin / block_size)];
  const auto entries = static_cast<std::size_t>(neighbours_->entries(begin / block_size));
  if (block.doubt.size() < entries) block.doubt.resize(entries), block.doubt_lanes.resize(entries);
  WallMirrorArrays a{};
  a.doubt = block.doubt.data(), a.doubt_lanes = block.doubt_lanes.data(), a.doubts = &block.doubts;
  a.width = width_;
  if (block.has_moving_edges)
    a.reaction = block.edge_reactions.data(), a.edge_paths = block.edge_paths.data();
  for (int k = 0; k < 3; ++k) a.x[k] = p.x.data(k), a.aside[k] = at_end().shift()[k];
  a.V = volumes_->current(), a.rho = p.rho.data();
  a.h = p.active > 0 ? p.h[0] : 1, a.delta = delta_, a.half_step = half_step_;
  a.edge_loss = edge_loss_.data();
  for (int k = 0; k < 2; ++k) a.edge_sum[k] = edge_sum_[k].data();
  a.domain = sub_domains_.data(), a.edge = edges_.data(), a.skipped = skipped_.data(), a.kernel = kernel_;
  return a;
}

WallMirrorArrays WallImages::arrays_of_rates(Particles& p, Index begin) {
  WallMirrorArrays a = arrays(p, begin);
  for (int k = 0; k < 3; ++k) a.v[k] = p.v.data(k);
  a.drhodt = p.drhodt.data();
  return a;
}

WallMirrorArrays WallImages::arrays_of_forces(Particles& p, Index begin) {
  WallMirrorArrays a = arrays(p, begin);
  for (int k = 0; k < 3; ++k) a.f[k] = p.f.data(k), a.wall_force[k] = force_.data(k);
  a.p = pressure_.data();
  if (diffusion_) a.c = p.c.data(), a.potential = potential_->data(), a.diffusion = diffusion_->data();
  return a;
}

void WallImages::declare_forces(const World& world, Accesses& a) const {
  const Particles& p = world.particles;
  a.reads(p.x, Reach::others).reads(pressure_, Reach::others).reads(volumes_->now(), Reach::others);
  a.reads(p.h).reads(p.rho).reads(p.c).reads(p.part).updates(p.f).updates(force_);
  if (diffusion_) a.updates(*diffusion_).reads(*potential_, Reach::others);
  if (drag_) a.reads(*drag_);
  a.reads(edge_loss_, Reach::others);
  a.in_finish().updates(edge_loss_);
  if (!any_moves_) return;
  const Segments& s = world.segments;
  a.in_finish().updates(*s.contact_force).updates(world.nodes.f);
  a.reads(s.node0).reads(s.node1).reads(s.node2).reads(s.node3);
}

void WallImages::start_forces(const Clock& clock) {
  now_ = loads_.at(clock.t);
}

void WallImages::forces(World& world, Index begin, Index end) {
  Particles& p = world.particles;
  const Real* V = volumes_->current();
  for (Index i = begin; i < end; ++i)
    if (sees(i) && !in_sub_domain(i)) force_.set(i, drag_ ? drag_->vec(i) : Vec(Vec::Zero()));
  Block& block = blocks_[static_cast<std::size_t>(begin / block_size)];
  if (!viscosity_) {
    update_edges_at_end(begin, end, block);
    const WallMirrorArrays a = arrays_of_forces(p, begin);
    sub_domain_forces_(a, lists_of(*neighbours_, begin, end));
    edge_forces_(a, lists_of(*neighbours_, begin, end));
    react_of_edges(p, begin, end, block);
  }
  for (Index i = begin; any_moves_ && i < end; ++i)
    if (sees(i) && before_flat_[i]) add_flat_forces(p, i, block);
  for (const WallPath& path : block.paths) {
    const Index i = path.i, j = path.j;
    const Real share = path.weight * V[j] * slope(p.h[i], path.d), pressure = pressure_[i] + pressure_[j],
               W = kept(path) * V[j] * kernel(p.h[i], path.d);
    // the path of a particle to itself represents its reverse, too, which differs in a corner
    const Vec d = path.moves && i == j ? Vec(0.5 * (path.d - path.turn.transpose() * path.d)) : path.d;
    const Vec force = -V[i] * pressure * (share * d + W * path.by_i);
    p.f.add(i, force);
    force_.add(i, path.weight > 0 ? force : Vec(-V[i] * pressure * W * path.by_i));
    if (path.moves || path.derivatives < path.derivatives_end)
      react(p, path, -V[i] * pressure * share * path.d, -V[i] * pressure * W, block);
    if (!diffusion_) continue;
    // pressure behind the wall is hydrostatic, so its difference is the same as without the wall
    const Vec x = p.x.vec(i);
    const Real rise = now_.rise(x, p.x.vec(j) - x, p.part[i]);
    (*diffusion_)[i] -=
        2 * delta_ * p.h[i] / p.c[i] * share * (pressure_[j] - pressure_[i] + p.rho[i] * rise);
  }
}

/// Reaction of a path on moving walls, half of it here and half by the reverse path: from the force on
/// particle i along the path, and from the derivatives of its share, with the force `per_share`.
void WallImages::react(const Particles& p, const WallPath& path, const Vec& force, Real per_share,
                       Block& block) const {
  for (Index k = path.derivatives; k < path.derivatives_end; ++k)
    give(block.derivatives[static_cast<std::size_t>(k)], 0.5 * per_share, block);
  if (!path.moves) return;
  block.now.clear();
  at_end().add_image_derivatives(sheets_[path.i], path, p.x.vec(path.j), -force, block.now);
  for (const WallDerivative& derivative : block.now) give(derivative, -0.5, block);
}

void WallImages::give(const WallDerivative& derivative, Real times, Block& block) const {
  const WallSurface::Face& face = at_end().face(derivative.face);
  const Vec at = derivative.at - at_end().shift(), force = face.from_image * (times * derivative.force),
            normal = face.from_image * (times * face.n);
  auto& all = block.reactions;
  auto known =
      std::find_if(all.rbegin(), all.rend(), [&](const Reaction& r) { return r.segment == face.segment; });
  Reaction& to = known != all.rend() ? *known : all.emplace_back(Reaction{.segment = face.segment});
  const auto weight = surface_->weights_of_nodes(face, at);
  for (std::size_t e = 0; e < 4; ++e) to.on_node[e] += weight[e] * force;
  if (derivative.lever.isZero()) return;
  const auto there = surface_->weights_of_nodes(face, at + derivative.lever);
  for (std::size_t e = 0; e < 4; ++e) to.on_node[e] += (there[e] - weight[e]) * normal;
}

void WallImages::weigh_edges(World& world) {
  constexpr Real dry = 0.06, wet = 0.16, enough = 0.015;  // docs/theory_walls.md, METHOD 1
  for_each(world.particles.active, [&](Index i) {
    const auto k = static_cast<std::size_t>(i);
    const Real reflected = edge_sum_[0][k], seen = edge_sum_[1][k];
    const Real t = std::clamp((seen - dry * reflected) / ((wet - dry) * reflected + tiny), Real(0), Real(1));
    edge_loss_[i] = (1 - t * t * (3 - 2 * t)) * std::min(Real(1), spacing_ * reflected / enough);
  });
}

void WallImages::give_reactions(World& world) const {
  if (!any_moves_) return;
  for (const Block& block : blocks_)
    for (const Reaction& r : block.reactions) {
      const auto nodes = world.segments.nodes(r.segment);
      for (std::size_t e = 0; e < 4; ++e) {
        world.segments.contact_force->add(r.segment, r.on_node[e]);
        world.nodes.f.add(nodes[e], r.on_node[e]);
      }
    }
}

namespace {

class WallImageForces : public Force {
 public:
  explicit WallImageForces(std::shared_ptr<WallImages> images) : images_(std::move(images)) {}
  std::string name() const override { return "wall images (forces)"; }
  void declare(const World& world, Accesses& a) const override { images_->declare_forces(world, a); }
  void start(World&, const Clock& clock) override { images_->start_forces(clock); }
  void block(World& world, const Clock&, Index begin, Index end) override {
    images_->forces(world, begin, end);
  }
  void finish(World& world, const Clock&) override {
    images_->give_reactions(world);
    images_->weigh_edges(world);
  }

 private:
  std::shared_ptr<WallImages> images_;
};

}  // namespace

std::shared_ptr<Force> make_wall_image_forces(std::shared_ptr<WallImages> images) {
  return std::make_shared<WallImageForces>(std::move(images));
}

}  // namespace courant
