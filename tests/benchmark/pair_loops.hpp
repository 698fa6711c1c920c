#pragma once
// The two pair loops alone.
#include "app/run/simulation.hpp"

namespace courant::benchmarks {

struct PairTimes {
  double rates_ns = 0, forces_ns = 0;  ///< least wall time per active particle
};

/// The loops that `instruction_set()` chooses, on the particles of `s` (h the same for all), with gradients
/// kept or worked out again. Lists of their own, with the skin of `s`. `s` must not step afterwards.
class PairLoopsAlone {
 public:
  explicit PairLoopsAlone(Simulation& s);
  PairTimes measure(bool kept, int threads, int repeats);
  double entries() const;  ///< lanes in reach per active particle

 private:
  Simulation& s_;
  std::shared_ptr<Neighbours> neighbours_;
};

}  // namespace courant::benchmarks
