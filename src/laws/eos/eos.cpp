#include "laws/eos/eos.hpp"

namespace courant {

std::vector<EosEntry>& eos_registry() {
  static std::vector<EosEntry> registry;
  return registry;
}

}  // namespace courant
