#include "app/run/state_files.hpp"

#include <fmt/format.h>

#include "app/run/field_options.hpp"

namespace courant {
namespace {

D3plotModel* d3plot_of(World& world) {
  const auto found = world.passes.all<D3plotModel>();
  return found.empty() ? nullptr : found.front();
}

}  // namespace

StateFiles::StateFiles(const std::filesystem::path& dir, Simulation& simulation)
    : dir_(dir),
      model_(d3plot_of(simulation.world())),
      vtk_(dir, field_options(simulation.model(), simulation.sph().hide_inactive)) {
  if (model_)
    d3plot_.emplace(dir, model_->extent().bits, model_->state_bytes(simulation.world()), model_->most_bytes);
}

StateFiles::State StateFiles::take(World& world, const Clock& clock, int number) {
  State out{number};
  if (with_vtk()) out.vtk = vtk_.take(world, clock.t, number);
  if (!model_) return out;
  if (!has_head_) out.d3plot_head = model_->head(world);
  has_head_ = true;
  out.d3plot = model_->state(world, clock);
  return out;
}

void StateFiles::write(State state) {
  ++states_;
  if (state.vtk) vtk_.write(std::move(*state.vtk));
  if (!d3plot_) return;
  if (first_ == none)
    d3plot_->begin(state.d3plot_head), first_ = state.number;
  else if (!state.d3plot_head.empty() && !d3plot_->has_head())  // the first one behind a restart
    d3plot_->write_head(state.d3plot_head);
  d3plot_->write(state.number - first_, state.d3plot);
}

void StateFiles::keep(Archive& archive) {
  vtk_.keep(archive);
  const Archive::Group inside(archive, "d3plot");
  std::int64_t state_bytes = d3plot_ ? static_cast<std::int64_t>(d3plot_->state_bytes()) : 0;
  const std::int64_t now = state_bytes;
  archive("first", first_);
  archive("states", states_);
  archive("state_bytes", state_bytes);
  if (archive.loading() && d3plot_ && first_ != none && state_bytes != now)
    throw OutputError(dir_ / "d3plot",
                      fmt::format("its states have {} bytes, those of this deck {}", state_bytes, now));
}

std::string StateFiles::cut(int number) {
  if (with_vtk()) vtk_.cut(number);
  if (!d3plot_ || first_ == none) return "";
  const bool whole = d3plot_->has_states(number - first_);
  const int next = d3plot_->next_whole(number - first_);
  first_ = number - next;
  d3plot_->cut(next);
  return !whole                ? "files of d3plot are missing: the states in them are lost"
         : d3plot_->has_head() ? ""
                               : "the file d3plot is missing: it is written again";
}

}  // namespace courant
