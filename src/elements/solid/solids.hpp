#pragma once
// Solid elements in the world: a group for each part, and the passes over it.
#include <memory>
#include <vector>

#include "elements/erosion.hpp"
#include "elements/solid/formulation.hpp"
#include "elements/solid/hourglass.hpp"
#include "elements/solid/solid_pressure.hpp"
#include "laws/strength/strength.hpp"
#include "model/model.hpp"
#include "state/world.hpp"

namespace courant {

/// What solids of a part are made of.
struct SolidPart {
  std::shared_ptr<StrengthLaw> law;  ///< null: the part has no solids
  std::shared_ptr<SolidPressure>
      pressure;  ///< of an equation of state; null: the law gives all of the stress
  const SolidFormulation* formulation = nullptr;  ///< null only without a law
  SolidViscosity viscosity;
  /// [M/LT2]
  Real bulk_modulus() const { return pressure ? pressure->bulk_modulus() : law->bulk_modulus(); }
  /// Of compression waves at the start. [L/T]
  Real sound_speed() const { return pressure ? pressure->initial_sound_speed() : law->sound_speed(); }
  /// V/V0 at the start. [-]
  Real relative_volume() const { return pressure ? pressure->eos().V0 : 1; }
};

/// The law and viscosity of each part with solids. Missing or unsuitable materials, and sections of other
/// formulations, are errors.
std::vector<SolidPart> find_solid_parts(const Deck& deck, const Model& model, Diagnostics& diagnostics);

/// For the loops, of hourglass control, bulk viscosity and the material at rest.
SolidControl control_of(const SolidPart& part);

/// Adds a group of elements for each part with solids, and their masses to world.nodes. `node_of`: the node
/// of the world of each node of the model.
void build_solids(const Model& model, const std::vector<SolidPart>& parts, const std::vector<Index>& node_of,
                  World& world);

struct ReferenceGeometry;
/// Adds the forces of solids to the passes of `world`. `node_of` as above. Solids that are inside out in the
/// reference geometry, or on the path from there, are errors.
void add_solid_passes(const Model& model, const std::vector<SolidPart>& parts,
                      const std::vector<Index>& node_of, const ReferenceGeometry& reference,
                      ElementOptions& options, World& world, Diagnostics& diagnostics);

}  // namespace courant
