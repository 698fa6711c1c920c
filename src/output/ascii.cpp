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

Histories::Histories(const std::filesystem::path& dir, HistoryRequests requests) {
  const std::string header =
      ascii_header(requests.title, fmt::format("{:%m/%d/%Y}", fmt::localtime(std::time(nullptr))));
  const auto open = [&](const char* name, Real interval, const std::string& legend,
                        std::string (*text)(const Sample&)) {
    if (interval <= 0) return;
    files_.push_back({OutputSchedule(interval), TextFile(dir / name), text});
    files_.back().file.write(header + legend);
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
