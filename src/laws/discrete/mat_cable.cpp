#include "keyword/registry.hpp"
#include "laws/discrete/discrete_law_cards.hpp"

namespace courant {

namespace {

const RegisterKeyword<MatCableDiscreteBeam> mat_cable{mat_cable_discrete_beam_table()};

}  // namespace

/// The table has changed E as a modulus.
std::string convert_stiffness_of_cable(MatCableDiscreteBeam& card, const Conversion& conversion) {
  if (card.e < 0) card.e *= conversion.units.of("M/T2") / conversion.units.of("M/LT2");
  return {};
}

}  // namespace courant
