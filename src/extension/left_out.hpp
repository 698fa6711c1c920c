#pragma once
#include <string>
#include <utility>
#include <vector>

namespace courant {

/// A pass or output that the deck does not need, and why.
struct PassNote {
  std::string name;
  std::string reason;
};
struct LeftOut {
  std::vector<PassNote> notes{};
  void add(std::string name, std::string reason) { notes.push_back({std::move(name), std::move(reason)}); }
};

}  // namespace courant
