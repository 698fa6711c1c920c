#include "laws/strength/strength.hpp"

#include <cmath>

namespace courant {

std::vector<StrengthEntry>& strength_registry() {
  static std::vector<StrengthEntry> registry;
  return registry;
}

Real StrengthLaw::sound_speed() const {
  return std::sqrt((bulk_modulus() + 4 * shear_modulus() / 3) / ro);
}

}  // namespace courant
