#pragma once
// What the cards of materials of discrete beams share: stiffness and damping, preload, failure.
#include "laws/discrete/discrete_beam_law.hpp"
#include "laws/discrete/discrete_law_cards.hpp"

namespace courant {

struct DiscreteBeamCard : DiscreteBeamFields {
  void put_shared(DiscreteBeamLaw& law) const {
    law.ro = ro;
    const SixOfBeam start{for_, fos, fot, mor, mos, mot};
    for (std::size_t d = 0; d < 6; ++d) law.springs[d].preload = start[d];
  }
  void put_linear(DiscreteBeamLaw& law) const {
    const SixOfBeam k{tkr, tks, tkt, rkr, rks, rkt}, c{tdr, tds, tdt, rdr, rds, rdt};
    for (std::size_t d = 0; d < 6; ++d) law.springs[d].k = k[d], law.springs[d].c = c[d];
  }
  void put_limits(DiscreteBeamLaw& law) const {
    law.limits.force = {ffailr, ffails, ffailt, mfailr, mfails, mfailt};
    law.limits.displacement = law.limits.negative = {ufailr, ufails, ufailt, tfailr, tfails, tfailt};
  }
};

}  // namespace courant
