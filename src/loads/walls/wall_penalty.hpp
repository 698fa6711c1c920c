#pragma once
// Rigid walls against rigid bodies: springs between a wall and nodes of the bodies.
#include <functional>
#include <vector>

#include "loads/walls/wall_shape.hpp"
#include "state/restartable.hpp"
#include "state/wall_bodies.hpp"
#include "state/world.hpp"

namespace courant {

/// A node of a rigid body that a wall pushes.
struct BodyNode {
  Index node = 0;  ///< of World::nodes
  Index body = 0;  ///< of WallBodies
};

/// How much of a wall's penalty there is for rigid bodies.
struct RigidWallPenalty {
  WallBodies bodies{};
  Real scale = 0;             ///< |RWPNAL| of *CONTROL_CONTACT; 0: bodies go through [-]
  bool of_all_nodes = false;  ///< RWPNAL < 0: also requested for nodes that deform
};

/// The springs of one wall: k d at each node, d its depth behind the surface, along the normal. All of a body
/// have the same k = s / (S dt^2): s the scale, S the trace of what unit forces at all of these nodes do to
/// it, dt the step in which it first touches the wall. However many nodes touch, no frequency of the body on
/// its springs is above sqrt(s)/dt, so that explicit steps are stable up to 2/sqrt(s) dt. Nodes behind the
/// wall at the start get no deeper, but are not pushed back.
class WallPenalty {
 public:
  /// Largest scale for which steps a little longer than the first are stable. [-]
  static constexpr Real most_scale = 3;

  WallPenalty() = default;
  WallPenalty(std::vector<BodyNode> nodes, WallBodies bodies, Real scale);
  bool empty() const { return nodes_.empty(); }
  /// False where all motion of the body is prescribed or held.
  bool gives(Index body, const World& world) const { return mobility(body, world) > 0; }

  /// The wall in a step.
  struct Wall {
    const WallShape* shape = nullptr;
    Vec moved = Vec::Zero();  ///< since t = 0 [L]
    Vec v = Vec::Zero();      ///< [L/T]
    /// Force against `slip` on a mass at a position with this normal, where the wall pushes with `push`;
    /// empty: none. [ML/T2]
    std::function<Vec(const Vec& n, const Vec& slip, Real push, Real mass, Real dt)> friction{};
  };
  /// Pushes the bodies, after forces are summed and dt is known.
  void push(const World& world, const Clock& clock, const Wall& wall);
  /// The wall acts no longer, or not yet. Returns what the springs held. [ML2/T2]
  Real release();

  const Vec& force() const { return force_; }  ///< on the wall [ML/T2]
  Real normal() const { return normal_; }      ///< with which all nodes push the wall [ML/T2]
  Real stored() const { return stored_; }      ///< in the springs at t^n [ML2/T2]
  /// What friction takes over the step, the wall moving with v. [ML2/T2]
  Real friction_loss(const World& world, const Clock& clock, const Vec& v) const;
  Real longest_step() const { return longest_; }  ///< infinity where nothing has touched it [T]
  void keep(Archive& archive);

 private:
  enum State : char { outside, touching, beside, unknown };
  struct Rub {
    std::size_t k = 0;
    Vec force = Vec::Zero();
  };
  Real mobility(Index body, const World& world) const;
  Real stiffness_of(Index body, const World& world, Real dt);
  /// Where nodes are against the surface.
  void look(const World& world, const Wall& wall);
  void rub(const World& world, const Clock& clock, const Wall& wall, std::size_t k, Real push);

  std::vector<BodyNode> nodes_;
  WallBodies bodies_;
  Real scale_ = 0;
  std::vector<WallShape::Near> near_;  ///< of each node
  std::vector<Rub> rubs_;
  std::vector<char> state_;
  std::vector<Real> allowed_;    ///< depth that pushes nothing [L]
  std::vector<Real> stiffness_;  ///< of the nodes of each body; 0: not chosen yet [M/T2]
  Vec force_ = Vec::Zero();
  Real normal_ = 0, stored_ = 0, longest_;
};

}  // namespace courant
