#include "app/run/interface_impulses.hpp"

#include "extension/builders.hpp"
#include "model/model.hpp"

namespace courant {

namespace {

/// A contact may act on particles and on nodes.
void add_interface(const InterfaceForce& one, std::vector<InterfaceForce>& all) {
  for (InterfaceForce& known : all) {
    if (known.id != one.id) continue;
    known.on_surfa += one.on_surfa;
    known.energy_stored += one.energy_stored, known.energy_damping += one.energy_damping;
    known.energy_friction += one.energy_friction;
    return;
  }
  all.push_back(one);
}

void watch_impulses(const Model& model, World& world, const Contacts& contacts) {
  if (contacts.empty() && world.passes.all<InterfaceReporter>().empty() &&
      world.passes.all<WallForceReporter>().empty())
    return;
  // also without rcforc, which a restart may add
  world.passes.add(std::make_shared<InterfaceImpulses>(contacts, model.output.histories.contains("rcforc")));
}

const RegisterBuilder watch_all(BuildPhase::checks, "impulses of contacts", watch_impulses);

}  // namespace

std::vector<InterfaceForce> interface_forces(const World& world, const Contacts& contacts) {
  std::vector<InterfaceForce> out;
  for (const auto& contact : contacts) out.push_back(contact->report());
  for (const auto* nodes : world.passes.all<const InterfaceReporter>()) add_interface(nodes->report(), out);
  for (const auto* walls : world.passes.all<const WallForceReporter>()) out.push_back(walls->report(world));
  return out;
}

void InterfaceImpulses::record(World& world, const Clock& clock, EnergyLedger&) {
  if (!asked_) return;
  const std::vector<InterfaceForce> now = interface_forces(world, contacts_);
  impulses_.resize(now.size(), Vec::Zero());
  for (std::size_t k = 0; k < now.size(); ++k) impulses_[k] += clock.dt_mean() * now[k].on_surfa;
}

std::vector<Vec> InterfaceImpulses::so_far(std::size_t count) const {
  if (!asked_) return {};
  std::vector<Vec> out = impulses_;
  out.resize(count, Vec::Zero());
  return out;
}

}  // namespace courant
