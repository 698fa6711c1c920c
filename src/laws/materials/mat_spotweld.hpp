#pragma once
#include <memory>
#include <string>

#include "laws/strength/strength.hpp"

namespace courant {

/// *MAT_SPOTWELD: a plastic material, and what the section of a weld carries until it fails.
struct MatSpotweld : Entry {
  std::string title;
  Id mid = 0;
  Real ro = 0, E = 0, pr = 0, sigy = 0, eh = 0, dt = 0, tfail = 0;
  Real efail = 0, nrr = 0, nrs = 0, nrt = 0, mrr = 0, mss = 0, mtt = 0;
  int nf = 0;
  Real rs = 0, fval = 0, true_t = 0, asff = 0, beta = 0, dmgopt = 0;
  int opt = 0;
  bool with_damage() const { return name % 2 == 1; }  ///< _DAMAGE-FAILURE, by name or number
  bool of_resultants() const { return nrr > 0 || nrs > 0 || nrt > 0 || mrr > 0 || mss > 0 || mtt > 0; }
  std::shared_ptr<StrengthLaw> law() const;
  void check(const Deck& deck, const Model& model, Diagnostics& diagnostics) const;
};

}  // namespace courant
