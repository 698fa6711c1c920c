#include "base/instruction_set.hpp"

#include <cstdlib>

namespace courant {

namespace {

InstructionSet from_environment() {
  const auto sets = instruction_sets();
  const char* wish = std::getenv("COURANT_SIMD");
  if (!wish || !*wish) return sets.back();
  for (const InstructionSet set : sets)
    if (name_of(set) == std::string(wish)) return set;
  throw std::runtime_error("COURANT_SIMD=" + std::string(wish) + ": this machine has no such variant");
}

InstructionSet& chosen() {
  static InstructionSet set = from_environment();
  return set;
}

}  // namespace

std::vector<InstructionSet> instruction_sets() {
  std::vector<InstructionSet> sets{InstructionSet::baseline};
#if defined(__x86_64__)
  [[maybe_unused]] const bool avx2 = __builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma");
#if !defined(COURANT_WITHOUT_avx2)
  if (avx2) sets.push_back(InstructionSet::avx2);
#endif
#if !defined(COURANT_WITHOUT_avx512)
  if (avx2 && __builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512dq") &&
      __builtin_cpu_supports("avx512vl"))
    sets.push_back(InstructionSet::avx512);
#endif
#endif
  return sets;
}

const char* name_of(InstructionSet set) {
  return set == InstructionSet::avx512 ? "avx512" : set == InstructionSet::avx2 ? "avx2" : "baseline";
}

InstructionSet instruction_set() {
  return chosen();
}

void use_instruction_set(InstructionSet set) {
  chosen() = set;
}

}  // namespace courant
