// Benchmarks of the step on Google Benchmark; tests/benchmark/report.py makes the tables of
// docs/benchmarks.md of what this program writes.
//   benchmarks [--full | --smoke] [options of Google Benchmark]
// --full adds the scenes that take minutes and gigabytes; --smoke runs the small ones for a few steps.
#include <benchmark/benchmark.h>

#include <cstdio>
#include <functional>
#include <limits>
#include <string>

#include "machine.hpp"
#include "measure.hpp"
#include "pair_loops.hpp"
#include "parallel/parallel.hpp"
#include "parallel/start_over.hpp"
#include "scenes.hpp"

using namespace courant;
using namespace courant::benchmarks;

namespace {

enum class Size { smoke, usual, full };

Effort effort_of(Size size) {
  return size == Size::smoke ? Effort{1, 0.0, 3} : Effort{};
}

/// The body runs once, finds its own repeats, and tells the seconds of one step or burst.
void add(const std::string& name, const std::function<double(benchmark::State&)>& body) {
  benchmark::RegisterBenchmark(name.c_str(),
                               [body](benchmark::State& state) {
                                 for (auto _ : state) state.SetIterationTime(body(state));
                               })
      ->Iterations(1)
      ->UseManualTime()
      ->Unit(benchmark::kMillisecond);
}

using Build = std::function<std::unique_ptr<Simulation>()>;

void tell_sizes(benchmark::State& state, const Sizes& z) {
  const double flops = z.entries * pair_work(z.dim, z.gradients).both() + particle_work;
  auto& c = state.counters;
  c["dim"] = z.dim;
  c["active"] = z.active;
  c["pairs"] = z.pairs;
  c["entries"] = z.entries;
  c["kept"] = z.gradients != Gradients::again;
  c["field_bytes"] = z.field_bytes;
  c["list_bytes"] = z.list_bytes;
  c["kept_bytes"] = z.kept_bytes;
  c["flops"] = flops;
  c["useful_flops"] = z.pairs * pair_work(z.dim, z.gradients).both() + particle_work;
  c["bytes_streamed"] = bytes_streamed(z.dim, z.entries, z.gradients);
}

double measure_step(benchmark::State& state, const Build& build, const Effort& effort) {
  set_threads(0);
  const auto s = build();
  const Measured m = measure(*s, effort);
  const Sizes z = sizes_of(*s);
  tell_sizes(state, z);
  auto& c = state.counters;
  c["wall_ns_1"] = m.one.wall_ns();
  c["wall_ns_2"] = m.two.wall_ns();
  c["cpu_ns_1"] = m.cpu_ns;
  c["steps"] = static_cast<double>(m.steps);
  c["rebuilds"] = static_cast<double>(m.rebuilds);
  for (const auto& row : m.one.passes) c["pass " + row.name] = row.seconds / m.one.wall;
  return m.one.wall / static_cast<double>(m.one.steps);
}

void add_step(const std::string& name, const Effort& effort, const Build& build) {
  add("step/" + name, [=](benchmark::State& state) { return measure_step(state, build, effort); });
}

Build scene(const std::string& path, const Parameters& parameters, int warm_up) {
  return [=] {
    auto s = build_scene(path, parameters);
    take_steps(*s, warm_up);
    return s;
  };
}

/// A jump that a soft liquid (c0 = 30 m/s) took to time `t`, then some hundred steps with `c0` and `cards`.
Build jump(int resolution, int c0, Real t, Size size, const std::string& cards = "") {
  return [=] {
    const std::string path = "keyword_decks/hydraulic_jump/scene.yaml";
    Parameters parameters{{"resolution", std::to_string(resolution)}, {"c0", "30"}, {"endtim", "2"}};
    auto s = build_scene(path, parameters);
    run_until(*s, t, size == Size::smoke ? 5 : 1000000);
    if (c0 == 30) return s;
    parameters["c0"] = std::to_string(c0);
    auto stiff = build_scene(path, parameters, cards);
    start_from(*stiff, *s, c0, 30, 1000);
    take_steps(*stiff, size == Size::smoke ? 5 : 600);
    return stiff;
  };
}

const std::string own = "tests/benchmark/scenes/";

Build dam_2d(int n, int warm_up) {
  return scene(own + "dam_break_2d.yaml", {{"n", std::to_string(n)}}, warm_up);
}
Build block(int dim, int n) {
  return scene(own + "water_block_" + std::to_string(dim) + "d.yaml", {{"n", std::to_string(n)}}, 3);
}

void add_scenes(Size size) {
  const std::string windows = "*COURANT_PAIR_GEOMETRY\n0.04\n";
  const Effort effort = effort_of(size);
  const int some = size == Size::smoke ? 3 : 300;
  add_step("jump d1/4 c0 30", effort, jump(4, 30, 1, size));
  add_step("jump d1/4 c0 1484", effort, jump(4, 1484, 1, size));
  add_step("jump d1/4 c0 1484 windows", effort, jump(4, 1484, 1, size, windows));
  add_step("dam 2D 5k", effort, dam_2d(50, some));
  if (size == Size::smoke) return;
  add_step("jump d1/10 c0 1484", effort, jump(10, 1484, 0.2, size));
  add_step("jump d1/10 c0 1484 windows", effort, jump(10, 1484, 0.2, size, windows));
  add_step("dam 2D 20k", effort, dam_2d(100, 300));
  add_step("dam 2D 100k", effort, dam_2d(224, 150));
  const std::string dam = "keyword_decks/dam_break_3d/scene.yaml";
  const Effort few{3, 0.5, 100};
  add_step("dam 3D 100k", few, scene(dam, {{"dx", "0.2/37"}}, 40));
  if (size == Size::full) add_step("dam 3D 1M", few, scene(dam, {{"dx", "0.2/80"}}, 40));
}

void add_blocks(Size size) {
  struct Side {
    int square, cube;
  };
  for (const Side side : {Side{32, 10}, {100, 22}, {316, 46}, {1000, 100}, {3162, 215}}) {
    if ((side.square > 1000 && size != Size::full) || (side.square > 32 && size == Size::smoke)) break;
    const Effort effort = size == Size::smoke   ? effort_of(size)
                          : side.square >= 1000 ? Effort{2, 0, 15}
                                                : Effort{5, 0.1, 500};
    add_step("block 2D " + std::to_string(side.square), effort, block(2, side.square));
    add_step("block 3D " + std::to_string(side.cube), effort, block(3, side.cube));
  }
}

void add_instruction_sets(Size size) {
  for (const InstructionSet set : instruction_sets()) {
    const auto build = [=] {
      const InstructionSet before = instruction_set();
      use_instruction_set(set);
      auto s = dam_2d(50, size == Size::smoke ? 3 : 300)();
      use_instruction_set(before);
      return s;
    };
    add_step(std::string("set ") + name_of(set), effort_of(size), build);
  }
}

double pair_seconds(const PairTimes& t, Index particles) {
  return 1e-9 * (t.rates_ns + t.forces_ns) * particles;
}

/// The pair loops alone, gradients kept and worked out again: each instruction set, the best one on two
/// threads, too.
double measure_pair_loops(benchmark::State& state, const Build& build, int repeats) {
  set_threads(1);
  const auto s = build();
  const Index active = s->world().particles.active;
  PairLoopsAlone loops(*s);
  double quickest = std::numeric_limits<double>::infinity();
  const auto measure = [&](const std::string& row, int threads) {
    for (const bool kept : {false, true}) {
      const PairTimes t = loops.measure(kept, threads, repeats * threads);
      state.counters[row + (kept ? " kept rates_ns" : " again rates_ns")] = t.rates_ns;
      state.counters[row + (kept ? " kept forces_ns" : " again forces_ns")] = t.forces_ns;
      quickest = std::min(quickest, pair_seconds(t, active));
    }
  };
  const InstructionSet usual = instruction_set();
  for (const InstructionSet set : instruction_sets()) {
    use_instruction_set(set);
    measure(name_of(set) + std::string("/1"), 1);
  }
  use_instruction_set(usual);
  measure(name_of(usual) + std::string("/2"), 2);
  const int dim = s->world().dim;
  state.counters["active"] = active;
  state.counters["flops kept"] = loops.entries() * pair_work(dim, Gradients::kept).both();
  state.counters["flops again"] = loops.entries() * pair_work(dim, Gradients::again).both();
  return quickest;
}

void add_pair_loops(Size size, int dim, int n, int repeats) {
  if (size == Size::smoke) repeats = 1;
  add("pairs/" + std::to_string(dim) + "D " + std::to_string(n),
      [=](benchmark::State& state) { return measure_pair_loops(state, block(dim, n), repeats); });
}

void add_machine(Size size) {
  for (const InstructionSet set : instruction_sets())
    for (const int threads : {1, 2})
      add("peak/" + std::string(name_of(set)) + "/" + std::to_string(threads), [=](benchmark::State& state) {
        const double flops = peak_flops(set, threads, size == Size::smoke ? 1 : 100 * threads);
        state.counters["flops"] = flops;
        return 1 / flops;
      });
  for (const int threads : {1, 2})
    add("triad/" + std::to_string(threads), [=](benchmark::State& state) {
      const std::int64_t bytes = size == Size::smoke ? 3 << 20 : 192 << 20;  // beyond all caches
      const double bandwidth = triad_bandwidth(threads, size == Size::smoke ? 2 : 25 * threads, bytes);
      state.counters["bytes"] = bandwidth;
      return 24 / bandwidth;
    });
}

/// Takes our own options out of the command line.
Size size_of(int& argc, char** argv) {
  Size size = Size::usual;
  int kept = 1;
  for (int k = 1; k < argc; ++k) {
    const std::string word = argv[k];
    if (word == "--smoke")
      size = Size::smoke;
    else if (word == "--full")
      size = Size::full;
    else
      argv[kept++] = argv[k];
  }
  argc = kept;
  return size;
}

}  // namespace

int main(int argc, char** argv) {
  start_over_for_speed(argv);
  try {
    const Size size = size_of(argc, argv);
    benchmark::Initialize(&argc, argv);
    if (benchmark::ReportUnrecognizedArguments(argc, argv)) return 1;
    benchmark::AddCustomContext("instruction_set", name_of(instruction_set()));
    add_machine(size);
    add_scenes(size);
    add_blocks(size);
    add_instruction_sets(size);
    add_pair_loops(size, 2, 100, 20);
    if (size != Size::smoke) {
      add_pair_loops(size, 2, 316, 4);
      add_pair_loops(size, 3, 22, 10);
      add_pair_loops(size, 3, 46, 4);
    }
    benchmark::RunSpecifiedBenchmarks();
  } catch (const std::exception& error) {
    std::fprintf(stderr, "benchmarks: %s\n", error.what());
    return 1;
  }
  return 0;
}
