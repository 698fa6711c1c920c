#pragma once
// The limits of the machine, measured: arithmetic and memory.
#include <cstdint>

#include "base/instruction_set.hpp"

namespace courant::benchmarks {

/// Most floating-point operations per second (an FMA is two), by chains of FMAs that do not wait for each
/// other; `baseline` has no FMA and multiplies and adds. The best of `repeats` bursts of some
/// milliseconds: many, where others may take a core.
double peak_flops(InstructionSet set, int threads, int repeats);

/// Bytes per second of a = b + s c with three arrays of `bytes` in all, counted as STREAM does: 24 an
/// element.
double triad_bandwidth(int threads, int repeats, std::int64_t bytes);

}  // namespace courant::benchmarks
