#include "state/world.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace courant {

Real EnergyLedger::unexplained() const {
  const Real here = residual(), there = here + half_step, kept = there - (below - below_at_start);
  const auto [least, most] = std::minmax({here, there, kept});
  if (least <= 0 && most >= 0) return 0;
  return least > 0 ? least : most;
}

Real EnergyLedger::error() const {
  constexpr Real round_off = 1e-9;
  const Real terms = std::abs(kinetic) + std::abs(internal) + std::abs(potential) + std::abs(contact) +
                     std::abs(hourglass) + std::abs(bulk_viscosity) + std::abs(dissipated) +
                     std::abs(external_work);
  const Real lost = unexplained();
  return std::abs(lost) <= round_off * terms || !(scale() > 0) ? 0 : lost / scale();
}

Index World::elements() const {
  Index count = 0;
  for (const auto& group : groups) count += group->size();
  return count;
}

FieldSet& World::add_set(const std::string& name) {
  for (const FieldSet* set : sets())
    if (set->name() == name) throw std::logic_error("there is an entity set '" + name + "' already");
  return *other_sets.emplace_back(std::make_unique<FieldSet>(name));
}

std::vector<FieldSet*> World::sets() {
  std::vector<FieldSet*> out{&particles.fields, &nodes.fields, &segments.fields};
  for (const auto& set : other_sets) out.push_back(set.get());
  return out;
}

std::vector<const FieldSet*> World::sets() const {
  std::vector<const FieldSet*> out{&particles.fields, &nodes.fields, &segments.fields};
  for (const auto& set : other_sets) out.push_back(set.get());
  return out;
}

bool moves_all_by_bodies(const World& world) {
  return world.particles.size() == 0 &&
         std::all_of(world.groups.begin(), world.groups.end(), [](const auto& group) {
           return sum(group->size(), [&](Index e) { return group->mass[e]; }) == 0 || group->corners() == 1 ||
                  !group->pushes;
         });
}

}  // namespace courant
