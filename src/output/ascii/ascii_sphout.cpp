#include <fmt/format.h>
#include <fmt/printf.h>

#include <cmath>

#include "output/ascii/text_history.hpp"

namespace courant {
namespace {

/// sqrt(3/2 s:s) of a symmetric tensor without trace.
Real effective(const std::array<Real, 6>& s) {
  return std::sqrt(1.5 * (s[0] * s[0] + s[1] * s[1] + s[2] * s[2]) +
                   3 * (s[3] * s[3] + s[4] * s[4] + s[5] * s[5]));
}

std::string tensor_rows(const Sample& s, const char* name, Real (*value)(const ParticleSample&, int)) {
  std::string out =
      fmt::sprintf("\n particle  mat    %s-xx      %s-yy      %s-zz      %s-xy      %s-yz      %s-zx\n", name,
                   name, name, name, name, name);
  for (const ParticleSample& p : s.particles) {
    out += fmt::sprintf("%8d%6d", p.id, p.part);
    for (int k = 0; k < 6; ++k) out += fmt::sprintf("%12.4E", value(p, k));
    out += "\n";
  }
  return out;
}

/// One state of sphout: stress (sigma = tau - p I, tension positive), strain (not kept: 0), density,
/// smoothing length, neighbours, active; yield stress (0) and effective stress.
std::string sphout_text(const Sample& s, Real /*first_potential*/) {
  std::string out =
      fmt::sprintf("\n\n\n S P H   o u t p u t       at time%11.4E     for  time  step%10d\n", s.t, s.cycle);
  out += tensor_rows(s, "sig", [](const ParticleSample& p, int k) {
    return p.tau[static_cast<std::size_t>(k)] - (k < 3 ? p.p : 0);
  });
  out += tensor_rows(s, "eps", [](const ParticleSample&, int) { return 0.0; });
  out += "\n particle  mat    density     smooth     neigh   act\n";
  for (const ParticleSample& p : s.particles)
    out +=
        fmt::sprintf("%8d%6d%12.4E%12.4E%7d%6d\n", p.id, p.part, p.rho, p.h, p.neighbours, p.active ? 1 : 0);
  out += "\n particle  mat    yield       effsg       state\n";
  for (const ParticleSample& p : s.particles)
    out += fmt::sprintf("%8d%6d%12.4E%12.4E   %7s\n", p.id, p.part, 0.0, effective(p.tau), "elastic");
  return out;
}

void sphout_binout(const Sample& s, Real /*first_potential*/, HistoryNumbers& to) {
  using P = ParticleSample;
  constexpr const char* axes[] = {"xx", "yy", "zz", "xy", "yz", "zx"};
  HistoryRows rows(to, "", s.particles, &P::id);
  for (std::size_t k = 0; k < 6; ++k)
    rows.real(fmt::format("sig_{}", axes[k]), [k](const P& p) { return p.tau[k] - (k < 3 ? p.p : 0); });
  rows.real("density", &P::rho).real("smooth", &P::h);
  rows.real("neigh", [](const P& p) { return static_cast<Real>(p.neighbours); });
  rows.real("act", [](const P& p) { return p.active ? 1.0 : 0.0; });
}

const RegisterTextHistory sphout{{"sphout", sphout_text, sphout_binout}};

}  // namespace

}  // namespace courant
