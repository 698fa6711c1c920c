#pragma once
#include <span>
#include <vector>

#include "keyword/deck.hpp"
#include "model/prescribed_motion.hpp"
#include "search/images.hpp"
#include "sph/sph.hpp"
#include "state/world.hpp"

namespace courant {

/// Adds the pass that moves particles as *BOUNDARY_PRESCRIBED_MOTION_NODE and _SET ask; call before the
/// motion of particles is added, while particles stand in the order of the model. False if no particle is
/// driven. Refuses by name: nodes that are no particles, directions that are held or driven twice, motions
/// out of the plane of a 2D scene, and a computational box, outside of which nothing is driven.
bool add_prescribed_particles(const std::vector<PrescribedMotion>& motions, const Deck& deck,
                              const Model& model, const SphSettings& settings,
                              std::span<const ImagePlane> planes, World& world, Diagnostics& diagnostics);

}  // namespace courant
