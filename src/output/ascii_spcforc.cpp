#include <fmt/printf.h>

#include "output/ascii.hpp"

namespace courant {

std::string spcforc_text(const Sample& s) {
  std::string out = fmt::sprintf(" output at time =%14.5E\n", s.t);
  Vec total = Vec::Zero();
  for (const BoundaryForce& b : s.boundary_forces) {
    if (b.kind != BoundaryForce::Kind::held_point) continue;
    out += fmt::sprintf(" node=%8d local x,y,z forces =%14.4E%14.4E%14.4E\n", b.id, b.force.x(), b.force.y(),
                        b.force.z());
    total += b.force;
  }
  return out + fmt::sprintf("             force resultants   =%14.4E%14.4E%14.4E\n", total.x(), total.y(),
                            total.z());
}

}  // namespace courant
