#pragma once
// Springs, dampers and lumped masses in the world: a group of springs for each part, one of all masses.
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "laws/discrete/spring_law.hpp"
#include "state/wall_bodies.hpp"
#include "state/world.hpp"

namespace courant {

/// Springs and dampers of a part; vectors by element.
struct SpringPart {
  ElementGroup* group = nullptr;
  std::shared_ptr<SpringLaw> law;
  bool turns = false;                 ///< torsional
  Real kd = 0, v0 = 0;                ///< of *SECTION_DISCRETE: force times 1 + kd |rate|/v0
  std::vector<Real> scale;            ///< S
  std::vector<Vec> along;             ///< unit vector of VID; 0: along the line between the ends
  std::vector<Vec> ground;            ///< position of the second end, if that is the ground
  std::vector<char> grounded, shown;  ///< N2 is 0; in deforc
};

/// > 0: longer than at rest, at the start OFFSET; of torsional ones an angle. [L]
Field<Real>& stretch_of(const SpringPart& part);

/// Nodes of springs and masses, indices into Model::nodes.
std::vector<Index> discrete_nodes(const Deck& deck, const Model& model);

/// Adds the groups, and the masses to world.nodes. `node_of`: the node of the world of each node of the
/// model. Refuses by name: nodes of particles, springs whose ends coincide, parts without a section or law.
std::vector<SpringPart> build_discrete(const Deck& deck, const Model& model,
                                       const std::vector<Index>& node_of, World& world,
                                       Diagnostics& diagnostics);

/// *ELEMENT_MASS_PART and _SET: adds a group of masses, and these to world.nodes, once elements that deform
/// are there. Refuses by name: particles, beams, rigid parts, masses that would fall.
void add_part_masses(const Deck& deck, const Model& model, World& world, Diagnostics& diagnostics);

/// Mass of a node that has none and is held, so that forces over it are numbers. [M]
inline constexpr Real mass_of_held = 1e-200;

/// Adds the forces of springs to the passes of `world`, once bodies and masses are there. `bodies`: that ends
/// belong to. `longest`: a step
/// that is taken where springs ask for none. Torsional springs on nodes that do not turn are refused.
void add_discrete_passes(const Deck& deck, std::vector<SpringPart> parts, WallBodies bodies, Real tssfac,
                         Real longest, World& world, Diagnostics& diagnostics);

/// A spring or damper at t^n.
struct SpringForce {
  Id id = 0;
  bool turns = false;
  Vec force = Vec::Zero();          ///< on its first end; of torsional ones a moment [ML/T2], [ML2/T2]
  Real resultant = 0, stretch = 0;  ///< > 0 in tension [ML/T2], [L]
};
struct SpringReporter {
  virtual ~SpringReporter() = default;
  /// Those that deforc shows.
  virtual void report_springs(std::vector<SpringForce>& out) const = 0;
  /// That with this id, shown or not; nothing where there is none.
  virtual std::optional<SpringForce> find_spring(Id id) const = 0;
  /// All of the part, shown or not.
  virtual const ElementGroup& spring_group() const = 0;
  virtual SpringForce spring(Index e) const = 0;
};

}  // namespace courant
