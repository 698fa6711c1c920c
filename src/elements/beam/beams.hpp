#pragma once
// Beams and trusses in the world: a group for each part, and the pass over it.
#include <algorithm>
#include <array>
#include <memory>
#include <optional>
#include <vector>

#include "elements/beam/axial_preload.hpp"
#include "elements/beam/beam_frame.hpp"
#include "elements/beam/weld.hpp"
#include "elements/erosion.hpp"
#include "laws/strength/strength.hpp"
#include "model/model.hpp"
#include "state/world.hpp"

namespace courant {

enum class BeamKind {
  integrated,  ///< Hughes and Liu: stress at points of the section (ELFORM 1, 9)
  resultant,   ///< Belytschko and Schwer: linear in elongation, twist and rotations of the ends (2)
  truss,       ///< axial stress alone (3)
};

/// A point of the section, in s and t over half the widths (of tubes: over the radius of gyration times the
/// root of 2), and its share of the area.
struct SectionPoint {
  Real s = 0, t = 0, share = 1;
};

/// Of a beam.
struct BeamMeasures {
  Real A = 0, Iss = 0, Itt = 0, J = 0;  ///< area [L2], second moments about s and t, of torsion [L4]
  Real shear_area = 0;                  ///< SA, 0: no shear strain; integrated: SHRF A [L2]
  Real half_s = 0, half_t = 0;          ///< to which points belong [L]
  /// The node line is no principal axis: axial force bends it, and bending about s and t go together.
  bool coupled = false;
  /// Square of the thickness of a rectangle with these over its length. [-]
  Real thickness2(Real L) const { return 12 * std::max(Iss, Itt) / (A * L * L); }
};

/// What beams of a part are made of; vectors by element of the group.
struct BeamPart {
  std::shared_ptr<StrengthLaw> law;  ///< null: the part has no beams
  bool null = false;                 ///< *MAT_NULL: mass, no stress
  Index part = 0;
  BeamKind kind = BeamKind::truss;
  std::vector<SectionPoint> points{};
  std::vector<const ModelBeam*> beams{};
  std::vector<BeamMeasures> measures{};
  std::vector<BeamReleases> releases{};  ///< empty: none
  std::vector<Matrix> axes{};            ///< r, s, t at the start, as columns
  Real nsm = 0;                          ///< mass per length besides that of the law [M/L]
  std::optional<WeldStrength> weld{};    ///< of ELFORM 9
  AxialPreload preload{};
  ElementGroup* group = nullptr;
};

/// Parts with beams, by index into the model's parts. Refuses by name: formulations, rules and materials that
/// are not there, rigid beams, beams without measures or, where they need one, without a direction of s.
std::vector<BeamPart> find_beam_parts(const Deck& deck, const Model& model, Diagnostics& diagnostics);
/// Nodes of beams, indices into Model::nodes.
std::vector<Index> beam_nodes(const Model& model);
/// Adds groups, masses, and the rotations of nodes with their inertia. `node_of`: the node of the world of
/// each node of the model. 2D is an error.
void build_beams(const Model& model, std::vector<BeamPart>& parts, const std::vector<Index>& node_of,
                 World& world, Diagnostics& diagnostics);
/// Adds the forces of beams to the passes of `world`, and their mass by DT2MS or DT of *MAT_SPOTWELD.
void add_beam_passes(const Model& model, const std::vector<BeamPart>& parts, ElementOptions& options,
                     World& world);
/// The longer of the steps by DT2MS and DT of *MAT_SPOTWELD, at the start alone; beams without stress get no
/// mass.
MassScaling scaling_of(const BeamPart& part, const MassScaling& of_deck);
/// Reports the mass that it has added.
void report_beam_scaling(const Deck& deck, const Model& model, const std::vector<BeamPart>& parts,
                         const World& world, Diagnostics& diagnostics);

/// Inertia that a beam gives each of its ends, so that its step is that of waves along it. [ML2]
Real end_inertia(BeamKind kind, const StrengthLaw& law, const BeamMeasures& m, Real mass, Real length);
/// Square of the largest frequency of a beam alone, with that inertia and half its mass at each end, `start`
/// long without stress and `length` now. [1/T2]
Real largest_square(BeamKind kind, const StrengthLaw& law, const BeamMeasures& m, Real mass, Real inertia,
                    Real start, Real length, Real pull);

}  // namespace courant
