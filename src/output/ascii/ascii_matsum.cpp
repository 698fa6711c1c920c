#include <fmt/printf.h>

#include "output/ascii/text_history.hpp"

namespace courant {

namespace {

/// One state of matsum: per part energies, momentum, rigid body velocity.
std::string matsum_text(const Sample& s, Real /*first_potential*/) {
  std::string out = fmt::sprintf("\n\n time =%13.4E\n", s.t);
  for (const PartSample& p : s.parts) {
    out += fmt::sprintf(
        " mat.#=%5d             inten=%13.4E     kinen=%13.4E     eroded_ie=%13.4E     eroded_ke=%13.4E\n",
        p.id, p.internal, p.kinetic, p.eroded_internal, 0.0);
    out += fmt::sprintf(" x-mom=%13.4E     y-mom=%13.4E     z-mom=%13.4E\n", p.momentum.x(), p.momentum.y(),
                        p.momentum.z());
    out += fmt::sprintf(" x-rbv=%13.4E     y-rbv=%13.4E     z-rbv=%13.4E\n", p.rigid_velocity.x(),
                        p.rigid_velocity.y(), p.rigid_velocity.z());
    out += fmt::sprintf("                         hgeng=%13.4E     +mass=%13.4E     eroded_he=%13.4E\n\n",
                        p.hourglass, p.added_mass, p.eroded_hourglass);
  }
  return out;
}

void matsum_binout(const Sample& s, Real /*first_potential*/, HistoryNumbers& to) {
  using P = PartSample;
  HistoryRows(to, "", s.parts, &P::id)
      .real("internal_energy", &P::internal)
      .real("kinetic_energy", &P::kinetic)
      .real("eroded_internal_energy", &P::eroded_internal)
      .real("eroded_kinetic_energy", [](const P&) { return 0.0; })
      .real("eroded_hourglass_energy", &P::eroded_hourglass)
      .real("hourglass_energy", &P::hourglass)
      .vector("{}_momentum", &P::momentum)
      .vector("{}_rbvelocity", &P::rigid_velocity)
      .real("mass", &P::mass)
      .real("added_mass", &P::added_mass);
}

const RegisterTextHistory matsum{{"matsum", matsum_text, matsum_binout, &HistoryTitles::parts}};

}  // namespace

}  // namespace courant
