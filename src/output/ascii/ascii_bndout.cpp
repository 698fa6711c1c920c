#include <fmt/printf.h>

#include "output/ascii/text_history.hpp"

namespace courant {

namespace {

/// One state of bndout: the forces that drive particles and bodies, and their work so far.
std::string bndout_text(const Sample& s, Real /*first_potential*/) {
  std::string out =
      fmt::sprintf("\n\n\n\n\n n o d a l   f o r c e/e n e r g y    o u t p u t   t=%9.3E\n", s.t);
  out += "\n\n\n\n\n velocity boundary condition forces/rigid body moments \n\n";
  Vec total = Vec::Zero();
  Real work = 0;
  const auto line = [&](const char* who, const BoundaryForce& b) {
    out += fmt::sprintf("%s%8d  xforce=%13.4E   yforce=%13.4E  zforce=%13.4E   energy=%13.4E\n", who, b.id,
                        b.force.x(), b.force.y(), b.force.z(), b.work);
    total += b.force, work += b.work;
  };
  for (const BoundaryForce& b : s.boundary_forces)
    if (b.kind == BoundaryForce::Kind::driven_point) line(" nd#", b);
  for (const BoundaryForce& b : s.boundary_forces)
    if (b.kind == BoundaryForce::Kind::driven_body) {
      line("mat#", b);
      out += fmt::sprintf("             xmoment=%13.4E  ymoment=%13.4E zmoment=%13.4E\n", b.moment.x(),
                          b.moment.y(), b.moment.z());
    }
  out += fmt::sprintf("              xtotal=%13.4E   ytotal=%13.4E  ztotal=%13.4E   etotal=%13.4E\n",
                      total.x(), total.y(), total.z(), work);
  return out;
}

const RegisterTextHistory bndout{{"bndout", bndout_text}};

}  // namespace

}  // namespace courant
