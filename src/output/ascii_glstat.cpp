#include <fmt/format.h>
#include <fmt/printf.h>

#include <cstdio>

#include "output/ascii.hpp"

namespace courant {
namespace {

/// One blank, the label padded with dots to 31 characters, the value.
std::string line(std::string label, Real value) {
  label.resize(31, '.');
  return fmt::sprintf(" %s%14.5E\n", label, value);
}

/// LS-DYNA's words for who controls the step, from the text of TimeLimit.
std::string controller(const std::string& who) {
  long long particle = 0;
  if (std::sscanf(who.c_str(), "sph particle %lld", &particle) == 1)
    return fmt::sprintf("sph %16d", particle);
  return who;
}

}  // namespace

std::string glstat_text(const Sample& s, Real first_potential) {
  const EnergyLedger& e = s.energy;
  Real contact_dissipated = 0;
  for (const InterfaceForce& i : s.interfaces) contact_dissipated += i.energy_damping + i.energy_friction;
  Real at_walls = 0;
  for (const RigidWallForce& wall : s.rigid_walls) at_walls += wall.dissipated;
  Real added_mass = 0, eroded_internal = 0, eroded_hourglass = 0;
  for (const PartSample& part : s.parts) {
    added_mass += part.added_mass;
    eroded_internal += part.eroded_internal, eroded_hourglass += part.eroded_hourglass;
  }
  const Real eroded = eroded_internal + eroded_hourglass;
  const Real internal = e.internal + e.bulk_viscosity + e.dissipated - contact_dissipated - at_walls - eroded;
  const Real external_work = e.external_work + first_potential - e.potential;
  const Real total = e.total() - e.potential;
  const Real expected = e.initial - first_potential + external_work;

  std::string out =
      fmt::sprintf("\n\n dt of cycle%8d is controlled by %s\n\n", s.cycle, controller(s.dt_set_by));
  out += line("time", s.t) + line("time step", s.dt);
  out += line("kinetic energy", e.kinetic) + line("internal energy", internal);
  if (e.hourglass != 0) out += line("hourglass energy", e.hourglass);
  for (const RigidWallForce& wall : s.rigid_walls) {
    out += line("stonewall energy", wall.dissipated);
    out.insert(out.size() - 1, fmt::sprintf(" wall#%6d", wall.id));
  }
  if (s.rigid_walls.empty()) out += line("stonewall energy", 0);
  out += line("rigid body stopper energy", 0) + line("spring and damper energy", e.discrete);
  out += line("system damping energy", 0) + line("sliding interface energy", e.contact + contact_dissipated);
  out += line("external work", external_work);
  out += line("eroded kinetic energy", 0) + line("eroded internal energy", eroded_internal) +
         line("eroded hourglass energy", eroded_hourglass);
  out += line("total energy", total);
  out += line("total energy / initial energy", expected != 0 ? total / expected : 1);
  out += line("energy ratio w/o eroded energy", expected != 0 ? (total - eroded) / expected : 1);
  out += line("global x velocity", s.velocity.x()) + line("global y velocity", s.velocity.y());
  out += line("global z velocity", s.velocity.z());
  if (added_mass != 0)
    out += line("added mass", added_mass) +
           line("percentage increase", 100 * added_mass / (s.mass - added_mass));
  out += fmt::sprintf(" %s%14d\n", "time per zone cycle.(nanosec)..",
                      static_cast<long long>(s.ns_per_zone_cycle + 0.5));
  return out;
}

}  // namespace courant
