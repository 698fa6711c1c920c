#include "laws/strength/strength.hpp"

#include <algorithm>
#include <cmath>

namespace courant {

std::vector<StrengthEntry>& strength_registry() {
  static std::vector<StrengthEntry> registry;
  return registry;
}

void add_to_strength_registry(StrengthEntry entry) {
  std::vector<StrengthEntry>& all = strength_registry();
  const auto place = std::find_if(all.begin(), all.end(),
                                  [&](const StrengthEntry& other) { return other.keyword > entry.keyword; });
  all.insert(place, std::move(entry));
}

std::vector<LawAddition>& law_additions() {
  static std::vector<LawAddition> additions;
  return additions;
}

std::shared_ptr<StrengthLaw> with_additions(const Deck& deck, const Model& model, Id mid,
                                            std::shared_ptr<StrengthLaw> law) {
  for (const LawAddition& add : law_additions()) law = add(deck, model, mid, std::move(law));
  return law;
}

Real StrengthLaw::plane_modulus() const {
  const Real K = bulk_modulus(), G = shear_modulus();
  return 4 * G * (3 * K + G) / (3 * K + 4 * G);
}

Real StrengthLaw::sound_speed() const {
  return std::sqrt((bulk_modulus() + 4 * shear_modulus() / 3) / ro);
}

}  // namespace courant
