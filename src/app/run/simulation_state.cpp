// What a restart file holds of a simulation.
#include "app/run/simulation.hpp"
#include "state/restartable.hpp"

namespace courant {

void Simulation::keep(Archive& archive) {
  const Archive::Group inside(archive, "state");
  keep_clock(clock_, archive);
  const bool more_wait = keep_world(world_, archive);
  auto restartables = restartables_of(world_);
  restartables.emplace_back("guard", guard_.get());
  restartables.emplace_back("stepper", stepper_.get());
  if (lists()) lists()->keep(archive);
  {
    const Archive::Group passes(archive, "passes");
    for (const auto& [name, restartable] : restartables) {
      const Archive::Group pass(archive, name);
      restartable->keep(archive);
    }
  }
  if (!archive.loading()) return;
  archive.stop_for_leftovers();
  if (lists()) lists()->restore(world_, restartables);
  for (const auto& [name, restartable] : restartables) restartable->loaded(world_);
  for (Exchanger* e : world_.passes.all<Exchanger>())
    e->exchange_all(world_);  // what `loaded` made anew, too
  if (!more_wait) return;
  lists()->force_refresh();
  // lists that are built anew now, earlier than in that run, put sums in another order
  changes_.push_back(
      "more particles wait in front of inlets than in the run so far: the last bits of what follows may "
      "differ "
      "from those of a run that had them from its start");
}

}  // namespace courant
