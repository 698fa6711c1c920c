#include "pair_loops.hpp"

#include <limits>

#include "measure.hpp"
#include "sph/core/pair_passes.hpp"

namespace courant::benchmarks {

PairLoopsAlone::PairLoopsAlone(Simulation& s)
    : s_(s),
      neighbours_(std::make_shared<Neighbours>(s.neighbours().skin(), s.neighbours().region(),
                                               s.neighbours().support())) {
  neighbours_->cut_tasks();
  neighbours_->refresh(s.world(), s.clock());
}

double PairLoopsAlone::entries() const {
  const Particles& p = s_.world().particles;
  return entries_worked_on(p, *neighbours_, Gradients::again) * Neighbours::lanes / p.active;
}

PairTimes PairLoopsAlone::measure(bool kept, int threads, int repeats) {
  World& world = s_.world();
  const std::int64_t most_kept = kept ? std::numeric_limits<std::int64_t>::max() : -1;
  const auto geometry = std::make_shared<PairGeometry>(neighbours_, s_.sph().uniform_h, most_kept);
  const auto volumes = make_pair_volumes(world);
  const PairPasses pairs = make_plain_passes(s_.sph(), world, geometry, volumes);
  const Index n = world.particles.active;
  set_threads(threads);
  neighbours_->share_blocks(world);
  const Shares& shares = world.shares;
  const auto take = [&](BlockPass& pass) {
    pass.start(world, s_.clock());
    on_threads(shares.threads(), [&](int t) {
      for (Index b = shares.first[t]; b < shares.first[t + 1]; ++b)
        pass.block(world, s_.clock(), b * block_size, std::min(n, (b + 1) * block_size));
    });
    pass.finish(world, s_.clock());
  };
  const auto nanoseconds = [&](const auto& passes) {
    const double start = PassTimer::now();
    for (const auto& pass : passes) take(*pass);
    return 1e9 * (PassTimer::now() - start) / n;
  };
  PairTimes best{std::numeric_limits<double>::infinity(), std::numeric_limits<double>::infinity()};
  for (int r = 0; r < repeats + 1; ++r) {
    world.particles.f.fill(0);
    const double rates_ns = nanoseconds(pairs.rates), forces_ns = nanoseconds(pairs.forces);
    if (r == 0) continue;  // memory is touched for the first time
    best.rates_ns = std::min(best.rates_ns, rates_ns);
    best.forces_ns = std::min(best.forces_ns, forces_ns);
  }
  return best;
}

}  // namespace courant::benchmarks
