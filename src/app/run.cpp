#include <sys/resource.h>

#include <chrono>
#include <cmath>
#include <ctime>

#include <fmt/format.h>

#include "app/advice.hpp"
#include "app/end_report.hpp"
#include "app/field_options.hpp"
#include "app/simulation.hpp"
#include "base/run_error.hpp"
#include "model/output_times.hpp"
#include "output/ascii.hpp"
#include "output/field_writer.hpp"
#include "output/messag.hpp"
#include "parallel/job_queue.hpp"
#include "parallel/parallel.hpp"
#include "time/guard.hpp"

namespace courant {

namespace {

using Clock_ = std::chrono::steady_clock;

double seconds_since(Clock_::time_point start) {
  return std::chrono::duration<double>(Clock_::now() - start).count();
}

double cpu_seconds() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  const auto seconds = [](const timeval& t) {
    return static_cast<double>(t.tv_sec) + 1e-6 * static_cast<double>(t.tv_usec);
  };
  return seconds(usage.ru_utime) + seconds(usage.ru_stime);
}

std::int64_t peak_memory() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  return usage.ru_maxrss * 1024;
}

OutputSchedule schedule(const OutputTimes& times) {
  if (times.rule == OutputTimes::Rule::interval) return {times.interval};
  return {first_output(times), [times](Real due) { return next_output(times, due); }};
}

HistoryRequests history_requests(const Simulation& s) {
  const OutputRequests& wanted = s.model().output;
  HistoryRequests h;
  h.glstat = schedule(wanted.glstat), h.matsum = schedule(wanted.matsum), h.rcforc = schedule(wanted.rcforc);
  h.sleout = schedule(wanted.sleout), h.sphout = schedule(wanted.sphout), h.nodout = schedule(wanted.nodout);
  h.rbdout = schedule(wanted.rbdout), h.bndout = schedule(wanted.bndout);
  h.spcforc = schedule(wanted.spcforc);
  for (const HistoryNode& node : wanted.history_node)
    if (!node.title.empty()) h.nodes.push_back({node.id, node.title});
  h.title = s.model().title;
  for (const ModelPart& part : s.model().parts) h.parts.push_back({part.id, part.title});
  for (const auto& contact : s.contacts())
    h.contacts.push_back({contact->report().id, contact->report().title});
  return h;
}

/// One run with its files.
class Run {
 public:
  Run(Simulation& simulation, const std::string& deck_path, const RunOptions& options)
      : s_(simulation),
        options_(options),
        end_(options.until > 0 ? options.until : simulation.model().endtim),
        messag_((prepare_folder(options.dir), std::filesystem::path(options.dir) / "messag"),
                [this](std::string_view line) {
                  if (options_.print) options_.print(std::string(line));
                }),
        fields_(options.dir, field_options(simulation.model(), simulation.sph().hide_inactive)),
        histories_(options.dir, history_requests(simulation)),
        field_schedule_(field_schedule(simulation, end_)) {
    summary_.title = s_.model().title;
    summary_.deck = deck_path;
    summary_.threads = threads();
    summary_.particles = s_.world().particles.size();
    summary_.warnings = options.warnings;
    summary_.dt_min = std::numeric_limits<Real>::infinity();
  }

  Summary execute() {
    print_start();
    try {
      loop();
      finish_normally();
    } catch (const RunError& error) {
      fail(error.what());
      explain(error.cause);
    } catch (const OutputError& error) {
      fail(error.what());
    }
    close();
    return summary_;
  }

 private:
  /// An older run's results must not pass for this one's if this one is killed.
  static void prepare_folder(const std::filesystem::path& dir) {
    make_folder(dir);
    for (const char* name :
         {"summary.yaml", "fields.pvd", "history.h5", "fields/failed.vtp", "fields/failed_shells.vtu"}) {
      std::error_code ignored;  // a file that cannot be removed cannot be replaced either: that is told then
      std::filesystem::remove(dir / name, ignored);
    }
  }
  static OutputSchedule field_schedule(const Simulation& s, Real end) {
    const OutputRequests& wanted = s.model().output;
    return wanted.d3plot_count > 0 ? OutputSchedule(end / wanted.d3plot_count) : schedule(wanted.d3plot);
  }

  void print_start() {
    messag_.line(fmt::format("Courant {}", COURANT_VERSION));
    messag_.line(fmt::format("deck {}: {}", summary_.deck, summary_.title));
    messag_.line(fmt::format("{} particles in {}D, {} shell nodes, {} segments, {} threads",
                             summary_.particles, s_.world().dim, s_.world().nodes.size(),
                             s_.world().segments.size(), summary_.threads));
    for (const std::string& warning : options_.warnings) messag_.line(warning);
    messag_.line(s_.passes());
    messag_.line(" input of data is completed");
    messag_.line(fmt::format(" termination time                  = {:10.3E}", end_));
  }

  void loop() {
    const Id endcyc = s_.model().endcyc;
    while (s_.clock().t < end_) {
      if (options_.stop && options_.stop->load()) {
        summary_.termination = "interrupted";
        summary_.reason = fmt::format("stopped by a signal at time {:.6g}", s_.clock().t);
        return;
      }
      if (endcyc > 0 && s_.clock().cycle >= endcyc) {
        summary_.reason = "termination cycle reached";
        return;
      }
      s_.step([this](World& world, const Clock& clock, const std::string& who) {
        at_time_level(world, clock, who);
      });
      summary_.particle_steps += s_.world().particles.active;
      if (s_.clock().cycle % 64 == 0) show_progress();
    }
    summary_.reason = "termination time reached";
  }

  void at_time_level(World& world, const Clock& clock, const std::string& who) {
    who_ = who;
    if (clock.cycle == 0) print_first_step(clock);
    summary_.dt_min = std::min(summary_.dt_min, clock.dt);
    summary_.dt_max = std::max(summary_.dt_max, clock.dt);
    if (field_schedule_.take(clock.t, clock.dt)) write_fields(world, clock);
    if (histories_.is_due(clock.t, clock.dt)) write_histories(false);
    if (clock.cycle % 5000 == 0 && clock.cycle > 0) {
      messag_.status(clock.cycle, clock.t, clock.dt, "flush i/o buffers");
      messag_.line(fmt::format("          step set by {}  {}  {} left", who, state_in_words(), time_left()));
    }
  }

  void print_first_step(const Clock& clock) {
    messag_.line(fmt::format(" initial kinetic energy = {:.8E}", s_.world().energy.kinetic));
    messag_.line(" initialization completed");
    messag_.line(fmt::format("first step {:.4E} [T], set by {}", clock.dt, who_));
  }

  void write_fields(World& world, const Clock& clock) {
    s_.guard().look(world, clock);  // states that are written are sound
    for (const auto& contact : s_.contacts()) contact->show_forces(world);
    writer_.submit(
        [this, state = fields_.take(world, clock.t, state_++)]() mutable { fields_.write(std::move(state)); },
        weight_of_state);
    last_field_time_ = clock.t;
    messag_.status(clock.cycle, clock.t, clock.dt, "write d3plot file");
  }

  void write_histories(bool always) {
    const Histories::Due due = histories_.take(s_.clock().t, s_.clock().dt, always);
    Sample sample = s_.sample(who_);
    const double steps = static_cast<double>(std::max<std::int64_t>(summary_.particle_steps, 1));
    sample.ns_per_zone_cycle = 1e9 * seconds_since(start_) / steps;
    if (!std::isfinite(sample.energy.total())) s_.guard().look(s_.world(), s_.clock());
    writer_.submit([this, sample = std::move(sample), due] { histories_.write(sample, due); });
  }

  void finish_normally() {
    s_.evaluate(who_);  // pressures and forces at the end time
    s_.timer().measure("guard", [&] { s_.guard().look(s_.world(), s_.clock()); });
    s_.timer().measure("output", [&] { write_last(); });
    if (summary_.termination.empty()) {
      summary_.termination = "normal";
      messag_.line(fmt::format(" *** {} ***", summary_.reason));
    }
  }

  void write_last() {
    if (field_schedule_.is_wanted() && last_field_time_ < s_.clock().t) write_fields(s_.world(), s_.clock());
    write_histories(true);
    writer_.wait();
  }

  void fail(const std::string& reason) {
    summary_.termination = "error";
    summary_.reason = reason;
    failure_ = " *** Error: " + reason;
  }

  /// What the state tells of the failure: advice, and the state itself for those who want to look.
  void explain(StopCause cause) {
    failed_state_ = true;
    s_.guard().note_ranges(s_.world(), s_.clock());
    add_facts_at_stop(facts_, s_, cause, who_);
    summary_.advice = advice(facts_);
    failure_ += "\n     hint: " + summary_.advice;
  }

  /// Writes what can still be written; a second failure must not hide the first.
  void close() {
    s_.timer().measure("output", [&] {
      attempt([&] { writer_.wait(); });
      attempt([&] { histories_.finish(); });
      attempt([&] { fields_.finish(); });
      if (failed_state_) attempt([&] { fields_.write_failed(s_.world(), s_.clock().t); });
    });
    Summary& y = summary_;
    y.ranges = s_.guard().ranges();
    y.time = s_.clock().t, y.steps = s_.clock().cycle;
    y.wall_seconds = seconds_since(start_), y.cpu_seconds = cpu_seconds() - cpu_start_;
    y.writer_cpu_seconds = writer_.cpu_seconds();
    y.active_particles = s_.world().particles.active;
    y.peak_memory_bytes = peak_memory();
    y.energy = s_.world().energy;
    y.counters = s_.world().counters;
    y.maxima = s_.world().maxima;
    y.leaked_particles = y.counters.contains("leaked_particles") ? y.counters.at("leaked_particles") : 0;
    y.max_penetration = y.maxima.contains("max_penetration") ? y.maxima.at("max_penetration") : 0;
    if (!std::isfinite(y.dt_min)) y.dt_min = 0;
    y.read_seconds = s_.read_seconds();
    y.counters["neighbour_rebuilds"] = s_.neighbours().rebuilds();
    for (const std::string& warning : end_warnings(y)) y.warnings.push_back(warning);
    note_times();
    note_output();
    attempt([&] { print_end(); });
    attempt([&] { write_summary(std::filesystem::path(options_.dir) / "summary.yaml", y); });
  }

  /// One of the last files; where it fails, the others are still written.
  template <class Write>
  void attempt(Write write) {
    try {
      write();
    } catch (const OutputError& error) {
      if (summary_.termination == "error") return;  // the first failure is the one to report
      summary_.termination = "error";
      summary_.reason = error.what();
      failure_ = " *** Error: " + summary_.reason;
    }
  }

  void print_end() {
    if (!failure_.empty()) messag_.line(failure_);
    if (summary_.termination == "interrupted") messag_.line(fmt::format(" *** {} ***", summary_.reason));
    for (const std::string& line : end_report(summary_)) messag_.line(line);
    const bool ok = summary_.termination != "error";
    messag_.banner(ok ? " N o r m a l    t e r m i n a t i o n" : " E r r o r    t e r m i n a t i o n");
  }

  /// Rows of the passes, and what is left of the elapsed time.
  void note_times() {
    double sum = 0;
    for (const auto& row : s_.timer().table()) {
      summary_.passes.push_back({row.name, row.seconds, row.calls});
      sum += row.seconds;
      if (row.name == "output") summary_.output.seconds = row.seconds;
    }
    summary_.passes.push_back({"rest", summary_.read_seconds + summary_.wall_seconds - sum, 1});
  }

  void note_output() {
    summary_.output.states = fields_.states();
    summary_.output.field_bytes = fields_.bytes();
    summary_.output.history_bytes = histories_.bytes();
  }

  void show_progress() {
    if (s_.clock().cycle == 64) {
      const double done = s_.clock().t / end_;
      messag_.line(fmt::format(" estimated clock time to complete    = {:10.0f} sec",
                               seconds_since(start_) * (1 - done) / done));
    }
    if (!options_.progress || seconds_since(shown_) < 0.5) return;
    shown_ = Clock_::now();
    const double done = std::min(1.0, s_.clock().t / end_);
    options_.progress(fmt::format("t {:.4f} of {:g}  {:5.1f} %  dt {:.2e} ({})  {}  {} left", s_.clock().t,
                                  end_, 100 * done, s_.clock().dt_old, who_, state_in_words(), time_left()));
  }

  std::string time_left() const {
    const double done = std::min(1.0, s_.clock().t / end_);
    return done > 0 ? duration(seconds_since(start_) * (1 - done) / done) : "?";
  }

  /// Energy as the guard saw it last.
  std::string state_in_words() const {
    const Counters& counters = s_.world().counters;
    const auto leaked = counters.find("leaked_particles");
    return fmt::format("{} active  energy ratio {:.4f}  leaked {}", s_.world().particles.active,
                       1 + energy_ratio_change(s_.world().energy) / 100,
                       leaked == counters.end() ? 0 : leaked->second);
  }

  Simulation& s_;
  const RunOptions& options_;
  Real end_;
  Messag messag_;
  FieldWriter fields_;
  Histories histories_;
  OutputSchedule field_schedule_;
  Summary summary_;
  std::string who_, failure_;
  StopFacts facts_ = facts_at_start(s_);
  bool failed_state_ = false;
  Real last_field_time_ = -1;
  int state_ = 0;
  double cpu_start_ = cpu_seconds();
  Clock_::time_point start_ = Clock_::now(), shown_ = start_;

  /// At most two field states are held in memory, or the samples that fit beside them.
  static constexpr int weight_of_state = 16;
  /// Writes fields_ and histories_, which nothing else may touch before it has been waited for. The last
  /// member: its jobs end before what they write to.
  JobQueue writer_{2 * weight_of_state};
};

}  // namespace

Summary run(Simulation& simulation, const std::string& deck_path, const RunOptions& options) {
  return Run(simulation, deck_path, options).execute();
}

}  // namespace courant
