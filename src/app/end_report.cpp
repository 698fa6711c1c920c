#include "app/end_report.hpp"

#include <fmt/format.h>

#include <cmath>

#include "app/range_warnings.hpp"

namespace courant {

namespace {

constexpr Real most_residual = 5;  // percent

/// The sum of what may cancel in a residual: where that is round-off of it, nothing is wrong.
Real size_of(const EnergyLedger& e) {
  return std::abs(e.kinetic) + std::abs(e.internal) + std::abs(e.potential) + std::abs(e.contact) +
         std::abs(e.dissipated) + std::abs(e.external_work) + e.hourglass + e.bulk_viscosity;
}

/// What elements hold and have taken went through them, too.
Real passed_through(const EnergyLedger& e) {
  const bool has_elements = e.hourglass + e.bulk_viscosity > 0;
  return e.throughput + (has_elements ? std::abs(e.internal) + e.hourglass + e.bulk_viscosity : 0);
}

/// Where next to nothing passed through (a gas that expands, a block that flies), the residual is compared
/// with the energy itself.
bool hardly_passes(const EnergyLedger& e) {
  return !(passed_through(e) > 1e-3 * size_of(e));
}
const char* residual_of(const EnergyLedger& e) {
  return hardly_passes(e) ? "the energy" : "what passed through";
}

std::string energy_warning(const EnergyLedger& e) {
  constexpr Real round_off = 1e-9;
  const Real percent = residual_percent(e);
  if (!(std::abs(percent) > most_residual) || std::abs(e.residual()) < round_off * size_of(e)) return {};
  return fmt::format(
      "warning: the energy balance does not close: {:.3g} % of {} {}; lower TSSFAC, and look "
      "at contact stiffness (SFSA, SLSFAC) and at where particles leave the box",
      std::abs(percent), residual_of(e), percent > 0 ? "came from nowhere" : "was lost");
}

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

Real residual_percent(const EnergyLedger& e) {
  const Real whole = hardly_passes(e) ? size_of(e) : passed_through(e);
  return whole > 0 ? 100 * e.residual() / whole : 0;
}

std::string duration(double seconds) {
  if (seconds < 60) return fmt::format("{:.0f} s", seconds);
  if (seconds < 3600)
    return fmt::format("{:.0f} min {:02.0f} s", std::floor(seconds / 60), std::fmod(seconds, 60));
  return fmt::format("{:.0f} h {:02.0f} min", std::floor(seconds / 3600), std::fmod(seconds / 60, 60));
}

std::vector<std::string> end_warnings(const Summary& s) {
  std::vector<std::string> out;
  if (s.leaked_particles > 0)
    out.push_back(
        fmt::format("warning: {} particle{} leaked through a wall: make the contact stiffer (SFSA, SLSFAC), "
                    "or lower TSSFAC "
                    "for what hits the wall so fast",
                    s.leaked_particles, s.leaked_particles == 1 ? "" : "s"));
  if (const std::string text = energy_warning(s.energy); !text.empty()) out.push_back(text);
  if (const std::string text = windows_warning(s); !text.empty()) out.push_back(text);
  for (std::string& text : range_warnings(s.ranges)) out.push_back(std::move(text));
  return out;
}

std::vector<std::string> end_report(const Summary& s) {
  std::vector<std::string> out;
  add_timing(s, out);
  out.push_back(fmt::format(" Problem time       = {:12.5E}", s.time));
  out.push_back(fmt::format(" Problem cycle      = {}", s.steps));
  out.push_back(
      fmt::format(" Total CPU time     = {:.1f} s, elapsed {:.1f} s, {:.0f} ns per particle and step",
                  s.cpu_seconds, s.wall_seconds, s.ns_per_particle_step()));
  out.push_back(output_line(s));
  out.push_back(
      fmt::format(" leaked particles {}, largest penetration {:.4g} [L], energy residual {:.3g} % of {}",
                  s.leaked_particles, s.max_penetration, residual_percent(s.energy), residual_of(s.energy)));
  for (const std::string& line : range_lines(s.ranges)) out.push_back(line);
  for (const std::string& warning : end_warnings(s)) out.push_back(" " + warning);
  return out;
}

}  // namespace courant
