#include "elements/solid/formulation.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <stdexcept>
#include <utility>

namespace courant {

std::vector<SolidFormulation>& solid_formulations() {
  static std::vector<SolidFormulation> all;
  return all;
}

void add_solid_formulation(SolidFormulation formulation) {
  std::vector<SolidFormulation>& all = solid_formulations();
  for (const Elform& own : formulation.elforms)
    for (const SolidFormulation& other : all)
      for (const Elform& known : other.elforms)
        if (known.number == own.number)
          throw std::logic_error(fmt::format("ELFORM {} of solids is registered twice", own.number));
  const auto later = [&](const SolidFormulation& other) {
    return formulation.elforms.front().number < other.elforms.front().number;
  };
  all.insert(std::find_if(all.begin(), all.end(), later), std::move(formulation));
}

}  // namespace courant
