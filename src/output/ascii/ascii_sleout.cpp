#include <fmt/printf.h>

#include "output/ascii/text_history.hpp"

namespace courant {

namespace {

/// One state of sleout: per interface the energy of springs, damping and friction, all of it on the side
/// SURFA (the particles), and the friction among it. Their sum is the sliding energy of glstat.
std::string sleout_text(const Sample& s, Real /*first_potential*/) {
  std::string out = fmt::sprintf("\n\n\n contact interface energy file, time=%14.7E\n", s.t);
  out += fmt::sprintf("    #             surfa       surfb        cycle=%14d    frictional\n\n", s.cycle);
  Real total = 0, friction = 0;
  for (const InterfaceForce& i : s.interfaces) {
    const Real energy = i.energy_stored + i.energy_damping + i.energy_friction;
    out += fmt::sprintf("%10d%13.4E%13.4E%27s%13.4E\n", i.id, energy, 0.0, "", i.energy_friction);
    total += energy, friction += i.energy_friction;
  }
  out += fmt::sprintf("\n summary   total surfa side=%14.7E\n", total);
  out += fmt::sprintf("           total surfb side=%14.7E\n", 0.0);
  out += fmt::sprintf("           total energy    =%14.7E\n", total);
  out += fmt::sprintf("           total friction  =%14.7E\n\n\n\n", friction);
  return out;
}

void sleout_binout(const Sample& s, Real /*first_potential*/, HistoryNumbers& to) {
  using I = InterfaceForce;
  const auto energy = [](const I& i) { return i.energy_stored + i.energy_damping + i.energy_friction; };
  Real total = 0, friction = 0;
  for (const I& i : s.interfaces) total += energy(i), friction += i.energy_friction;
  HistoryRows(to, "", s.interfaces, &I::id)
      .fixed("single_sided", [](const I&) { return 0; })
      .real("slave", energy)
      .real("master", [](const I&) { return 0.0; })
      .real("friction_energy", &I::energy_friction);
  to.real("total_slave", total), to.real("total_master", 0), to.real("total_energy", total);
  to.real("total_friction", friction);
}

const RegisterTextHistory sleout{{"sleout", sleout_text, sleout_binout}};

}  // namespace

}  // namespace courant
