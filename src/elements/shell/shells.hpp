#pragma once
// Shells that deform, in the world: groups of quadrilaterals and of triangles for each part, and the passes
// over them. Rigid shells are walls only: src/shell.
#include <array>
#include <memory>
#include <vector>

#include "elements/erosion.hpp"
#include "elements/shell/shell_loops.hpp"
#include "laws/strength/strength.hpp"
#include "model/model.hpp"
#include "state/world.hpp"

namespace courant {

/// NFAIL1, NFAIL4: shells that turn inwards. With 2 x 2 points those that `stay` stop the run, too.
enum class DistortedShells : std::uint8_t { stay, deleted, stop };

/// What shells of a part are made of.
struct ShellPart {
  /// Null: the part has no shells that deform. Of layers with several the first that can fail, else the
  /// first.
  std::shared_ptr<StrengthLaw> law;
  bool null = false;  ///< *MAT_NULL: mass and faces, no stress
  /// Of each point through the thickness its own, and the angle of its directions about the normal [degrees];
  /// empty: `law` in all, without an angle.
  std::vector<std::shared_ptr<StrengthLaw>> laws{};
  std::vector<Real> angle{};
  bool fails_with_all = false;  ///< FAILOPT 1: not by the points that can fail alone
  bool faulty = false;          ///< its material has a law, and faults that are reported
  DistortedShells distorted = DistortedShells::stay;
  bool thins_by_flow = false;  ///< ISTUPD 4: with `control.thins`
  ShellControl control;
  bool full = false;              ///< ELFORM 16: 2 x 2 points in the plane of quadrilaterals
  std::vector<Real> zeta, share;  ///< points through the thickness: height over half of it, weight (sum 1)
  Real marea = 0;                 ///< mass per area besides that of the law [M/L2]
  int contact_plane = 0;          ///< CNTCO
  Real nloc = 0;                  ///< NLOC: height of the nodes over the middle, over half the thickness
  Real rotary_scale = 1;          ///< ROTASCL
  Real warp_warning = 20;         ///< WRPANG [degrees]
  /// Of shells with layers of their own what those are made of; each with its index into Model::layups.
  std::vector<ShellPart> layups{};
  Index layup = -1;
  /// What a group of shells is made of: this for -1, else one of `layups`.
  const ShellPart& of(Index layup) const;
  const StrengthLaw& law_of(std::size_t layer) const { return laws.empty() ? *law : *laws[layer]; }
  bool has_axes() const;  ///< some law has directions
  Real density() const;   ///< mean over the thickness [M/L3]
};

/// Young's modulus and Poisson's ratio of a law at rest. [M/LT2], [-]
struct ElasticConstants {
  Real E = 0, nu = 0;
};
ElasticConstants elastic_constants(const StrengthLaw& law);
/// With the means of bulk and shear modulus over the thickness.
ElasticConstants elastic_constants(const ShellPart& part);

/// The axes of a shell as columns: e1 along side 1-2, or by INN 2 (`invariant`) between its middles; e3
/// normal.
Matrix shell_axes(const std::array<Vec, 4>& x, int corners, bool invariant);

/// Cosine and sine of the angle between e1 and the direction a of each layer: of layer k at 2 k and 2 k + 1.
/// Only of parts with directions; `build_shells` fills it. [-]
Field<Real>& layer_directions_of(const ElementGroup& group, std::size_t layers);

/// Points of Gauss (1 to 10), or of Lobatto (3 to 10), on [-1, 1], ascending; the weights sum up to 1.
void gauss_points(int count, std::vector<Real>& zeta, std::vector<Real>& weight);
void lobatto_points(int count, std::vector<Real>& zeta, std::vector<Real>& weight);

/// The law and the options of each part with shells whose material is not rigid. Materials that shells cannot
/// have, and options and formulations that are not there, are errors; a missing material is none here.
std::vector<ShellPart> find_shell_parts(const Deck& deck, const Model& model, Diagnostics& diagnostics);

/// Adds groups of elements, and the rotations of their nodes (state/shared_fields.hpp) with their inertia.
/// The masses of the nodes are build_segments' business. `node_of`: the node of the world of each node of the
/// model; world.segments must be in the order of Model::shells. Warns of warped shells.
void build_shells(const Model& model, const std::vector<ShellPart>& parts, const std::vector<Index>& node_of,
                  World& world, Diagnostics& diagnostics);

/// Rotary inertia that an element has for each of its corners; `build_shells` fills it. [ML2]
Field<Real>& corner_inertia_of(const ElementGroup& group);

/// Stress at the points of shells, in the axes of the element, zz = 0 left out. Point p is layer p % layers
/// at position p / layers in the plane. [M/LT2]
Field<Real>& layer_stress_of(const ElementGroup& group, int points);
/// Where component k of point p is there: xx yy xy yz zx, k = 0, 1, 3, 4, 5.
constexpr int at_layer(int point, int k) {
  return 5 * point + k - (k > 2);
}
/// A number or tensor that the law of point p keeps.
Field<Real>& layer_history_of(const ElementGroup& group, const HistoryVariable& kind, int point);
Field<Real>& thickness_of_shells(const ElementGroup& group);  ///< [L]
/// Height of the middle surface over the nodes along the normal, over half the thickness, with which it grows
/// and shrinks; null: it is where the nodes are. `build_shells` fills it. [-]
Field<Real>* offset_of_shells(const ElementGroup& group);
/// Tells histories of the shells of a group, which `part` are made of, and, where they are `shown`, the field
/// files.
std::shared_ptr<Pass> make_shell_report(const ShellPart& part, const ElementGroup& group, bool shown,
                                        bool strains);

/// Adds the forces of shells to the passes of `world`. Computes the largest frequency of each group, which
/// bounds the step.
void add_shell_passes(const Model& model, const std::vector<ShellPart>& parts,
                      const std::vector<Index>& node_of, ElementOptions& options, World& world);

}  // namespace courant
