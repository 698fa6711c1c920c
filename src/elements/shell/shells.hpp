#pragma once
// Shells that deform, in the world: groups of quadrilaterals and of triangles for each part, and the passes
// over them. Rigid shells are walls only: src/shell.
#include <memory>
#include <vector>

#include "elements/erosion.hpp"
#include "elements/shell/shell_loops.hpp"
#include "laws/strength/strength.hpp"
#include "model/model.hpp"
#include "state/world.hpp"

namespace courant {

/// What shells of a part are made of.
struct ShellPart {
  std::shared_ptr<StrengthLaw> law;  ///< null: the part has no shells that deform
  ShellControl control;
  bool full = false;              ///< ELFORM 16: 2 x 2 points in the plane of quadrilaterals
  std::vector<Real> zeta, share;  ///< points through the thickness: height over half of it, weight (sum 1)
  Real marea = 0;                 ///< mass per area besides that of the law [M/L2]
  Real rotary_scale = 1;          ///< ROTASCL
  Real warp_warning = 20;         ///< WRPANG [degrees]
};

/// Young's modulus and Poisson's ratio of a law at rest. [M/LT2], [-]
struct ElasticConstants {
  Real E = 0, nu = 0;
};
ElasticConstants elastic_constants(const StrengthLaw& law);

/// Points of Gauss (1 to 10), or of Lobatto (3 to 10), on [-1, 1], ascending; the weights sum up to 1.
void gauss_points(int count, std::vector<Real>& zeta, std::vector<Real>& weight);
void lobatto_points(int count, std::vector<Real>& zeta, std::vector<Real>& weight);

/// The law and the options of each part with shells whose material is not rigid. Materials that shells cannot
/// have, and options and formulations that are not there, are errors; a missing material is none here.
std::vector<ShellPart> find_shell_parts(const Deck& deck, const Model& model, Diagnostics& diagnostics);

/// Adds groups of elements, and the rotations of their nodes (state/shared_fields.hpp) with their inertia.
/// The masses of the nodes are build_segments' business. `node_of`: the node of the world of each node of the
/// model; world.segments must stand in the order of Model::shells. Warns of warped shells.
void build_shells(const Model& model, const std::vector<ShellPart>& parts, const std::vector<Index>& node_of,
                  World& world, Diagnostics& diagnostics);

/// Rotary inertia that an element has for each of its corners; `build_shells` fills it. [ML2]
Field<Real>& corner_inertia_of(const ElementGroup& group);

/// Adds the forces of shells to the passes of `world`. Computes the largest frequency of each group, which
/// bounds the step.
void add_shell_passes(const Model& model, const std::vector<ShellPart>& parts,
                      const std::vector<Index>& node_of, ElementOptions& options, World& world);

}  // namespace courant
