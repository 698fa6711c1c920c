// Entry points of libFuzzer: build with -DCOURANT_FUZZ=ON and clang, see docs/contributing.md.
#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstring>

#include "mutate.hpp"
#include "read_and_build.hpp"

extern "C" std::size_t LLVMFuzzerMutate(std::uint8_t* data, std::size_t size, std::size_t max_size);

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  if (size <= courant::fuzz::largest_input)
    courant::fuzz::read_and_build({reinterpret_cast<const char*>(data), size});
  return 0;
}

extern "C" std::size_t LLVMFuzzerCustomMutator(std::uint8_t* data, std::size_t size, std::size_t max_size,
                                               unsigned seed) {
  if (seed % 2 == 0) return LLVMFuzzerMutate(data, size, max_size);
  std::string deck(reinterpret_cast<const char*>(data), size);
  courant::fuzz::Mutator(seed).change(deck, deck, max_size);
  std::memcpy(data, deck.data(), deck.size());
  return deck.size();
}

extern "C" std::size_t LLVMFuzzerCustomCrossOver(const std::uint8_t* data1, std::size_t size1,
                                                 const std::uint8_t* data2, std::size_t size2,
                                                 std::uint8_t* out, std::size_t max_out_size, unsigned seed) {
  std::string deck(reinterpret_cast<const char*>(data1), size1);
  courant::fuzz::Mutator(seed).change(deck, std::string(reinterpret_cast<const char*>(data2), size2),
                                      max_out_size);
  std::memcpy(out, deck.data(), deck.size());
  return deck.size();
}
