#pragma once
// Discrete beams (ELFORM 6) of six springs: a triad turns with the ends, springs and dampers act along and
// about its axes.
#include <array>
#include <memory>
#include <vector>

#include "elements/erosion.hpp"
#include "laws/discrete/discrete_beam_law.hpp"
#include "model/model.hpp"
#include "state/world.hpp"

namespace courant {

/// SCOOR, RRCON, SRCON and TRCON of *SECTION_BEAM.
struct DiscreteTriad {
  int node = 0;                ///< it turns with end 1 (< 0), end 2 (> 0), or the mean of both (0)
  bool line = false;           ///< r stays on the line between the ends (SCOOR -2, 2)
  bool lever = false;          ///< shear forces turn the ends as those of a beam do (|SCOOR| > 1)
  std::array<bool, 3> held{};  ///< does not turn about r, s, t
};

/// The discrete beams of a part; vectors by element.
struct DiscreteBeamPart {
  Index part = 0;
  std::shared_ptr<const DiscreteBeamLaw> law;
  DiscreteTriad triad;
  std::vector<const ModelBeam*> beams{};
  std::vector<Real> volume{}, inertia{};  ///< [L3], of both ends together [ML2]
  std::vector<Matrix> axes{};             ///< r, s, t at the start, as columns
};

/// Parts of *SECTION_BEAM with ELFORM 6 whose material is one of these. Refuses systems that turn with nodes,
/// triads along a line without length, beams without volume, or without inertia where they turn something.
std::vector<DiscreteBeamPart> find_discrete_beam_parts(const Deck& deck, const Model& model,
                                                       Diagnostics& diagnostics);
/// Adds groups, masses, rotations of nodes with their inertia, and passes. `node_of`: the node of the world
/// of each node of the model. 2D is an error.
void build_discrete_beams(const Model& model, const std::vector<DiscreteBeamPart>& parts,
                          const std::vector<Index>& node_of, ElementOptions& options, World& world,
                          Diagnostics& diagnostics);

}  // namespace courant
