#include "time/stage.hpp"

#include <algorithm>

#include "parallel/in_parts.hpp"
#include "time/access_check.hpp"

namespace courant {

Stage::Stage(StagePlan plan, const World& world, PassTimer& timer)
    : plan_(std::move(plan)),
      timer_(timer),
      waiting_(timer.row("waiting for threads")),
      exchangers_(world.passes.all<Exchanger>()) {
  for (std::size_t k = 0; k < plan_.entries.size(); ++k) {
    const StagePlan::Entry& e = plan_.entries[k];
    rows_.push_back(timer_.row(e.pass->name()));
    if (k == 0 || e.waits) parts_.push_back(k);
    const bool known =
        std::any_of(even_.begin(), even_.end(), [&](const auto& s) { return s.set == e.over; });
    if (!known) even_.push_back({e.over});
  }
  parts_.push_back(plan_.entries.size());
  work_.resize(plan_.entries.size());
}

// Sets change their size between steps only where particles wait at inlets; their number of blocks and the
// number of threads tell whether shares still hold.
void Stage::share_work(const World& world) {
  for (std::size_t k = 0; k < work_.size(); ++k) {
    const StagePlan::Entry& e = plan_.entries[k];
    if (e.over == &world.particles.fields) {
      const bool moves = e.pass->phase() >= Phase::drive;
      work_[k] = {moves ? world.particles.moving : world.particles.active,
                  moves ? &world.moving_shares : &world.shares};
      continue;
    }
    EvenShares& even =
        *std::find_if(even_.begin(), even_.end(), [&](const auto& s) { return s.set == e.over; });
    const Index blocks = block_count(e.over->size());
    if (even.blocks != blocks || even.threads != threads())
      even.shares = Shares::even(blocks), even.blocks = blocks, even.threads = threads();
    work_[k] = {e.over->size(), &even.shares};
  }
}

void Stage::exchange(World& world) {
  if (plan_.exchange.empty()) return;
  std::vector<const FieldBase*> fields;
  for (const Resource* r : plan_.exchange) fields.push_back(r->field());
  for (Exchanger* e : exchangers_) timer_.measure(e->name(), [&] { e->exchange(world, fields); });
}

void Stage::run_share(World& world, const Clock& clock, int thread, std::size_t first_pass,
                      std::size_t last_pass) {
  auto& seconds = seconds_[static_cast<std::size_t>(thread)].of_pass;
  seconds.resize(plan_.entries.size());
  double start = PassTimer::now();
  for (std::size_t k = first_pass; k < last_pass; ++k) {
    const auto [n, shares] = work_[k];
    if (thread < shares->threads())
      for (Index b = shares->first[thread]; b < shares->first[thread + 1]; ++b)
        plan_.entries[k].pass->block(world, clock, b * block_size, std::min(n, (b + 1) * block_size));
    const double end = PassTimer::now();
    seconds[k] = end - start;
    start = end;
  }
}

// One pass after the other, on one thread.
void Stage::run_each_checked(World& world, const Clock& clock) {
  for (const StagePlan::Entry& e : plan_.entries)
    run_checked(e, Access::When::start, world, [&] { e.pass->start(world, clock); });
  for (std::size_t k = 0; k < work_.size(); ++k) {
    const StagePlan::Entry& e = plan_.entries[k];
    const Index n = work_[k].n;
    run_checked(e, Access::When::block, world, [&] {
      for (Index begin = 0; begin < n; begin += block_size) {
        const Index end = std::min(n, begin + block_size);
        run_block_checked(e, world, begin, end, [&] { e.pass->block(world, clock, begin, end); });
      }
    });
  }
  for (const StagePlan::Entry& e : plan_.entries)
    run_checked(e, Access::When::finish, world, [&] { e.pass->finish(world, clock); });
}

void Stage::run(World& world, const Clock& clock) {
  exchange(world);
  share_work(world);
  const std::size_t count = plan_.entries.size();
  constexpr int checked_cycles = 3;  // what a pass touches it touches at once; more would take too long
  if constexpr (checks_accesses)
    if (clock.cycle < checked_cycles) return run_each_checked(world, clock);
  int team = 1;
  for (const Work& work : work_) team = std::max(team, work.shares->threads());
  const auto timed = [&](auto&& call) {
    double start = PassTimer::now();
    for (std::size_t k = 0; k < count; ++k) {
      call(*plan_.entries[k].pass);
      const double end = PassTimer::now();
      serial_[k] += end - start;
      start = end;
    }
  };
  serial_.assign(count, 0);
  if (static_cast<int>(seconds_.size()) < team) seconds_.resize(static_cast<std::size_t>(team));
  timed([&](BlockPass& pass) { pass.start(world, clock); });
  const double start = PassTimer::now();
  on_threads_in_parts(static_cast<int>(parts_.size()) - 1, team, [&](int part, int t) {
    run_share(world, clock, t, parts_[static_cast<std::size_t>(part)],
              parts_[static_cast<std::size_t>(part) + 1]);
  });
  double waiting = PassTimer::now() - start;
  timed([&](BlockPass& pass) { pass.finish(world, clock); });
  for (std::size_t k = 0; k < count; ++k) {
    double mean = 0;
    for (int t = 0; t < team; ++t) mean += seconds_[static_cast<std::size_t>(t)].of_pass[k] / team;
    waiting -= mean;
    timer_.add(rows_[k], mean + serial_[k]);
  }
  timer_.add(waiting_, waiting);
}

}  // namespace courant
