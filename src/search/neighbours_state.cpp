// How neighbour lists outlive a run: by the places at which they were built.
#include "search/neighbours.hpp"

#include <algorithm>

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

void Neighbours::restore(World& world, const std::vector<std::pair<std::string, Keeper*>>& keepers) {
  if (rebuilds_ == 0) return;  // saved before the first step: the lists are still to be built
  Particles& p = world.particles;
  Array<Real>* const built[4] = {&x_built_, &y_built_, &z_built_, &h_built_};
  find_moving_nodes(world);
  exchange(p, built);
  count_cells(world);
  if (images_) build_images(world);
  build_lists(world);
  for (const auto& [name, keeper] : keepers) keeper->relist(world);
  exchange(p, built);
}

/// Where the particles of each cell start, as sorting left them.
void Neighbours::count_cells(const World& world) {
  const Particles& p = world.particles;
  const Index cells = grid_.total();
  const auto count = [&](Index begin, Index end) {
    std::vector<Index> start(cells + 1, 0);
    for (Index i = begin; i < end; ++i)
      ++start[grid_.cell_of(p.x.data(0)[i], p.x.data(1)[i], p.x.data(2)[i]) + 1];
    start[0] = begin;
    for (Index c = 0; c < cells; ++c) start[c + 1] += start[c];
    return start;
  };
  active_start_ = count(0, p.active);
  rim_start_ = count(p.active, p.moving);
}

}  // namespace courant
