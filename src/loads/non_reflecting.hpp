#pragma once
// Faces of solids through which waves leave.
#include <functional>
#include <memory>
#include <optional>

#include "keyword/deck.hpp"
#include "model/model.hpp"
#include "state/pass.hpp"
#include "state/world.hpp"

namespace courant {

/// Of a material at rest.
struct WaveSpeeds {
  Real ro = 0, dilatation = 0, shear = 0;  ///< [M/L3], [L/T]
};
using SpeedsOfPart = std::function<std::optional<WaveSpeeds>(Index part)>;

/// *BOUNDARY_NON_REFLECTING; nullptr where there is none. In front of supports. Refuses by name: sets that
/// are not there, faces that are no faces of solids, nodes that rigid bodies move.
std::shared_ptr<Constraint> make_non_reflecting(const Deck& deck, const Model& model,
                                                const SpeedsOfPart& speeds, World& world,
                                                Diagnostics& diagnostics);

}  // namespace courant
