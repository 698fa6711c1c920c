#include "elements/solid/formulation.hpp"

#include <algorithm>
#include <utility>

namespace courant {

std::vector<SolidFormulation>& solid_formulations() {
  static std::vector<SolidFormulation> all;
  return all;
}

void add_solid_formulation(SolidFormulation formulation) {
  std::vector<SolidFormulation>& all = solid_formulations();
  const auto later = [&](const SolidFormulation& other) {
    return formulation.elforms.front().number < other.elforms.front().number;
  };
  all.insert(std::find_if(all.begin(), all.end(), later), std::move(formulation));
}

}  // namespace courant
