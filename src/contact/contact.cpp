#include "contact/contact.hpp"

#include <fmt/format.h>

#include <cmath>
#include <limits>

#include "contact/near.hpp"
#include "parallel/parallel.hpp"

namespace courant {
namespace {

constexpr Real infinity = std::numeric_limits<Real>::infinity();

/// Stiffness K A / (longest diagonal) of a shell segment and the least mass of its nodes.
void give_stiffness(Facet& f, const ContactLaw& law, const World& world) {
  const Segments& g = world.segments;
  const auto a = g.nodes(f.segment);
  Corners x;
  for (int e = 0; e < 4; ++e) x[e] = world.nodes.x.vec(a[e]);
  const Real area = 0.5 * (x[2] - x[0]).cross(x[3] - x[1]).norm();
  const bool triangle = a[2] == a[3];
  Real diagonal = std::max((x[2] - x[0]).norm(), (x[3] - x[1]).norm());
  if (triangle) diagonal = std::max({(x[1] - x[0]).norm(), (x[2] - x[1]).norm(), (x[0] - x[2]).norm()});
  f.k = law.slsfac * law.sfsb * g.K[f.segment] * area / diagonal;
  f.r = law.sbst > 0 ? 0.5 * law.sbst : 0.5 * g.thickness[f.segment] * law.sfsbt;
  f.m = infinity;
  if (f.moves)
    for (const Index n : a) f.m = std::min(f.m, world.nodes.m[n]);
}

Field<Real>* particle_field(World& world, const std::string& name, const std::string& dimension,
                            int components) {
  return &world.particles.fields.add<Real>({.name = name, .dimension = dimension, .components = components});
}

}  // namespace

Contact::Contact(ContactLaw law, const ContactOptions& options, int number,
                 const std::vector<Index>& segments, const std::vector<bool>& tracked, World& world)
    : law_(std::move(law)), options_(options), number_(number), friction_on_(law_.fs > 0 || law_.fd > 0) {
  const std::string prefix = fmt::format("contact_{}_", number_);
  Particles& p = world.particles;
  k_particle_ = particle_field(world, prefix + "stiffness", "M/T2", 1);
  ghost_ = particle_field(world, prefix + "ghost", "L", 3);
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

  facets_ = make_facets(world, segments);
  Real r = 0, k_facet = 0, m_facet = infinity;
  for (Facet& f : facets_) {
    give_stiffness(f, law_, world);
    any_moves_ = any_moves_ || f.moves;
    r = std::max(r, f.r);
    k_facet = std::max(k_facet, f.k);
    m_facet = std::min(m_facet, f.m);
  }
  if (any_moves_) before_.resize(facets_.size());
  Real radius = radius_all_;
  limit_ = infinity;
  for (Index i = 0; i < p.size(); ++i) {
    (*k_particle_)[i] = 0;
    if (!tracked[i]) continue;
    const Real dx = std::pow(p.m[i] / p.rho[i], 1.0 / world.dim);
    // rho c^2 A^2 / V of a cube of the particle's volume; in 2D per unit depth
    (*k_particle_)[i] = law_.slsfac * law_.sfsa * p.rho[i] * p.c[i] * p.c[i] * (world.dim == 3 ? dx : 1.0);
    if (radius_) radius = std::max(radius, (*radius_)[i] = 0.5 * dx * law_.sfsat);
    Facet stiffest;
    stiffest.k = k_facet;
    stiffest.m = m_facet;
    const Real m = 1 / (1 / p.m[i] + 1 / m_facet);
    limit_ = std::min(limit_, std::sqrt(2 * m / stiffness(i, stiffest, world)));
  }
  // The second wall of an obtuse corner acts up to 1.4 r away from it, so the list looks a little beyond r.
  reach_ = 1.5 * (r + radius) + options_.reach_margin;
  grid_.build(facets_, reach_);
}

std::string Contact::name() const {
  return fmt::format("contact {}", law_.id ? law_.id : number_);
}

Real Contact::stiffness(Index i, const Facet& f, const World& world) const {
  const Real kn = (*k_particle_)[i];
  Real k = law_.penopt == 2 ? f.k : law_.penopt == 3 ? kn : std::min(kn, f.k);
  const Real dt = law_.dtstif > 0 ? law_.dtstif : soft_dt_;
  if (law_.soft == 1 && dt > 0)
    k = std::max(k, 0.5 * law_.sofscl * std::min(world.particles.m[i], f.m) / (dt * dt));
  return k;
}

void Contact::update_facets(const World& world, const Clock& clock) {
  if (!any_moves_) return;
  for_each(Index(facets_.size()), [&](Index s) {
    Facet& f = facets_[s];
    if (!f.moves) return;
    update_facet(f, world.nodes);
    for (int e = 0; e < 4; ++e)
      before_[s][e] = f.x[e] - world.nodes.v.vec(f.node[std::min(e, f.corners - 1)]) * clock.dt_old;
  });
}

void Contact::refreshed(World& world, const Clock& clock, std::span<const Index>) {
  update_facets(world, clock);
  if (any_moves_) grid_.build(facets_, reach_);
  const Particles& p = world.particles;
  slots_.clear();
  first_.assign(1, 0);
  candidate_.clear();
  for (Index i = 0; i < p.size(); ++i) {
    bool near = false;
    if (i < p.active && (*k_particle_)[i] > 0) {
      const Vec x = p.x.vec(i);
      for (const Index s : grid_.near(x)) {
        const Facet& f = facets_[s];
        if (std::abs(plane_distance(f, x)) > reach_) continue;
        if ((x - f.centre).squaredNorm() > (reach_ + f.radius) * (reach_ + f.radius)) continue;
        if (!is_over(f, x) && (x - nearest_on_rim(f, x)).squaredNorm() > reach_ * reach_) continue;
        candidate_.push_back(s);
        near = true;
      }
    }
    if (near) {
      slots_.push_back({.particle = i});
      first_.push_back(Index(candidate_.size()));
      continue;
    }
    ghost_->set(i, Vec::Zero());
    if (friction_on_)
      for (int k = 0; k < 3; ++k) friction_force_[k]->set(i, Vec::Zero());
  }
  side_.resize(candidate_.size());
  touches_.resize(slots_.size() * Pushes::capacity);
  learn_sides(world, clock);
}

// The sides are those of one step ago, so that a path that crosses a wall in the very step before this one is
// seen.
void Contact::learn_sides(const World& world, const Clock& clock) {
  for_each(Index(slots_.size()), [&](Index s) {
    const Index i = slots_[s].particle;
    const Vec ghost = world.particles.x.vec(i) - world.particles.v.vec(i) * clock.dt_old + ghost_->vec(i);
    for (Index c = first_[s]; c < first_[s + 1]; ++c) {
      const Facet& f = facets_[candidate_[c]];
      if (!f.moves) {
        side_[c] = std::int8_t(side_of(plane_distance(f, ghost)));
        continue;
      }
      const Corners& b = before_[candidate_[c]];
      const Vec n =
          f.corners == 4 ? Vec((b[2] - b[0]).cross(b[3] - b[1])) : Vec((b[1] - b[0]).cross(b[2] - b[0]));
      side_[c] = std::int8_t(side_of(n.dot(ghost - b[0])));
    }
  });
}

void Contact::start(World& world, const Clock& clock) {
  for (int k = 0; k < 3; ++k) {
    std::fill_n(world.nodes.f.data(k), world.nodes.size(), 0.0);
    std::fill_n(world.segments.contact_force.data(k), world.segments.size(), 0.0);
  }
  soft_dt_ = std::max(soft_dt_, clock.dt_old);
  total_ = Vec::Zero();
  stored_ = stored_friction_ = 0;
  if (clock.t < law_.birth || clock.t > law_.death) {
    for (Slot& s : slots_) s.count = 0;
    for (int k = 0; k < 3; ++k) std::fill_n(ghost_->data(k), world.particles.size(), 0.0);
    asleep_ = true;
    return;
  }
  update_facets(world, clock);
  if (asleep_) learn_sides(world, clock);
  asleep_ = false;
  for_each(Index(slots_.size()), [&](Index s) { touch(world, clock, s); });
  scatter(world);
}

void Contact::scatter(World& world) {
  Nodes& nodes = world.nodes;
  Real& deepest = world.maxima["max_penetration"];
  for (std::size_t s = 0; s < slots_.size(); ++s) {
    const Slot& slot = slots_[s];
    if (slot.crossed && !(*leaked_)[slot.particle]) {
      (*leaked_)[slot.particle] = 1;
      ++world.counters["leaked_particles"];
    }
    stored_friction_ += slot.stored_friction;
    for (Index t = 0; t < slot.count; ++t) {
      const Touch& a = touches_[s * Pushes::capacity + t];
      const Facet& f = facets_[a.facet];
      const auto N = shape_functions(f, a.q);
      for (int e = 0; e < f.corners; ++e) nodes.f.add(f.node[e], -N[e] * a.force);
      world.segments.contact_force.add(f.segment, -a.force);
      world.particles.f.add(slot.particle, a.force);
      total_ += a.force;
      stored_ += 0.5 * a.k * a.share * a.depth;
      deepest = std::max(deepest, a.depth);
    }
  }
}

TimeLimit::Limit Contact::limit(const World&, const Clock&) {
  Real dt = limit_;
  const Real soft = law_.dtstif > 0 ? law_.dtstif : soft_dt_;
  if (law_.soft == 1 && soft > 0) dt = std::min(dt, 2 * soft / std::sqrt(law_.sofscl));
  return {dt, name() + " (particle stiffness)"};
}

// Work of the step from the force at t^n and the mean of the velocities before and after the kick.
void Contact::record(World& world, const Clock& clock, EnergyLedger& ledger) {
  if (law_.vdc <= 0 && !friction_on_) return;
  const Particles& p = world.particles;
  const Real before = damping_work_ + friction_work_;
  for (std::size_t s = 0; s < slots_.size(); ++s) {
    const Index i = slots_[s].particle;
    for (Index t = 0; t < slots_[s].count; ++t) {
      const Touch& a = touches_[s * Pushes::capacity + t];
      const Vec v = p.v.vec(i) + 0.5 * clock.dt_mean() / p.m[i] * p.f.vec(i) -
                    wall_velocity(world, facets_[a.facet], a.q);
      damping_work_ -= a.damping * a.n.dot(v) * clock.dt_mean();
      friction_work_ -= a.friction.dot(v) * clock.dt_mean();
    }
  }
  ledger.dissipated += damping_work_ + friction_work_ - before;
}

// Friction springs hold part of the friction work: what they store now is not dissipated yet.
void Contact::sample(const World&, const Clock&, EnergyLedger& ledger) const {
  ledger.contact += stored_;
}

InterfaceForce Contact::report() const {
  return {.id = law_.id ? law_.id : Id(number_),
          .title = law_.title,
          .on_surfa = total_,
          .energy_stored = stored_ + stored_friction_,
          .energy_damping = damping_work_,
          .energy_friction = friction_work_ - stored_friction_};
}

std::vector<Real> Contact::state() const {
  return {damping_work_, friction_work_, soft_dt_};
}

void Contact::set_state(std::span<const Real> state) {
  if (state.size() != 3) return;
  damping_work_ = state[0];
  friction_work_ = state[1];
  soft_dt_ = state[2];
}

Contact::Penetrations Contact::penetrations(World& world) {
  Penetrations out;
  const Particles& p = world.particles;
  const Index n = p.active > 0 ? p.active : p.size();
  for (Index i = 0; i < n; ++i) {
    if (!((*k_particle_)[i] > 0)) continue;
    const Vec x = p.x.vec(i);
    Real deepest = 0;
    for (const Index s : grid_.near(x)) {
      const Facet& f = facets_[s];
      const Real d = is_over(f, x) ? std::abs(plane_distance(f, x)) : (x - nearest_on_rim(f, x)).norm();
      const Real r = contact_distance(i, f);
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
