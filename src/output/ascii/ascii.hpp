#pragma once
// All histories of a run: LS-DYNA's ASCII files, binout, history.h5.
#include <chrono>
#include <filesystem>
#include <functional>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "output/ascii/text_history.hpp"
#include "output/binout/binout.hpp"
#include "output/file.hpp"
#include "output/history.hpp"
#include "output/output_schedule.hpp"
#include "output/sample.hpp"
#include "state/saved_state.hpp"

namespace courant {

/// Head of each file: title line, then the program and the date.
std::string ascii_header(const std::string& title, const std::string& date);
/// What a run writes, and when.
struct HistoryRequests {
  struct Request {
    TextHistory file{};
    OutputSchedule schedule{};           ///< not wanted: an older file of a run is removed
    int binary = 1;                      ///< BINARY: 2 in binout, 3 in both, else text
    std::optional<std::size_t> gauge{};  ///< number in Sample::gauges; none: of a whole sample
    GaugeLayout layout{};                ///< of a gauge
  };
  std::vector<Request> files{};
  /// history.h5; where it is not wanted: with the file of the shortest interval, and with those that a curve
  /// times; none if there is no other.
  OutputSchedule h5{};
  std::string title{};
  HistoryTitles titles{};
  /// Asks for one of text_histories(). Throws std::out_of_range where there is none of that name.
  void ask(const std::string& name, OutputSchedule schedule, int binary = 1);
  /// Gauge of a number, from 0: a file of columns, and a group of history.h5 with its own times.
  void ask_gauge(std::size_t number, GaugeLayout layout, Real interval);
};

/// How far the files of a run have come: what a restart cuts them back to.
struct HistoryPositions {
  std::map<std::string, std::int64_t> bytes;            ///< of each text file
  std::int64_t rows = 0;                                ///< of history.h5
  std::map<std::string, std::int64_t> gauge_rows{};     ///< of each gauge there
  std::vector<Real> first_potential;                    ///< none before the first sample [ML2/T2]
  std::map<std::string, std::int64_t> binout_states{};  ///< of each history in binout
  std::int64_t binout_bytes = 0;
  void keep(Archive& archive) {
    archive("bytes", bytes);
    archive("rows", rows);
    if (!archive.loading() || archive.has("gauge_rows")) archive("gauge_rows", gauge_rows);
    archive("first_potential", first_potential);
    archive("binout_states", binout_states);
    archive("binout_bytes", binout_bytes);
  }
};

/// All histories of a run, each at its own interval.
class Histories {
 public:
  /// Opens the requested files: empty ones, or those of an earlier run, cut back to where they were then.
  /// Throws OutputError.
  Histories(const std::filesystem::path& dir, HistoryRequests requests,
            const HistoryPositions* resume = nullptr);
  /// What of the earlier run's files is missing, a line each.
  const std::vector<std::string>& lost() const { return lost_; }
  /// Times of the last writes. `t`: time at which the run continues [T]
  void keep(Archive& archive, Real t);
  /// How long the files are, with what `finish` would still write. Belongs to the thread that writes.
  HistoryPositions positions() const;
  void set_first_potential(const HistoryPositions& before) {
    if (!before.first_potential.empty()) first_potential_ = before.first_potential[0];
  }

  /// Whether any file is due at the cycle that goes from t to t + dt: only then a Sample need be filled.
  bool is_due(Real t, Real dt) const;
  /// Which files a sample goes to: one entry for each ASCII file, the last one for history.h5.
  using Due = std::vector<bool>;
  /// The files that are due at the cycle that goes from t to t + dt, with `always` (the end of the run) all
  /// that have no sample of time t yet. From here on they count as written.
  Due take(Real t, Real dt, bool always = false);
  /// Whether more than gauges are due.
  bool needs_whole_sample(const Due& due) const;
  /// Numbers of the gauges that are due.
  std::vector<std::size_t> due_gauges(const Due& due) const;
  /// Writes the sample to those files. Touches nothing that `is_due` and `take` use: they may go on while
  /// another thread writes. Throws OutputError.
  void write(const Sample& sample, const Due& due);
  void write(const Sample& sample, bool always = false) { write(sample, take(sample.t, sample.dt, always)); }
  /// Writes what is buffered. Throws OutputError.
  void finish();
  std::int64_t bytes() const;  ///< of all files, after `finish`

 private:
  void choose_h5_times(const OutputSchedule& wanted);
  void open_binout(const std::string& title, const std::string& date, const HistoryPositions* resume);

  struct Ascii {
    OutputSchedule schedule;
    std::string name;
    std::optional<TextFile> file;                                       // none: in binout alone
    std::function<void(const Sample&, Real, HistoryNumbers&)> numbers;  // for binout; none: not there
    std::vector<Legend> legend;                                         // of binout
    std::function<std::string(const Sample&, Real)> text;
    std::optional<std::size_t> gauge;
    GaugeLayout layout;
    std::string waiting;  // rows of a gauge that are not in its file yet
    Real last = -1;       // time of the last state
  };
  void write(Ascii& to, const Sample& sample);
  void write_gauge(Ascii& to, const Sample& sample, std::size_t& next);
  void write_waiting(Ascii& to);
  void write_all_waiting();

  std::filesystem::path dir_;
  std::vector<Ascii> files_;
  std::vector<OutputSchedule> h5_schedules_;  // any of them
  std::optional<History> h5_;
  std::optional<Binout> binout_;
  Real h5_last_ = -1;
  std::optional<Real> first_potential_;
  std::vector<std::string> lost_;
  std::chrono::steady_clock::time_point last_waiting_ = std::chrono::steady_clock::now();
};

}  // namespace courant
