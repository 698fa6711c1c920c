// Compiled once for each instruction set, as the pair loops are.
#include <cstdint>

#include "base/simd.hpp"

namespace courant::COURANT_SIMD {

/// `n` rounds of twelve chains of native FMAs; returns their number of operations. `out` keeps the compiler
/// from leaving them out.
double fma_chains(std::int64_t n, double* out) {
  constexpr int chains = 12;  // latency x throughput of the processors of today is 8 to 12
  const Native factor = 0.999999 - Native{}, term = 1e-6 - Native{};
  Native a[chains];
  for (int k = 0; k < chains; ++k) a[k] = double(k) - Native{};
  for (std::int64_t i = 0; i < n; ++i) {
#pragma GCC unroll 12
    for (int k = 0; k < chains; ++k) a[k] = a[k] * factor + term;
  }
  for (int k = 1; k < chains; ++k) a[0] += a[k];
  *out = a[0][0];
  return 2.0 * chains * native_lanes * static_cast<double>(n);
}

}  // namespace courant::COURANT_SIMD
