#include "loads/carried_mass.hpp"

#include <algorithm>
#include <array>
#include <map>

#include <Eigen/LU>

#include "parallel/parallel.hpp"
#include "state/shared_fields.hpp"
#include "state/tied_mass.hpp"

namespace courant {

CarriedMass::CarriedMass(std::shared_ptr<const Carriage> how, std::string name, World& world)
    : how_(std::move(how)),
      name_(std::move(name)),
      open_(shared_fields::open_momentum.add(world.nodes.fields)),
      inertia_(shared_fields::rotary_inertia.find(world.nodes.fields)),
      spin_(shared_fields::angular_velocity.find(world.nodes.fields)) {
  const Nodes& nodes = world.nodes;
  std::map<Index, std::size_t> place;
  first_.push_back(0);
  for (std::size_t i = 0; i < how_->size(); ++i) {
    const auto carriers = how_->carriers(i);
    const auto shares = how_->shares(i);
    const Real mass = nodes.m[how_->node(i)];
    weighs_.push_back(mass > 0 && how_->weighs(world, i));
    any_ = any_ || weighs_[i];
    for (std::size_t k = 0; k < carriers.size(); ++k) {
      const auto [at, is_new] = place.try_emplace(carriers[k], node_.size());
      if (is_new) node_.push_back(carriers[k]), slots_of_.emplace_back();
      if (weighs_[i]) slots_of_[at->second].push_back(carrier_.size());
      carrier_.push_back(at->second), carried_.push_back(i), share_.push_back(shares[k]);
    }
    first_.push_back(carrier_.size());
  }
  counts_ = weighs_;
  own_.resize(node_.size());
  rate_.resize(carrier_.size());
  is_free_.resize(node_.size()), inverse_.resize(node_.size());
  mass_.resize(counts_.size()), turns_.resize(counts_.size());
  for (Vecs* of_carriers : {&before_, &v_, &x_, &wanted_, &pushed_})
    of_carriers->assign(node_.size(), Vec::Zero());
  for (Vecs* of_carried : {&was_, &had_spin_, &change_, &turned_, &a_, &spin_a_, &momenta_, &turning_})
    of_carried->assign(counts_.size(), Vec::Zero());
  find_own_masses(world);
}

void CarriedMass::find_own_masses(const World& world) {
  each_carrier([&](std::size_t c) {
    own_[c] = world.nodes.m[node_[c]];
    for (const std::size_t slot : slots_of_[c])
      if (counts_[carried_[slot]]) own_[c] -= share_[slot] * world.nodes.m[how_->node(carried_[slot])];
  });
}

void CarriedMass::find_free_axes(const World& world) {
  const FieldSet& nodes = world.nodes.fields;
  const Field<Index>*held = shared_fields::held_axes.find(nodes),
        *driven = shared_fields::driven_axes.find(nodes), *alike = shared_fields::alike_axes.find(nodes);
  for (std::size_t c = 0; c < node_.size(); ++c) {
    const Index n = node_[c],
                bits = (held ? (*held)[n] : 0) | (driven ? (*driven)[n] : 0) | (alike ? (*alike)[n] : 0);
    for (int k = 0; k < 3; ++k)
      is_free_[c][static_cast<std::size_t>(k)] = world.nodes.follow[n] == 0 && !(bits & (1 << k));
  }
}

template <class Value>
void CarriedMass::each_carrier(const Value& value) const {
  for_each(static_cast<Index>(node_.size()), [&](Index c) { value(static_cast<std::size_t>(c)); });
}

Vec CarriedMass::free(std::size_t c, Vec value) const {
  for (int k = 0; k < 3; ++k)
    if (!is_free_[c][static_cast<std::size_t>(k)]) value[k] = 0;
  return value;
}

/// sum B^T p + W^T L over the nodes that a carrier carries.
Vec CarriedMass::pulled(std::size_t c, const Vecs& momenta, const Vecs& turning) const {
  Vec out = Vec::Zero();
  for (const std::size_t slot : slots_of_[c]) {
    const std::size_t i = carried_[slot];
    if (!counts_[i]) continue;
    out += rate_[slot].B.transpose() * momenta[i];
    if (turns_[i] > 0) out += rate_[slot].W.transpose() * turning[i];
  }
  return out;
}

Carriage::Chord CarriedMass::chord(const World& world, std::size_t i, const Vecs& x, const Vecs& v,
                                   Real dt) const {
  thread_local Vecs x_of, v_of;
  x_of.clear(), v_of.clear();
  for (std::size_t slot = first_[i]; slot < first_[i + 1]; ++slot)
    x_of.push_back(x[carrier_[slot]]), v_of.push_back(v[carrier_[slot]]);
  return how_->chord(world, i, x_of, v_of, dt);
}

void CarriedMass::look(World& world) {
  find_free_axes(world);
  for_each(static_cast<Index>(counts_.size()), [&](Index k) {
    const auto i = static_cast<std::size_t>(k);
    const Index n = how_->node(i);
    was_[i] = world.nodes.v.vec(n), mass_[i] = world.nodes.m[n];
    counts_[i] = weighs_[i] && how_->holds(world, i);
    turns_[i] = inertia_ && how_->spins(i) ? (*inertia_)[n] : 0;
    if (turns_[i] > 0) had_spin_[i] = spin_->vec(n);
    if (counts_[i]) how_->rates(world, i, std::span(rate_).subspan(first_[i], first_[i + 1] - first_[i]));
  });
  find_own_masses(world);
  each_carrier([&](std::size_t c) { before_[c] = world.nodes.v.vec(node_[c]); });
  precondition();
}

void CarriedMass::precondition() {
  each_carrier([&](std::size_t c) {
    Matrix M = own_[c] * Matrix::Identity();
    for (const std::size_t slot : slots_of_[c]) {
      const Carriage::Rate& rate = rate_[slot];
      if (!counts_[carried_[slot]]) continue;
      M += mass_[carried_[slot]] * rate.B.transpose() * rate.B;
      if (turns_[carried_[slot]] > 0) M += turns_[carried_[slot]] * rate.W.transpose() * rate.W;
    }
    for (int k = 0; k < 3; ++k)
      if (!is_free_[c][static_cast<std::size_t>(k)]) M.row(k).setZero(), M.col(k).setZero(), M(k, k) = 1;
    inverse_[c] = M.trace() > 0 ? Matrix(M.inverse()) : Matrix(Matrix::Zero());
  });
}

Real CarriedMass::dot(const Vecs& a, const Vecs& b) const {
  return sum(static_cast<Index>(a.size()),
             [&](Index c) { return a[static_cast<std::size_t>(c)].dot(b[static_cast<std::size_t>(c)]); });
}

/// (own mass + sum B^T m B + W^T I W) p.
void CarriedMass::times(const Vecs& p, Vecs& out) {
  for_each(static_cast<Index>(counts_.size()), [&](Index k) {
    const auto i = static_cast<std::size_t>(k);
    if (!counts_[i]) return;
    Vec v = Vec::Zero(), w = Vec::Zero();
    for (std::size_t slot = first_[i]; slot < first_[i + 1]; ++slot) {
      v += rate_[slot].B * p[carrier_[slot]];
      if (turns_[i] > 0) w += rate_[slot].W * p[carrier_[slot]];
    }
    momenta_[i] = mass_[i] * v, turning_[i] = turns_[i] * w;
  });
  each_carrier([&](std::size_t c) { out[c] = free(c, own_[c] * p[c] + pulled(c, momenta_, turning_)); });
}

/// Conjugate gradients.
CarriedMass::Vecs CarriedMass::solve(Vecs r) {
  constexpr Real enough = 1e-9;  // of the right side; what is left is solved for again
  constexpr int most = 500;
  Vecs out(r.size(), Vec::Zero()), z(r.size()), q(r.size());
  const auto condition = [&] { each_carrier([&](std::size_t c) { z[c] = inverse_[c] * r[c]; }); };
  condition();
  Vecs p = z;
  Real rz = dot(r, z);
  const Real first = rz;
  for (int it = 0; it < most && rz > enough * enough * first; ++it) {
    times(p, q);
    const Real step = rz / dot(p, q);
    each_carrier([&](std::size_t c) { out[c] += step * p[c], r[c] -= step * q[c]; });
    condition();
    const Real now = dot(r, z);
    each_carrier([&](std::size_t c) { p[c] = z[c] + now / rz * p[c]; });
    rz = now;
  }
  return out;
}

void CarriedMass::join(World& world) {
  look(world);
  constexpr int rounds = 3;
  for (int round = 0; round < rounds; ++round) {
    Vecs r(node_.size());
    for (std::size_t i = 0; i < counts_.size(); ++i) {
      Vec v = Vec::Zero(), spin = Vec::Zero();
      for (std::size_t slot = first_[i]; slot < first_[i + 1]; ++slot)
        v += rate_[slot].B * before_[carrier_[slot]], spin += rate_[slot].W * before_[carrier_[slot]];
      change_[i] = mass_[i] * (was_[i] - v), turned_[i] = turns_[i] * (had_spin_[i] - spin);
      world.nodes.v.set(how_->node(i), v);
      if (how_->spins(i) && spin_) spin_->set(how_->node(i), spin);
    }
    each_carrier([&](std::size_t c) {
      r[c] = free(c, pulled(c, change_, turned_) + own_[c] * (world.nodes.v.vec(node_[c]) - before_[c]));
    });
    const Vecs more = solve(r);
    each_carrier([&](std::size_t c) { before_[c] += more[c]; });
  }
  each_carrier([&](std::size_t c) { world.nodes.v.set(node_[c], before_[c]); });
}

/// Of the momenta of carried nodes, where carriers come to x with the velocities v.
void CarriedMass::note_changes(const World& world, const Vecs& x, const Vecs& v, const Clock& clock) {
  for_each(static_cast<Index>(counts_.size()), [&](Index k) {
    const auto i = static_cast<std::size_t>(k);
    if (!counts_[i]) return;
    const Carriage::Chord now = chord(world, i, x, v, clock.dt);
    change_[i] = mass_[i] * (now.v - was_[i]);
    if (turns_[i] > 0) turned_[i] = turns_[i] * (now.spin - had_spin_[i]);
  });
}

/// By Newton's method: the chords of a step are nearly linear in the velocities.
void CarriedMass::find_velocities(World& world, const Clock& clock) {
  const Nodes& nodes = world.nodes;
  Vecs r(node_.size());
  each_carrier([&](std::size_t c) {
    const Index n = node_[c];
    const Vec impulse = clock.dt_mean() * nodes.f.vec(n);
    wanted_[c] = free(c, impulse + open_.vec(n));
    v_[c] = before_[c] + (nodes.follow[n] == 0 ? free(c, Vec(impulse / nodes.m[n])) : Vec(Vec::Zero()));
  });
  constexpr int most = 6;
  constexpr Real round_off = 1e-15;
  Real last = 0;
  for (int round = 0; round < most; ++round) {
    each_carrier([&](std::size_t c) { x_[c] = nodes.x.vec(node_[c]) + clock.dt * v_[c]; });
    note_changes(world, x_, v_, clock);
    each_carrier([&](std::size_t c) {
      r[c] = free(c, wanted_[c] - own_[c] * (v_[c] - before_[c]) - pulled(c, change_, turned_));
    });
    const Real wrong = sum(static_cast<Index>(node_.size()), [&](Index k) {
      const auto c = static_cast<std::size_t>(k);
      return r[c].dot(inverse_[c] * r[c]);
    });
    const Real all = sum(static_cast<Index>(node_.size()), [&](Index k) {
      const auto c = static_cast<std::size_t>(k);
      return nodes.m[node_[c]] * (v_[c].squaredNorm() + before_[c].squaredNorm());
    });
    if (!(wrong > round_off * round_off * all) || (round > 1 && wrong > 0.25 * last)) return;
    last = wrong;
    const Vecs more = solve(r);
    each_carrier([&](std::size_t c) { v_[c] += more[c]; });
  }
}

/// Forces with which the usual kick gives the velocities; supports bear what the carried nodes take there.
void CarriedMass::push(World& world, const Clock& clock) {
  Nodes& nodes = world.nodes;
  Field<Real>* support = shared_fields::support_force.find(nodes.fields);
  const Real dt = clock.dt_mean();
  each_carrier([&](std::size_t c) {
    const Index n = node_[c];
    pushed_[c] = free(c, Vec(nodes.m[n] / dt * (v_[c] - before_[c]) - nodes.f.vec(n)));
    nodes.f.add(n, pushed_[c]);
    if (!support || nodes.follow[n] != 0) return;
    const Vec taken = pulled(c, change_, turned_) / dt;
    support->add(n, taken - free(c, taken));
  });
  for (std::size_t i = 0; i < counts_.size(); ++i)
    if (counts_[i])
      a_[i] = change_[i] / (mass_[i] * dt),
      spin_a_[i] = turns_[i] > 0 ? Vec(turned_[i] / (turns_[i] * dt)) : Vec(Vec::Zero());
}

void CarriedMass::strike(World& world, const Clock& clock) {
  if (!(clock.dt > 0) || !any_) return;
  look(world);
  find_velocities(world, clock);
  push(world, clock);
}

void CarriedMass::declare_move(const World& world, Accesses& a) const {
  a.in_finish().revises(world.nodes.x).revises(world.nodes.v).reads(world.nodes.follow);
  if (any_) a.reads(world.nodes.f).reads(world.nodes.m).updates(open_);
}

void CarriedMass::move(World& world, const Clock& clock) {
  if (!(clock.dt > 0)) return;
  Nodes& nodes = world.nodes;
  each_carrier([&](std::size_t c) { x_[c] = nodes.x.vec(node_[c]), v_[c] = nodes.v.vec(node_[c]); });
  if (any_) note_changes(world, x_, v_, clock);
  const Real dt = clock.dt_mean();
  each_carrier([&](std::size_t c) {
    const Index n = node_[c];
    if (!any_ || nodes.follow[n] != 0) return;
    const Vec force = nodes.f.vec(n), got = dt * own_[c] / nodes.m[n] * force + pulled(c, change_, turned_);
    open_.set(n, free(c, open_.vec(n) + dt * (force - pushed_[c]) - got));
  });
  for_each(static_cast<Index>(counts_.size()), [&](Index k) {
    const auto i = static_cast<std::size_t>(k);
    const Index n = how_->node(i);
    if (!how_->holds(world, i)) return;
    const Carriage::Chord now = chord(world, i, x_, v_, clock.dt);
    nodes.x.set(n, now.x), nodes.v.set(n, now.v);
    if (how_->spins(i) && spin_) spin_->set(n, now.spin);
  });
}

/// Beyond those that the carriers have with the masses of World::nodes.
CarriedMass::Energies CarriedMass::energies(const World& world, Real dt) const {
  const Nodes& nodes = world.nodes;
  Energies out;
  const auto add = [&](Real mass, const Vec& v, const Vec& a) {
    const Vec now = v + 0.5 * dt * a;
    out.kinetic += 0.5 * mass * v.squaredNorm();
    out.half_step += 0.5 * mass * (now.squaredNorm() - v.squaredNorm());
    out.below += 0.125 * dt * dt * mass * a.squaredNorm();
  };
  for (std::size_t i = 0; i < counts_.size(); ++i) {
    if (!counts_[i]) continue;
    const Index n = how_->node(i);
    add(nodes.m[n], nodes.v.vec(n), a_[i]);
    if (inertia_ && how_->spins(i)) add((*inertia_)[n], spin_->vec(n), spin_a_[i]);
  }
  for (std::size_t c = 0; c < node_.size(); ++c)
    if (const Index n = node_[c]; !slots_of_[c].empty())
      add(own_[c] - nodes.m[n], nodes.v.vec(n), nodes.f.vec(n) / nodes.m[n]);
  return out;
}

void CarriedMass::record(World& world, const Clock& clock, EnergyLedger& ledger) {
  if (clock.cycle == 0) ledger.below_at_start += energies(world, clock.dt).below;
}
void CarriedMass::sample(const World& world, const Clock& clock, EnergyLedger& ledger) const {
  const Energies more = energies(world, clock.dt_old);
  ledger.kinetic += more.kinetic, ledger.half_step += more.half_step, ledger.below += more.below;
}

}  // namespace courant
