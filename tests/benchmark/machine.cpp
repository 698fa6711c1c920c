#include "machine.hpp"

#include <algorithm>
#include <array>

#include "parallel/buffer.hpp"
#include "parallel/parallel.hpp"
#include "time/pass_timer.hpp"

namespace courant {

namespace baseline {
double fma_chains(std::int64_t n, double* out);
}
namespace avx2 {
double fma_chains(std::int64_t n, double* out);
}
namespace avx512 {
double fma_chains(std::int64_t n, double* out);
}

namespace benchmarks {

double peak_flops(InstructionSet set, int threads, int repeats) {
  const InstructionSet before = instruction_set();
  use_instruction_set(set);
  const auto loop = COURANT_VARIANT(fma_chains);
  use_instruction_set(before);
  constexpr std::int64_t rounds = 1 << 20;  // some 3 ms
  struct alignas(64) Out {
    double value;
  };
  std::array<Out, 64> out{};
  double best = 0;
  for (int r = 0; r < repeats; ++r) {
    double operations = 0;
    const double start = PassTimer::now();
    on_threads(threads, [&](int t) {
      const double mine = loop(rounds, &out[t % out.size()].value);
      if (t == 0) operations = mine * threads;
    });
    best = std::max(best, operations / (PassTimer::now() - start));
  }
  return best;
}

double triad_bandwidth(int threads, int repeats, std::int64_t bytes) {
  const std::int64_t n = bytes / 24;
  std::array<Buffer<Real>, 3> array;
  for (auto& a : array) a.grow_to(static_cast<std::size_t>(n));
  Real *a = array[0].data(), *b = array[1].data(), *c = array[2].data();
  const auto shared = [&](const auto& body) {
    on_threads(threads, [&](int t) { body(n * t / threads, n * (t + 1) / threads); });
  };
  shared([&](std::int64_t begin, std::int64_t end) {
    for (std::int64_t i = begin; i < end; ++i) a[i] = 0, b[i] = 1, c[i] = 2;
  });
  double best = 0;
  for (int r = 0; r < repeats; ++r) {
    const Real s = 1 + 1e-3 * r;
    const double start = PassTimer::now();
    shared([&](std::int64_t begin, std::int64_t end) {
#pragma omp simd
      for (std::int64_t i = begin; i < end; ++i) a[i] = b[i] + s * c[i];
    });
    best = std::max(best, 24.0 * static_cast<double>(n) / (PassTimer::now() - start));
  }
  return best;
}

}  // namespace benchmarks
}  // namespace courant
