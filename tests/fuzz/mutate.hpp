#pragma once
#include <cstdint>
#include <random>
#include <string>
#include <vector>

namespace courant::fuzz {

/// Changes of the kind that decks go wrong with: lines doubled, lost, moved or cut, keywords of the registry,
/// huge numbers, commas, parameters, line ends. The same seed gives the same changes.
class Mutator {
 public:
  explicit Mutator(std::uint64_t seed);
  /// The same for files of another kind: `pieces` instead of what decks are made of, `lines` instead of
  /// keywords. Both must outlive the mutator.
  Mutator(std::uint64_t seed, const std::vector<std::string>& pieces, const std::vector<std::string>& lines);
  /// Changes `deck` in one to four locations; `other` lends lines. At most `largest` bytes come out.
  void change(std::string& deck, const std::string& other, std::size_t largest);

 private:
  void change_once(std::string& deck, const std::string& other);
  void change_bytes(std::string& deck);
  void change_lines(std::string& deck, const std::string& other);
  std::size_t below(std::size_t bound);  ///< a random number
  const std::string& one_of(const std::vector<std::string>& words) { return words[below(words.size())]; }

  std::mt19937_64 random_;
  const std::vector<std::string>&pieces_, &keywords_;
};

/// Changes of bytes in one to four locations: bits turned, numbers of 1 to 8 bytes set to values at their
/// limits, bytes lost, doubled or taken from `other`, the end cut off. At most `largest` bytes come out.
void change_binary(std::string& bytes, const std::string& other, std::size_t largest,
                   std::mt19937_64& random);

}  // namespace courant::fuzz
