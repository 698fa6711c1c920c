#include "time/stage.hpp"

#include "parallel/in_parts.hpp"

namespace courant {

void Stage::add(std::shared_ptr<BlockPass> pass) {
  rows_.push_back(timer_.row(pass->name()));
  if (parts_.empty()) parts_ = {0, 0};
  if (pass->waits() && parts_.back() > 0) parts_.push_back(parts_.back());
  ++parts_.back();
  passes_.push_back(std::move(pass));
}

void Stage::run_share(World& world, const Clock& clock, Index n, const Shares& shares, int thread,
                      std::size_t first_pass, std::size_t last_pass) {
  const Index first = shares.first[thread], last = shares.first[thread + 1];
  auto& seconds = seconds_[thread].of_pass;
  seconds.resize(passes_.size());
  double start = PassTimer::now();
  for (std::size_t k = first_pass; k < last_pass; ++k) {
    for (Index b = first; b < last; ++b)
      passes_[k]->block(world, clock, b * block_size, std::min(n, (b + 1) * block_size));
    const double end = PassTimer::now();
    seconds[k] = end - start;
    start = end;
  }
}

void Stage::run(World& world, const Clock& clock, Index n, const Shares& shares) {
  if (passes_.empty()) return;
  const int threads = shares.threads();
  const auto timed = [this](auto&& call) {
    double start = PassTimer::now();
    for (std::size_t k = 0; k < passes_.size(); ++k) {
      call(*passes_[k]);
      const double end = PassTimer::now();
      serial_[k] += end - start;
      start = end;
    }
  };
  serial_.assign(passes_.size(), 0);
  if (static_cast<int>(seconds_.size()) < threads) seconds_.resize(threads);
  timed([&](BlockPass& pass) { pass.start(world, clock); });
  const double start = PassTimer::now();
  on_threads_in_parts(static_cast<int>(parts_.size()) - 1, threads, [&](int part, int t) {
    run_share(world, clock, n, shares, t, parts_[part], parts_[part + 1]);
  });
  double waiting = PassTimer::now() - start;
  timed([&](BlockPass& pass) { pass.finish(world, clock); });
  for (std::size_t k = 0; k < passes_.size(); ++k) {
    double mean = 0;
    for (int t = 0; t < threads; ++t) mean += seconds_[t].of_pass[k] / threads;
    waiting -= mean;
    timer_.add(rows_[k], mean + serial_[k]);
  }
  timer_.add(waiting_, waiting);
}

}  // namespace courant
