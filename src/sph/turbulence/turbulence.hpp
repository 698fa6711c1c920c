#pragma once
// *COURANT_TURBULENCE: models of what turbulence, which no particle resolves, does to the mean flow.
#include <vector>

#include "keyword/card.hpp"
#include "sph/turbulence/turbulence_cards.hpp"

namespace courant {

/// *COURANT_TURBULENCE, ours.
struct CourantTurbulence : Entry {
  int model = 0;
  Real cmu = 0, kappa = 0, lmax = 0, surface = 0, cs = 0;
  Id wallb = 0;
  int wallbtyp = 0;
  Real c1 = 0, c2 = 0, sigma_k = 0, sigma_e = 0, k = 0, epsilon = 0;
  int limit = 0;
  Real lsurf = 0;
};

enum class TurbulenceModel { none = 0, mixing_length = 1, k_epsilon = 2, smagorinsky = 3 };

struct TurbulenceRules {
  TurbulenceModel model = TurbulenceModel::none;
  Real cmu = 0.09, kappa = 0.41;
  Real lmax = 0;     ///< longest mixing length [L]
  Real surface = 0;  ///< SURF: a of the factor at surfaces; 0: none
  Real cs = 0.17;    ///< Smagorinsky's constant
  Real c1 = 1.44, c2 = 1.92, sigma_k = 1, sigma_e = 1.3;
  bool limits_stress = false;    ///< LIMIT 1: nu_t |S| is at most sqrt(c_mu) k
  Real surface_length = 0;       ///< LSURF: of eddies at free surfaces [L]; 0: free
  std::vector<Real> k, epsilon;  ///< per part, at the start; 0: the least there is [L2/T2], [L2/T3]
  std::vector<Index> walls;      ///< segments whose distance counts
  bool on() const { return model != TurbulenceModel::none; }
};

}  // namespace courant
