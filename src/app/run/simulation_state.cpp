// What a restart file holds of a simulation.
#include "app/run/simulation.hpp"
#include "state/restartable.hpp"

namespace courant {

void Simulation::keep(Archive& archive) {
  const Archive::Group inside(archive, "state");
  keep_clock(clock_, archive);
  keep_world(world_, archive);
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
}

}  // namespace courant
