#include "post/run_analyses.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "output/file.hpp"
#include "parallel/job_queue.hpp"

namespace courant {
namespace {

struct Loaded {
  std::optional<ParticleFrame> frame;
  Diagnostics diagnostics;
};

}  // namespace

bool stream_states(const std::vector<StateFiles>& states, const std::vector<StateReader>& readers,
                   const std::vector<ParticleArray>& arrays,
                   const std::function<void(const std::string&)>& progress, Diagnostics& diagnostics) {
  std::vector<std::size_t> wanted;
  const auto any = [&](std::size_t s, std::function<bool(std::size_t)> StateReader::*asks) {
    return std::any_of(readers.begin(), readers.end(),
                       [&](const StateReader& r) { return (r.*asks) && (r.*asks)(s); });
  };
  for (std::size_t s = 0; s < states.size(); ++s)
    if (any(s, &StateReader::wants)) wanted.push_back(s);

  Loaded next;
  JobQueue queue(1);
  const auto load = [&](std::size_t s) {
    const bool speed = any(s, &StateReader::wants_speed);
    queue.submit([&, s, speed] { next.frame = read_particles(states[s], speed, arrays, next.diagnostics); });
  };
  if (!wanted.empty()) load(wanted.front());
  for (std::size_t k = 0; k < wanted.size(); ++k) {
    queue.wait();
    const Loaded now = std::exchange(next, {});
    for (const Diagnostic& message : now.diagnostics.all()) diagnostics.add(message);
    if (!now.frame) return false;
    if (k + 1 < wanted.size()) load(wanted[k + 1]);
    for (const StateReader& reader : readers)
      if (reader.wants(wanted[k])) reader.take(wanted[k], *now.frame);
    if (progress && (k % 16 == 0 || k + 1 == wanted.size()))
      progress(fmt::format("state {} of {}, t = {:.4g}, {:.0f} %", k + 1, wanted.size(), now.frame->t,
                           100.0 * static_cast<double>(k + 1) / static_cast<double>(wanted.size())));
  }
  return true;
}

StateReader analysis_reader(const std::vector<std::unique_ptr<Analysis>>& analyses,
                            const std::vector<StateFiles>& states, const std::filesystem::path& folder) {
  const Real slack = states.size() > 1
                         ? 0.25 * (states.back().t - states.front().t) / static_cast<Real>(states.size() - 1)
                         : 0;
  StateReader out;
  out.wants = [&analyses, &states, slack](std::size_t s) {
    return std::any_of(analyses.begin(), analyses.end(),
                       [&](const auto& a) { return a->needs_states() && a->looks_at(states[s].t, slack); });
  };
  out.take = [&analyses, &folder, slack](std::size_t, const ParticleFrame& frame) {
    const PostState state(frame, slack, folder);
    for (const auto& analysis : analyses)
      if (analysis->needs_states() && analysis->looks_at(frame.t, slack)) analysis->take(state);
  };
  return out;
}

void finish_analyses(const std::vector<std::unique_ptr<Analysis>>& analyses, const std::filesystem::path& dir,
                     const std::filesystem::path& folder, const std::function<void(std::string_view)>& say,
                     Diagnostics& diagnostics) {
  make_folder(folder);
  std::vector<PostTable> all;
  for (const auto& analysis : analyses) {
    analysis->finish(analyses, dir, diagnostics);
    const PostResult& result = analysis->result();
    for (const PostTable& table : result.tables) {
      write_file(folder / (table.name + ".csv"), csv_text(table));
      all.push_back(table);
    }
    for (const PostImage& image : result.images) write_vti(folder / (image.name + ".vti"), image);
    say(fmt::format("{} ({})\n{}", analysis->name(), analysis->kind(), result.text));
  }
  write_tables_h5(folder / "tables.h5", all);
}

}  // namespace courant
