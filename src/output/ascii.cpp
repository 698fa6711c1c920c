#include "output/ascii.hpp"

#include <fmt/chrono.h>
#include <fmt/format.h>

#include <ctime>

namespace courant {

std::string ascii_header(const std::string& title, const std::string& date) {
  return fmt::format(" {:<72.72}\n                         courant {:<34}date {}\n", title, COURANT_VERSION,
                     date);
}

std::string ascii_legend(const std::vector<Legend>& entries) {
  std::string out = "\n{BEGIN LEGEND}\n Entity #        Title\n";
  for (const Legend& e : entries) out += fmt::format("{:9d}     {:<70.70}\n", e.id, e.title);
  return out + "{END LEGEND}\n";
}

Histories::Histories(const std::filesystem::path& dir, HistoryRequests requests,
                     const HistoryPositions* resume) {
  const std::string header =
      ascii_header(requests.title, fmt::format("{:%m/%d/%Y}", fmt::localtime(std::time(nullptr))));
  const auto open = [&](const char* name, Real interval, const std::string& legend,
                        std::string (*text)(const Sample&)) {
    if (interval <= 0) return;
    const bool goes_on = resume && resume->bytes.contains(name);
    files_.push_back({name, OutputSchedule(interval), TextFile(dir / name, goes_on), text});
    TextFile& file = files_.back().file;
    if (goes_on) {
      const auto bytes = static_cast<std::uintmax_t>(resume->bytes.at(name));
      if (file.size() < bytes) lost_.push_back(fmt::format("{} has lost its end before the restart", name));
      file.cut(bytes);
    }
    if (file.size() == 0) file.write(header + legend);
  };
  make_folder(dir);
  open("glstat", requests.glstat, "", nullptr);
  open("matsum", requests.matsum, ascii_legend(requests.parts), matsum_text);
  open("rcforc", requests.rcforc, ascii_legend(requests.contacts), rcforc_text);
  open("sphout", requests.sphout, "", sphout_text);

  Real interval = requests.h5;
  for (const Ascii& file : files_)
    if (requests.h5 <= 0 && (interval <= 0 || file.schedule.interval() < interval))
      interval = file.schedule.interval();
  h5_schedule_ = OutputSchedule(interval);
  if (interval > 0) h5_.emplace(dir / "history.h5");
  if (!resume) return;
  set_first_potential(*resume);
  const auto rows = static_cast<std::size_t>(resume->rows);
  if (h5_ && rows > 0 && h5_->resume(rows) < rows)
    lost_.push_back("history.h5 has lost samples before the restart");
}

void Histories::keep(Archive& archive, Real t) {
  const Archive::Group inside(archive, "histories");
  std::map<std::string, Real> interval, count, last;
  const auto each = [&](const auto& visit) {
    for (Ascii& file : files_) visit(file.name, file.schedule, file.last);
    visit("history.h5", h5_schedule_, h5_last_);
  };
  each([&](const std::string& name, const OutputSchedule& schedule, Real last_time) {
    interval[name] = schedule.interval(), count[name] = schedule.count(), last[name] = last_time;
  });
  archive("interval", interval);
  archive("count", count);
  archive("last", last);
  if (!archive.loading()) return;
  each([&](const std::string& name, OutputSchedule& schedule, Real& last_time) {
    if (interval.contains(name) && interval[name] == schedule.interval()) {
      schedule.set_count(count[name]);
      last_time = last[name];
    } else {
      schedule.skip_to(t);
    }
  });
}

HistoryPositions Histories::positions() {
  HistoryPositions out;
  for (const Ascii& file : files_) out.bytes[file.name] = static_cast<std::int64_t>(file.file.size());
  if (h5_) {
    h5_->flush();
    out.rows = static_cast<std::int64_t>(h5_->rows());
  }
  if (first_potential_) out.first_potential = {*first_potential_};
  return out;
}

bool Histories::is_due(Real t, Real dt) const {
  if (h5_schedule_.is_due(t, dt)) return true;
  for (const Ascii& file : files_)
    if (file.schedule.is_due(t, dt)) return true;
  return false;
}

Histories::Due Histories::take(Real t, Real dt, bool always) {
  Due due;
  const auto add = [&](OutputSchedule& schedule, Real& last) {
    due.push_back((schedule.take(t, dt) || always) && last != t);
    if (due.back()) last = t;
  };
  for (Ascii& file : files_) add(file.schedule, file.last);
  add(h5_schedule_, h5_last_);
  return due;
}

void Histories::write(const Sample& sample, const Due& due) {
  if (!first_potential_) first_potential_ = sample.energy.potential;
  for (std::size_t i = 0; i < files_.size(); ++i)
    if (due[i])
      files_[i].file.write(files_[i].text ? files_[i].text(sample) : glstat_text(sample, *first_potential_));
  if (h5_ && due.back()) h5_->record(sample);
}

void Histories::finish() {
  if (h5_) h5_->flush();
}

}  // namespace courant
