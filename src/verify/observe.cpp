#include "verify/observe.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numeric>

#include "base/nearest_word.hpp"
#include "post/history_file.hpp"
#include "verify/formula.hpp"
#include "verify/particle_states.hpp"

namespace courant {
namespace {

using ObservationKind = SuiteObservation::Kind;

Measured nothing(std::string why) {
  Measured out;
  out.why = std::move(why);
  return out;
}

std::string first_error(const Diagnostics& diagnostics) {
  for (const Diagnostic& d : diagnostics.all())
    if (d.severity == Severity::error) return fmt::format("{}: {}", d.where.file, d.message);
  return "unknown fault";
}

/// The part of a series that counts: its window with a slack of a quarter of the mean distance of samples,
/// because a sample is written up to one step early.
Series in_window(const Series& series, const MeasuredTimes& window) {
  const Real range = series.size() > 1 ? series.x.back() - series.x.front() : 0;
  const Real slack = series.size() > 1 ? 0.25 * range / static_cast<Real>(series.size() - 1) : 0;
  return courant::window(series, window.from - slack, window.to + slack);
}

/// The number of a scalar observation, from its series.
Measured taken(const SuiteObservation& o, Series series, const MeasuredTimes& window) {
  Measured out;
  if (series.size() == 0) return nothing("no sample lies in the window");
  if (o.take != "curve") {
    // a moment may lie between samples of which one is outside the window
    const Taken number = take_number(series, o.take, window.at);
    if (!number.value) return nothing(number.why);
    if (!std::isfinite(*number.value)) return nothing("the value is not finite");
    out.value = number.value;
  }
  out.found = true;
  out.series = std::move(series);
  return out;
}

/// Observations of history.h5.
class HistoryObserver {
 public:
  HistoryObserver(const HistoryFile& file, const Variables& variables) : file_(file), variables_(variables) {}

  Measured observe(const SuiteObservation& o) const {
    const HistoryText text = find_history_names(o.of);
    std::vector<std::string> words = text.words;
    words.push_back("t");
    Formula formula(text.text, words, variables_);
    if (!formula.ok()) return nothing(formula.error());
    const MeasuredTimes window = window_of(o, variables_);
    if (!window.why.empty()) return nothing(window.why);
    std::vector<std::vector<Real>> columns;
    std::vector<char> there(time().size(), 1);
    for (const HistoryName& name : text.names) {
      if (const std::string fault = fault_of(name); !fault.empty()) return nothing(fault);
      columns.push_back(*file_.column(name.path, std::max(0, name.component)));
      const std::vector<char> sampled = file_.sampled(name.path);
      for (std::size_t i = 0; i < there.size(); ++i) there[i] = there[i] && sampled[i];
    }
    columns.push_back(time());
    Series series;
    std::vector<Real> row(columns.size());
    for (std::size_t i = 0; i < there.size(); ++i) {
      if (!there[i]) continue;
      for (std::size_t k = 0; k < columns.size(); ++k) row[k] = columns[k][i];
      if (!series.x.empty() && !(row.back() > series.x.back())) continue;  // the last sample may stand twice
      series.x.push_back(row.back());
      series.y.push_back(formula(row.data()));
    }
    series = in_window(series, window);
    for (std::size_t i = 0; i < series.size(); ++i)
      if (!std::isfinite(series.y[i])) return nothing(fmt::format("not finite at t = {:.6g}", series.x[i]));
    return taken(o, std::move(series), window);
  }

  /// What is not finite in the sums over the whole model.
  std::string garbage() const {
    for (const std::string& name : file_.names()) {
      if (!name.starts_with("/global/")) continue;
      for (int k = 0; k < file_.components(name); ++k) {
        const std::vector<Real> values = *file_.column(name, k);
        for (std::size_t i = 0; i < values.size(); ++i)
          if (!std::isfinite(values[i]))
            return fmt::format("{} is not finite at t = {:.6g}", name.substr(1), time()[i]);
      }
    }
    return {};
  }

 private:
  std::vector<Real> time() const { return *file_.column("/global/time"); }

  std::string fault_of(const HistoryName& name) const {
    const int components = file_.components(name.path);
    if (components == 0) {
      const std::string near = nearest_word(name.path, file_.names());
      return fmt::format("history.h5 has no '{}'{}", name.path.substr(1),
                         near.empty() ? "" : fmt::format("; did you mean {}?", near.substr(1)));
    }
    if (components == 1 && name.component >= 0) return fmt::format("'{}' is no vector", name.path.substr(1));
    if (components > 1 && name.component < 0)
      return fmt::format("'{}' is a vector: add .x, .y or .z", name.path.substr(1));
    return {};
  }

  const HistoryFile& file_;
  const Variables& variables_;
};

/// An observation over particles on its way through the states.
struct ParticleTask {
  const SuiteObservation& o;
  Measured& out;
  Formula of, along, reference;
  Selection where;
  MeasuredTimes window;
  int state = -1;  // of a profile
  std::vector<Real> volumes_of_profile;
  bool open = true;

  ParticleTask(const SuiteObservation& observation, Measured& measured, const Variables& variables)
      : o(observation),
        out(measured),
        of(observation.of, particle_variables(), variables),
        along(observation.along.empty() ? "0" : observation.along, particle_variables(), variables),
        reference(with_formula(observation) ? observation.reference.formula : "0", particle_variables(),
                  variables),
        where(observation.where, of, variables),
        window(window_of(observation, variables)) {
    for (const Formula* formula : formulas())
      if (!formula->ok()) close(formula->error());
    if (!window.why.empty()) close(window.why);
  }
  static bool with_formula(const SuiteObservation& o) {
    return o.kind == ObservationKind::profile && o.reference.kind == SuiteReference::Kind::formula;
  }
  std::array<const Formula*, 4> formulas() const { return {&of, &along, &reference, &where.formula()}; }
  void close(const std::string& why) {
    if (open) out = nothing(why);
    open = false;
  }
  void note(StateTable::Used& used) const {
    for (const Formula* formula : formulas()) note_used(*formula, used);
  }

  void look_at(const StateTable& state) {
    std::vector<Real> values, volumes;
    for (std::size_t i = 0; i < state.size(); ++i) {
      const auto row = state.row(i);
      if (!where.counts(state, i, row.data())) continue;
      values.push_back(of(row.data()));
      volumes.push_back(state.volume(i));
      if (!std::isfinite(values.back()))
        return close(fmt::format("'of' is not finite for a particle at t = {:.6g}", state.t()));
      if (o.kind != ObservationKind::profile) continue;
      volumes_of_profile.push_back(volumes.back());
      out.series.x.push_back(along(row.data()));
      out.series.y.push_back(values.back());
      if (with_formula(o)) out.formula.push_back(reference(row.data()));
      if (!std::isfinite(out.series.x.back())) return close("'along' is not finite for a particle");
    }
    if (o.kind == ObservationKind::profile) return;
    const Real value = reduce(o.reduce, std::move(values), volumes);
    if (!std::isfinite(value)) return close(fmt::format("no particle counts at t = {:.6g}", state.t()));
    out.series.x.push_back(state.t());
    out.series.y.push_back(value);
  }

  void finish() {
    if (!open) return;
    if (o.kind == ObservationKind::particles) {
      out = taken(o, std::move(out.series), window);
    } else if (out.series.size() == 0) {
      close("no particle counts");
    } else {
      if (o.bins > 0) put_in_bins();
      sort_by_x();
      out.found = true;
      if (o.take != "curve") out = taken(o, std::move(out.series), window);
    }
  }
  /// One point for each bin in which there are particles: its middle, and the reduced values; of a reference
  /// formula, too.
  void put_in_bins() {
    const auto [low, high] = std::minmax_element(out.series.x.begin(), out.series.x.end());
    const Real first = *low, width = (*high - *low) / o.bins;
    if (!(width > 0)) return;
    struct Bin {
      std::vector<Real> values, formula, volumes;
    };
    std::vector<Bin> bins(o.bins);
    for (std::size_t i = 0; i < out.series.size(); ++i) {
      Bin& bin = bins[std::min(o.bins - 1, static_cast<int>((out.series.x[i] - first) / width))];
      bin.values.push_back(out.series.y[i]);
      bin.volumes.push_back(volumes_of_profile[i]);
      if (!out.formula.empty()) bin.formula.push_back(out.formula[i]);
    }
    out.series = {};
    out.formula.clear();
    for (int k = 0; k < o.bins; ++k) {
      if (bins[k].values.empty()) continue;
      out.series.x.push_back(first + (k + 0.5) * width);
      out.series.y.push_back(reduce(o.reduce, bins[k].values, bins[k].volumes));
      if (!bins[k].formula.empty()) out.formula.push_back(reduce(o.reduce, bins[k].formula, bins[k].volumes));
    }
  }
  void sort_by_x() {
    std::vector<std::size_t> order(out.series.size());
    std::iota(order.begin(), order.end(), std::size_t(0));
    std::stable_sort(order.begin(), order.end(),
                     [&](std::size_t a, std::size_t b) { return out.series.x[a] < out.series.x[b]; });
    const auto sorted = [&](const std::vector<Real>& from) {
      std::vector<Real> to;
      for (const std::size_t i : order) to.push_back(from[i]);
      return to;
    };
    out.series = {sorted(out.series.x), sorted(out.series.y)};
    if (!out.formula.empty()) out.formula = sorted(out.formula);
  }
};

/// Whether a task needs the state with this index.
bool needs(const ParticleTask& task, const std::vector<StateFiles>& states, std::size_t i) {
  if (!task.open) return false;
  if (task.o.kind == ObservationKind::profile) return task.state == static_cast<int>(i);
  const Real range = states.back().t - states.front().t;
  const Real slack = states.size() > 1 ? 0.25 * range / static_cast<Real>(states.size() - 1) : 0;
  return states[i].t >= task.window.from - slack && states[i].t <= task.window.to + slack;
}

void observe_states(std::vector<ParticleTask>& tasks, const std::vector<StateFiles>& states, bool all_states,
                    std::string& garbage) {
  StateTable::Used used{};
  for (ParticleTask& task : tasks) {
    if (!task.open) continue;
    task.note(used);
    if (task.o.kind != ObservationKind::profile) continue;
    task.state =
        task.window.at ? nearest_state(states, *task.window.at) : static_cast<int>(states.size()) - 1;
    if (task.state < 0) task.close(fmt::format("there is no field state at t = {:.6g}", *task.window.at));
  }
  for (std::size_t i = 0; i < states.size(); ++i) {
    const bool needed = std::any_of(tasks.begin(), tasks.end(),
                                    [&](const ParticleTask& task) { return needs(task, states, i); });
    if (!needed && !all_states) continue;
    Diagnostics faults;
    const StateTable table(states[i], used, all_states, faults);
    if (!faults.ok()) {
      if (garbage.empty()) garbage = first_error(faults);
      for (ParticleTask& task : tasks)
        if (needs(task, states, i)) task.close(first_error(faults));
      continue;
    }
    for (ParticleTask& task : tasks)
      if (needs(task, states, i)) task.look_at(table);
  }
  for (ParticleTask& task : tasks) task.finish();
}

}  // namespace

MeasuredTimes window_of(const SuiteObservation& o, const Variables& variables) {
  constexpr Real infinity = std::numeric_limits<Real>::infinity();
  MeasuredTimes out{-infinity, infinity, {}, {}};
  if (o.from) out.from = constant_value(*o.from, variables, out.why);
  if (o.to) out.to = constant_value(*o.to, variables, out.why);
  if (o.at) out.at = constant_value(*o.at, variables, out.why);
  return out;
}

Measurements observe_run(const SuiteCase& definition, const Variables& variables,
                         const std::filesystem::path& folder, bool all_states) {
  Measurements out;
  out.observations.resize(definition.observations.size());
  Diagnostics faults;
  const auto file = HistoryFile::open(folder / "history.h5", faults);
  std::vector<ParticleTask> tasks;
  tasks.reserve(out.observations.size());
  for (std::size_t k = 0; k < out.observations.size(); ++k) {
    const SuiteObservation& o = definition.observations[k];
    if (o.kind != ObservationKind::history)
      tasks.emplace_back(o, out.observations[k], variables);
    else if (file)
      out.observations[k] = HistoryObserver(*file, variables).observe(o);
    else
      out.observations[k] = nothing(first_error(faults));
  }
  if (file) out.garbage = HistoryObserver(*file, variables).garbage();
  if (tasks.empty() && !all_states) return out;
  Diagnostics missing;
  const std::vector<StateFiles> states = read_states(folder, missing);
  if (states.empty())
    for (ParticleTask& task : tasks) task.close(first_error(missing));
  else
    observe_states(tasks, states, all_states, out.garbage);
  return out;
}

}  // namespace courant
