#pragma once
// Times of steps, and what is behind them.
#include <string>
#include <vector>

#include "app/run/simulation.hpp"
#include "work.hpp"

namespace courant::benchmarks {

/// How long to measure.
struct Effort {
  int rounds = 6;                  ///< chunks for each number of threads, more in doubt; the quickest counts
  double seconds = 0.12;           ///< least length of a chunk
  std::int64_t most_steps = 2000;  ///< of a chunk
};

/// Whole cycles of steps, each ending with one that built the lists again.
struct Chunk {
  std::int64_t steps = 0, particle_steps = 0, rebuilds = 0;
  double wall = 0, cpu = 0;            ///< s; cpu of all threads
  std::vector<PassTimer::Row> passes;  ///< seconds within the chunk
  double wall_ns() const { return 1e9 * wall / static_cast<double>(particle_steps); }
  double cpu_ns() const { return 1e9 * cpu / static_cast<double>(particle_steps); }
};

struct Measured {
  Chunk one, two;     ///< on one thread and on two: the chunk of least wall time per particle-step
  double cpu_ns = 0;  ///< least processor time per particle-step, one thread
  std::int64_t steps = 0, rebuilds = 0;  ///< of all chunks
};

/// Chunks on one thread and on two, taking turns, so that load from others and the flow itself act on both.
Measured measure(Simulation& s, const Effort& effort);

/// Sizes of the state as it stands.
struct Sizes {
  int dim = 2;
  Index active = 0;
  double pairs = 0;    ///< neighbours within 2h per active particle
  double entries = 0;  ///< lanes in reach per active particle, in each of the two pair loops
  Gradients gradients = Gradients::again;
  double field_bytes = 0, list_bytes = 0, kept_bytes = 0;  ///< per active particle
};
Sizes sizes_of(const Simulation& s);
/// Entries of the lists that pair loops do not leave out, where all have one h: in reach of any of their
/// eight now, or for plain loops when the lists were built.
double entries_worked_on(const Particles& p, const Neighbours& lists, Gradients gradients);

}  // namespace courant::benchmarks
