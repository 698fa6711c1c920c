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
  /// Changes `deck` in one to four places; `other` lends lines. At most `largest` bytes come out.
  void change(std::string& deck, const std::string& other, std::size_t largest);

 private:
  void change_once(std::string& deck, const std::string& other);
  void change_bytes(std::string& deck);
  void change_lines(std::string& deck, const std::string& other);
  std::size_t below(std::size_t bound);  ///< a random number
  const std::string& one_of(const std::vector<std::string>& words) { return words[below(words.size())]; }

  std::mt19937_64 random_;
  const std::vector<std::string>& keywords_;
};

}  // namespace courant::fuzz
