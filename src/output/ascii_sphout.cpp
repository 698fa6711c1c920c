#include <fmt/printf.h>

#include "output/ascii.hpp"

namespace courant {

std::string sphout_text(const Sample& s) {
  std::string out = fmt::sprintf("\n time =%14.7E   cycle =%10d\n", s.t, s.cycle);
  out +=
      "  particle act             x             y             z            vx            vy            vz    "
      "  pressure"
      "       density        energy\n";
  for (const ParticleSample& p : s.particles) {
    out += fmt::sprintf("%10d%4d", p.id, p.active ? 1 : 0);
    for (Real value : {p.x.x(), p.x.y(), p.x.z(), p.v.x(), p.v.y(), p.v.z(), p.p, p.rho, p.E})
      out += fmt::sprintf("%14.5E", value);
    out += "\n";
  }
  return out;
}

}  // namespace courant
