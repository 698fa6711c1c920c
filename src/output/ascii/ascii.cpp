#include "output/ascii/ascii.hpp"

#include <fmt/chrono.h>
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <ctime>
#include <fstream>
#include <iterator>
#include <stdexcept>
#include <utility>

#include "base/version.hpp"
#include "output/result_names.hpp"

namespace courant {

std::string ascii_header(const std::string& title, const std::string& date) {
  return fmt::format(" {:<72.72}\n                         courant {:<34}date {}\n", title, COURANT_VERSION,
                     date);
}

void HistoryRequests::ask(const std::string& name, OutputSchedule schedule, int binary) {
  for (const TextHistory& file : text_histories())
    if (file.name == name) return files.push_back({file, std::move(schedule), binary});
  throw std::out_of_range("no history " + name);
}

namespace {

std::string gauge_head(const GaugeLayout& layout) {
  std::string out = "time";
  for (const GaugeLayout::Column& column : layout.columns)
    for (int k = 0; k < column.components; ++k)
      out += fmt::format(",{}{}", column.name, column.components == 1 ? "" : fmt::format(".{}", "xyz"[k]));
  return out + "\n";
}

constexpr std::size_t most_waiting = 1 << 16;        // bytes of a gauge
constexpr std::chrono::seconds longest_waiting(10);  // of rows of gauges

/// `from`: where it is looked for first, as gauges are written in the order of the sample.
const GaugeSample& gauge_of(const Sample& sample, std::size_t number, std::size_t& from) {
  const std::size_t n = sample.gauges.size();
  for (std::size_t k = 0; k < n; ++k)
    if (const GaugeSample& one = sample.gauges[(from + k) % n]; one.gauge == number) {
      from += k + 1;
      return one;
    }
  throw std::out_of_range(fmt::format("no values of gauge {}", number));
}

/// The text of "{:.9g}" in half its time: numbers of gauges are most of what their files cost.
void add_number(Real value, std::string& to) {
  constexpr int digits = 9, longest = 32;
  std::array<char, longest> text;
  const auto end = std::to_chars(text.begin(), text.end(), value, std::chars_format::general, digits).ptr;
  to.append(text.begin(), end);
}

void add_row(const Sample& sample, const std::vector<Real>& values, std::string& to) {
  add_number(sample.t, to);
  for (const Real value : values) to += ',', add_number(value, to);
  to += '\n';
}

}  // namespace

void HistoryRequests::ask_gauge(std::size_t number, GaugeLayout layout, Real interval) {
  Request request{.file = {.name = fmt::format("{}/{}.csv", result_names::gauges, layout.name)},
                  .schedule = OutputSchedule(interval),
                  .gauge = number,
                  .layout = std::move(layout)};
  files.push_back(std::move(request));
}

namespace {

/// One that an earlier run left and this one does not write would pass for this one's. Others' files are
/// theirs.
void remove_ours(const std::filesystem::path& file) {
  std::ifstream stream(file);
  std::string line;
  std::error_code ignored;  // a file that cannot be removed does no harm to this run
  if (std::getline(stream, line) && std::getline(stream, line) &&
      line.starts_with("                         courant "))
    std::filesystem::remove(file, ignored);
}

}  // namespace

Histories::Histories(const std::filesystem::path& dir, HistoryRequests requests,
                     const HistoryPositions* resume)
    : dir_(dir) {
  const std::string date = fmt::format("{:%m/%d/%Y}", fmt::localtime(std::time(nullptr)));
  const std::string header = ascii_header(requests.title, date);
  make_folder(dir);
  std::vector<std::string> unused;
  for (const TextHistory& file : text_histories())
    if (std::none_of(requests.files.begin(), requests.files.end(),
                     [&](const auto& request) { return request.file.name == file.name; }))
      unused.push_back(file.name);
  for (HistoryRequests::Request& request : requests.files) {
    const std::string& name = request.file.name;
    const bool binout = (request.binary == 2 || request.binary == 3) && request.file.numbers;
    const bool text = request.binary != 2 || !request.file.numbers;
    if (!request.schedule.is_wanted() || !text) unused.push_back(name);
    if (!request.schedule.is_wanted()) continue;
    files_.push_back(
        {request.schedule,
         name,
         {},
         binout ? request.file.numbers : nullptr,
         binout && request.file.legend ? request.file.legend(requests.titles) : std::vector<Legend>(),
         std::move(request.file.text),
         request.gauge,
         request.layout,
         {}});
    if (!text) continue;
    if (request.gauge) make_folder(dir / result_names::gauges);
    const bool goes_on = resume && resume->bytes.contains(name);
    TextFile& file = files_.back().file.emplace(dir / name, goes_on);
    if (goes_on) {
      const auto bytes = static_cast<std::uintmax_t>(resume->bytes.at(name));
      if (file.size() < bytes) lost_.push_back(fmt::format("{} has lost its end before the restart", name));
      file.cut(bytes);
    }
    if (file.size() == 0 && request.gauge)
      file.write(gauge_head(request.layout));
    else if (file.size() == 0)
      file.write(header + history_head(request.file, requests.titles));
  }
  if (!resume)
    for (const std::string& name : unused) remove_ours(dir / name);
  if (std::any_of(files_.begin(), files_.end(), [](const Ascii& file) { return file.numbers != nullptr; }))
    open_binout(requests.title, date, resume);
  choose_h5_times(requests.h5);
  const auto is_gauge = [](const Ascii& file) { return file.gauge.has_value(); };
  if (!h5_schedules_.empty() || std::any_of(files_.begin(), files_.end(), is_gauge))
    h5_.emplace(result_path(dir, result_names::history));
  if (!resume) return;
  set_first_potential(*resume);
  const auto rows = static_cast<std::size_t>(resume->rows);
  if (h5_ && (rows > 0 || !resume->gauge_rows.empty()) && h5_->resume(rows, resume->gauge_rows) < rows)
    lost_.push_back("history.h5 has lost samples before the restart");
}

void Histories::open_binout(const std::string& title, const std::string& date,
                            const HistoryPositions* resume) {
  const std::filesystem::path file = result_path(dir_, result_names::binout);
  std::optional<std::uintmax_t> bytes;
  std::map<std::string, std::int64_t> states;
  if (resume && resume->binout_bytes > 0) {
    std::error_code missing;
    const std::uintmax_t size = std::filesystem::file_size(file, missing);
    bytes = static_cast<std::uintmax_t>(resume->binout_bytes), states = resume->binout_states;
    if (missing || size < *bytes) {
      lost_.push_back("binout0000 has lost its end before the restart: it starts at the restart");
      bytes.reset(), states.clear();
    }
  }
  binout_.emplace(file, title, date, std::move(states), bytes);
}

// What is due next follows from the time; whether the last sample was at this very time does not.
void Histories::keep(Archive& archive, Real t) {
  const Archive::Group inside(archive, "histories");
  std::map<std::string, Real> last;
  for (const Ascii& file : files_) last[file.name] = file.last;
  last["history.h5"] = h5_last_;
  archive("last", last);
  if (!archive.loading()) return;
  const auto take_over = [&](const std::string& name, Real& to) {
    if (last.contains(name)) to = last[name];
  };
  for (Ascii& file : files_) {
    take_over(file.name, file.last);
    file.schedule.skip_to(t);
  }
  take_over("history.h5", h5_last_);
  for (OutputSchedule& schedule : h5_schedules_) schedule.skip_to(t);
}

HistoryPositions Histories::positions() const {
  HistoryPositions out;
  for (const Ascii& file : files_)
    if (file.file) out.bytes[file.name] = static_cast<std::int64_t>(file.file->size());
  if (binout_)
    out.binout_states = binout_->states(), out.binout_bytes = static_cast<std::int64_t>(binout_->size());
  if (h5_) out.rows = static_cast<std::int64_t>(h5_->rows()), out.gauge_rows = h5_->gauge_rows();
  if (first_potential_) out.first_potential = {*first_potential_};
  return out;
}

void Histories::choose_h5_times(const OutputSchedule& wanted) {
  if (wanted.is_wanted()) {
    h5_schedules_ = {wanted};
    return;
  }
  Real shortest = 0;
  for (const Ascii& file : files_) {
    if (file.gauge) continue;
    const Real interval = file.schedule.interval();
    if (interval <= 0)
      h5_schedules_.push_back(file.schedule);
    else if (shortest == 0 || interval < shortest)
      shortest = interval;
  }
  if (shortest > 0) h5_schedules_.emplace_back(shortest);
}

bool Histories::is_due(Real t, Real dt) const {
  const auto due = [&](const OutputSchedule& schedule) { return schedule.is_due(t, dt); };
  return std::any_of(h5_schedules_.begin(), h5_schedules_.end(), due) ||
         std::any_of(files_.begin(), files_.end(), [&](const Ascii& file) { return due(file.schedule); });
}

Histories::Due Histories::take(Real t, Real dt, bool always) {
  Due due;
  const auto add = [&](bool is_due, Real& last) {
    due.push_back((is_due || always) && last != t);
    if (due.back()) last = t;
  };
  for (Ascii& file : files_) add(file.schedule.take(t, dt), file.last);
  bool h5_is_due = false;
  for (OutputSchedule& schedule : h5_schedules_) h5_is_due |= schedule.take(t, dt);
  add(h5_is_due, h5_last_);
  return due;
}

bool Histories::needs_whole_sample(const Due& due) const {
  if (due.back()) return true;
  for (std::size_t k = 0; k < files_.size(); ++k)
    if (due[k] && !files_[k].gauge) return true;
  return false;
}

std::vector<std::size_t> Histories::due_gauges(const Due& due) const {
  std::vector<std::size_t> out;
  for (std::size_t k = 0; k < files_.size(); ++k)
    if (due[k] && files_[k].gauge) out.push_back(*files_[k].gauge);
  return out;
}

void Histories::write(const Sample& sample, const Due& due) {
  if (!first_potential_ && needs_whole_sample(due)) first_potential_ = sample.energy.potential;
  std::size_t next_gauge = 0;
  for (std::size_t i = 0; i < files_.size(); ++i)
    if (due[i] && files_[i].gauge)
      write_gauge(files_[i], sample, next_gauge);
    else if (due[i])
      write(files_[i], sample);
  if (h5_ && due.back()) h5_->record(sample);
  if (std::chrono::steady_clock::now() - last_waiting_ >= longest_waiting) write_all_waiting();
}

void Histories::write(Ascii& to, const Sample& sample) {
  if (to.file) to.file->write(to.text(sample, first_potential_.value_or(0)));
  if (!to.numbers) return;
  HistoryNumbers numbers;
  to.numbers(sample, first_potential_.value_or(0), numbers);
  binout_->write(to.name, sample.t, sample.cycle, numbers, to.legend);
}

void Histories::write_gauge(Ascii& to, const Sample& sample, std::size_t& next) {
  const std::vector<Real>& values = gauge_of(sample, *to.gauge, next).values;
  add_row(sample, values, to.waiting);
  if (to.waiting.size() >= most_waiting) write_waiting(to);
  h5_->record_gauge(to.layout, sample.t, values);
}

// Many gauges at short intervals would else spend more time in calls of the system than in their sums.
void Histories::write_waiting(Ascii& to) {
  if (to.waiting.empty()) return;
  to.file->write(to.waiting);
  to.waiting.clear();
}

void Histories::write_all_waiting() {
  for (Ascii& file : files_) write_waiting(file);
  last_waiting_ = std::chrono::steady_clock::now();
}

void Histories::finish() {
  write_all_waiting();
  if (h5_) h5_->flush();
}

std::int64_t Histories::bytes() const {
  std::int64_t sum = 0;
  const auto add = [&](const std::string& name) {
    std::error_code none;  // a file that was not begun
    const std::uintmax_t size = std::filesystem::file_size(dir_ / name, none);
    if (!none) sum += static_cast<std::int64_t>(size);
  };
  for (const Ascii& file : files_) add(file.name);
  if (h5_) add("history.h5");
  if (binout_) add(result_names::binout);
  return sum;
}

}  // namespace courant
