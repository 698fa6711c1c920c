#pragma once
// The state does not depend on the number of threads, nor on a restart.
#include <gtest/gtest.h>

#include <cstring>
#include <string>
#include <vector>

#include "../structures/solid_decks.hpp"
#include "parallel/parallel.hpp"
#include "state/restartable.hpp"

namespace courant::test {

/// All real numbers of the world, set by set.
inline std::vector<Real> state_of(const World& world) {
  std::vector<Real> out;
  for (const FieldSet* set : world.sets())
    for (const auto& field : set->all())
      if (const auto* reals = dynamic_cast<const Field<Real>*>(field.get()))
        for (int k = 0; k < reals->info().components; ++k)
          out.insert(out.end(), reals->data(k), reals->data(k) + set->size());
  return out;
}

/// What the histories print, but for the time that steps took.
inline std::vector<Real> numbers_of(const Sample& s) {
  std::vector<Real> out{s.t, s.dt, s.mass};
  const auto add = [&](const auto&... numbers) { (out.push_back(numbers), ...); };
  const auto add_vec = [&](const auto&... vectors) {
    (out.insert(out.end(), vectors.data(), vectors.data() + 3), ...);
  };
  const EnergyLedger& e = s.energy;
  add(e.kinetic, e.internal, e.discrete, e.potential, e.contact, e.hourglass, e.bulk_viscosity, e.dissipated,
      e.external_work, e.throughput, e.initial, e.half_step, e.below, e.below_at_start, e.most_internal,
      e.peak);
  add_vec(s.velocity);
  for (const PartSample& p : s.parts) {
    add(p.mass, p.internal, p.kinetic, p.hourglass, p.added_mass, p.eroded_internal, p.eroded_hourglass);
    add_vec(p.momentum, p.rigid_velocity);
  }
  for (const InterfaceForce& c : s.interfaces) {
    add(c.energy_stored, c.energy_damping, c.energy_friction);
    add_vec(c.on_surfa);
  }
  for (const RigidBodyReport& b : s.bodies) {
    add(b.kinetic_energy);
    add_vec(b.x, b.v, b.omega, b.force, b.moment);
  }
  for (const BoundaryForce& b : s.boundary_forces) {
    add(b.work);
    add_vec(b.force, b.moment);
  }
  for (const RigidWallForce& w : s.rigid_walls) {
    add(w.normal, w.dissipated);
    add_vec(w.force, w.impulse, w.v, w.displacement);
  }
  return out;
}

/// All that a run has after some steps: fields, what a restart file would hold, what histories print of the
/// last of them.
struct WholeState {
  std::vector<Real> fields, printed;
  SavedState saved;
};

inline bool same_numbers(const std::vector<Real>& a, const std::vector<Real>& b) {
  return a.size() == b.size() && (a.empty() || std::memcmp(a.data(), b.data(), a.size() * sizeof(Real)) == 0);
}

/// Names of what differs, in bits.
inline std::vector<std::string> differences(const WholeState& a, const WholeState& b) {
  std::vector<std::string> out;
  if (!same_numbers(a.fields, b.fields)) out.emplace_back("fields");
  if (!same_numbers(a.printed, b.printed)) out.emplace_back("what histories print");
  for (const auto& [name, array] : a.saved) {
    const auto other = b.saved.find(name);
    if (other == b.saved.end() || other->second.bytes.size() != array.bytes.size() ||
        (!array.bytes.empty() &&
         std::memcmp(array.bytes.data(), other->second.bytes.data(), array.bytes.size()) != 0))
      out.push_back(name);
  }
  if (a.saved.size() != b.saved.size()) out.emplace_back("names");
  return out;
}

inline SavedState saved_state(Simulation& s) {
  SavedState saved;
  Archive save = Archive::saver(saved);
  s.keep(save);
  return saved;
}

/// Until `steps` steps are done.
inline WholeState state_after(Simulation& s, int steps) {
  WholeState out;
  while (s.clock().cycle < steps)
    s.step([&](World&, const Clock& clock, const std::string& who) {
      if (clock.cycle == steps - 1) out.printed = numbers_of(s.sample(who));
    });
  out.fields = state_of(s.world()), out.saved = saved_state(s);
  return out;
}

/// A run of the deck that goes on from a state.
inline WholeState state_after_restart(const std::string& deck, SavedState saved, int steps) {
  auto s = simulation_of(deck);
  Archive load = Archive::loader(saved);
  s->keep(load);
  return state_after(*s, steps);
}

inline std::string listed(const std::vector<std::string>& names) {
  std::string out;
  for (const std::string& name : names) out += name + "; ";
  return out;
}

/// After `steps`, on 1, 2 and 4 threads, and with a restart from the state after `saved_at`.
inline void expect_same_bits(const std::string& deck, int steps, int saved_at) {
  WholeState reference;
  for (const int threads : {1, 2, 4}) {
    set_threads(threads);
    auto s = simulation_of(deck);
    WholeState state = state_after(*s, steps);
    if (threads == 1)
      reference = std::move(state);
    else
      EXPECT_EQ(listed(differences(reference, state)), "") << threads << " threads";
  }
  set_threads(0);
  auto first = simulation_of(deck);
  for (int k = 0; k < saved_at; ++k) first->step(do_nothing);
  EXPECT_EQ(listed(differences(reference, state_after_restart(deck, saved_state(*first), steps))), "")
      << "after a restart";
}

}  // namespace courant::test
