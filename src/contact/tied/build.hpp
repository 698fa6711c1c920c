#pragma once
// Tied contacts from the cards of a deck.
#include <functional>

#include "keyword/deck.hpp"
#include "model/model.hpp"
#include "state/wall_bodies.hpp"
#include "state/world.hpp"

namespace courant {

struct TiedOptions {
  /// Of the solids of a part. [M/LT2]
  std::function<Real(Index part)> bulk_modulus = [](Index) { return Real(0); };
  WallBodies bodies{};  ///< whose nodes and faces may be tied
  Real tssfac = 0.9;
  bool mass_grows = false;  ///< mass scaling may add some in the run
};

/// All *CONTACT_TIED of the deck, and what holds those with TIEBREAK in their names until it breaks, added to
/// the passes of `world`. Elements and bodies must be there, and rotations started; nodes that are tied
/// exactly follow from then on, and the corners of their faces have their masses. Refuses plane scenes. Warns
/// of nodes that find no face, and of ties that cannot be exact, which become springs (not_exact.hpp).
/// Returns what constraints leave of the step of elements. [-]
Real add_tied_contacts(const Deck& deck, const Model& model, const TiedOptions& options, World& world,
                       Diagnostics& diagnostics);

}  // namespace courant
