#include "state/access.hpp"

#include <algorithm>

namespace courant {

const char* name_of(Phase phase) {
  constexpr const char* names[] = {"rates", "laws",   "reductions", "forces",     "constraints",
                                   "drive", "motion", "relocation", "preparation"};
  return names[static_cast<std::size_t>(phase)];
}

void Accesses::drop(const std::string& resource) {
  all_.erase(
      std::remove_if(all_.begin(), all_.end(), [&](const Access& a) { return a.what->name() == resource; }),
      all_.end());
}

}  // namespace courant
