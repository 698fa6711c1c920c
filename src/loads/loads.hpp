#pragma once
// Loads and constraints for all that moves: each is one file, written once for Points. `points`: particles
// while they are in the order of the model, or nodes.
#include <algorithm>
#include <array>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "extension/left_out.hpp"
#include "keyword/deck.hpp"
#include "loads/body_acceleration.hpp"
#include "loads/walls/wall_penalty.hpp"
#include "model/conditions/prescribed_motion.hpp"
#include "model/model.hpp"
#include "search/neighbours.hpp"
#include "state/points.hpp"
#include "state/wall_bodies.hpp"
#include "state/world.hpp"

namespace courant {

/// Those on which loads act: active particles, all nodes.
inline Index loaded_points(const Points& points, const World& world) {
  return points.set == &world.particles.fields ? world.particles.active : points.set->size();
}

/// Of each point of the world, an index into Model::nodes.
std::vector<Index> model_nodes(const Model& model, const World& world, const Points& points);

/// m a of the body loads, and their energy. `neighbours`: of particles, states which of them come and go;
/// null for nodes.
std::shared_ptr<Force> make_body_load(BodyAcceleration acceleration, Points points, World& world,
                                      std::shared_ptr<Neighbours> neighbours = nullptr);

/// BOUNDARY_SPC and TC of *NODE. nullptr where no point is fixed, or only such as follow a rigid body.
/// `measured`: reactions are reported also where *DATABASE_SPCFORC does not ask.
std::shared_ptr<Constraint> make_fixed_points(const Model& model, Points points, World& world,
                                              bool measured = false);

/// What prescribed motions of points have to respect.
struct MotionLimits {
  int dim = 3;
  bool boxed = false;          ///< particles are in a computational box, outside of which nothing is driven
  std::vector<Vec> mirrors{};  ///< normals of symmetry planes
};
/// Adds the passes that move particles and nodes as *BOUNDARY_PRESCRIBED_MOTION_NODE and _SET ask; false if
/// none is driven. Refuses by name: nodes that are neither particles nor move by their forces, directions
/// that are held or driven twice, motions out of the plane of a 2D scene or across a mirror, and a
/// computational box.
bool add_prescribed_points(const std::vector<PrescribedMotion>& motions, const Deck& deck, const Model& model,
                           const MotionLimits& limits, World& world, Diagnostics& diagnostics);

/// One direction of one *LOAD_NODE_POINT or _SET.
struct NodalLoad {
  Vec direction = Vec::Zero();  ///< unit
  Curve curve{};                ///< of time
  Real sf = 1;                  ///< SF curve(t): force on each node [ML/T2]
  std::vector<Index> nodes{};   ///< indices into Model::nodes
  Entry card{};                 ///< for messages
  bool turns = false;           ///< a moment about `direction`, on rotations [ML2/T2]
  /// Of World::nodes: it acts along their normal, wherever they go; nothing: along `direction`.
  std::optional<std::array<Index, 3>> follows{};
};
/// Refuses by name: follower loads, moments where nothing turns, systems that move, nodes that are neither
/// particles nor move by their forces.
std::vector<NodalLoad> nodal_loads(const Deck& deck, const Model& model, const World& world,
                                   Diagnostics& diagnostics);
/// nullptr where none acts on these points.
std::shared_ptr<Force> make_nodal_loads(const std::vector<NodalLoad>& loads, const Model& model,
                                        Points points, World& world);

/// *LOAD_SEGMENT and _SET: pressure on faces between nodes; nullptr where there is none. `bodies`: whose
/// nodes it may push. Refuses by name: faces whose corners belong to no element.
std::shared_ptr<Force> make_segment_pressure(const Deck& deck, const Model& model, const WallBodies& bodies,
                                             World& world, Diagnostics& diagnostics);

/// *DAMPING_GLOBAL and *DAMPING_PART_MASS: what they take of the velocity.
struct Damping {
  Curve curve{};  ///< of time; empty: constant
  Real sf = 0;    ///< SF curve(t), or SF alone: the damping constant [1/T]
  Vec scale = Vec::Ones(), turn_scale = Vec::Ones();  ///< of the axes, of rotations about them
  std::vector<Index> parts{};                         ///< sorted; empty: all
  Real at(Real t) const { return curve.abscissa.empty() ? sf : sf * curve(t); }
  bool acts_on(Index part) const {
    return parts.empty() || std::binary_search(parts.begin(), parts.end(), part);
  }
};
/// Refuses by name: parts that are named twice, constants below 0.
std::vector<Damping> damping_of(const Deck& deck, const Model& model, const World& world,
                                Diagnostics& diagnostics);
/// f -= c m v, with the v of the middle of the kick. nullptr where there is none.
std::shared_ptr<Constraint> make_damping(std::vector<Damping> damping, Points points, World& world);

/// What acts on points, as the cards say.
struct PointLoads {
  std::vector<NodalLoad> nodal{};
  std::vector<Damping> damping{};
  Real relaxation_factor = 1;  ///< DRFCTR
};
/// Adds nodal forces, SPC and damping of points to the passes of `world`. `left_out`: gets a note for those
/// that the deck does not ask for; null: it does not matter.
void add_loads(const Points& points, const Deck& deck, const Model& model, const PointLoads& loads,
               World& world, LeftOut* left_out);

/// Of a relaxation: velocities times a factor in each step.
std::shared_ptr<Drive> make_slow_points(Points points, Real factor);

/// *RIGIDWALL_PLANAR and _GEOMETRIC: adds a pass for each wall, which holds particles and nodes of deformable
/// elements, and pushes rigid bodies by `penalty`; false if there is none. Behind add_prescribed_points.
/// Refuses by name: sets, boxes and curves that are not there, normals, edges and motions without a direction
/// or, in 2D, out of the plane, other kinds of friction, displacements that jump or do not begin with 0.
bool add_rigid_walls(const Deck& deck, const Model& model, const RigidWallPenalty& penalty, World& world,
                     Diagnostics& diagnostics);

/// Whether there is a rigid wall.
struct RigidWallsThere {
  bool any = false;
};

}  // namespace courant
