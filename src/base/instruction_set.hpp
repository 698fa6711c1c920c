#pragma once
// Which of the compiled variants of a hot loop this machine runs.
#include <stdexcept>
#include <string>
#include <vector>

namespace courant {

enum class InstructionSet { baseline, avx2, avx512 };

/// The best one that the processor and this build have; COURANT_SIMD=baseline, avx2 or avx512 in the
/// environment chooses a lesser one. Throws std::runtime_error where that is not to be had.
InstructionSet instruction_set();
const char* name_of(InstructionSet set);
/// All that this processor and this build have, the best last.
std::vector<InstructionSet> instruction_sets();
/// For tests and benchmarks; takes effect for what is built afterwards.
void use_instruction_set(InstructionSet set);

/// The variant for this machine of a function that is compiled for each instruction set. On other processors
/// than x86-64 only `baseline` exists, and the others are null.
template <class Function>
Function variant(Function baseline, Function avx2, Function avx512) {
  switch (instruction_set()) {
    case InstructionSet::avx512:
      return avx512;
    case InstructionSet::avx2:
      return avx2;
    default:
      return baseline;
  }
}

}  // namespace courant

/// `variant` of a function that each instruction set's namespace has under the same name.
#if defined(__x86_64__)
#define COURANT_VARIANT(function) variant(&baseline::function, &avx2::function, &avx512::function)
#else
#define COURANT_VARIANT(function) variant(&baseline::function, decltype(&baseline::function){}, {})
#endif
