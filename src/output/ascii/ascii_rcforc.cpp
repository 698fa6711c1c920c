#include <fmt/printf.h>

#include "output/ascii/text_history.hpp"

namespace courant {

namespace {

/// One state of rcforc: per interface the force on SURFA (the particles) and on SURFB. The mass is printed as
/// 0; the columns of moments, which newer LS-DYNA versions append, are not there.
std::string rcforc_text(const Sample& s, Real /*first_potential*/) {
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

void rcforc_binout(const Sample& s, Real /*first_potential*/, HistoryNumbers& to) {
  struct Side {
    Id id;
    int side;  ///< 0 SURFA, 1 SURFB
    Vec force;
  };
  std::vector<Side> sides;
  for (const InterfaceForce& i : s.interfaces) {
    sides.push_back({i.id, 0, i.on_surfa});
    sides.push_back({i.id, 1, -i.on_surfa});
  }
  HistoryRows(to, "", sides, &Side::id)
      .fixed("side", &Side::side)
      .vector("{}_force", &Side::force)
      .real("mass", [](const Side&) { return 0.0; });
}

const RegisterTextHistory rcforc{{"rcforc", rcforc_text, rcforc_binout, &HistoryTitles::contacts}};

}  // namespace

}  // namespace courant
