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

void Histories::write(const Sample& sample, bool always) {
  if (!first_potential_) first_potential_ = sample.energy.potential;
  for (Ascii& file : files_) {
    const bool due = file.schedule.take(sample.t, sample.dt) || always;
    if (!due || file.last == sample.t) continue;
    file.last = sample.t;
    file.file.write(file.text ? file.text(sample) : glstat_text(sample, *first_potential_));
  }
  const bool due = h5_schedule_.take(sample.t, sample.dt) || always;
  if (!h5_ || !due || h5_last_ == sample.t) return;
  h5_last_ = sample.t;
  h5_->record(sample);
}

void Histories::finish() {
  if (h5_) h5_->flush();
}

}  // namespace courant
