#include <fmt/printf.h>

#include <algorithm>

#include "output/ascii/text_history.hpp"

namespace courant {
namespace {

std::string head(const Sample& s, const char* columns) {
  return fmt::sprintf(
      "\n\n\n n o d a l   p r i n t   o u t   f o r   t i m e  s t e p%8d                              ( at "
      "time%14.7E )\n\n nodal point  %s\n",
      s.cycle, s.t, columns);
}

std::string row(Id id, std::initializer_list<Vec> vectors) {
  std::string out = fmt::sprintf("%9d ", id);  // LS-DYNA makes the first number a column wider
  for (const Vec& v : vectors) out += fmt::sprintf("%12.4E%12.4E%12.4E", v.x(), v.y(), v.z());
  return out + "\n";
}

/// One state of nodout: displacement, velocity, acceleration and location of nodes, in global axes; then,
/// where a node belongs to a rigid body or turns with shells and beams, its rotation. Velocities are those of
/// the last half step.
std::string nodout_text(const Sample& s, Real /*first_potential*/) {
  std::string out = head(s,
                         "x-disp     y-disp      z-disp      x-vel       y-vel       z-vel      x-accl      "
                         "y-accl      z-accl      x-coor      y-coor      z-coor");
  for (const NodeSample& n : s.nodes) out += row(n.id, {n.displacement, n.v, n.a, n.x});
  if (std::none_of(s.nodes.begin(), s.nodes.end(), [](const NodeSample& n) { return n.turns; })) return out;
  out +=
      head(s,
           "x-rot      y-rot       z-rot       x-rot vel   y-rot vel   z-rot vel   x-rot acc   y-rot acc   "
           "z-rot acc");
  for (const NodeSample& n : s.nodes) out += row(n.id, {n.rotation, n.omega, n.angular_a});
  return out;
}

void nodout_binout(const Sample& s, Real /*first_potential*/, HistoryNumbers& to) {
  using N = NodeSample;
  HistoryRows rows(to, "", s.nodes, &N::id);
  rows.vector("{}_displacement", &N::displacement).vector("{}_velocity", &N::v);
  rows.vector("{}_acceleration", &N::a).vector("{}_coordinate", &N::x);
  if (std::none_of(s.nodes.begin(), s.nodes.end(), [](const N& n) { return n.turns; })) return;
  rows.vector("r{}_displacement", &N::rotation).vector("r{}_velocity", &N::omega);
  rows.vector("r{}_acceleration", &N::angular_a);
}

const RegisterTextHistory nodout{{"nodout", nodout_text, nodout_binout, &HistoryTitles::nodes, false}};

}  // namespace

}  // namespace courant
