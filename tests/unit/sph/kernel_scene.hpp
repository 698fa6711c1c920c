#pragma once
// The cards that choose a kernel, for tests that run scenes with each of them.
#include <string>

#include "sph/kernel/kernel_choice.hpp"

namespace courant::test {

/// *SECTION_SPH 1 with constant h, and *COURANT_KERNEL where the kernel needs it.
inline std::string kernel_cards(KernelChoice kernel, const std::string& cslh = "1.2",
                                const std::string& bounds = "1,1") {
  const int k = static_cast<int>(kernel);
  std::string text = "*SECTION_SPH\n1," + cslh + "," + bounds + ",0,0,0," + std::to_string(k < 4 ? k : 0);
  if (k >= 4) text += std::string("\n*COURANT_KERNEL\n") + (k == 4 ? "wendland_c2" : "wendland_c4");
  return text + "\n";
}

/// For the names of tests.
inline std::string kernel_word(KernelChoice kernel) {
  std::string word = kernel_name(kernel);
  for (char& c : word)
    if (c == ' ') c = '_';
  return word;
}

}  // namespace courant::test
