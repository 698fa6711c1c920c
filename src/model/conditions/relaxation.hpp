#pragma once
// *CONTROL_DYNAMIC_RELAXATION: a phase before the run that brings what loads hold to rest.
#include <functional>
#include <limits>
#include <string_view>

#include "keyword/deck.hpp"
#include "model/model.hpp"

namespace courant {

struct Relaxation {
  bool asked = false;
  int check_every = 250;                             ///< NRCYCK: steps
  Real tolerance = 1e-3;                             ///< DRTOL: of the largest kinetic energy so far
  Real factor = 0.995;                               ///< DRFCTR: of velocities, in each step
  Real end = std::numeric_limits<Real>::infinity();  ///< DRTERM [T]
  bool at_once = false;                              ///< a load begins with more than 0
  Real ramp = 0;                                     ///< loads of this phase alone change until then [T]
};

/// The request of a deck: by IDRFLG, or by SIDR 1 or 2 of a curve that a load or a motion has. Refused by
/// name: IDRFLG other than -1, 0, 1, IRELAL 1, and particles; these with a warning where only SIDR 2 asks.
Relaxation relaxation_of(const Deck& deck, const Model& model, bool has_particles, Diagnostics& diagnostics);

/// TSSFDR, or TSSFAC.
Real relaxation_tssfac(const Deck& deck, Real tssfac);

/// Whether the curve of such a field acts in that phase only, for any SIDR.
bool is_of_relaxation(std::string_view field);

/// Calls of(entry, field, curve id) for each curve that a load, a motion, damping or a rigid wall has.
void for_load_curves(const Deck& deck, const std::function<void(const Entry&, const char*, Id)>& of);

}  // namespace courant
