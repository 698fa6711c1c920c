#include "verify/verify.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <sys/file.h>
#include <sys/utsname.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <ctime>
#include <fstream>
#include <memory>
#include <numeric>

#include "base/nearest_word.hpp"
#include "generate/generate.hpp"
#include "output/file.hpp"
#include "verify/judge.hpp"
#include "verify/observe.hpp"
#include "verify/picture.hpp"
#include "verify/plan.hpp"
#include "verify/processes.hpp"
#include "verify/record.hpp"
#include "verify/schedule.hpp"

namespace courant {
namespace {

/// Keeps a second call out of the folder, and marks it as ours.
class FolderLock {
 public:
  explicit FolderLock(const std::filesystem::path& folder) {
    const std::filesystem::path file = folder / ".courant_verify";
    std::error_code ignored;
    strange_ = std::filesystem::exists(folder / "runs", ignored) && !std::filesystem::exists(file, ignored);
    if (strange_) return;
    file_ = open(file.c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0644);
    if (file_ < 0) throw OutputError(file, std::error_code(errno, std::generic_category()).message());
    held_ = flock(file_, LOCK_EX | LOCK_NB) == 0;
  }
  FolderLock(const FolderLock&) = delete;
  FolderLock& operator=(const FolderLock&) = delete;
  ~FolderLock() {
    if (file_ >= 0) close(file_);
  }
  bool held() const { return held_; }
  bool strange() const { return strange_; }

 private:
  int file_ = -1;
  bool held_ = false, strange_ = false;
};

std::string machine() {
  std::string processor = "unknown processor";
  std::ifstream info("/proc/cpuinfo");
  for (std::string line; std::getline(info, line);)
    if (line.starts_with("model name")) {
      processor = line.substr(std::min(line.find(": ") + 2, line.size()));
      break;
    }
  utsname system{};
  uname(&system);
  return fmt::format("{}, {} cores, {} {}", processor, sysconf(_SC_NPROCESSORS_ONLN), system.sysname,
                     system.release);
}

std::string utc_now() {
  const std::time_t now = std::time(nullptr);
  std::tm parts{};
  gmtime_r(&now, &parts);
  char text[32];
  std::strftime(text, sizeof text, "%Y-%m-%dT%H:%M:%SZ", &parts);
  return text;
}

/// A run with its deck.
struct PreparedRun {
  PlannedRun plan;
  std::filesystem::path folder, deck;
  std::string key;
  double cost = 0;
  std::optional<RunRecord> record;
  bool reused = false;
};

class Verification {
 public:
  Verification(const Suite& suite, const VerifyOptions& options)
      : suite_(suite), options_(options), build_(digest_of_build(options.executable)) {
    jobs_ = options.jobs > 0 ? options.jobs : static_cast<int>(sysconf(_SC_NPROCESSORS_ONLN));
  }

  /// Writes the decks and finds what need not be run again. False: the suite is wrong.
  bool prepare(Diagnostics& diagnostics) {
    for (PlannedRun& plan : plan_runs(suite_, diagnostics)) runs_.emplace_back().plan = std::move(plan);
    if (!diagnostics.ok()) return false;
    for (PreparedRun& run : runs_) {
      if (!prepare(run, diagnostics)) return false;
      if (options_.stop && options_.stop->load()) return true;
    }
    return true;
  }

  /// False: interrupted.
  bool execute() {
    std::vector<std::size_t> order;
    for (std::size_t k = 0; k < runs_.size(); ++k)
      if (!runs_[k].record) order.push_back(k);
    std::stable_sort(order.begin(), order.end(),
                     [&](std::size_t a, std::size_t b) { return runs_[a].cost > runs_[b].cost; });
    if (order.size() < runs_.size())
      print(fmt::format("{} of {} runs are taken over from an earlier call", runs_.size() - order.size(),
                        runs_.size()));
    std::vector<ProcessJob> jobs;
    std::vector<RunSchedule::Run> costs;
    for (const std::size_t k : order) {
      jobs.push_back(job_of(runs_[k]));
      costs.push_back({runs_[k].plan.of_case, runs_[k].cost});
    }
    RunSchedule schedule(std::move(costs), jobs_);
    ProcessCalls calls;
    calls.started = [&](std::size_t j) { schedule.started(j); };
    calls.ended = [&](std::size_t j, const RunRecord& record) {
      schedule.ended(j, record.wall_seconds);
      ended(runs_[order[j]], record, schedule);
    };
    calls.waiting = [&] {
      if (!options_.progress) return;
      const double left = schedule.seconds_left();
      options_.progress(
          fmt::format("{} of {} runs done, {}", schedule.done(), schedule.size(),
                      left < 0 ? "time left not known yet" : "about " + duration_text(left) + " left"));
    };
    return run_processes(jobs, jobs_, options_.stop, calls);
  }

  SuiteResult result() {
    SuiteResult out;
    out.suite = suite_;
    out.version = fmt::format("Courant {} (build {})", COURANT_VERSION, build_.substr(0, 8));
    out.machine = machine();
    out.date = utc_now();
    out.jobs = jobs_;
    for (std::size_t c = 0; c < suite_.cases.size(); ++c) {
      if (options_.progress)
        options_.progress(fmt::format("reading the results of {}", suite_.cases[c].name));
      std::vector<PreparedRun*> runs;
      for (PreparedRun& run : runs_)
        if (run.plan.of_case == c) runs.push_back(&run);
      out.cases.push_back(result_of_case(suite_.cases[c], runs));
    }
    out.wall_seconds = seconds();
    return out;
  }

 private:
  bool prepare(PreparedRun& run, Diagnostics& diagnostics) {
    const SuiteCase& definition = suite_.cases[run.plan.of_case];
    run.folder = options_.folder / run.plan.folder;
    make_folder(run.folder);
    std::string parameters;
    if (!definition.scene.empty()) {
      run.deck = run.folder / "deck.k";
      Diagnostics faults;
      if (!generate_deck(definition.scene.string(), run.deck.string(), run.plan.parameters, faults)) {
        diagnostics.error(definition.where,
                          fmt::format("case {}, {}: {}", definition.name, run.plan.setting, faults.text()));
        return false;
      }
    } else {
      run.deck = definition.deck;
      for (const auto& [name, value] : run.plan.parameters) parameters += name + "=" + value + "\n";
    }
    run.key =
        digest(parameters + build_,
               digest_of_deck(run.deck, definition.scene.empty() ? run.plan.parameters : SuiteParameters{}));
    std::error_code unknown;
    const double bytes = static_cast<double>(std::filesystem::file_size(run.deck, unknown));
    // the number of steps grows with the resolution, in 2D like the root of the number of particles
    run.cost = std::pow(bytes, 1.5);
    if (definition.scene.empty() && run.plan.size > 0) run.cost /= std::pow(run.plan.size, 3);
    const auto record = options_.fresh ? std::nullopt : read_record(run.folder);
    const bool fits = record && record->key == run.key;
    const bool more_time = fits && record->timed_out && record->time_limit < definition.time_limit;
    if (fits && !more_time) {
      run.record = record;
      run.reused = true;
    }
    return true;
  }

  ProcessJob job_of(const PreparedRun& run) const {
    const SuiteCase& definition = suite_.cases[run.plan.of_case];
    clear(run);
    ProcessJob job{{options_.executable.string(), "run", run.deck.string(), "-o", run.folder.string(),
                    "--threads", "1", "--no-final-dump", "--quiet"},
                   run.folder,
                   definition.time_limit};
    if (definition.scene.empty())
      for (const auto& [name, value] : run.plan.parameters) {
        job.words.push_back("--param");
        job.words.push_back(name + "=" + value);
      }
    return job;
  }

  /// Results of another deck or build must not pass for those of this one.
  static void clear(const PreparedRun& run) {
    std::error_code error;
    std::filesystem::remove(run.folder / "record.yaml", error);
    std::vector<std::filesystem::path> old;
    for (const auto& entry : std::filesystem::directory_iterator(run.folder))
      if (entry.path() != run.deck) old.push_back(entry.path());
    for (const std::filesystem::path& path : old) {
      std::filesystem::remove_all(path, error);
      if (error) throw OutputError(path, error.message());
    }
  }

  void ended(PreparedRun& run, RunRecord record, const RunSchedule& schedule) {
    record.key = run.key;
    RunNumbers numbers;
    const RunResult result = result_of_run(run.folder, record, numbers);
    if (says_something_of_the_deck(record, result)) write_record(run.folder, record);
    run.record = record;
    const SuiteCase& definition = suite_.cases[run.plan.of_case];
    const std::string resolution = run.plan.resolution.empty()
                                       ? ""
                                       : fmt::format(", {} = {}", definition.resolution, run.plan.resolution);
    print(fmt::format("[{}/{}] {}: {}{}: {:.1f} s, {} steps{}", schedule.done(), schedule.size(),
                      definition.name, run.plan.setting, resolution, result.wall_seconds, result.steps,
                      result.verdict == Verdict::stable
                          ? ""
                          : fmt::format(", {}: {}", word_for(result.verdict), result.reason)));
  }

  CaseResult result_of_case(const SuiteCase& definition, const std::vector<PreparedRun*>& runs) {
    CaseResult out;
    out.definition = definition;
    std::vector<Measurements> measured;
    std::vector<RunNumbers> numbers(runs.size());
    for (std::size_t k = 0; k < runs.size(); ++k) {
      out.runs.push_back(result_of_run(runs[k]->folder, *runs[k]->record, numbers[k]));
      measured.push_back(measure(definition, *runs[k], out.runs.back()));
    }
    for (std::size_t k = 0; k < runs.size(); ++k) {
      const std::size_t finest = finest_of(runs, k);
      for (std::size_t o = 0; o < definition.observations.size(); ++o)
        out.runs[k].observed.push_back(compare_observation(
            definition.observations[o], measured[k].observations[o], runs[k]->plan.variables,
            finest == k ? nullptr : &measured[finest].observations[o]));
      if (definition.stability)
        out.checks.push_back(judge_stability(*definition.stability, runs[k]->plan, numbers[k], out.runs[k]));
      if (!definition.stability) out.runs[k].as_required = out.runs[k].verdict == Verdict::stable;
    }
    out.orders = measured_orders(definition, out.runs);
    if (!definition.stability) out.checks = check_bounds(definition, out.runs, out.orders);
    if (!definition.picture_of.empty()) {
      const std::size_t finest = finest_of(runs, 0);
      out.picture = draw_particles(definition, runs[finest]->plan.variables, runs[finest]->folder);
    }
    return out;
  }

  /// Observations of a run that came to its end; also finds garbage in its results.
  Measurements measure(const SuiteCase& definition, const PreparedRun& run, RunResult& result) const {
    result.setting = run.plan.setting;
    result.resolution = run.plan.resolution;
    result.parameters = run.plan.parameters;
    result.size = run.plan.size;
    result.reused = run.reused;
    Measurements out;
    if (result.verdict == Verdict::stable || result.verdict == Verdict::degraded) {
      out = observe_run(definition, run.plan.variables, run.folder, definition.stability.has_value());
      if (out.garbage.empty()) return out;
      result.verdict = Verdict::broken;
      result.reason = "it ended normally, but " + out.garbage;
    }
    out.observations.assign(definition.observations.size(), {});
    for (Measured& m : out.observations)
      m.why = fmt::format("the run was {}: {}", word_for(result.verdict), result.reason);
    return out;
  }

  /// The last run of the same setting.
  static std::size_t finest_of(const std::vector<PreparedRun*>& runs, std::size_t k) {
    while (k + 1 < runs.size() && !runs[k]->plan.finest) ++k;
    return k;
  }

  void print(const std::string& line) const {
    if (options_.print) options_.print(line);
  }
  double seconds() const {
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - start_).count();
  }

  const Suite& suite_;
  const VerifyOptions& options_;
  std::string build_;
  int jobs_ = 1;
  std::vector<PreparedRun> runs_;
  std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
};

/// The suite with the cases asked for alone.
Suite chosen(const Suite& suite, const std::vector<std::string>& only, Diagnostics& diagnostics) {
  Suite out = suite;
  std::vector<std::string> names;
  for (const SuiteCase& c : suite.cases) names.push_back(c.name);
  for (const std::string& name : only) {
    if (std::find(names.begin(), names.end(), name) != names.end()) continue;
    const std::string near = nearest_word(name, names);
    diagnostics.error({suite.file.string()}, fmt::format("the suite has no case '{}'", name),
                      near.empty() ? fmt::format("its cases: {}", fmt::join(names, ", "))
                                   : fmt::format("did you mean {}?", near));
  }
  if (!only.empty())
    std::erase_if(out.cases, [&](const SuiteCase& c) {
      return std::find(only.begin(), only.end(), c.name) == only.end();
    });
  return out;
}

}  // namespace

std::optional<VerifyOutcome> verify_suite(const Suite& suite, const VerifyOptions& options,
                                          Diagnostics& diagnostics) {
  const Suite wanted = chosen(suite, options.only, diagnostics);
  if (!diagnostics.ok()) return std::nullopt;
  plan_runs(wanted, diagnostics);  // before the folder is touched
  if (!diagnostics.ok()) return std::nullopt;
  make_folder(options.folder);
  const FolderLock lock(options.folder);
  if (!lock.held()) {
    diagnostics.error({options.folder.string()},
                      lock.strange() ? "the folder holds something else called 'runs'"
                                     : "another `courant verify` works in this folder",
                      "choose another folder with -o");
    return std::nullopt;
  }
  Verification verification(wanted, options);
  if (!verification.prepare(diagnostics)) return std::nullopt;
  VerifyOutcome out;
  out.interrupted = !verification.execute();
  if (!out.interrupted) out.result = verification.result();
  return out;
}

}  // namespace courant
