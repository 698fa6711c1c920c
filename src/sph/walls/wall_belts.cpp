// *COURANT_WALL_BELT: how it is read, and what is refused of it.
#include "sph/walls/wall_belts.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "keyword/registry.hpp"
#include "model/definitions/named_curve.hpp"
#include "model/mesh/named_parts.hpp"
#include "sph/sph.hpp"
#include "sph/walls/wall_surface.hpp"

namespace courant {

namespace {

using B = CourantWallBelt;
const RegisterKeyword<CourantWallBelt> wall_belt_keyword{courant_wall_belt_table()};

class BeltReader {
 public:
  BeltReader(const Deck& deck, const Model& model, const World& world, SphSettings& settings,
             Diagnostics& diagnostics)
      : deck_(deck), model_(model), world_(world), walls_(settings.walls), diagnostics_(diagnostics) {
    walls_.belts.of_segment.assign(static_cast<std::size_t>(world.segments.size()), -1);
  }

  void add(const B& c) {
    WallBelts::Belt belt{.motion = {Vec(c.xc, c.yc, c.zc), Vec(c.vx, c.vy, c.vz), Vec(c.wx, c.wy, c.wz)},
                         .sf = c.sf};
    if (c.lcid != 0) {
      const Curve* curve = curve_named(deck_, model_, c, "LCID", c.lcid, diagnostics_);
      if (!curve) return;
      belt.curve = *curve;
    }
    if (belt.motion.v.isZero(0) && belt.motion.omega.isZero(0))
      return error(c, "VX", "the surface has no velocity", "give VX, VY, VZ, or a turn WX, WY, WZ on card 2");
    if (world_.dim == 2 && (c.vz != 0 || c.wx != 0 || c.wy != 0))
      return error(c,
                   c.vz != 0   ? "VZ"
                   : c.wx != 0 ? "WX"
                               : "WY",
                   "in 2D surfaces move in the plane x, y", "give VX and VY, or a turn WZ");
    const auto chosen = shell_parts_named(deck_, model_, c, "SURFB", c.surfb, c.surfbtyp, diagnostics_);
    bool smooth = false;
    across_ = 0, shells_across_ = 0;
    for (Index s = 0; s < world_.segments.size(); ++s) {
      if (!chosen[static_cast<std::size_t>(world_.segments.part[s])]) continue;
      if (!take(c, s, belt)) return;
      const WallFriction& wall = walls_.friction[static_cast<std::size_t>(s)];
      smooth |= !wall.rubs() && !wall.no_slip;
    }
    walls_.belts.belts.push_back(belt);
    if (smooth)
      diagnostics_.warning(deck_.where(c),
                           "*COURANT_WALL_BELT: the shells are smooth, so "
                           "water does not notice that their "
                           "surface moves",
                           "give CF, LAW 1 or LAW 2 in *COURANT_WALL_SUPPORT");
    if (across_ > least_across)
      diagnostics_.warning(deck_.where(c),
                           fmt::format("*COURANT_WALL_BELT: up to {:.2g} of its velocity is "
                                       "across its shells, on {} of them, "
                                       "and is left out: the surface moves along itself",
                                       across_, shells_across_),
                           "give a velocity along the shells, or move them by "
                           "*BOUNDARY_PRESCRIBED_MOTION_RIGID");
  }

 private:
  static constexpr Real least_across = 0.01;  ///< of the velocity: what directions in decks are rounded by

  void error(const B& c, const char* field, const std::string& what, const char* hint) {
    deck_.error(diagnostics_, c, field, what, hint);
  }
  Id part_id(Index segment) const {
    return model_.parts[static_cast<std::size_t>(world_.segments.part[segment])].id;
  }
  bool take(const B& c, Index s, const WallBelts::Belt& belt) {
    const auto k = static_cast<std::size_t>(s);
    const auto refuse = [&](const char* what, const char* hint) {
      error(c, "SURFB", fmt::format("the shells of part {} {}", part_id(s), what), hint);
      return false;
    };
    if (walls_.friction[k].cf < 0)
      return refuse("do not support particles", "name them by *COURANT_WALL_SUPPORT");
    if (walls_.belts.of_segment[k] >= 0)
      return refuse("belong to another *COURANT_WALL_BELT", "name each part by one card");
    if (segment_moves(world_, s))
      return refuse("move themselves, and the shells of this keyword are fixed",
                    "hold them by CON1 and CON2 of *MAT_RIGID, or omit *COURANT_WALL_BELT");
    walls_.belts.of_segment[k] = static_cast<int>(walls_.belts.belts.size());
    const auto node = world_.segments.nodes(s);
    Vec middle = Vec::Zero();
    for (const Index n : node) middle += 0.25 * world_.nodes.x.vec(n);
    if (node[3] == node[2])
      middle = (world_.nodes.x.vec(node[0]) + world_.nodes.x.vec(node[1]) + world_.nodes.x.vec(node[2])) / 3;
    const Vec n = (world_.nodes.x.vec(node[2]) - world_.nodes.x.vec(node[0]))
                      .cross(world_.nodes.x.vec(node[3]) - world_.nodes.x.vec(node[1]))
                      .normalized();
    const Vec u = belt.motion.at(middle);
    if (const Real across = std::abs(u.dot(n)); across > least_across * u.norm())
      across_ = std::max(across_, across / u.norm()), ++shells_across_;
    return true;
  }

  const Deck& deck_;
  const Model& model_;
  const World& world_;
  SupportedWalls& walls_;
  Diagnostics& diagnostics_;
  Real across_ = 0;  ///< largest share of a velocity
  Index shells_across_ = 0;
};

}  // namespace

/// A turn has a sense that a mirror would change, and a rate that says nothing of stretched positions.
std::string keep_turn(CourantWallBelt& card, const Affine& motion) {
  const bool turns = card.wx != 0 || card.wy != 0 || card.wz != 0;
  const Matrix a = motion.linear();
  if (!turns || (a.determinant() > 0 && (a.transpose() * a).isIdentity(1e-9))) return {};
  return "a rotating surface can be moved and rotated, but not stretched or "
         "mirrored";
}

void read_wall_belts(const Deck& deck, const Model& model, const World& world, SphSettings& settings,
                     Diagnostics& diagnostics) {
  const auto& cards = deck.all<CourantWallBelt>();
  if (cards.empty()) return;
  const auto* turbulence = deck.last<CourantTurbulence>();
  if (turbulence && static_cast<TurbulenceModel>(turbulence->model) == TurbulenceModel::k_epsilon)
    return deck.error(diagnostics, cards.front(), "SURFB",
                      "k-epsilon takes the law of the wall from the velocity of the shells, "
                      "not of moving surfaces",
                      "use another MODEL of *COURANT_TURBULENCE, or omit *COURANT_WALL_BELT");
  BeltReader reader(deck, model, world, settings, diagnostics);
  for (const CourantWallBelt& c : cards) reader.add(c);
  if (settings.walls.belts.belts.empty()) settings.walls.belts.of_segment.clear();
}

}  // namespace courant
