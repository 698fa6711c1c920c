#include "elements/solid/formulation.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <stdexcept>

namespace courant {

std::vector<SolidFormulation>& solid_formulations() {
  static std::vector<SolidFormulation> all;
  return all;
}

RegisterSolidFormulation::RegisterSolidFormulation(const SolidFormulation& formulation) {
  std::vector<SolidFormulation>& all = solid_formulations();
  for (const Elform& own : formulation.elforms)
    for (const SolidFormulation& other : all)
      for (const Elform& known : other.elforms)
        if (own.number != 0 && known.number == own.number)
          throw std::logic_error(fmt::format("ELFORM {} of solids is registered twice", own.number));
  const auto later = [&](const SolidFormulation& other) {
    return formulation.elforms[0].number < other.elforms[0].number;
  };
  all.insert(std::find_if(all.begin(), all.end(), later), formulation);
}

}  // namespace courant
