#pragma once
// Nodes that springs hold at the positions of faces to which they are tied.
#include <memory>
#include <string>
#include <vector>

#include "contact/tied/cohesive.hpp"
#include "contact/tied/ties.hpp"
#include "state/reports.hpp"
#include "state/restartable.hpp"
#include "state/wall_bodies.hpp"
#include "state/world.hpp"

namespace courant {

/// When a spring breaks: (max(f_n, 0)/normal)^n + (|f_t|/shear)^m >= 1, of forces, or of forces over the area
/// of the node; never where `normal` is 0. [ML/T2], or [M/LT2]
struct TieStrength {
  Real normal = 0, shear = 0;
  Real n = 2, m = 2;  ///< [-]
  bool stress = true;
  /// Where > 0, the force falls straight from there to nothing at this distance, and on a straight line to
  /// zero where the distance falls again. [L]
  Real opening = 0;
  bool breaks() const { return normal > 0; }
};

struct TiedSpringsLaw {
  Id id = 0;
  std::string title;
  TieStrength strength{};
  CohesiveLaw cohesive{};  ///< where it holds, instead of Tie::k and `strength`
  Real death = 1e20;       ///< from then on none holds [T]
};

/// What else may be tied, each node once, where it comes to touch.
struct LaterTies {
  Id contact = 0;  ///< which reports
  std::vector<TieNode> nodes{};
  std::vector<TieFace> faces{};
  Real scale = 1;  ///< of Tie::k
  Real tssfac = 0.9;
  WallBodies bodies{};
};

/// Adds springs of stiffness Tie::k between nodes and their positions on faces. A spring ends with its face,
/// too; what it stores then is dissipated.
void add_springs(TiedSpringsLaw law, std::vector<Tie> ties, World& world);
/// With others that come later.
void add_springs(TiedSpringsLaw law, std::vector<Tie> ties, LaterTies later, World& world);
/// Keeps the step below what all springs of the scene together ask for. `tssfac`: what elements take of their
/// own step. [-]
void add_spring_limit(const std::vector<Tie>& ties, Real tssfac, const WallBodies& bodies, World& world);

}  // namespace courant
