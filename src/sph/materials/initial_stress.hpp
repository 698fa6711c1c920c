#pragma once
#include "keyword/deck.hpp"
#include "sph/materials/materials.hpp"

namespace courant {

/// The mu = rho/rho0 - 1 nearest to the law's own start at which it has pressure p with its initial energy
/// E0, by Newton's method inside a bracket; nothing if there is none, or p falls there with mu (no sound
/// speed). Exact to round-off of the law.
std::optional<Real> compression_at(const EosLaw& law, Real rho0, Real p);

/// Gives the particles that *INITIAL_STRESS_SPH names the density at which they have the pressure
/// p = -(SIGXX + SIGYY + SIGZZ)/3; their masses stay. Refuses by name: what is no particle, stresses that
/// differ by direction, two cards for one particle, tension beyond PC, pressures that the equation of state
/// does not reach. Call while particles are in the order of the model.
void set_initial_pressures(const Deck& deck, const Model& model, const std::vector<PartMaterial>& materials,
                           World& world, Diagnostics& diagnostics);

/// Gives back the memory of the cards.
void release_initial_stresses(Deck& deck);

}  // namespace courant
