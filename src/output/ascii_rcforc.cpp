#include <fmt/printf.h>

#include "output/ascii.hpp"

namespace courant {

std::string rcforc_text(const Sample& s) {
  std::string out;
  const auto line = [&](const char* side, Id id, const Vec& f) {
    out += fmt::sprintf("  %s %11d time%12.5E  x %12.5E  y %12.5E  z %12.5E mass %12.5E\n", side, id, s.t,
                        f.x(), f.y(), f.z(), 0.0);
  };
  for (const InterfaceForce& i : s.interfaces) {
    line("SURFA", i.id, i.on_surfa);
    line("SURFB", i.id, Vec::Zero() - i.on_surfa);  // not the sign alone: 0 must not become -0
  }
  return out;
}

}  // namespace courant
