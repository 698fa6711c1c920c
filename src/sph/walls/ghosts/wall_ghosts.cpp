#include "sph/walls/ghosts/wall_ghosts.hpp"

#include <algorithm>
#include <cmath>
#include <map>

#include "parallel/parallel.hpp"
#include "sph/core/fields.hpp"
#include "sph/walls/wall_surface.hpp"
#include "surfaces/face_forces.hpp"

namespace courant {

namespace {

Vec in_plane(const Vec& x, int dim) {
  return dim == 2 ? Vec(x[0], x[1], 0) : x;
}

}  // namespace

PartFrame::PartFrame(const World& world, std::vector<Index> nodes) : dim_(world.dim) {
  if (nodes.empty()) return;
  const auto at = [&](Index n) { return in_plane(world.nodes.x.vec(n), dim_); };
  const auto farthest = [&](const auto& distance) {
    return *std::max_element(nodes.begin(), nodes.end(),
                             [&](Index a, Index b) { return distance(at(a)) < distance(at(b)); });
  };
  const Vec a = at(nodes.front());
  node_[0] = nodes.front();
  node_[1] = farthest([&](const Vec& x) { return (x - a).norm(); });
  const Vec along = (at(node_[1]) - a).normalized();
  node_[2] = farthest([&](const Vec& x) { return (x - a).cross(along).norm(); });
}

PartFrame::Pose PartFrame::pose(const World& world) const {
  std::array<Vec, 3> x;
  for (std::size_t e = 0; e < 3; ++e) x[e] = in_plane(world.nodes.x.vec(node_[e]), dim_);
  Pose out{x[0], Matrix::Identity()};
  const Vec first = (x[1] - x[0]).normalized();
  const Vec third = dim_ == 2 ? Vec(0, 0, 1) : Vec((x[1] - x[0]).cross(x[2] - x[0]).normalized());
  out.axes.col(0) = first, out.axes.col(1) = third.cross(first), out.axes.col(2) = third;
  return out;
}

WallMotion PartFrame::motion(const World& world) const {
  std::array<Vec, 3> x, v;
  for (std::size_t e = 0; e < 3; ++e) {
    x[e] = in_plane(world.nodes.x.vec(node_[e]), dim_);
    v[e] = in_plane(world.nodes.v.vec(node_[e]), dim_);
  }
  return rigid_motion(x, v, dim_);
}

WallGhosts::WallGhosts(const SphSettings& s, World& world, const std::vector<WallGhost>& laid,
                       const std::vector<char>& driven)
    : dim_(s.dim),
      kernel_(s.kernel),
      loads_(s.loads),
      loads_now_(s.loads.at(0)),
      pressure_(std::holds_alternative<BulkViscosity>(s.viscosity)
                    ? sph_fields::pressure_plus_q(world.particles)
                    : world.particles.p),
      rate_loop_(ghost_rate_loop(s.kernel, s.dim)),
      squeeze_loop_(squeezed_by_ghosts_loop(s.kernel, s.dim)),
      pressure_loop_(ghost_pressure_loop(s.kernel, s.dim, s.has_viscous_stress())) {
  Particles& p = world.particles;
  if (s.has_viscous_stress()) stress_ = &sph_fields::stress(p);
  if (s.density_diffusion > 0) potential_ = &sph_fields::potential(p);
  h_ = p.h[0];
  part_ = p.part[0];
  volume_ = p.m[0] / p.rho[0];
  world.segments.keep_contact_force();
  frames_.emplace_back(world, std::vector<Index>{});
  driven_.push_back(0);
  std::map<Index, Index> frame_of_part;
  std::map<Index, std::vector<Index>> nodes;
  const auto moves = [&](Index segment) { return segment_moves(world, segment); };
  for (Index segment = 0; segment < world.segments.size(); ++segment)
    if (moves(segment))
      for (const Index n : world.segments.nodes(segment)) nodes[world.segments.part[segment]].push_back(n);
  std::vector<PartFrame::Pose> start(1);
  boxes_.push_back({Vec::Zero(), Vec::Zero()});
  for (const WallGhost& ghost : laid) {
    Index frame = 0;
    if (moves(ghost.segment)) {
      const Index part = world.segments.part[ghost.segment];
      const auto [known, is_new] = frame_of_part.try_emplace(part, static_cast<Index>(frames_.size()));
      frame = known->second;
      if (is_new) {
        frames_.emplace_back(world, nodes.at(part));
        driven_.push_back(driven[static_cast<std::size_t>(part)]);
        start.push_back(frames_.back().pose(world));
        boxes_.push_back({Vec::Constant(1e300), Vec::Constant(-1e300)});
      }
    }
    const PartFrame::Pose& at = start[static_cast<std::size_t>(frame)];
    all_.push_back({at.to(ghost.x), ghost.segment, frame});
    Box& box = boxes_[static_cast<std::size_t>(frame)];
    box.low = box.low.cwiseMin(all_.back().x), box.high = box.high.cwiseMax(all_.back().x);
  }
  acceleration_.assign(frames_.size(), Vec::Zero());
  angular_ = acceleration_;
}

void WallGhosts::declare(const World& world, Accesses& a) const {
  const Particles& p = world.particles;
  a.reads(volumes_->before(), Reach::others);
  a.reads(p.x, Reach::others).reads(p.v, Reach::others).reads_before(p.rho).revises(p.drhodt);
  a.in_start().reads(world.nodes.x).reads(world.nodes.v);
}

void WallGhosts::start(World& world, const Clock& clock) {
  loads_now_ = loads_.at(clock.t);
  follow_driven(world, clock);
}

void WallGhosts::block(World& world, const Clock& clock, Index begin, Index end) {
  const List& list = seen_[static_cast<std::size_t>(begin / block_size)];
  if (!list.entries.empty())
    squeeze_loop_(arrays(world), {list.entries.data(), list.start.data(), begin, end});
  if (!list.entries.empty() && clock.dt_old > 0)
    for (Index i = begin; i < end; ++i) {
      const Real rho = world.particles.rho[i], strain = clock.dt_old * world.particles.drhodt[i] / rho;
      world.particles.drhodt[i] = rho * std::expm1(strain) / clock.dt_old;
    }
}

/// Velocities are those of the last half step, so that accelerations are those of half a step before.
void WallGhosts::follow_driven(const World& world, const Clock& clock) {
  const bool first = velocity_.empty();
  velocity_.resize(frames_.size(), Vec::Zero()), omega_.resize(frames_.size(), Vec::Zero());
  for (std::size_t f = 1; f < frames_.size(); ++f) {
    if (!driven_[f]) continue;
    const WallMotion motion = frames_[f].motion(world);
    if (!first && clock.dt_old > 0) {
      acceleration_[f] = (motion.v - velocity_[f]) / clock.dt_old;
      angular_[f] = (motion.omega - omega_[f]) / clock.dt_old;
    }
    velocity_[f] = motion.v, omega_[f] = motion.omega;
  }
}

void WallGhosts::find_poses(const World& world, std::vector<PartFrame::Pose>& poses) const {
  poses.assign(1, {});
  for (std::size_t f = 1; f < frames_.size(); ++f) poses.push_back(frames_[f].pose(world));
}

void WallGhosts::build(World& world, Real support, Real skin) {
  Particles& p = world.particles;
  if (!loaded_) find_poses(world, built_);
  loaded_ = false;
  Vec low = Vec::Constant(1e300), high = -low;
  for (int k = 0; k < dim_; ++k) {
    low[k] = -maximum(p.active, [&](Index i) { return -p.x.data(k)[i]; }) - support - skin;
    high[k] = maximum(p.active, [&](Index i) { return p.x.data(k)[i]; }) + support + skin;
  }
  if (dim_ == 2) low[2] = -1e300, high[2] = 1e300;
  collect(static_cast<Index>(all_.size()), here_, [&](Index begin, Index end, std::vector<Index>& found) {
    for (Index k = begin; k < end; ++k) {
      const Ghost& ghost = all_[static_cast<std::size_t>(k)];
      const Vec x = built_[static_cast<std::size_t>(ghost.frame)].from(ghost.x);
      if ((x.array() >= low.array()).all() && (x.array() <= high.array()).all()) found.push_back(k);
    }
  });
  allocate(world);
  set_positions(world, built_);
}

void WallGhosts::set_positions(World& world, const std::vector<PartFrame::Pose>& poses) const {
  Particles& p = world.particles;
  for_each(count(), [&](Index k) {
    const Ghost& one = ghost(k);
    p.x.set(first() + k, poses[static_cast<std::size_t>(one.frame)].from(one.x));
  });
}

void WallGhosts::sort(World& world, std::span<const Index> order) {
  std::vector<Index> sorted(order.size());
  for (std::size_t k = 0; k < order.size(); ++k) sorted[k] = here_[static_cast<std::size_t>(order[k])];
  here_.swap(sorted);
  Particles& p = world.particles;
  const Index last = first() + count();
  for (const auto& field : p.fields.all()) {  // what none of them has is 0
    auto* real = field->info().exchange ? dynamic_cast<Field<Real>*>(field.get()) : nullptr;
    if (real == nullptr) continue;
    for (int c = 0; c < real->info().components; ++c)
      std::fill(real->data(c) + first(), real->data(c) + last, Real(0));
  }
  std::fill(p.h.data() + first(), p.h.data() + last, h_);
  volumes_->set_ghosts(first(), last, volume_);
  set_positions(world, built_);
}

/// Lists of the groups of n entities: `add(first, count, entries)` appends those of the group of `count` from
/// `first` on.
template <class Add>
void WallGhosts::fill_lists(Index n, std::vector<List>& lists, const Add& add) {
  lists.resize(static_cast<std::size_t>(block_count(n)));
  for_each_block(n, [&](Index begin, Index end) {
    List& list = lists[static_cast<std::size_t>(begin / block_size)];
    list.entries.clear();
    for (Index g = 0; g < Neighbours::groups_per_block; ++g) {
      list.start[static_cast<std::size_t>(g)] = static_cast<Index>(list.entries.size());
      const Index from = begin + g * Neighbours::lanes, size = std::min(Neighbours::lanes, end - from);
      if (size > 0) add(from, size, list.entries);
    }
    list.start[Neighbours::groups_per_block] = static_cast<Index>(list.entries.size());
  });
}

void WallGhosts::relist(World& world) {
  const Index n = count();
  fill_lists(n, lists_, [&](Index from, Index size, std::vector<Index>& entries) {
    neighbours_->add_active_near(world, first() + from, size, entries);
  });
  fill_lists(world.particles.active, seen_, [&](Index from, Index, std::vector<Index>& entries) {
    for (const Index j : neighbours_->listed(from / Neighbours::lanes))
      if (j >= first()) entries.push_back(j);
  });
  for (auto* arrays : {rise_, force_})
    for (int k = 0; k < 3; ++k) arrays[k].assign(static_cast<std::size_t>(n), Real(0));
  for (auto* array : {&value_, &excess_, &excess_before_, &volume_rate_})
    array->assign(static_cast<std::size_t>(n), Real(0));
  squeeze_.assign(static_cast<std::size_t>(n + (copies_ ? copies_->count() : 0)), Real(0));
}

void WallGhosts::keep(Archive& archive) {
  std::vector<Vec> positions;
  for (const PartFrame::Pose& position : built_) {
    positions.push_back(position.x);
    for (Index k = 0; k < 3; ++k) positions.push_back(position.axes.col(k));
  }
  archive("positions", positions);
  archive("velocity", velocity_);
  archive("omega", omega_);
  archive("half_step", half_step_);
  archive("excess", excess_);
  if (!archive.loading()) return;
  excess_.swap(saved_excess_);
  built_.assign(positions.size() / 4, {});
  for (std::size_t f = 0; f < built_.size(); ++f) {
    built_[f].x = positions[4 * f];
    for (Index k = 0; k < 3; ++k) built_[f].axes.col(k) = positions[4 * f + 1 + static_cast<std::size_t>(k)];
  }
  loaded_ = built_.size() == frames_.size();
}

/// The farthest that a corner of the boxes around the ghosts has moved: no point between them has moved more.
Real WallGhosts::largest_move(const World& world) const {
  Real most2 = 0;
  for (std::size_t f = 1; f < frames_.size() && f < built_.size(); ++f) {
    const PartFrame::Pose now = frames_[f].pose(world);
    for (int corner = 0; corner < 8; ++corner) {
      Vec x;
      for (int k = 0; k < 3; ++k) x[k] = (corner >> k & 1) != 0 ? boxes_[f].high[k] : boxes_[f].low[k];
      most2 = std::max(most2, (now.from(x) - built_[f].from(x)).squaredNorm());
    }
  }
  return std::sqrt(most2);
}

template <class Loop>
void WallGhosts::run(Loop loop, const GhostArrays& a) const {
  for_each_block(count(), [&](Index begin, Index end) {
    const List& list = lists_[static_cast<std::size_t>(begin / block_size)];
    loop(a, {list.entries.data(), list.start.data(), a.first + begin, a.first + end});
  });
}

/// Of the rates; the forces need more (`set_pressures`).
GhostArrays WallGhosts::arrays(World& world) {
  Particles& p = world.particles;
  GhostArrays a{};
  for (int k = 0; k < 3; ++k) a.x[k] = p.x.data(k), a.v[k] = p.v.data(k);
  a.V = volumes_->current(), a.rho = p.rho.data(), a.drhodt = p.drhodt.data();
  a.h = h_, a.half_step = half_step_, a.kernel = &any_kernel(kernel_), a.first = first();
  a.squeeze = squeeze_.data(), a.volume_rate = volume_rate_.data();
  return a;
}

/// Of the middle of the step, where the positions in it were, too.
void WallGhosts::set_velocities(World& world) const {
  std::vector<WallMotion> motion(frames_.size());
  for (std::size_t f = 1; f < frames_.size(); ++f) motion[f] = frames_[f].motion(world);
  Particles& p = world.particles;
  for_each(count(), [&](Index k) {
    const auto f = static_cast<std::size_t>(ghost(k).frame);
    if (f == 0) return;
    const Vec r = p.x.vec(first() + k) - motion[f].x0;
    p.v.set(first() + k, motion[f].v + motion[f].omega.cross(r - half_step_ * motion[f].omega.cross(r)));
  });
}

void WallGhosts::set_pressures(World& world) {
  Particles& p = world.particles;
  std::vector<WallMotion> motion(frames_.size());
  for (std::size_t f = 1; f < frames_.size(); ++f)
    if (driven_[f]) motion[f] = frames_[f].motion(world);
  for_each(count(), [&](Index k) {
    const auto f = static_cast<std::size_t>(ghost(k).frame);
    const Vec x = p.x.vec(first() + k);
    Vec g = loads_.uniform() ? loads_now_.everywhere() : loads_now_(x, part_);
    if (driven_[f]) {
      const Vec r = x - motion[f].x0;
      const Vec& omega = motion[f].omega;
      g -= acceleration_[f] + angular_[f].cross(r) + omega.cross(omega.cross(r));
    }
    for (int c = 0; c < 3; ++c) rise_[c][k] = g[c];
  });
  excess_.swap(excess_before_);
  GhostArrays a = arrays(world);
  for (int k = 0; k < 3; ++k) a.g[k] = rise_[k].data(), a.force[k] = force_[k].data();
  for (int k = 0; stress_ != nullptr && k < 6; ++k) a.tau[k] = stress_->data(k);
  a.m = p.m.data(), a.p = pressure_.data(), a.pressure = value_.data(), a.excess = excess_.data();
  run(pressure_loop_, a);
  for_each(count(), [&](Index k) { pressure_[first() + k] = value_[k]; });
}

void WallGhosts::exchange(World& world, std::span<const FieldBase* const> fields) {
  Particles& p = world.particles;
  const auto asks = [&](const FieldBase* field) {
    return field != nullptr && std::find(fields.begin(), fields.end(), field) != fields.end();
  };
  if (asks(&p.x) && any_moves()) {
    std::vector<PartFrame::Pose> poses;
    find_poses(world, poses);
    set_positions(world, poses);
  }
  if (asks(potential_))
    for_each(count(), [&](Index k) {
      const Vec x = p.x.vec(first() + k);
      (*potential_)[first() + k] =
          loads_.uniform() ? -loads_now_.everywhere().dot(x) : loads_now_.potential(x, part_);
    });
  if (asks(&p.v)) {
    if (any_moves()) set_velocities(world);
    run(rate_loop_, arrays(world));
    for (Index k = 0; copies_ && k < copies_->count(); ++k)
      squeeze_[count() + k] = squeeze_[copies_->source(k) - first()];
  }
  if (asks(&pressure_)) set_pressures(world);
}

void WallGhosts::exchange_all(World& world) {
  if (!saved_excess_.empty()) {  // pressures of the last forces; nothing reads them before the next ones
    const FieldBase* const positions[]{&world.particles.x, &world.particles.v, potential_};
    exchange(world, positions);
    excess_.swap(saved_excess_);
    saved_excess_.clear();
    return;
  }
  const FieldBase* const fields[]{&world.particles.x, &world.particles.v, &pressure_, potential_};
  exchange(world, fields);
}

void WallGhosts::record(World& world, const Clock& clock, EnergyLedger& ledger) {
  const Real work = -clock.dt_old * sum(count(), [&](Index k) {
    return 0.5 * volume_rate_[k] * (excess_before_[k] + excess_[k]);
  });
  ledger.external_work += work;
  world.maxima["wall_ghost_work"] += work;
  half_step_ = 0.5 * clock.dt;
}

// Of each segment the force and the moment about its middle; nodes get forces of that sum and that moment.
void WallGhosts::add_forces(World& world, bool moving) const {
  struct Load {
    Vec middle, force = Vec::Zero(), moment = Vec::Zero();
  };
  std::map<Index, Load> loads;
  const auto middle = [&](Index segment) {
    const auto nodes = world.segments.nodes(segment);
    const int n = nodes[2] == nodes[3] ? 3 : 4;
    Vec sum = Vec::Zero();
    for (int e = 0; e < n; ++e) sum += world.nodes.x.vec(nodes[static_cast<std::size_t>(e)]);
    return Vec(sum / n);
  };
  for (Index k = 0; k < count(); ++k) {
    const Ghost& one = ghost(k);
    const Vec F = force(k);
    if ((one.frame > 0) != moving || F.isZero(0)) continue;
    const auto [known, is_new] = loads.try_emplace(one.segment);
    Load& load = known->second;
    if (is_new) load.middle = middle(one.segment);
    load.force += F;
    load.moment += in_plane(world.particles.x.vec(first() + k) - load.middle, dim_).cross(F);
  }
  for (const auto& [segment, load] : loads) {
    const auto nodes = world.segments.nodes(segment);
    const int n = nodes[2] == nodes[3] ? 3 : 4;
    Matrix inertia = Matrix::Zero();
    for (int e = 0; e < n; ++e) {
      const Vec r = world.nodes.x.vec(nodes[static_cast<std::size_t>(e)]) - load.middle;
      inertia += r.squaredNorm() * Matrix::Identity() - r * r.transpose();
    }
    const Vec turn = inertia.completeOrthogonalDecomposition().solve(load.moment);
    for (int e = 0; e < n; ++e) {
      const Index node = nodes[static_cast<std::size_t>(e)];
      world.nodes.f.add(node, load.force / n + turn.cross(world.nodes.x.vec(node) - load.middle));
    }
    world.segments.contact_force->add(segment, load.force);
  }
}

InterfaceForce WallGhosts::report(const World&) const {
  InterfaceForce out;
  out.title = "wall support";
  for (Index k = 0; k < count(); ++k) out.on_surfa -= force(k);
  return out;
}

void WallGhosts::show_forces(World& world) {
  if (!shown_.empty()) return;
  for (Index k = 0; k < count(); ++k) {
    const Ghost& one = ghost(k);
    if (one.frame == 0) shown_.push_back(one.segment);
  }
  std::sort(shown_.begin(), shown_.end());
  shown_.erase(std::unique(shown_.begin(), shown_.end()), shown_.end());
  add_forces(world, false);
}

void WallGhosts::take_back_forces(World& world) {
  for (const Index s : shown_) {
    world.segments.contact_force->set(s, Vec::Zero());
    for (const Index n : world.segments.nodes(s)) world.nodes.f.set(n, Vec::Zero());
  }
  shown_.clear();
}

void WallGhosts::report_point_forces(const World& world, const std::function<void(const PointForce&)>& take) {
  for (Index k = 0; k < count(); ++k) {
    const Ghost& one = ghost(k);
    take({.segment = one.segment, .point = world.particles.x.vec(first() + k), .force = force(k)});
  }
}

namespace {

/// Hands the forces of the water on ghosts to the parts that they belong to.
class WallGhostForce : public Force {
 public:
  explicit WallGhostForce(std::shared_ptr<WallGhosts> ghosts) : ghosts_(std::move(ghosts)) {}
  std::string name() const override { return "wall ghosts (forces)"; }
  void declare(const World& world, Accesses& a) const override {
    const Segments& s = world.segments;
    a.reads(ghosts_->pressure(), Reach::others);
    a.in_start().updates(*s.contact_force).updates(world.nodes.f);
    a.reads(s.node0).reads(s.node1).reads(s.node2).reads(s.node3);
    a.in_finish().updates(*s.contact_force).updates(world.nodes.f).reads(world.nodes.x);
    a.reads(world.particles.x);
    a.reads(s.node0).reads(s.node1).reads(s.node2).reads(s.node3);
  }
  void start(World& world, const Clock&) override { ghosts_->take_back_forces(world); }
  void block(World&, const Clock&, Index, Index) override {}
  void finish(World& world, const Clock&) override {
    if (ghosts_->any_moves()) ghosts_->add_forces(world, true);
  }

 private:
  std::shared_ptr<WallGhosts> ghosts_;
};

}  // namespace

void add_wall_ghost_forces(World& world, std::shared_ptr<WallGhosts> ghosts) {
  if (ghosts->any_moves()) add_clear_face_forces(world);
  world.passes.add(std::make_shared<WallGhostForce>(std::move(ghosts)));
}

}  // namespace courant
