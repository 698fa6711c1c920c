#include "contact/tied/cohesive.hpp"

#include <fmt/format.h>

#include <limits>
#include <tuple>
#include <utility>

namespace courant {

void warn_of_cohesive_fields(const ContactCard& c, const Deck& deck, Diagnostics& diagnostics) {
  for (const auto& [field, value] : {std::pair("ERATEN", c.eraten), std::pair("ERATES", c.erates),
                                     std::pair("CT2CN", c.ct2cn), std::pair("CN", c.cn)})
    if (value > 0)
      deck.warning(diagnostics, c, field, fmt::format("OPTION {} does not use it", c.option),
                   "OPTION 9 and 11 are cohesive joints, with energies and stiffnesses");
}

bool read_cohesive(const ContactCard& c, Real slsfac, std::vector<Tie>& ties, CohesiveLaw& law,
                   const std::function<void(const char* field, std::string what, const char* hint)>& error) {
  for (const auto& [field, value] : {std::pair("ERATEN", c.eraten), std::pair("ERATES", c.erates)})
    if (!(value > 0)) {
      error(field, fmt::format("expected a number > 0, got '{:g}'", value),
            "with OPTION 9 and 11 the energy by area that the joint takes");
      return false;
    }
  Real softest = std::numeric_limits<Real>::infinity();
  for (const Tie& tie : ties) {
    if (!(tie.area > 0)) {
      error("SURFA", "a tied node has no face of its own, whose area stresses act on",
            "let SURFA be segments or parts");
      return false;
    }
    softest = std::min(softest, slsfac * tie.k / tie.area);
  }
  law.normal = c.nfls, law.shear = c.sfls, law.normal_energy = c.eraten, law.shear_energy = c.erates;
  law.normal_stiffness = c.cn > 0 ? c.cn : softest;
  law.shear_stiffness = (c.ct2cn > 0 ? c.ct2cn : 1) * law.normal_stiffness;
  law.exponent = c.param != 0 ? c.param : 1;
  for (const auto& [open, across, field] : {std::tuple(1.0, 0.0, "ERATEN"), std::tuple(0.0, 1.0, "ERATES")})
    if (const Real first = law.onset(open, across); law.end(open, across, first) <= first) {
      error(
          field,
          fmt::format("the joint is open by {:.3g} at its peak, and takes more than this energy up to there",
                      first),
          "raise CN, or the energy");
      return false;
    }
  const Real stiffest = std::max(law.normal_stiffness, law.shear_stiffness);
  for (Tie& tie : ties) tie.k = stiffest * tie.area / slsfac;
  return true;
}

}  // namespace courant
