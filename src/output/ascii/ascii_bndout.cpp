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

void bndout_binout(const Sample& s, Real /*first_potential*/, HistoryNumbers& to) {
  using B = BoundaryForce;
  const std::vector<B> nodes = boundary_forces_of(s, B::Kind::driven_point),
                       bodies = boundary_forces_of(s, B::Kind::driven_body);
  const auto put = [&to](const std::string& folder, const std::vector<B>& forces, bool moments) {
    HistoryRows rows(to, folder, forces, &B::id);
    rows.integer("ids", &B::id);  // particles may leave
    rows.vector("{}_force", &B::force).real("energy", &B::work);
    if (moments) rows.vector("{}_moment", &B::moment);
    B total;
    for (const B& one : forces) total.force += one.force, total.work += one.work;
    if (forces.empty()) return;
    to.real("x_total", total.force.x(), folder), to.real("y_total", total.force.y(), folder);
    to.real("z_total", total.force.z(), folder), to.real("e_total", total.work, folder);
  };
  put("velocity/nodes", nodes, false);
  put("velocity/rigidbodies", bodies, true);
}

const RegisterTextHistory bndout{{"bndout", bndout_text, bndout_binout}};

}  // namespace

}  // namespace courant
