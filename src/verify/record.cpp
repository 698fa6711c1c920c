#include "verify/record.hpp"

#include <dlfcn.h>
#include <fmt/format.h>
#include <yaml-cpp/yaml.h>

#include <cmath>
#include <cstdlib>
#include <cstring>
#include <fstream>
#include <set>
#include <sstream>

#include "keyword/deck.hpp"
#include "keyword/source.hpp"
#include "output/file.hpp"

namespace courant {
namespace {

std::optional<std::string> content_of(const std::filesystem::path& file) {
  std::ifstream stream(file, std::ios::binary);
  std::stringstream bytes;
  if (stream) bytes << stream.rdbuf();
  if (!stream) return std::nullopt;
  return bytes.str();
}

std::optional<YAML::Node> load(const std::filesystem::path& file) {
  try {
    const YAML::Node node = YAML::LoadFile(file.string());
    if (node.IsMap()) return node;
  } catch (const YAML::Exception&) {  // not there or not whole: as good as none
  }
  return std::nullopt;
}

template <class T>
T value(const YAML::Node& node, const char* key, T otherwise) {
  const YAML::Node found = node.IsMap() ? node[key] : YAML::Node(YAML::NodeType::Undefined);
  T out{};
  return found && YAML::convert<T>::decode(found, out) ? out : otherwise;
}

/// The first error in what the run said, without the place in the deck's folder.
std::string first_error_line(const std::filesystem::path& file) {
  std::ifstream stream(file);
  std::string first;
  for (std::string line; std::getline(stream, line);) {
    if (first.empty()) first = line;
    if (line.find("error: ") != std::string::npos) return line;
  }
  return first;
}

void take_summary(const YAML::Node& y, RunResult& out, RunNumbers& numbers) {
  out.termination = value<std::string>(y, "termination", "");
  out.reason = value<std::string>(y, "reason", "");
  out.wall_seconds = value(y, "wall_seconds", out.wall_seconds);
  out.cpu_seconds = value(y, "cpu_seconds", out.cpu_seconds);
  out.particles = value<std::int64_t>(y, "particles", 0);
  out.steps = value<std::int64_t>(y, "steps", 0);
  out.particle_steps = value<std::int64_t>(y, "particle_steps", 0);
  out.peak_memory_bytes = value(y, "peak_memory_bytes", out.peak_memory_bytes);
  const YAML::Node energy = y["energy"] ? y["energy"] : YAML::Node(YAML::NodeType::Map);
  const Real throughput = value(energy, "throughput", 0.0), residual = value(energy, "residual", 0.0);
  numbers.residual = throughput > 0           ? std::abs(residual) / throughput
                     : std::abs(residual) > 0 ? std::nan("")
                                              : 0;
  numbers.ratio = value(energy, "ratio", std::nan(""));
  numbers.leaked = value(y, "leaked_particles", 0.0);
  numbers.penetration = value(y, "max_penetration", 0.0);
  numbers.steps = static_cast<Real>(out.steps);
  if (out.termination == "normal" && !std::isfinite(value(energy, "total", std::nan("")))) {
    out.verdict = Verdict::broken;
    out.reason = "it ended normally, but its energy is not finite";
  }
}

}  // namespace

void write_record(const std::filesystem::path& folder, const RunRecord& record) {
  YAML::Emitter out;
  out << YAML::BeginMap;
  const auto entry = [&](const char* key, const auto& what) {
    out << YAML::Key << key << YAML::Value << what;
  };
  entry("key", record.key);
  entry("exit_code", record.exit_code);
  entry("signal", record.signal);
  entry("timed_out", record.timed_out);
  entry("time_limit", record.time_limit);
  entry("wall_seconds", record.wall_seconds);
  entry("cpu_seconds", record.cpu_seconds);
  entry("peak_memory_bytes", record.peak_memory_bytes);
  out << YAML::EndMap;
  write_file(folder / "record.yaml", std::string(out.c_str()) + "\n");
}

std::optional<RunRecord> read_record(const std::filesystem::path& folder) {
  const auto y = load(folder / "record.yaml");
  if (!y) return std::nullopt;
  RunRecord out;
  out.key = value<std::string>(*y, "key", "");
  out.exit_code = value(*y, "exit_code", -1);
  out.signal = value(*y, "signal", 0);
  out.timed_out = value(*y, "timed_out", false);
  out.time_limit = value(*y, "time_limit", 0.0);
  out.wall_seconds = value(*y, "wall_seconds", 0.0);
  out.cpu_seconds = value(*y, "cpu_seconds", 0.0);
  out.peak_memory_bytes = value<std::int64_t>(*y, "peak_memory_bytes", 0);
  if (out.key.empty()) return std::nullopt;
  return out;
}

bool says_something_of_the_deck(const RunRecord& record, const RunResult& result) {
  if (record.timed_out) return true;
  const bool could_not_write = result.reason.find(OutputError::beginning) != std::string::npos;
  return result.termination != "interrupted" && record.signal == 0 && record.exit_code <= 2 &&
         !could_not_write;
}

RunResult result_of_run(const std::filesystem::path& folder, const RunRecord& record, RunNumbers& numbers) {
  RunResult out;
  out.folder = folder;
  out.exit_code = record.exit_code;
  out.wall_seconds = record.wall_seconds, out.cpu_seconds = record.cpu_seconds;
  out.peak_memory_bytes = record.peak_memory_bytes;
  const auto summary = load(folder / "summary.yaml");
  if (summary) take_summary(*summary, out, numbers);
  const auto broken = [&](std::string reason) {
    out.verdict = Verdict::broken;
    out.reason = std::move(reason);
  };
  const std::string said = first_error_line(folder / "errors.txt");
  if (record.timed_out) {
    broken(fmt::format("ran longer than {:g} s", record.time_limit));
  } else if (record.signal != 0) {
    broken(fmt::format("ended by signal {} ({})", record.signal, strsignal(record.signal)));
  } else if (record.exit_code == 1) {
    out.verdict = Verdict::refused;
    out.reason = said;
    if (said.empty()) broken("refused without a reason (exit code 1)");
  } else if (record.exit_code == 2 && out.termination == "normal" && out.verdict != Verdict::broken) {
    out.verdict = Verdict::degraded;  // it came to its end: limits and bounds of the suite count, too
    const YAML::Node reasons = (*summary)["verdict_reasons"];
    out.reason = "its results cannot be trusted";
    if (reasons && reasons.IsSequence() && reasons.size() > 0)
      out.reason += ": " + reasons[0].as<std::string>("");
  } else if (record.exit_code == 2) {
    out.verdict = Verdict::stopped;
    if (out.reason.empty()) out.reason = said;
    if (out.reason.empty()) broken("stopped without a reason (exit code 2)");
    if (out.reason.find(OutputError::beginning) != std::string::npos) broken(out.reason);
  } else if (record.exit_code != 0) {
    broken(fmt::format("exit code {}{}{}", record.exit_code, said.empty() ? "" : ": ", said));
  } else if (!summary) {
    broken("exit code 0, but there is no summary.yaml");
  } else if (out.termination != "normal" && out.verdict != Verdict::broken) {
    broken(fmt::format("exit code 0 with the termination '{}': {}", out.termination, out.reason));
  }
  return out;
}

std::string digest(const std::string& text, const std::string& before) {
  std::uint64_t sum = 14695981039346656037u;
  const auto add = [&](const std::string& bytes) {
    for (const char c : bytes) sum = (sum ^ static_cast<unsigned char>(c)) * 1099511628211u;
  };
  add(before);
  add(text);
  return fmt::format("{:016x}", sum);
}

std::string digest_of_deck(const std::filesystem::path& deck,
                           const std::map<std::string, std::string>& parameters) {
  const auto text = content_of(deck);
  std::string sum = digest(text ? *text : deck.string());
  if (!text || upper_case(*text).find("*INCLUDE") == std::string::npos) return sum;
  Diagnostics of_the_run;  // which tells them itself
  const Deck read = read_deck(deck.string(), {.parameters = parameters, .open = {}}, of_the_run);
  std::set<const SourceText*> seen;
  for (const DeckFile& file : read.files)
    if (file.source && seen.insert(file.source.get()).second) sum = digest(file.source->text, sum);
  return sum;
}

std::string digest_of_build(const std::filesystem::path& executable) {
  std::string sum = digest(content_of(executable).value_or(executable.string()));
  Dl_info library{};
  if (dladdr(reinterpret_cast<const void*>(&digest_of_build), &library) != 0 && library.dli_fname)
    sum = digest(content_of(library.dli_fname).value_or(""), sum);
  const char* const instructions = std::getenv("COURANT_SIMD");
  return digest(instructions ? instructions : "", sum);
}

}  // namespace courant
