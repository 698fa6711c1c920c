#include "verify/result_files.hpp"

#include <fmt/format.h>
#include <yaml-cpp/yaml.h>

#include <cmath>

#include "output/file.hpp"
#include "verify/judge.hpp"

namespace courant {
namespace {

std::string csv_cell(const std::string& text) {
  if (text.find_first_of(",\"\n\r") == std::string::npos) return text;
  std::string out = "\"";
  for (const char c : text) {
    if (c == '"') out += '"';
    out += c == '\n' || c == '\r' ? ' ' : c;
  }
  return out + "\"";
}

std::string in_full(const std::optional<Real>& value) {
  return value ? fmt::format("{:.10g}", *value) : "";
}

constexpr const char* head =
    "case,setting,resolution,size,observation,value,reference,error,check,verdict,as_required,wall_seconds,"
    "cpu_seconds,particles,steps,particle_steps,peak_memory_bytes,exit_code,termination,reason,why\n";

std::string row(const CaseResult& c, std::size_t k, const Observed& o) {
  const RunResult& run = c.runs[k];
  std::string reason = run.reason;
  for (const std::string& exceeded : run.exceeded) reason += (reason.empty() ? "" : "; ") + exceeded;
  return fmt::format("{},{},{},{},{},{},{},{},{},{},{},{:.4f},{:.4f},{},{},{},{},{},{},{},{}\n",
                     c.definition.name, csv_cell(run.setting), csv_cell(run.resolution),
                     run.size > 0 ? in_full(run.size) : "", o.name, in_full(o.value), in_full(o.reference),
                     in_full(o.error), check_of_row(c, k, o.name), word_for(run.verdict),
                     run.as_required ? "yes" : "no", run.wall_seconds, run.cpu_seconds, run.particles,
                     run.steps, run.particle_steps, run.peak_memory_bytes, run.exit_code,
                     csv_cell(run.termination), csv_cell(reason), csv_cell(o.why));
}

template <class T>
void entry(YAML::Emitter& out, const char* key, const T& value) {
  out << YAML::Key << key << YAML::Value << value;
}
void entry(YAML::Emitter& out, const char* key, const std::optional<Real>& value) {
  if (value) out << YAML::Key << key << YAML::Value << *value;
}

void emit_parameters(YAML::Emitter& out, const SuiteParameters& parameters) {
  out << YAML::Key << "parameters" << YAML::Value << YAML::Flow << YAML::BeginMap;
  for (const auto& [name, value] : parameters) out << YAML::Key << name << YAML::Value << value;
  out << YAML::EndMap;
}

void emit_run(YAML::Emitter& out, const RunResult& run) {
  out << YAML::BeginMap;
  entry(out, "setting", run.setting);
  entry(out, "resolution", run.resolution);
  emit_parameters(out, run.parameters);
  if (run.size > 0) entry(out, "size", run.size);
  entry(out, "folder", run.folder.string());
  entry(out, "verdict", std::string(word_for(run.verdict)));
  entry(out, "as_required", run.as_required);
  entry(out, "exceeded", run.exceeded);
  entry(out, "exit_code", run.exit_code);
  entry(out, "termination", run.termination);
  entry(out, "reason", run.reason);
  entry(out, "wall_seconds", run.wall_seconds);
  entry(out, "cpu_seconds", run.cpu_seconds);
  entry(out, "particles", run.particles);
  entry(out, "steps", run.steps);
  entry(out, "particle_steps", run.particle_steps);
  entry(out, "peak_memory_bytes", run.peak_memory_bytes);
  entry(out, "reused", run.reused);
  out << YAML::Key << "observed" << YAML::Value << YAML::BeginSeq;
  for (const Observed& o : run.observed) {
    out << YAML::BeginMap;
    entry(out, "name", o.name);
    entry(out, "found", o.found);
    if (!o.why.empty()) entry(out, "why", o.why);
    entry(out, "value", o.value);
    entry(out, "reference", o.reference);
    entry(out, "error", o.error);
    out << YAML::EndMap;
  }
  out << YAML::EndSeq << YAML::EndMap;
}

void emit_case(YAML::Emitter& out, const CaseResult& c) {
  const SuiteCase& d = c.definition;
  out << YAML::BeginMap;
  entry(out, "name", d.name);
  entry(out, "title", d.title);
  entry(out, "about", d.about);
  if (d.scene.empty())
    entry(out, "deck", d.deck.string());
  else
    entry(out, "scene", d.scene.string());
  out << YAML::Key << "runs" << YAML::Value << YAML::BeginSeq;
  for (const RunResult& run : c.runs) emit_run(out, run);
  out << YAML::EndSeq << YAML::Key << "orders" << YAML::Value << YAML::BeginSeq;
  for (const MeasuredOrder& m : c.orders) {
    out << YAML::Flow << YAML::BeginMap;
    entry(out, "setting", m.setting);
    entry(out, "observation", m.observation);
    entry(out, "order", m.order);
    out << YAML::EndMap;
  }
  out << YAML::EndSeq << YAML::Key << "checks" << YAML::Value << YAML::BeginSeq;
  for (const BoundCheck& check : c.checks) {
    out << YAML::Flow << YAML::BeginMap;
    entry(out, "setting", check.setting);
    entry(out, "observation", check.observation);
    entry(out, "what", check.what);
    entry(out, "bound", check.bound);
    entry(out, "measured", check.measured);
    entry(out, "met", check.met);
    out << YAML::EndMap;
  }
  out << YAML::EndSeq << YAML::EndMap;
}

}  // namespace

std::string check_of_row(const CaseResult& c, std::size_t k, const std::string& observation) {
  const RunResult& run = c.runs[k];
  if (c.definition.stability) return run.as_required ? "met" : "missed";
  if (k + 1 < c.runs.size() && c.runs[k + 1].setting == run.setting) return {};
  std::string out;
  for (const BoundCheck& check : c.checks) {
    if (check.setting != run.setting || (check.observation != observation && !check.observation.empty()))
      continue;
    if (!check.met) return "missed";
    out = "met";
  }
  return out;
}

std::string results_csv(const SuiteResult& result) {
  std::string out = head;
  for (const CaseResult& c : result.cases) {
    for (std::size_t k = 0; k < c.runs.size(); ++k) {
      if (c.runs[k].observed.empty()) out += row(c, k, Observed{});
      for (const Observed& o : c.runs[k].observed) out += row(c, k, o);
    }
  }
  return out;
}

std::string results_yaml(const SuiteResult& result) {
  YAML::Emitter out;
  out.SetDoublePrecision(12);
  out << YAML::BeginMap;
  entry(out, "suite", result.suite.file.string());
  entry(out, "title", result.suite.title);
  entry(out, "about", result.suite.about);
  entry(out, "version", result.version);
  entry(out, "machine", result.machine);
  entry(out, "date", result.date);
  entry(out, "wall_seconds", result.wall_seconds);
  entry(out, "jobs", result.jobs);
  entry(out, "ok", result.ok());
  out << YAML::Key << "cases" << YAML::Value << YAML::BeginSeq;
  for (const CaseResult& c : result.cases) emit_case(out, c);
  out << YAML::EndSeq << YAML::EndMap;
  return std::string(out.c_str()) + "\n";
}

void write_result_files(const SuiteResult& result, const std::filesystem::path& folder) {
  write_file(folder / "results.csv", results_csv(result));
  write_file(folder / "results.yaml", results_yaml(result));
}

}  // namespace courant
