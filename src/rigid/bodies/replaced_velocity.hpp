#pragma once
// IRIGID of *INITIAL_VELOCITY and *INITIAL_VELOCITY_GENERATION.
#include <optional>
#include <vector>

#include "rigid/bodies/body_cards.hpp"
#include "state/world.hpp"

namespace courant {

/// A body of *PART_INERTIA, or of *CONSTRAINED_NODAL_RIGID_BODY_INERTIA.
struct InertiaBody {
  Index part = -1;                  ///< index into Model::parts; -1: a body of nodes
  const std::vector<Index>& nodes;  ///< indices into World::nodes
};

/// The velocity that replaces that of the body's own card: of the last card whose IRIGID names the body.
/// `centre`: of its mass. [L]
std::optional<BodyStart> replaced_start(const Deck& deck, const Model& model, const World& world,
                                        const InertiaBody& body, const Vec& centre);

/// Refuses IRIGID that names no part set, and notes where no body has a velocity that it could replace.
void check_irigid(const Deck& deck, const Model& model, Diagnostics& diagnostics);

}  // namespace courant
