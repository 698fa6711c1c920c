#include "contact/contact.hpp"

#include <fmt/format.h>

#include <cmath>
#include <limits>
#include <utility>

#include "contact/near.hpp"
#include "parallel/parallel.hpp"
#include "state/shared_fields.hpp"
#include "surfaces/contact_thickness.hpp"

namespace courant {
namespace {

constexpr Real infinity = std::numeric_limits<Real>::infinity();

/// A facet that is this far beside the one that a particle is over, of the contact distance, is twenty depth
/// tolerances less deep, so that the order in which facets are looked at does not matter.
constexpr Real apart_of_contact_distance = 2e-4;

/// Stiffness of a segment, K A / (longest diagonal) of a shell, K A^2 / V of the skin of a solid, and the
/// least mass of its nodes.
void give_stiffness(Facet& f, const ContactLaw& law, const WallBodies& bodies, const World& world) {
  const Segments& g = world.segments;
  const auto a = g.nodes(f.segment);
  Corners x;
  for (int e = 0; e < 4; ++e) x[e] = world.nodes.x.vec(a[e]);
  const Real area = 0.5 * (x[2] - x[0]).cross(x[3] - x[1]).norm();
  const bool triangle = a[2] == a[3];
  Real diagonal = std::max((x[2] - x[0]).norm(), (x[3] - x[1]).norm());
  if (triangle) diagonal = std::max({(x[1] - x[0]).norm(), (x[2] - x[1]).norm(), (x[0] - x[2]).norm()});
  // in 2D per unit of depth, and of a shell that is as long as its part in the plane, whatever its width
  const Real V = g.volume[f.segment];
  const Real length = world.dim == 2 ? 1 : V > 0 ? area * area / V : area / diagonal;
  f.k = law.slsfac * law.sfsb * g.K[f.segment] * length;
  f.r = law.sbst > 0 ? 0.5 * law.sbst : 0.5 * contact_thickness(g, f.segment) * law.sfsbt;
  f.m = infinity;
  if (!f.moves) return;
  f.body = f.centred ? -1 : bodies.body(f.node[0]);
  for (const Index n : a)
    if (!world.nodes.held[n]) f.m = std::min(f.m, world.nodes.m[n]);
}

Field<Real>* particle_field(World& world, const std::string& name, const std::string& dimension,
                            int components) {
  return &world.particles.fields.add<Real>({.name = name, .dimension = dimension, .components = components});
}

}  // namespace

Contact::Contact(ContactLaw law, const ContactOptions& options, int number,
                 const std::vector<Index>& segments, const std::vector<bool>& tracked, World& world)
    : law_(std::move(law)),
      options_(options),
      number_(number),
      dim_(world.dim),
      friction_on_(law_.rubs()),
      drag_on_(friction_on_ || law_.vdc > 0),
      hold_(!law_.literal),
      eroded_(shared_fields::eroded.find(world.segments.fields)) {
  const std::string prefix = fmt::format("contact_{}_", number_);
  world.segments.keep_contact_force();
  Particles& p = world.particles;
  k_particle_ = particle_field(world, prefix + "stiffness", "M/T2", 1);
  admissible_ = particle_field(world, prefix + "admissible", "L", 3);
  leaked_ = &p.fields.add<Index>({.name = "leaked", .dimension = "-"});
  if (friction_on_)
    for (int k = 0; k < 3; ++k) {
      friction_normal_[k] = particle_field(world, fmt::format("{}friction_normal_{}", prefix, k), "-", 3);
      friction_force_[k] = particle_field(world, fmt::format("{}friction_force_{}", prefix, k), "ML/T2", 3);
    }
  world.counters.try_emplace("leaked_particles", 0);
  world.maxima.try_emplace("max_penetration", 0);
  if (law_.sast > 0)
    radius_all_ = 0.5 * law_.sast * law_.sfsat;
  else if (options_.thickness_from_volume)
    radius_ = particle_field(world, prefix + "radius", "L", 1);

  facets_ = make_facets(world, segments, [&](Index n) {
    return dim_ == 3 && !world.nodes.held[n] && options_.bodies.body(n) < 0;
  });
  Real r = 0, k_facet = 0, m_facet = infinity;
  for (Facet& f : facets_) {
    give_stiffness(f, law_, options_.bodies, world);
    if (f.moves) moving_.push_back(Index(&f - facets_.data()));
    deforms_ = deforms_ || (f.moves && f.body < 0);
    if (law_.table) part_of_.push_back(world.segments.part[f.segment]);
    walls_.push_back(make_wall(f));
    r = std::max(r, f.r);
    k_facet = std::max(k_facet, f.k);
    m_facet = std::min(m_facet, f.m);
  }
  if (!moving_.empty()) before_.resize(facets_.size()), find_incidence(world);
  Real radius = radius_all_;
  limit_ = infinity;
  for (Index i = 0; i < p.size(); ++i) {
    (*k_particle_)[i] = 0;
    if (!tracked[i]) continue;
    const Real dx = std::pow(p.m[i] / p.rho[i], 1.0 / world.dim);
    // K A^2 / V of a cube of the particle's volume; in 2D per unit depth. K is rho c^2 of the equation of
    // state: strength adds its waves to c later.
    const Real of_law = options_.bulk_modulus(p.part[i]);
    const Real K = of_law > 0 ? of_law : p.rho[i] * p.c[i] * p.c[i];
    (*k_particle_)[i] = law_.slsfac * law_.sfsa * K * (world.dim == 3 ? dx : 1.0);
    if (radius_) radius = std::max(radius, (*radius_)[i] = 0.5 * dx * law_.sfsat);
    Facet stiffest;
    stiffest.m = m_facet;
    const Real m = 1 / (1 / p.m[i] + 1 / m_facet);
    limit_ = std::min(limit_, std::sqrt(2 * m / stiffness(i, (*k_particle_)[i], k_facet, stiffest, world)));
  }
  // An explicit spring with damping xi is stable for w dt < 2 (sqrt(1 + xi^2) - xi), w^2 = k/m; nine tenths
  // of that.
  const Real xi = 0.01 * law_.vdc;
  limit_ *= std::min(Real(1), 0.9 * std::sqrt(Real(2)) * (std::sqrt(1 + xi * xi) - xi));
  // The second wall of an obtuse corner acts up to 1.4 r away from it, so the list looks a little beyond r.
  r_most_ = r + radius;
  find_least_distance(p);
  reach_ = 1.5 * r_most_ + options_.reach_margin;
  grid_.build(facets_, reach_);
  choose_shortcuts();
}

void Contact::find_least_distance(const Particles& p) {
  r_least_ = infinity;
  for (const Facet& f : facets_) r_least_ = std::min(r_least_, f.r);
  Real radius = radius_ ? infinity : radius_all_;
  if (radius_)
    for (Index i = 0; i < p.size(); ++i)
      if ((*k_particle_)[i] > 0) radius = std::min(radius, (*radius_)[i]);
  r_least_ += radius;
}

// Where coordinates are so large that round-off is no longer far below the margins of the shortcuts, there
// are none.
void Contact::choose_shortcuts() {
  if (!options_.shortcuts || facets_.empty()) return;
  Real size = infinity, largest = 0;
  for (const Facet& f : facets_) {
    size = std::min(size, f.radius);
    for (int e = 0; e < f.corners; ++e) largest = std::max(largest, f.x[e].cwiseAbs().maxCoeff());
  }
  const Real r = r_least_;
  if (!std::isfinite(r)) return;
  // with space for walls that move away
  const Real round_off = 4 * std::numeric_limits<Real>::epsilon() * (largest + 100 * reach_);
  search_less_ = round_off < 0.01 * clear_margin * r && round_off < 1e-7 * size;
  if (search_less_ && round_off < 0.1 * depth_tolerance * r)
    find_planes(facets_, reach_, 0.2 * depth_tolerance * r, apart_of_contact_distance * r_most_, walls_);
}

std::string Contact::name() const {
  return fmt::format("contact {}", law_.id ? law_.id : number_);
}

void Contact::declare(const World& world, Accesses& a) const {
  const Particles& p = world.particles;
  const Nodes& n = world.nodes;
  a.reads(p.x).reads(p.v).reads(p.m).updates(p.f).updates(*admissible_);
  if (radius_) a.reads(*radius_);
  if (friction_on_) {
    if (law_.limits_stress()) a.reads(p.rho);
    if (!part_of_.empty()) a.reads(p.part);
    for (std::size_t j = 0; j < 3; ++j) a.updates(*friction_normal_[j]).updates(*friction_force_[j]);
  }
  const bool moves = !moving_.empty(), held = moving_.size() != facets_.size();
  const bool sleeps = law_.birth > 0 || law_.death < ContactLaw().death || law_.gate.there();
  if (moves) a.reads(n.v, Reach::others);
  a.in_start();
  if (sleeps) a.reads(p.x, Reach::others).reads(p.v, Reach::others).updates(*admissible_);
  if (moves) a.reads(n.x, Reach::others).reads(n.v, Reach::others);
  if (held) a.updates(n.f).updates(*world.segments.contact_force);
  if (eroded_) {
    a.reads(*eroded_, Reach::others).reads(p.x, Reach::others).reads(p.v, Reach::others);
    a.reads(*k_particle_, Reach::others).updates(*admissible_).updates(*leaked_);
    if (law_.soft == 1) a.reads(p.m, Reach::others);
    if (radius_) a.reads(*radius_, Reach::others);
    for (std::size_t j = 0; friction_on_ && j < 3; ++j) a.updates(*friction_force_[j]);
    if (auto* near = shared_fields::near_wall.find(p.fields)) a.updates(*near);
  }
  a.in_finish().updates(*leaked_);
  if (moves) a.writes(reactions_resource_);
  if (deforms_) a.reads(n.m, Reach::others).reads(n.held, Reach::others);
}

void Contact::update_facets(const World& world, const Clock& clock) {
  if (moving_.empty()) return;
  const Real moved2 = maximum(Index(moving_.size()), [&](Index k) {
    const Index s = moving_[k];
    Facet& f = facets_[s];
    const Corners old = f.x;
    update_facet(f, world.nodes);
    walls_[s] = make_wall(f);
    Real most = 0;
    for (int e = 0; e < 4; ++e) {
      before_[s][e] = f.x[e] - at_corner(f, e, [&](Index n) { return world.nodes.v.vec(n); }) * clock.dt_old;
      most = std::max(most, (f.x[e] - old[e]).squaredNorm());
    }
    return most;
  });
  travel_ += std::sqrt(moved2) * (1 + clear_margin);
  wall_speed_ = std::sqrt(maximum(Index(moving_.size()), [&](Index k) {
    Real most = 0;
    for (const Index n : facets_[moving_[k]].node)
      if (n >= 0) most = std::max(most, world.nodes.v.vec(n).squaredNorm());
    return most;
  }));
}

void Contact::fall_asleep(World& world) {
  if (asleep_) return;
  let_go_ += std::exchange(stored_, 0);
  for (Block& b : blocks_) {
    b.clear_touches();
    for (Slot& slot : b.slots) slot.behind = false, slot.room = 0;
  }
  for (int k = 0; k < 3; ++k) std::fill_n(admissible_->data(k), world.particles.size(), 0.0);
  asleep_ = true;
}

void Contact::start(World& world, const Clock& clock) {
  for (const Index s : written_) {
    const Facet& f = facets_[s];
    if (!f.moves)  // others are cleared with the forces of all nodes
      for (int e = 0; e < node_count(f); ++e) world.nodes.f.set(f.node[e], Vec::Zero());
    world.segments.contact_force->set(f.segment, Vec::Zero());
  }
  written_.clear();
  shown_ = false;
  soft_dt_ = std::max(soft_dt_, clock.dt_old);
  if (clock.t < law_.birth || clock.t > law_.death || !law_.gate.open()) {
    fall_asleep(world);
    return;
  }
  update_facets(world, clock);
  leave_deleted(world, clock);
  if (asleep_)
    for (Block& b : blocks_)
      for (const Slot& slot : b.slots) learn_sides(world, clock, b, slot);
  asleep_ = false;
}

void Contact::count_leaks(World& world, const std::vector<Index>& particles) {
  for (const Index i : particles) {
    if ((*leaked_)[i]) continue;
    (*leaked_)[i] = 1;
    ++world.counters["leaked_particles"];
  }
}

void Contact::finish(World& world, const Clock&) {
  Real deepest = 0;
  stored_ = 0;
  for (Block& b : blocks_) {
    if (may_end())
      for (const Touch& a : b.touches) stored_ += 0.5 * a.k * a.share * a.depth;
    deepest = std::max(deepest, b.deepest);
    count_leaks(world, b.crossed);
    if (!b.freed.empty()) let_go_ += let_go(b);
  }
  if (!moving_.empty()) gather_reactions();
  if (deforms_)
    stiffest_ =
        std::max(Real(0), maximum(world.nodes.size(), [&](Index n) { return stiffness_of_node(world, n); }));
  if (deepest > 0) {
    acted_ = true;
    Real& most = world.maxima["max_penetration"];
    most = std::max(most, deepest);
  }
}

void Contact::show_forces(World& world) {
  if (shown_) return;
  shown_ = true;
  for (const Block& b : blocks_)
    for (std::size_t t = 0; t < b.touches.size(); ++t) {
      const Facet& f = facets_[b.touches[t].facet];
      if (!f.moves) give_to_wall(world, b, t, shape_functions(f, b.touches[t].q));
    }
}

void Contact::give_to_wall(World& world, const Block& b, std::size_t touch,
                           const std::array<Real, 4>& share) {
  const Index s = b.touches[touch].facet;
  const Facet& f = facets_[s];
  const Vec force = force_of(b, touch);
  for (int e = 0; e < node_count(f); ++e) world.nodes.f.add(f.node[e], -share[e] * force);
  world.segments.contact_force->add(f.segment, -force);
  written_.push_back(s);
}

void Contact::report_point_forces(const World&, const std::function<void(const PointForce&)>& take) {
  for (const Block& b : blocks_)
    for (std::size_t t = 0; t < b.touches.size(); ++t)
      take({.segment = facets_[b.touches[t].facet].segment,
            .point = b.touches[t].q,
            .force = -force_of(b, t)});
}

TimeLimit::Limit Contact::limit(const World& world, const Clock&) {
  Real dt = limit_;
  std::string who = name() + " (particle stiffness)";
  const Real soft = law_.dtstif > 0 ? law_.dtstif : soft_dt_;
  if (law_.soft == 1 && soft > 0) dt = std::min(dt, 2 * soft / std::sqrt(law_.sofscl));
  for (const Block& b : blocks_)
    if (b.approaching >= 0 && b.approach_dt < dt)
      dt = b.approach_dt,
      who = fmt::format("{} (approach of particle {})", name(), world.particles.id[b.approaching]);
  if (stiffest_ > 0) {
    const Real xi = 0.01 * law_.vdc, taken = std::min(options_.tssfac, Real(0.95));
    const Real longest =
        2 / std::sqrt(stiffest_) * std::sqrt(1 - taken * taken) * (std::sqrt(1 + xi * xi) - xi);
    if (longest < dt) dt = longest, who = name() + " (particles on a node)";
  }
  return {dt, who};
}

// Work of the step from the force at t^n and the mean of the velocities before and after the kick.
void Contact::record(World& world, const Clock& clock, EnergyLedger& ledger) {
  record_held(world, clock, ledger);
  ledger.dissipated += let_go_, ledger.throughput += std::abs(let_go_);
  damping_work_ += let_go_, let_go_ = 0;
  if (!drag_on_) return;
  const Particles& p = world.particles;
  const Real before = damping_work_ + friction_work_;
  for_each_block(listed_, [&](Index begin, Index) {
    Block& b = blocks_[begin / block_size];
    b.damping_work = b.friction_work = 0;
    for (std::size_t t = 0; t < b.touches.size(); ++t) {
      const Touch& a = b.touches[t];
      const Index i = a.particle;
      const Vec v = p.v.vec(i) + 0.5 * clock.dt_mean() / p.m[i] * p.f.vec(i) -
                    wall_velocity(world, facets_[a.facet], a.q);
      b.damping_work -= b.drags[t].damping * a.n.dot(v) * clock.dt_mean();
      b.friction_work -= (b.drags[t].friction + b.drags[t].other).dot(v) * clock.dt_mean();
    }
  });
  for (const Block& b : blocks_) {
    damping_work_ += b.damping_work;
    friction_work_ += b.friction_work;
  }
  const Real work = damping_work_ + friction_work_ - before;
  ledger.dissipated += work;
  ledger.throughput += std::abs(work);
}

// Friction springs hold part of the friction work: what they store now is not dissipated yet.
void Contact::sample(const World&, const Clock&, EnergyLedger& ledger) const {
  Real stored = 0;
  for (const Block& b : blocks_)
    for (const Touch& a : b.touches) stored += 0.5 * a.k * a.share * a.depth;
  ledger.contact += stored;
}

InterfaceForce Contact::report() const {
  Vec total = Vec::Zero();
  Real stored = 0, stored_friction = 0;
  for (const Block& b : blocks_)
    for (std::size_t t = 0; t < b.touches.size(); ++t) {
      const Touch& a = b.touches[t];
      total += force_of(b, t);
      stored += 0.5 * a.k * a.share * a.depth;
      if (friction_on_) stored_friction += 0.5 * b.drags[t].friction.squaredNorm() / a.k;
    }
  return {.id = law_.id ? law_.id : Id(number_),
          .title = law_.title,
          .on_surfa = total,
          .energy_stored = stored + stored_friction,
          .energy_damping = damping_work_,
          .energy_friction = friction_work_ - stored_friction};
}

Contact::Penetrations Contact::penetrations(World& world) {
  Penetrations out;
  const Particles& p = world.particles;
  const Index n = p.active > 0 ? p.active : p.size();
  for (Index i = 0; i < n; ++i) {
    if (!((*k_particle_)[i] > 0) || p.state[i] == particle_waiting) continue;
    const Vec x = p.x.vec(i);
    Real deepest = 0;
    for (const Index s : grid_.near(x)) {
      const Facet& f = facets_[s];
      const Real d = is_over(f, x) ? std::abs(plane_distance(f, x)) : (x - nearest_on_rim(f, x)).norm();
      const Real r = contact_distance(i, walls_[s]);
      if (r - d > 1e-6 * r) deepest = std::max(deepest, r - d);  // just touching is no penetration
    }
    if (deepest <= 0) continue;
    ++out.count;
    if (deepest > out.deepest) {
      out.deepest = deepest;
      out.particle = p.id[i];
    }
  }
  return out;
}

}  // namespace courant
