#pragma once
// Inlets: *DEFINE_SPH_INJECTION and *DEFINE_SPH_INJECTION_SIMPLIFIED. Their particles are made at set-up, in
// layers that wait upstream of the plane of the inlet and move in with its velocity.
#include <string>
#include <vector>

#include "keyword/deck.hpp"
#include "model/model.hpp"
#include "search/neighbours.hpp"
#include "sph/inlets/inlet_flow.hpp"
#include "sph/materials/materials.hpp"
#include "state/world.hpp"

namespace courant {

/// An inlet and the particles made for it.
struct Injection {
  Entry card;
  Index part = 0;  ///< index into the model's parts
  InletPlane plane{};
  Vec v = Vec::Zero();         ///< [L/T], times `rate` and `factor`
  InletRate rate{};            ///< over time
  std::vector<Vec> places{};   ///< of a layer, in the plane [L]
  std::vector<Real> factor{};  ///< on v at each position; empty: 1 everywhere
  FreeSurface surface{};
  Real area = 0;            ///< of all positions [L2], in 2D per unit of depth [L]
  Real spacing = 0;         ///< of the layers, along the normal [L]
  Real cell = 0;            ///< distance of positions in the plane [L]
  Real begin = 0, end = 0;  ///< TBEG and TEND [T]
  Real reach = 0;           ///< how far upstream layers must be to fill the kernel [L]
  Index particles = 0;      ///< that were made

  /// Through the plane, before `rate` and `factor` [L/T]
  Real speed() const { return v.dot(plane.normal); }
  /// Whether its particles are on a lattice already where they wait, as all move alike.
  bool is_lattice() const { return rate.steady() && factor.empty() && !surface.on; }
};

/// All inlets of a deck.
struct Injections {
  std::vector<Injection> inlets;
  Index first = 0;              ///< particle of the model that was made; all behind it were, too
  std::vector<Index> inlet_of;  ///< particle first + k
  std::vector<Real> head;       ///< pressure with which it comes in, over RO [L2/T2]; empty: 0
};

/// The first card of an inlet; null where there is none.
const Entry* first_injection(const Deck& deck);

/// The inlets as their cards tell, without particles. `dim`: 2 or 3.
std::vector<Injection> read_injections(const Deck& deck, const Model& model, int dim,
                                       Diagnostics& diagnostics);

/// Adds nodes and particles of all layers that enter up to ENDTIM, or are seen from inside until then, to the
/// model, in the order of time: with a later ENDTIM more follow behind the same ones. Ids go on from the
/// highest of a node.
Injections add_injected_particles(const Deck& deck, Model& model, Diagnostics& diagnostics);

/// Marks the particles that were made as waiting, and has `neighbours` let them in. Call while particles
/// are in the order of the model.
void make_injected_wait(const Injections& injections, World& world, Neighbours& neighbours);

/// Gives particles that come in under pressure the density at which they have it, and the mass of their share
/// of the inlet at that density. Refuses pressures that the equation of state does not reach. Call as
/// make_injected_wait.
void set_inlet_pressures(const Injections& injections, const Deck& deck, const Model& model,
                         const std::vector<PartMaterial>& materials, World& world, Diagnostics& diagnostics);

/// A line about each, for `courant check` and `messag`.
std::string injections_text(const Injections& injections, const Model& model);

}  // namespace courant
