#include "app/report/end_report.hpp"

#include <fmt/format.h>

#include <cmath>

#include "app/report/range_warnings.hpp"
#include "app/report/verdict.hpp"
#include "time/guard.hpp"

namespace courant {

namespace {

/// Opening a window costs more than one that lasts for a step saves. The first opens blind.
std::string windows_warning(const Summary& s) {
  const auto windows = s.counters.find("pair_geometry_windows");
  if (windows == s.counters.end() || windows->second < 10 || s.steps >= 2 * windows->second) return {};
  return fmt::format(
      "warning: the {} windows of *COURANT_PAIR_GEOMETRY lasted {:.1f} steps on average and cost more than "
      "they saved: leave it out, or raise EPS",
      windows->second, static_cast<Real>(s.steps) / static_cast<Real>(windows->second));
}

void add_timing(const Summary& s, std::vector<std::string>& out) {
  const double total = s.read_seconds + s.wall_seconds;
  const auto row = [&](const std::string& name, double seconds) {
    out.push_back(
        fmt::format("  {:<38}{:10.3f}{:9.1f}", name, seconds, total > 0 ? 100 * seconds / total : 0));
  };
  out.push_back("T i m i n g   i n f o r m a t i o n        seconds        %");
  for (const Summary::PassTime& pass : s.passes) row(pass.name, pass.seconds);
  row("T o t a l", total);
  out.push_back(
      fmt::format("  {:<38}{:10.3f}", "(writer's CPU time, beside all this)", s.writer_cpu_seconds));
}

/// Of limits that the deck gave, too.
std::string verdict_line(const Summary& s) {
  std::string text = fmt::format(" verdict: {}", s.verdict);
  if (s.limits.given)
    text += fmt::format(
        " by *COURANT_VERDICT (energy {:g} and {:g}, leaks {:g} and {:g}, hourglass {:g} and {:g}, speed "
        "{:g}, "
        "density {:g})",
        s.limits.residual_doubtful, s.limits.residual_broken, s.limits.leaks_doubtful, s.limits.leaks_broken,
        s.limits.hourglass_doubtful, s.limits.hourglass_broken, s.limits.mach_doubtful,
        s.limits.density_doubtful);
  return text;
}

std::string output_line(const Summary& s) {
  const double states = static_cast<double>(std::max<std::int64_t>(s.output.states, 1));
  return fmt::format(
      " output: {} field states, {:.4g} MB ({:.4g} kB each), histories {:.3g} MB; {:.2g} % of the elapsed "
      "time",
      s.output.states, 1e-6 * static_cast<double>(s.output.field_bytes),
      1e-3 * static_cast<double>(s.output.field_bytes) / states,
      1e-6 * static_cast<double>(s.output.history_bytes),
      s.wall_seconds > 0 ? 100 * s.output.seconds / s.wall_seconds : 0);
}

}  // namespace

std::string duration(double seconds) {
  if (seconds < 60) return fmt::format("{:.0f} s", seconds);
  if (seconds < 3600)
    return fmt::format("{:.0f} min {:02.0f} s", std::floor(seconds / 60), std::fmod(seconds, 60));
  return fmt::format("{:.0f} h {:02.0f} min", std::floor(seconds / 3600), std::fmod(seconds / 60, 60));
}

std::string state_in_words(const World& world) {
  const std::string energy = fmt::format("energy ratio {:.4f}", 1 + energy_ratio_change(world.energy) / 100);
  if (world.particles.size() == 0) return energy;
  const auto leaked = world.counters.find("leaked_particles");
  return fmt::format("{} active  {}  leaked {}", world.particles.active, energy,
                     leaked == world.counters.end() ? 0 : leaked->second);
}

std::vector<std::string> end_warnings(const Summary& s) {
  std::vector<std::string> out;
  for (const Finding& finding : findings(s))
    if (finding.text != s.reason) out.push_back("warning: " + finding.text);
  if (std::string text = windows_warning(s); !text.empty()) out.push_back(std::move(text));
  return out;
}

std::vector<std::string> end_report(const Summary& s) {
  std::vector<std::string> out;
  add_timing(s, out);
  out.push_back(fmt::format(" Problem time       = {:12.5E}", s.time));
  out.push_back(fmt::format(" Problem cycle      = {}", s.steps));
  const bool particles = s.particles > 0;
  out.push_back(particles ? fmt::format(" Total CPU time     = {:.1f} s, {:.0f} ns per particle and step; "
                                        "elapsed {:.1f} s, {:.0f} ns",
                                        s.cpu_seconds, s.ns_per_particle_step(), s.wall_seconds,
                                        s.elapsed_ns_per_particle_step())
                          : fmt::format(" Total CPU time     = {:.1f} s; elapsed {:.1f} s", s.cpu_seconds,
                                        s.wall_seconds));
  out.push_back(output_line(s));
  out.push_back((particles ? fmt::format(" leaked particles {},", s.leaked_particles) : std::string()) +
                fmt::format(" largest penetration {:.4g} [L], {}", s.max_penetration, energy_line(s.energy)));
  for (const std::string& line : range_lines(s.ranges)) out.push_back(line);
  for (const std::string& warning : end_warnings(s)) out.push_back(" " + warning);
  for (const std::string& note : s.notes) out.push_back(" note: " + note);
  if (!s.verdict.empty()) out.push_back(verdict_line(s));
  return out;
}

}  // namespace courant
