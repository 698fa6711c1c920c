// How neighbour lists outlive a run: by the places at which they were built.
#include "search/neighbours.hpp"

#include <algorithm>

#include "base/restart_error.hpp"
#include "parallel/counting_sort.hpp"

namespace courant {

void Neighbours::keep(Archive& archive) {
  const Archive::Group inside(archive, "neighbours");
  archive("skin", skin_);
  archive("built", built_);
  archive("built_cycle", built_cycle_);
  archive("h_max", h_max_);
  archive("h_min", h_min_);
  archive("rebuilds", rebuilds_);
  archive("due", due_);
  archive("first_due", first_due_);
  archive("waking_time", waking_time_);
  archive("h_queued", h_queued_);
  archive("gone", gone_);
  archive("x_built", x_built_);
  archive("y_built", y_built_);
  archive("z_built", z_built_);
  archive("h_built", h_built_);
  archive("nodes_built", nodes_built_);
  grid_.keep(archive);
}

/// Puts moving particles where they were when lists were built, or back; h alike.
static void exchange(Particles& p, Array<Real>* const built[4]) {
  Real* const now[4] = {p.x.data(0), p.x.data(1), p.x.data(2), p.h.data()};
  for (int k = 0; k < 4; ++k) std::swap_ranges(built[k]->begin(), built[k]->end(), now[k]);
}

void Neighbours::restore(World& world,
                         const std::vector<std::pair<std::string, Restartable*>>& restartables) {
  if (rebuilds_ == 0) return;  // saved before the first step: the lists are still to be built
  Particles& p = world.particles;
  Array<Real>* const built[4] = {&x_built_, &y_built_, &z_built_, &h_built_};
  for (const Array<Real>* places : built)
    if (places->size() > static_cast<std::size_t>(p.size()))
      throw RestartError("the saved state does not fit this run: its neighbour lists are of other particles");
  find_moving_nodes(world);
  exchange(p, built);
  count_cells(world);
  if (ghosts_) build_ghosts(world);
  build_lists(world);
  for (const auto& [name, restartable] : restartables) restartable->relist(world);
  exchange(p, built);
}

/// Where the particles of each cell start, as sorting left them.
void Neighbours::count_cells(const World& world) {
  const Particles& p = world.particles;
  const Index cells = grid_.total();
  key_.resize(p.moving);
  find_cells(p, 0, p.moving, key_.data());
  for (Index i = p.active; i < p.moving; ++i) key_[i] += cells;
  counting_sort(key_, p.moving > p.active ? 2 * cells : cells, starts_, order_);
  take_cell_starts(cells);
}

}  // namespace courant
