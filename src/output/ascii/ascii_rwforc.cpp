#include <fmt/printf.h>

#include "output/ascii/text_history.hpp"

namespace courant {

namespace {

/// One state of rwforc: the force on each rigid wall.
std::string rwforc_text(const Sample& s, Real /*first_potential*/) {
  std::string out = "\n     time       wall#   normal-force       x-force        y-force        z-force\n";
  for (const RigidWallForce& wall : s.rigid_walls)
    out += fmt::sprintf("%12.5E%8d%15.6E%15.6E%15.6E%15.6E\n", s.t, wall.id, wall.normal, wall.force.x(),
                        wall.force.y(), wall.force.z());
  return out;
}

void rwforc_binout(const Sample& s, Real /*first_potential*/, HistoryNumbers& to) {
  using W = RigidWallForce;
  HistoryRows(to, "forces", s.rigid_walls, &W::id)
      .real("normal_force", &W::normal)
      .vector("{}_force", &W::force);
}

const RegisterTextHistory rwforc{{"rwforc", rwforc_text, rwforc_binout, &HistoryTitles::rigid_walls}};

}  // namespace

}  // namespace courant
