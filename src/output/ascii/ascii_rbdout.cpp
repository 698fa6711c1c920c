#include <fmt/format.h>
#include <fmt/printf.h>

#include "output/ascii/text_history.hpp"

namespace courant {
namespace {

std::string numbers(const Vec& a) {
  return fmt::sprintf("%12.4E%12.4E%12.4E", a.x(), a.y(), a.z());
}

std::string rows(const Vec& displacement, const Vec& rotation, const Vec& v, const Vec& omega, const Vec& a,
                 const Vec& angular_a) {
  return " displacements:  " + numbers(displacement) + numbers(rotation) +
         "\n    velocities:  " + numbers(v) + numbers(omega) + "\n accelerations:  " + numbers(a) +
         numbers(angular_a) + "\n";
}

/// One state of rbdout: motion of the centre of each rigid body, in global and in principal axes.
std::string rbdout_text(const Sample& s, Real /*first_potential*/) {
  std::string out = fmt::sprintf("1\n\n  r i g i d   b o d y   m o t i o n   a t  cycle=%8d    time=%15.6E\n",
                                 s.cycle, s.t);
  for (const RigidBodyMotion& b : s.body_motions) {
    out += fmt::sprintf("\n rigid body%8d\n", b.part);
    out += "   global             x           y           z          x-rot       y-rot       z-rot\n";
    out += "   coordinates:  " + numbers(b.x) + "\n";
    out += rows(b.displacement, b.rotation, b.v, b.omega, b.a, b.angular_a);
    out += "\nprincipal or user defined local coordinate direction vectors\n";
    out += "                     a           b           c\n";
    for (int i = 0; i < 3; ++i)
      out += fmt::sprintf("     row%2d%15.4E%15.4E%15.4E\n", i + 1, b.axes(i, 0), b.axes(i, 1), b.axes(i, 2));
    out += "\n output in principal or user defined local coordinate directions\n";
    out += "                      a           b           c          a-rot       b-rot       c-rot\n";
    const Matrix L = b.axes.transpose();
    out += rows(L * b.displacement, L * b.rotation, L * b.v, L * b.omega, L * b.a, L * b.angular_a);
  }
  return out;
}

void rbdout_binout(const Sample& s, Real /*first_potential*/, HistoryNumbers& to) {
  using M = RigidBodyMotion;
  HistoryRows rows(to, "", s.body_motions, &M::part);
  rows.vector("global_{}", &M::x).vector("global_d{}", &M::displacement);
  rows.vector("global_rd{}", &M::rotation).vector("global_v{}", &M::v).vector("global_rv{}", &M::omega);
  rows.vector("global_a{}", &M::a).vector("global_ra{}", &M::angular_a);
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j)
      rows.real(fmt::format("dircos_{}{}", i + 1, j + 1), [i, j](const M& b) { return b.axes(i, j); });
}

const RegisterTextHistory rbdout{{"rbdout", rbdout_text, rbdout_binout}};

}  // namespace

}  // namespace courant
