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

/// The variant for this machine of a function that is compiled for each instruction set. Those that
/// this build has not are null.
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

// What this build has: CMake's COURANT_LEAVE_OUT names sets that are not compiled.
#if defined(__x86_64__) && !defined(COURANT_WITHOUT_avx2)
#define COURANT_AVX2(function) &avx2::function
#else
#define COURANT_AVX2(function) nullptr
#endif
#if defined(__x86_64__) && !defined(COURANT_WITHOUT_avx512)
#define COURANT_AVX512(function) &avx512::function
#else
#define COURANT_AVX512(function) nullptr
#endif

/// Declares, in the namespace of each instruction set, the function that a file *_loops.cpp defines there: of
/// the same name and type as the one of namespace courant that picks among them.
#define COURANT_DECLARE_VARIANTS(function) \
  namespace baseline {                     \
  decltype(::courant::function) function;  \
  }                                        \
  namespace avx2 {                         \
  decltype(::courant::function) function;  \
  }                                        \
  namespace avx512 {                       \
  decltype(::courant::function) function;  \
  }

/// `variant` of a function that each instruction set's namespace has under the same name.
#define COURANT_VARIANT(function)                                                     \
  variant<decltype(&baseline::function)>(&baseline::function, COURANT_AVX2(function), \
                                         COURANT_AVX512(function))
