#include "extension/additions.hpp"

namespace courant {

std::vector<Addition>& additions() {
  static std::vector<Addition> registry;
  return registry;
}

std::vector<AsciiHistory>& ascii_histories() {
  static std::vector<AsciiHistory> registry;
  return registry;
}

}  // namespace courant
