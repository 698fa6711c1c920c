#include "output/summary.hpp"

#include <yaml-cpp/yaml.h>

#include <cmath>
#include <utility>

#include "base/utf8.hpp"
#include "base/version.hpp"

namespace courant {
namespace {

void emit_energy(YAML::Emitter& out, const Summary& s) {
  const EnergyLedger& e = s.energy;
  const std::pair<const char*, Real> entries[] = {
      {"kinetic", e.kinetic},       {"internal", e.internal},     {"potential", e.potential},
      {"contact", e.contact},       {"dissipated", e.dissipated}, {"external_work", e.external_work},
      {"initial", e.initial},       {"total", e.total()},         {"residual", e.residual()},
      {"throughput", e.throughput}, {"ratio", s.energy_ratio()},  {"scale", e.scale()},
      {"error", e.error()},         {"hourglass", e.hourglass},   {"bulk_viscosity", e.bulk_viscosity},
  };
  out << YAML::Key << "energy" << YAML::Value << YAML::BeginMap;
  for (const auto& [key, value] : entries) out << YAML::Key << key << YAML::Value << value;
  out << YAML::EndMap;
}

void emit_verdict(YAML::Emitter& out, const Summary& s) {
  if (s.verdict.empty()) return;
  out << YAML::Key << "verdict" << YAML::Value << s.verdict;
  out << YAML::Key << "verdict_reasons" << YAML::Value << YAML::BeginSeq;
  for (const std::string& reason : s.verdict_reasons) out << reason;
  out << YAML::EndSeq;
  if (!s.limits.given) return;
  const VerdictLimits& l = s.limits;
  const std::pair<const char*, Real> entries[] = {
      {"residual_doubtful", l.residual_doubtful},   {"residual_broken", l.residual_broken},
      {"leaks_doubtful", l.leaks_doubtful},         {"leaks_broken", l.leaks_broken},
      {"hourglass_doubtful", l.hourglass_doubtful}, {"hourglass_broken", l.hourglass_broken},
      {"mach_doubtful", l.mach_doubtful},           {"density_doubtful", l.density_doubtful},
  };
  out << YAML::Key << "verdict_limits" << YAML::Value << YAML::BeginMap;
  for (const auto& [key, value] : entries) out << YAML::Key << key << YAML::Value << value;
  out << YAML::EndMap;
}

template <class Map>
void emit_map(YAML::Emitter& out, const char* key, const Map& map) {
  out << YAML::Key << key << YAML::Value << YAML::BeginMap;
  for (const auto& [name, value] : map) out << YAML::Key << name << YAML::Value << value;
  out << YAML::EndMap;
}

void emit_extreme(YAML::Emitter& out, const char* key, const Extreme& e) {
  out << YAML::Key << key << YAML::Value << YAML::Flow << YAML::BeginMap << YAML::Key << "value"
      << YAML::Value << e.value << YAML::Key << "particle" << YAML::Value << e.particle << YAML::Key << "time"
      << YAML::Value << e.t << YAML::EndMap;
}

void emit_ranges(YAML::Emitter& out, const Ranges& ranges) {
  out << YAML::Key << "ranges" << YAML::Value << YAML::BeginSeq;
  for (const PartRange& r : ranges) {
    if (!r.seen) continue;
    out << YAML::BeginMap << YAML::Key << "part" << YAML::Value << r.part << YAML::Key << "sound_speed"
        << YAML::Value << r.c0;
    emit_extreme(out, "speed", r.speed);
    emit_extreme(out, "density_ratio_low", r.density_low);
    emit_extreme(out, "density_ratio_high", r.density_high);
    out << YAML::EndMap;
  }
  out << YAML::EndSeq;
}

void emit_lists(YAML::Emitter& out, const Summary& s) {
  out << YAML::Key << "warnings" << YAML::Value << YAML::BeginSeq;
  for (const std::string& warning : s.warnings) out << warning;
  out << YAML::EndSeq;
  out << YAML::Key << "passes" << YAML::Value << YAML::BeginSeq;
  for (const Summary::PassTime& pass : s.passes)
    out << YAML::Flow << YAML::BeginMap << YAML::Key << "name" << YAML::Value << pass.name << YAML::Key
        << "seconds" << YAML::Value << pass.seconds << YAML::Key << "calls" << YAML::Value << pass.calls
        << YAML::EndMap;
  out << YAML::EndSeq;
}

void emit_output(YAML::Emitter& out, const Summary::Output& o) {
  const auto entry = [&](const char* key, const auto& value) {
    out << YAML::Key << key << YAML::Value << value;
  };
  out << YAML::Key << "output" << YAML::Value << YAML::BeginMap;
  entry("seconds", o.seconds);
  entry("field_states", o.states);
  entry("field_bytes", o.field_bytes);
  entry("bytes_per_state", o.states > 0 ? o.field_bytes / o.states : 0);
  entry("history_bytes", o.history_bytes);
  out << YAML::EndMap;
}

double ns_of(double seconds, std::int64_t steps) {
  return steps > 0 ? 1e9 * seconds / static_cast<double>(steps) : 0;
}

}  // namespace

double Summary::ns_per_particle_step() const {
  return ns_of(cpu_seconds, particle_steps);
}

double Summary::elapsed_ns_per_particle_step() const {
  return ns_of(wall_seconds, particle_steps);
}

double Summary::ns_per_element_step() const {
  return ns_of(cpu_seconds, element_steps);
}

double Summary::elapsed_ns_per_element_step() const {
  return ns_of(wall_seconds, element_steps);
}

Real Summary::energy_ratio() const {
  const Real expected = energy.initial + energy.external_work;
  return std::abs(expected) > 1e-9 * energy.scale() ? energy.total() / expected : 1 + energy.error();
}

void write_summary(const std::filesystem::path& file, const Summary& s) {
  YAML::Emitter out;
  out.SetDoublePrecision(12);
  const auto entry = [&](const char* key, const auto& value) {
    out << YAML::Key << key << YAML::Value << value;
  };
  out << YAML::BeginMap;
  entry("version", std::string(COURANT_VERSION));
  entry("title", s.title);
  entry("deck", s.deck);
  if (!s.mass.empty())
    emit_map(
        out, "units",
        std::map<std::string, std::string>{{"mass", s.mass}, {"length", s.length}, {"time", s.time_unit}});
  entry("termination", s.termination);
  entry("reason", s.reason);
  if (!s.advice.empty()) entry("advice", s.advice);
  emit_verdict(out, s);
  entry("time", s.time);
  entry("steps", s.steps);
  if (s.restarts > 0) entry("restarts", s.restarts);
  if (!s.restart_notes.empty()) entry("restart_notes", s.restart_notes);
  if (!s.notes.empty()) entry("notes", s.notes);
  if (!s.restart_file.empty()) entry("restart_file", s.restart_file);
  entry("wall_seconds", s.wall_seconds);
  entry("cpu_seconds", s.cpu_seconds);
  entry("read_seconds", s.read_seconds);
  entry("writer_cpu_seconds", s.writer_cpu_seconds);
  entry("threads", s.threads);
  entry("particles", s.particles);
  entry("active_particles", s.active_particles);
  entry("particle_steps", s.particle_steps);
  entry("ns_per_particle_step", s.ns_per_particle_step());
  entry("elapsed_ns_per_particle_step", s.elapsed_ns_per_particle_step());
  entry("elements", s.elements);
  entry("element_steps", s.element_steps);
  entry("ns_per_element_step", s.ns_per_element_step());
  entry("elapsed_ns_per_element_step", s.elapsed_ns_per_element_step());
  entry("peak_memory_bytes", s.peak_memory_bytes);
  entry("dt_min", s.dt_min);
  entry("dt_max", s.dt_max);
  emit_energy(out, s);
  entry("leaked_particles", s.leaked_particles);
  entry("max_penetration", s.max_penetration);
  emit_output(out, s.output);
  emit_map(out, "counters", s.counters);
  emit_map(out, "maxima", s.maxima);
  emit_ranges(out, s.ranges);
  emit_lists(out, s);
  out << YAML::EndMap;
  write_file(file, valid_utf8(out.c_str()) + "\n");
}

}  // namespace courant
