#include <cmath>

#include <fmt/format.h>

#include "app/check/advice.hpp"
#include "app/report/end_report.hpp"
#include "app/report/run_summary.hpp"
#include "app/report/verdict.hpp"
#include "app/run/relaxation.hpp"
#include "app/run/resources.hpp"
#include "app/run/restart.hpp"
#include "app/run/run_ends.hpp"
#include "app/run/run_outputs.hpp"
#include "app/run/sense_switches.hpp"
#include "app/run/simulation.hpp"
#include "app/run/state_copies.hpp"
#include "app/run/state_files.hpp"
#include "base/run_error.hpp"
#include "base/version.hpp"
#include "output/ascii/ascii.hpp"
#include "output/folder_lock.hpp"
#include "output/messag.hpp"
#include "output/restart_file.hpp"
#include "parallel/job_queue.hpp"
#include "parallel/parallel.hpp"
#include "parallel/thread_choice.hpp"
#include "time/guard.hpp"

namespace courant {
namespace {

/// The restart file that a stop in error leaves.
constexpr const char* before_error = "before_error.h5";

/// One run with its files.
class Run {
 public:
  Run(Simulation& simulation, const std::string& deck_path, const RunOptions& options, StopFacts facts)
      : s_(simulation),
        options_(options),
        end_(options.until > 0 ? options.until : simulation.model().endtim),
        lock_(options.dir),
        goes_on_(prepare_folder(options, simulation.deck())),
        messag_(
            result_path(options.dir, result_names::messag),
            [this](std::string_view line) {
              if (options_.print) options_.print(std::string(line));
            },
            goes_on_),
        positions_(positions_before(options)),
        fields_(options.dir, simulation),
        histories_(options.dir, history_requests(simulation), goes_on_ ? &positions_ : nullptr),
        field_schedule_(field_schedule(simulation, end_)),
        restart_schedule_(simulation.deck()),
        switches_(options.dir, options.keyboard),
        copies_(simulation.world(), options.dump_at_end, simulation.clock().cycle),
        choice_(threads(), s_.world().particles.size() + s_.world().elements(),
                options.choose_threads ? running_elsewhere() : 0),
        facts_(std::move(facts)) {
    if (options.choose_threads) set_threads(choice_.threads());
    summary_.title = s_.model().title, summary_.deck = deck_path, summary_.threads = threads();
    summary_.particles = s_.world().particles.size(), summary_.elements = s_.world().elements();
    summary_.warnings = options.warnings, summary_.limits = verdict_limits(s_.deck());
    summary_.dt_min = std::numeric_limits<Real>::infinity();
  }

  Summary execute() {
    print_start();
    try {
      if (const std::string why = s_.why_not_until(end_); !why.empty())
        throw RunError(why, Simulation::how_until);
      options_.restart ? go_on() : relax_first();
      if (summary_.reason.empty()) loop();
      finish_normally();
    } catch (const RunError& error) {
      fail(error.what());
      explain(error);
    } catch (const OutputError& error) {
      fail(error.what());
    }
    close();
    return summary_;
  }

 private:
  void print_start() {
    messag_.line(fmt::format("Courant {}", COURANT_VERSION));
    messag_.line(fmt::format("deck {}: {}", summary_.deck, summary_.title));
    messag_.line(
        fmt::format("{} particles in {}D, {} elements that deform, {} nodes, {} segments, {} thread{}",
                    summary_.particles, s_.world().dim, summary_.elements, s_.world().nodes.size(),
                    s_.world().segments.size(), threads(), threads() == 1 ? "" : "s"));
    for (const std::string& warning : options_.warnings) messag_.line(warning);
    messag_.keep(s_.passes());
    if (options_.print) options_.print(s_.passes_in_short() + "; `messag` lists them");
    if (!copies_.refusal().empty()) messag_.line(copies_.refusal());
    messag_.line(" input of data is completed");
    messag_.line(fmt::format(" termination time                  = {:10.3E}", end_));
  }

  /// Takes up what the run was at when the restart file was written.
  void go_on() {
    Restart& before = *options_.restart;
    Archive archive = Archive::loader(before.state);
    keep_run(archive);
    messag_.line(fmt::format(" *** restart from {} at time {:.6g}, cycle {} ***", before.file.string(),
                             before.t, before.cycle));
    if (!goes_on_) {
      messag_.line(" the files of the run so far are in another folder: files here begin at the restart");
      histories_.set_first_potential(positions_);
    } else {
      const Archive::Group inside(archive, "files");
      fields_.keep(archive);
      if (std::string lost = fields_.cut(state_); !lost.empty()) before.warnings.push_back(std::move(lost));
    }
    if (before.file.filename() == before_error && s_.changes().empty())
      before.warnings.push_back("after this state the run stopped in error, and the deck is the same");
    for (const std::string& text : before.warnings) messag_.line(" *** Warning: " + text);
    for (const auto& from : {before.warnings, s_.changes()})
      summary_.restart_notes.insert(summary_.restart_notes.end(), from.begin(), from.end());
    for (const std::string& text : histories_.lost()) messag_.line(" *** Warning: " + text);
    for (const std::string& text : s_.changes()) messag_.line(" changed in the deck: " + text);
    before.state.clear();
    newest_restart_ = before.file.string();
    ++summary_.restarts;
    kept_cycle_ = s_.clock().cycle;
  }

  /// What restart files hold of the run itself, without its files.
  void keep_run(Archive& archive) {
    const Archive::Group inside(archive, "run");
    Summary& y = summary_;
    Real wall = wall_seconds(), cpu = cpu_before_ + cpu_seconds() - cpu_start_,
         writer = writer_before_ + writer_.cpu_seconds(), read = read_before_ + s_.read_seconds();
    std::vector<std::string> names;
    std::vector<Real> seconds;
    std::vector<std::int64_t> calls;
    for (const auto& row : s_.timer().table())
      names.push_back(row.name), seconds.push_back(row.seconds), calls.push_back(row.calls);
    archive("dt_min", y.dt_min);
    archive("dt_max", y.dt_max);
    archive("particle_steps", y.particle_steps);
    archive("element_steps", y.element_steps);
    archive("restarts", y.restarts);
    archive("restart_notes", y.restart_notes);
    archive("wall_seconds", wall);
    archive("cpu_seconds", cpu);
    archive("writer_cpu_seconds", writer);
    archive("read_seconds", read);
    archive("pass_names", names);
    archive("pass_seconds", seconds);
    archive("pass_calls", calls);
    archive("field_state", state_);
    archive("last_field_time", last_field_time_);
    restart_schedule_.keep(archive);
    histories_.keep(archive, s_.clock().t);
    if (!archive.loading()) return;
    wall_before_ = wall, cpu_before_ = cpu, writer_before_ = writer, read_before_ = read;
    for (std::size_t k = 0; k < names.size(); ++k) s_.timer().add({names[k], seconds.at(k), calls.at(k)});
    field_schedule_.skip_to(s_.clock().t);
  }

  /// Between two steps. Copies now; the thread that writes does the rest once other files are up to here.
  void write_restart(const std::string& name) {
    s_.timer().measure("restart files", [&] { submit_restart(name); });
    messag_.status(s_.clock().cycle, s_.clock().t, s_.clock().dt, fmt::format("write {} file", name));
    kept_cycle_ = s_.clock().cycle;
  }

  void submit_restart(const std::string& name) {
    auto state = std::make_shared<SavedState>();
    save(*state);
    writer_.submit(
        [this, state, file = restart_file(name + ".h5"), cycle = s_.clock().cycle] {
          histories_.finish();
          save_files(*state);
          write_restart_file(file, *state, cycle);
          newest_restart_ = file.string();
        },
        weight_of_state);
  }

  void save(SavedState& state) {
    Archive archive = Archive::saver(state);
    Restart head = head_of(s_);
    keep_head(head, archive);
    s_.keep(archive);
    keep_run(archive);
  }

  /// How far the files have come, by the thread that writes them.
  void save_files(SavedState& state) {
    Archive archive = Archive::saver(state);
    const Archive::Group inside(archive, "files");
    HistoryPositions positions = histories_.positions();
    positions.keep(archive);
    fields_.keep(archive);
  }

  std::filesystem::path restart_file(const std::string& name) const {
    return result_path(options_.dir, "restart/" + name);
  }

  void copy_state() {
    s_.timer().measure("copies for an error stop", [&] {
      auto copy = copies_.take(s_.clock(), [this](SavedState& state) { save(state); });
      writer_.submit([this, copy] {
        save_files(copy->state);
        copy->has_files = true;
      });
    });
  }

  /// After a stop in error, when nothing is left for the thread that writes.
  void write_copy() {
    const auto copy = copies_.best();
    if (!copy || !copy->has_files) return;
    const std::string file = restart_file(before_error).string();
    histories_.finish();  // its samples belong to the state
    write_restart_file(file, copy->state, copy->cycle);
    const char* const what = facts_.cause == StopCause::other ? "repeat the last steps"
                                                              : "go on with a smaller TSSFAC in the deck";
    failure_ += fmt::format("\n     {} has the state at time {:.6g}, cycle {}, a sound one; to {}: {}", file,
                            copy->t, copy->cycle, what, call_to_go_on(summary_.deck, options_, file));
    if (newest_restart_.empty() || copy->cycle > kept_cycle_) newest_restart_ = file;
  }

  /// False: the run ends here.
  bool obey(const SenseSwitch& order) {
    using Kind = SenseSwitch::Kind;
    const Clock& clock = s_.clock();
    messag_.status(clock.cycle, clock.t, clock.dt, "sense switch " + order.text);
    switch (order.kind) {
      case Kind::dump_and_stop:
      case Kind::stop:
        if (order.kind == Kind::dump_and_stop) write_restart(restart_schedule_.next_dump());
        summary_.termination = "interrupted";
        summary_.reason = fmt::format("stopped by sense switch {} at time {:.6g}", order.text, clock.t);
        return false;
      case Kind::dump:
        write_restart(restart_schedule_.next_dump());
        break;
      case Kind::plot:
        plot_wanted_ = true;  // when x, p and f are next of one time
        break;
      case Kind::flush:
        writer_.submit([this] { histories_.finish(), fields_.finish(); });
        break;
      case Kind::end_time:
        if (const std::string why = s_.why_not_until(order.end_time); !why.empty())
          messag_.line(" *** Warning: the end stays: " + why + "; " + Simulation::how_until);
        else
          end_ = order.end_time;
        messag_.line(fmt::format(" termination time                  = {:10.3E}", end_));
        break;
      case Kind::tell:
        break;
      case Kind::unknown:
        messag_.line(unknown_switch(order));
        break;
    }
    return true;
  }

  /// Stopped there, a run has no restart file, from which it would go on without the rest.
  void relax_first() {
    const RunEnds ends(s_, options_.stop, &program_);
    const auto stop = [&] { return ends.called_off(cpu_seconds() - cpu_start_); };
    if (const auto end = relax_before(s_, options_, stop, [&](const auto& line) { messag_.line(line); }))
      stop_at(*end);
  }

  void loop() {
    const RunEnds ends(s_, options_.stop, &program_);
    while (s_.clock().t < end_) {
      if (const auto end = ends.reached(cpu_seconds() - cpu_start_)) return stop_at(*end);
      s_.step([this](World& world, const Clock& clock, const std::string& who) {
        at_time_level(world, clock, who);
      });
      summary_.particle_steps += s_.world().particles.active, summary_.element_steps += summary_.elements;
      for (const std::string& name : restart_schedule_.due(s_.clock().cycle)) write_restart(name);
      if (copies_.is_due(s_.clock())) copy_state();
      if (const auto order = switches_.take(); order && !obey(*order)) return;
      if (s_.clock().cycle % 64 == 0) show_progress();
      if (options_.choose_threads) choose_threads();
    }
    summary_.reason = "termination time reached";
  }

  void stop_at(const RunEnd& end) {
    summary_.reason = end.reason;
    if (end.interrupted) summary_.termination = "interrupted";
    if (end.wants_restart) write_restart(restart_schedule_.next_dump());
  }

  void at_time_level(World& world, const Clock& clock, const std::string& who) {
    who_ = who;
    tell_failures(world, clock, messag_);
    if (clock.cycle == first_cycle_) tell_first_step(world, clock, who, messag_);
    summary_.dt_min = std::min(summary_.dt_min, clock.dt);
    summary_.dt_max = std::max(summary_.dt_max, clock.dt);
    if (field_schedule_.take(clock.t, clock.dt) || plot_wanted_) write_fields(world, clock);
    plot_wanted_ = false;
    if (histories_.is_due(clock.t, clock.dt)) write_histories(false);
    program_.at(s_, clock.t, clock.dt);
    if (clock.cycle % 5000 == 0 && clock.cycle > 0) {
      messag_.status(clock.cycle, clock.t, clock.dt, "flush i/o buffers");
      messag_.line(
          fmt::format("          step set by {}  {}  {} left", who, state_in_words(s_.world()), time_left()));
    }
  }

  void write_fields(World& world, const Clock& clock) {
    s_.guard().look(world, clock);  // states that are written are sound
    if (fields_.with_vtk()) s_.show_wall_forces();
    writer_.submit(
        [this, state = fields_.take(world, clock, state_++)]() mutable { fields_.write(std::move(state)); },
        weight_of_state);
    last_field_time_ = clock.t;
    messag_.keep_status(clock.cycle, clock.t, clock.dt, fmt::format("write field state {}", state_ - 1));
  }

  void write_histories(bool always) {
    const Histories::Due due = histories_.take(s_.clock().t, s_.clock().dt, always);
    const bool whole = always || histories_.needs_whole_sample(due);
    Sample sample = s_.sample(who_, whole, histories_.due_gauges(due));
    const auto steps = std::max<std::int64_t>(summary_.particle_steps + summary_.element_steps, 1);
    sample.ns_per_zone_cycle = 1e9 * wall_seconds() / static_cast<double>(steps);
    if (!std::isfinite(sample.energy.total())) s_.guard().look(s_.world(), s_.clock());
    writer_.submit([this, sample = std::move(sample), due] { histories_.write(sample, due); });
  }

  void finish_normally() {
    if (options_.dump_at_end && kept_cycle_ != s_.clock().cycle) write_restart(restart_schedule_.next_dump());
    s_.evaluate(who_);  // pressures and forces at the end time
    s_.timer().measure("guard", [&] { s_.guard().look(s_.world(), s_.clock()); });
    s_.timer().measure("output", [&] { write_last(); });
    program_.at_end(s_);
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
    summary_.termination = "error", summary_.reason = reason;
    failure_ = " *** Error: " + reason;
  }

  /// What the state shows of the failure: advice, and the state itself, to be looked at.
  void explain(const RunError& error) {
    failed_state_ = true;
    s_.guard().note_ranges(s_.world(), s_.clock());
    s_.show_wall_forces();
    add_facts_at_stop(facts_, s_, error, who_);
    if (!(summary_.advice = advice(facts_)).empty()) failure_ += "\n     hint: " + summary_.advice;
  }

  /// Writes what can still be written; a second failure must not hide the first.
  void close() {
    s_.timer().measure("output", [&] {
      attempt([&] { writer_.wait(); });
      if (failed_state_) attempt([&] { write_copy(); });
      tell_restart_file();
      attempt([&] { histories_.finish(); });
      attempt([&] { fields_.finish(); });
      if (failed_state_) attempt([&] { fields_.write_failed(s_.world(), s_.clock().t); });
    });
    Summary& y = summary_;
    y.threads = threads(), y.wall_seconds = wall_seconds(),
    y.cpu_seconds = cpu_before_ + cpu_seconds() - cpu_start_;
    y.writer_cpu_seconds = writer_before_ + writer_.cpu_seconds();
    y.restart_file = newest_restart_;
    y.read_seconds = read_before_ + s_.read_seconds();
    note_end(y, s_);
    judge(y);
    for (const std::string& warning : end_warnings(y)) y.warnings.push_back(warning);
    note_times(y, s_.timer());
    y.output.states = fields_.states(), y.output.field_bytes = fields_.bytes();
    y.output.history_bytes = histories_.bytes();
    attempt([&] { print_end(); });
    attempt([&] { write_summary(result_path(options_.dir, result_names::summary), y); });
  }

  /// What can go on from where, for a run that did not reach its end.
  void tell_restart_file() {
    const bool is_told = failure_.find(newest_restart_) != std::string::npos && !newest_restart_.empty();
    if (summary_.termination == "error" && !is_told)
      failure_ += newest_restart_.empty()
                      ? "\n     no restart file was written; *DATABASE_BINARY_RUNRSF asks for some"
                      : "\n     to go on from the latest whole state: " +
                            call_to_go_on(summary_.deck, options_, newest_restart_);
    else if (summary_.termination == "interrupted" && !newest_restart_.empty())
      summary_.reason += "; to go on: " + call_to_go_on(summary_.deck, options_, newest_restart_);
  }

  double wall_seconds() const { return wall_before_ + PassTimer::now() - start_; }

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
      judge(summary_);
    }
  }

  void print_end() {
    if (!failure_.empty()) messag_.line(failure_);
    const bool cut = summary_.termination == "interrupted";
    if (cut) messag_.line(fmt::format(" *** {} ***", summary_.reason));
    for (const std::string& line : end_report(summary_)) messag_.line(line);
    const char* const whole = cut ? " I n t e r r u p t e d" : " N o r m a l    t e r m i n a t i o n";
    const bool ok = summary_.termination != "error" && summary_.verdict != "broken";
    messag_.banner(ok ? whole : " E r r o r    t e r m i n a t i o n");
  }

  void choose_threads() {
    const std::string line = choice_.step(PassTimer::now() - start_, cpu_seconds());
    set_threads(choice_.threads());
    if (!line.empty()) messag_.line(line);
  }

  void show_progress() {
    if (!estimated_) {
      estimated_ = true;
      messag_.line(fmt::format(" estimated clock time to complete    = {:10.0f} sec", seconds_left()));
    }
    if (!options_.progress || PassTimer::now() - shown_ < 0.5) return;
    shown_ = PassTimer::now();
    const double done = std::min(1.0, s_.clock().t / end_);
    options_.progress(fmt::format("t {:.4f} of {:g}  {:5.1f} %  dt {:.2e} ({})  {}  {} left", s_.clock().t,
                                  end_, 100 * done, s_.clock().dt_old, who_, state_in_words(s_.world()),
                                  time_left()));
  }

  std::string time_left() const { return s_.clock().t > first_time_ ? duration(seconds_left()) : "?"; }
  double seconds_left() const {
    return (PassTimer::now() - start_) * std::max(0.0, end_ - s_.clock().t) / (s_.clock().t - first_time_);
  }
  Simulation& s_;
  const RunOptions& options_;
  Real end_;
  FolderLock lock_;
  bool goes_on_;  ///< with the files of the run before
  Messag messag_;
  HistoryPositions positions_;  ///< of the run before
  StateFiles fields_;
  Histories histories_;
  OutputSchedule field_schedule_;
  RestartSchedule restart_schedule_;
  SenseSwitches switches_;
  StateCopies copies_;
  Program program_{options_.hook};  ///< that follows the run
  Summary summary_;
  ThreadChoice choice_;
  std::string who_, failure_;
  StopFacts facts_;
  bool failed_state_ = false, plot_wanted_ = false, estimated_ = false;
  const std::int64_t first_cycle_ = s_.clock().cycle;
  const Real first_time_ = s_.clock().t;
  std::int64_t kept_cycle_ = 0;  ///< of the latest restart file
  std::string newest_restart_;   ///< that is whole; set by the thread that writes
  Real wall_before_ = 0, cpu_before_ = 0, writer_before_ = 0, read_before_ = 0;  ///< before the restart [s]
  Real last_field_time_ = -1;
  int state_ = 0;
  double cpu_start_ = cpu_seconds();
  double start_ = PassTimer::now(), shown_ = start_;

  /// At most two field states are held in memory, or the samples that fit beside them.
  static constexpr int weight_of_state = 16;
  /// Writes fields_ and histories_, which nothing else may touch before it has been waited for. The last
  /// member: its jobs end before what they write to.
  JobQueue writer_{memory_is_limited() ? 0 : 2 * weight_of_state};
};

}  // namespace

Summary run(Simulation& simulation, const std::string& deck_path, const RunOptions& options) {
  StopFacts facts = facts_at_start(simulation);
  if (options.restart) {
    Archive archive = Archive::loader(options.restart->state);
    simulation.keep(archive);
  }
  return Run(simulation, deck_path, options, std::move(facts)).execute();
}

}  // namespace courant
