#include <fmt/format.h>
#include <fmt/printf.h>

#include <cstdio>

#include "output/ascii/text_history.hpp"
#include "output/glstat.hpp"

namespace courant {
namespace {

/// One blank, the label padded with dots to 31 characters, the value.
std::string line(std::string label, Real value) {
  label.resize(31, '.');
  return fmt::sprintf(" %s%14.5E\n", label, value);
}

/// LS-DYNA's words for the source of the step, from the text of TimeLimit.
std::string controller(const std::string& who) {
  long long particle = 0;
  if (std::sscanf(who.c_str(), "sph particle %lld", &particle) == 1)
    return fmt::sprintf("sph %16d", particle);
  return who;
}

}  // namespace

GlstatNumbers glstat_numbers(const Sample& s, Real first_potential) {
  const EnergyLedger& e = s.energy;
  Real contact_dissipated = 0;
  for (const InterfaceForce& i : s.interfaces) contact_dissipated += i.energy_damping + i.energy_friction;
  GlstatNumbers out;
  for (const RigidWallForce& wall : s.rigid_walls) out.stonewall += wall.dissipated;
  for (const PartSample& part : s.parts) {
    out.added_mass += part.added_mass;
    out.eroded_internal += part.eroded_internal, out.eroded_hourglass += part.eroded_hourglass;
  }
  const Real eroded = out.eroded_internal + out.eroded_hourglass;
  out.kinetic = e.kinetic, out.hourglass = e.hourglass, out.discrete = e.discrete;
  out.internal = e.internal + e.bulk_viscosity + e.dissipated - contact_dissipated - out.stonewall - eroded;
  out.sliding = e.contact + contact_dissipated;
  out.external_work = e.external_work + first_potential - e.potential;
  out.total = e.total() - e.potential;
  const Real expected = e.initial - first_potential + out.external_work;
  if (expected != 0)
    out.ratio = out.total / expected, out.ratio_without_eroded = (out.total - eroded) / expected;
  return out;
}

namespace {

/// One state of glstat. LS-DYNA knows no potential energy: it counts the work of gravity as external work.
/// Therefore external work here is `external_work + first_potential - potential`, total energy is without the
/// potential, sliding energy holds springs, contact damping and friction, stonewall energy what rigid walls
/// took, internal energy the rest of what was dissipated. The ratio is total / (initial + external work), 1
/// exactly when the ledger's residual is 0. first_potential: potential energy at the first state [ML2/T2].
std::string glstat_text(const Sample& s, Real first_potential) {
  const GlstatNumbers g = glstat_numbers(s, first_potential);
  std::string out =
      fmt::sprintf("\n\n dt of cycle%8d is controlled by %s\n\n", s.cycle, controller(s.dt_set_by));
  out += line("time", s.t) + line("time step", s.dt);
  out += line("kinetic energy", g.kinetic) + line("internal energy", g.internal);
  if (g.hourglass != 0) out += line("hourglass energy", g.hourglass);
  for (const RigidWallForce& wall : s.rigid_walls) {
    out += line("stonewall energy", wall.dissipated);
    out.insert(out.size() - 1, fmt::sprintf(" wall#%6d", wall.id));
  }
  if (s.rigid_walls.empty()) out += line("stonewall energy", 0);
  out += line("rigid body stopper energy", 0) + line("spring and damper energy", g.discrete);
  out += line("system damping energy", 0) + line("sliding interface energy", g.sliding);
  out += line("external work", g.external_work);
  out += line("eroded kinetic energy", 0) + line("eroded internal energy", g.eroded_internal) +
         line("eroded hourglass energy", g.eroded_hourglass);
  out += line("total energy", g.total);
  out += line("total energy / initial energy", g.ratio);
  out += line("energy ratio w/o eroded energy", g.ratio_without_eroded);
  out += line("global x velocity", s.velocity.x()) + line("global y velocity", s.velocity.y());
  out += line("global z velocity", s.velocity.z());
  if (g.added_mass != 0)
    out += line("added mass", g.added_mass) +
           line("percentage increase", 100 * g.added_mass / (s.mass - g.added_mass));
  out += fmt::sprintf(" %s%14d\n", "time per zone cycle.(nanosec)..",
                      static_cast<long long>(s.ns_per_zone_cycle + 0.5));
  return out;
}

void glstat_binout(const Sample& s, Real first_potential, HistoryNumbers& to) {
  const GlstatNumbers g = glstat_numbers(s, first_potential);
  to.real("time_step", s.dt);
  to.real("kinetic_energy", g.kinetic), to.real("internal_energy", g.internal);
  to.real("hourglass_energy", g.hourglass), to.real("stonewall_energy", g.stonewall);
  to.real("rigid_body_stopper_energy", 0), to.real("spring_and_damper_energy", g.discrete);
  to.real("system_damping_energy", 0), to.real("sliding_interface_energy", g.sliding);
  to.real("external_work", g.external_work), to.real("eroded_kinetic_energy", 0);
  to.real("eroded_internal_energy", g.eroded_internal);
  to.real("eroded_hourglass_energy", g.eroded_hourglass);
  to.real("total_energy", g.total), to.real("energy_ratio", g.ratio);
  to.real("energy_ratio_wo_eroded", g.ratio_without_eroded);
  to.real("global_x_velocity", s.velocity.x()), to.real("global_y_velocity", s.velocity.y());
  to.real("global_z_velocity", s.velocity.z());
  to.real("added_mass", g.added_mass);
}

const RegisterTextHistory glstat{{"glstat", glstat_text, glstat_binout}};

}  // namespace

}  // namespace courant
