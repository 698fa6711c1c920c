#include "extension/additions.hpp"

namespace courant {

std::vector<Addition>& additions() {
  static std::vector<Addition> registry;
  return registry;
}

std::vector<Index> added_nodes(const Deck& deck, const Model& model) {
  std::vector<Index> out;
  for (const Addition& addition : additions())
    if (addition.nodes)
      for (const Index n : addition.nodes(deck, model)) out.push_back(n);
  return out;
}

std::vector<AsciiHistory>& ascii_histories() {
  static std::vector<AsciiHistory> registry;
  return registry;
}

}  // namespace courant
