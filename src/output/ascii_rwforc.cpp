#include <fmt/printf.h>

#include "output/ascii.hpp"

namespace courant {

std::string rwforc_text(const Sample& s) {
  std::string out = "\n     time       wall#   normal-force       x-force        y-force        z-force\n";
  for (const RigidWallForce& wall : s.rigid_walls)
    out += fmt::sprintf("%12.5E%8d%15.6E%15.6E%15.6E%15.6E\n", s.t, wall.id, wall.normal, wall.force.x(),
                        wall.force.y(), wall.force.z());
  return out;
}

}  // namespace courant
