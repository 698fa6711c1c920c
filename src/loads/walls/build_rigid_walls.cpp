// *RIGIDWALL_PLANAR and *RIGIDWALL_GEOMETRIC: what their cards mean.
#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <limits>
#include <set>
#include <tuple>
#include <utility>

#include <fmt/format.h>

#include "loads/loads.hpp"
#include "loads/walls/rigid_wall.hpp"
#include "loads/walls/rigid_wall_card.hpp"
#include "model/definitions/named_curve.hpp"
#include "state/shared_fields.hpp"

namespace courant {

namespace {

class RigidWallReader {
 public:
  RigidWallReader(const Deck& deck, const Model& model, const RigidWallPenalty& penalty, World& world,
                  Diagnostics& diagnostics)
      : deck_(deck), model_(model), penalty_(penalty), world_(world), diagnostics_(diagnostics) {
    for (const RigidWallPlanar& card : deck.all<RigidWallPlanar>()) taken_.insert(card.id);
    for (const RigidWallOrtho& card : deck.all<RigidWallOrtho>()) taken_.insert(card.id);
    for (const RigidWallGeometric& card : deck.all<RigidWallGeometric>()) taken_.insert(card.id);
  }

  void add(const RigidWallPlanar& card) {
    RigidWallSetup wall = start(card);
    if (read_plane(card, wall) && read_friction(card, wall, true)) choose_points(card, std::move(wall));
  }
  void add(const RigidWallOrtho& card) {
    RigidWallSetup wall = start(card);
    if (read_plane(card, wall) && read_ortho(card, wall)) choose_points(card, std::move(wall));
  }
  void add(const RigidWallGeometric& card) {
    RigidWallSetup wall = start(card);
    if (!read_shape(card, wall) || !read_friction(card, wall, false) ||
        (card.moves() && !read_motion(card, wall)))
      return;
    choose_points(card, std::move(wall));
  }
  /// Adds the passes; false: there is no wall.
  bool finish() {
    if (walls_.empty()) return false;
    add_wall_passes(std::move(walls_), world_);
    return true;
  }

 private:
  struct Count {
    Index held = 0, behind = 0, driven = 0, rigid = 0, tied = 0;
    Real deepest = 0;
    Id driven_id = 0, rigid_id = 0, tied_id = 0;
    std::vector<BodyNode> bodies{};  ///< that the wall pushes
    void see(Real gap, const Vec& x, const Vec& tail) {
      constexpr Real round_off = 1e-9;
      if (gap < -round_off * (x.norm() + tail.norm())) ++behind, deepest = std::max(deepest, -gap);
    }
  };

  RigidWallSetup start(const RigidWallCard& card) {
    ++number_;
    return {.id = card.id > 0 ? card.id : free_id(),
            .title = card.title,
            .shape = {.tail = card.tail()},
            .birth = card.birth,
            .death = card.death,
            .body_stiffness = card.rwksf};
  }

  void choose_points(const RigidWallCard& card, RigidWallSetup wall) {
    if (!read_nodes(card)) return;
    std::vector<HeldPoints> sets;
    Count count;
    for (const Points& points : {points_of(world_.particles), points_of(world_.nodes)}) {
      auto& state = points.set->add<Index>({.name = fmt::format("rigid_wall_{}", number_), .dimension = "-"});
      auto& push = points.set->add<Real>({.name = fmt::format("rigid_wall_{}_push", number_),
                                          .dimension = "ML/T2",
                                          .components = 3,
                                          .restart = false});
      choose(card, wall.shape, points, state, count);
      sets.push_back({points, state, push});
    }
    WallPenalty bodies(std::move(count.bodies), penalty_.bodies, penalty_.scale * wall.body_stiffness);
    warn(card, wall, count, bodies);
    if (diagnostics_.ok()) walls_.push_back({std::move(wall), std::move(sets), std::move(bodies)});
  }

  /// Its number in the deck, unless another wall has that as its id.
  Id free_id() {
    Id id = number_;
    while (!taken_.insert(id).second) ++id;
    return id;
  }

  bool error(const Entry& card, const char* field, std::string message, std::string hint) {
    deck_.error(diagnostics_, card, field, std::move(message), std::move(hint));
    return false;
  }

  /// The normal of a plane or of a prism's face, or the axis of a cylinder.
  bool read_normal(const RigidWallCard& card, RigidWallSetup& wall) {
    const Vec normal = card.head() - card.tail();
    if (!(normal.norm() > 0))
      return error(card, "XH", "tail and head of the normal are the same point",
                   "give a head on the side of what the wall holds");
    wall.shape.axes.col(2) = normal.normalized();
    wall.shape.axes.col(0) = wall.shape.n().unitOrthogonal();
    wall.shape.axes.col(1) = wall.shape.n().cross(Vec(wall.shape.axes.col(0)));
    if (world_.dim == 2 && wall.shape.kind == WallShape::Kind::plane && wall.shape.n()[2] != 0)
      return error(card, "ZH", "in 2D nothing moves along z, as the normal of the wall would ask for",
                   "give head and tail the same z");
    return true;
  }

  bool read_plane(const RigidWallPlanar& card, RigidWallSetup& wall) {
    wall.mass = card.mass, wall.speed = card.moving() ? card.v0 : 0, wall.weld_speed = card.wvel;
    return read_normal(card, wall) && (!card.finite() || read_edge(card, wall));
  }

  bool read_edge(const RigidWallCard& card, RigidWallSetup& wall) {
    const Vec n = wall.shape.n(), edge = card.edge() - card.tail();
    const Vec along = edge - edge.dot(n) * n;
    constexpr Real least_sine = 1e-6;
    if (!(along.norm() > least_sine * edge.norm()))
      return error(card, "XHEV", "the edge of the wall has no direction in its plane",
                   "give a head of the edge that is neither the tail nor on the normal");
    wall.shape.axes.col(0) = along.normalized(), wall.shape.axes.col(1) = n.cross(along.normalized());
    wall.shape.length = {card.lenl, card.lenm, 0};
    return true;
  }

  bool read_shape(const RigidWallGeometric& card, RigidWallSetup& wall) {
    using Kind = WallShape::Kind;
    constexpr std::array kinds{Kind::plane, Kind::prism, Kind::cylinder, Kind::sphere};
    WallShape& shape = wall.shape;
    shape.kind = kinds[static_cast<std::size_t>(card.shape())];
    if (shape.kind == Kind::sphere) {
      shape.radius = card.radsph;
    } else {
      if (!read_normal(card, wall) || ((card.lenl > 0 || card.lenm > 0) && !read_edge(card, wall)))
        return false;
      if (shape.kind == Kind::prism) shape.length[2] = card.lenp;
      if (shape.kind == Kind::cylinder) shape.radius = card.radcyl, shape.length[2] = card.lencyl;
    }
    if (card.nsegs > 0)
      return error(card, "NSEGS", "forces on sections of the cylinder are not supported",
                   "leave the field and the card behind this one out");
    constexpr Real round_off = 1e-12;
    const bool along_z = shape.kind == Kind::cylinder && shape.length[2] == 0 &&
                         std::hypot(shape.n()[0], shape.n()[1]) < round_off;
    if (world_.dim == 2 && shape.kind != Kind::plane && !along_z)
      return error(card, "XT", "in 2D nothing moves along z, as this wall would push",
                   "use _FLAT, or _CYLINDER along z with LENCYL 0");
    return true;
  }

  bool read_motion(const RigidWallGeometric& card, RigidWallSetup& wall) {
    const Curve* curve = curve_named(deck_, model_, card, "LCID", card.lcid, diagnostics_);
    if (!curve) return false;
    const Vec direction(card.vx, card.vy, card.vz);
    if (!(direction.norm() > 0))
      return error(card, "VX", "the motion has no direction", "give VX, VY, VZ a length above 0");
    if (world_.dim == 2 && direction[2] != 0)
      return error(card, "VZ", "in 2D nothing moves along z", "leave VZ 0");
    if (card.opt == 1 && (*curve)(0) != 0)
      return error(card, "LCID", fmt::format("the displacement is {:g} at t = 0", (*curve)(0)),
                   "begin with 0, and give the wall its first position on card 2");
    const auto& x = curve->abscissa;
    if (card.opt == 1 && std::adjacent_find(x.begin(), x.end(), std::greater_equal<>()) != x.end())
      return error(card, "LCID", "the displacement jumps", "give the points of the curve increasing times");
    using Motion = PrescribedMotion;
    Motion& motion = wall.motion.emplace();
    motion.kind = card.opt == 1 ? Motion::Kind::displacement : Motion::Kind::velocity;
    motion.direction = direction.normalized(), motion.curve = *curve, motion.card = card;
    return true;
  }

  /// `may_weld`: 2 and 3 are welds.
  bool read_friction(const RigidWallCard& card, RigidWallSetup& wall, bool may_weld) {
    wall.welds = may_weld && (card.fric == 2 || card.fric == 3);
    if (!wall.welds && card.fric > 1)
      return error(card, "FRIC",
                   fmt::format("expected a number from 0 to 1{}, got '{:g}'", may_weld ? ", or 2 or 3" : "",
                               card.fric),
                   may_weld ? "0 slides, up to 1 is Coulomb's coefficient, 1 does not slide, 2 and 3 weld"
                            : "0 slides, up to 1 is Coulomb's coefficient, 1 does not slide");
    const bool sticks = card.fric == 1 || card.fric == 3;
    wall.friction = sticks ? std::numeric_limits<Real>::infinity() : wall.welds ? 0 : card.fric;
    return true;
  }

  bool read_ortho(const RigidWallOrtho& card, RigidWallSetup& wall) {
    if (card.fric != 0)
      return error(card, "FRIC", fmt::format("'{:g}' is given with the friction of _ORTHO", card.fric),
                   "leave it 0, or leave out _ORTHO");
    OrthoFriction& friction = wall.ortho.emplace();
    friction.at_rest = {card.sfrica, card.sfricb}, friction.sliding = {card.dfrica, card.dfricb};
    friction.decay = {card.decaya, card.decayb};
    friction.d = Vec(card.d1, card.d2, card.d3);
    if ((card.node1 > 0 || card.node2 > 0) && !read_ortho_nodes(card, wall)) return false;
    const Vec n = wall.shape.n(), along = friction.d - friction.d.dot(n) * n;
    constexpr Real least_sine = 1e-6;
    if (!(along.norm() > least_sine * friction.d.norm()))
      return error(card, card.node1 > 0 ? "NODE1" : "D1",
                   "the direction a of friction has no length along the wall",
                   "give NODE1 and NODE2, or D1, D2, D3, not along the normal");
    return true;
  }
  bool read_ortho_nodes(const RigidWallOrtho& card, RigidWallSetup& wall) {
    std::array<Vec, 2> place;
    std::size_t k = 0;
    for (const auto& [field, id] : {std::pair("NODE1", card.node1), std::pair("NODE2", card.node2)}) {
      const auto of_id = [id = id](const ModelNode& node) { return node.id == id; };
      const auto node = std::find_if(model_.nodes.begin(), model_.nodes.end(), of_id);
      if (node == model_.nodes.end())
        return error(card, field, fmt::format("node {} does not exist", id), "define it with *NODE");
      const Index n = static_cast<Index>(node - model_.nodes.begin());
      if (std::any_of(model_.sph.begin(), model_.sph.end(), [n](const ModelSph& s) { return s.node == n; }))
        return error(card, field, fmt::format("node {} carries a particle", id),
                     "name nodes of elements, or give D1, D2, D3");
      place[k] = node->x;
      for (Index i = 0; i < world_.nodes.size(); ++i)  // one that is none of the world stays
        if (world_.nodes.id[i] == id) wall.ortho_nodes[k] = i;
      ++k;
    }
    wall.ortho->d = place[1] - place[0];
    if ((wall.ortho_nodes[0] < 0) != (wall.ortho_nodes[1] < 0))
      return error(card, "NODE1", "one of the two nodes moves with elements, and the other one with nothing",
                   "name two nodes of elements or bodies");
    return true;
  }

  /// Which of the model's nodes the sets and the box of a card name.
  bool read_nodes(const RigidWallCard& card) {
    chosen_.assign(model_.nodes.size(), card.nsid == 0 ? 1 : 0);
    for (const auto& [field, id, chosen] :
         {std::tuple("NSID", card.nsid, char(1)), std::tuple("NSIDEX", card.nsidex, char(0))}) {
      if (id == 0) continue;
      const auto set = model_.node_sets.find(id);
      if (set == model_.node_sets.end())
        return error(card, field, fmt::format("node set {} does not exist", id), "define it with *SET_NODE");
      for (const Index n : set->second) chosen_[static_cast<std::size_t>(n)] = chosen;
    }
    if (card.boxid == 0) return true;
    const auto box = model_.boxes.find(card.boxid);
    if (box == model_.boxes.end())
      return error(card, "BOXID", fmt::format("box {} does not exist", card.boxid),
                   "define it with *DEFINE_BOX");
    for (std::size_t n = 0; n < chosen_.size(); ++n)
      chosen_[n] = chosen_[n] && box->second.contains(model_.nodes[n].x);
    return true;
  }

  void choose(const RigidWallCard& card, const WallShape& shape, const Points& points, Field<Index>& state,
              Count& count) const {
    const std::vector<Index> node = model_nodes(model_, world_, points);
    const auto* driven = shared_fields::prescribed_motion.find(*points.set);
    const bool particles = points.set == &world_.particles.fields;
    for (Index i = 0; i < points.set->size(); ++i) {
      const Index n = node[static_cast<std::size_t>(i)];  // -1: not of the model, as particles of inlets
      state[i] = n >= 0 ? chosen_[static_cast<std::size_t>(n)] : card.nsid == 0 && card.boxid == 0;
      const Real gap = shape.nearest(points.x->vec(i)).gap;
      if (card.offset > 0 && std::abs(gap) > card.offset) state[i] = 0;
      if (state[i] == 0) continue;
      if (!particles && world_.nodes.follow[i]) {
        state[i] = 0;
        if (world_.nodes.follow[i] == 2) {  // a face moves it
          if (count.tied++ == 0) count.tied_id = world_.nodes.id[i];
        } else if (const Index body = penalty_.bodies.body(i); !world_.nodes.held[i]) {
          if (count.rigid++ == 0) count.rigid_id = world_.nodes.id[i];
          if (body < 0 || penalty_.scale == 0) continue;
          count.bodies.push_back({i, body});
          count.see(gap, points.x->vec(i), shape.tail);
        }
      } else {
        if (driven && (*driven)[i] != 0 && count.driven++ == 0) count.driven_id = (*points.id)[i];
        ++count.held;
        count.see(gap, points.x->vec(i), shape.tail);
      }
    }
  }

  void warn(const RigidWallCard& card, const RigidWallSetup& wall, const Count& count,
            const WallPenalty& bodies) {
    const WallShape& shape = wall.shape;
    warn_of_bodies(card, wall, count, bodies);
    if (count.tied > 0)
      deck_.warning(
          diagnostics_, card, "NSID",
          fmt::format("the wall does not hold {} nodes that are tied to faces, as {}: they go where the "
                      "faces go",
                      count.tied, count.tied_id),
          "leave them out by NSIDEX, or tie them by a contact with _OFFSET");
    if (count.driven > 0)
      deck_.warning(
          diagnostics_, card, "NSID",
          fmt::format("the wall does not hold {} points, as {}, while prescribed motions drive them "
                      "in a direction that is not along the wall",
                      count.driven, count.driven_id),
          "leave them out by NSIDEX, or end the motions by DEATH");
    if (count.behind > 0)
      deck_.warning(diagnostics_, card, "",
                    fmt::format("{} points start {} the wall, by up to {:.4g}: {}", count.behind,
                                shape.kind == WallShape::Kind::plane ? "behind" : "inside of", count.deepest,
                                shape.has_edges() ? "they are free until they come out"
                                                  : "they get no deeper, but are not pushed back"),
                    shape.kind == WallShape::Kind::plane
                        ? "turn the normal round, or leave them out by NSID, NSIDEX, BOXID or OFFSET"
                        : "move the wall, or leave them out by NSID, NSIDEX or BOXID");
    if (penalty_.of_all_nodes && count.held > 0)
      deck_.warning(
          diagnostics_, card, "",
          "RWPNAL of *CONTROL_CONTACT is below 0, which asks for a penalty of all nodes: nodes that "
          "deform are stopped at once instead, and do not bounce",
          "RWPNAL 1 says the same without this warning");
    if (count.held == 0 && bodies.empty())
      deck_.warning(diagnostics_, card, "", "the wall holds nothing", "name particles or nodes of solids");
  }
  void warn_of_bodies(const RigidWallCard& card, const RigidWallSetup& wall, const Count& count,
                      const WallPenalty& bodies) {
    if (count.rigid == 0) return;
    if (penalty_.scale * wall.body_stiffness == 0 || bodies.empty())
      return deck_.warning(
          diagnostics_, card, "NSID",
          fmt::format("the wall does not hold rigid bodies that can move: {} of their nodes go "
                      "through it, as node {}",
                      count.rigid, count.rigid_id),
          "RWPNAL 1 of *CONTROL_CONTACT lets walls push them; or leave them out by NSIDEX");
    if (!bodies.gives(penalty_.bodies.body(index_of(count.rigid_id)), world_))
      deck_.warning(diagnostics_, card, "NSID",
                    fmt::format("the wall does not hold rigid bodies whose motion is prescribed, as that of "
                                "node {}",
                                count.rigid_id),
                    "leave them out by NSIDEX");
    if (penalty_.scale * wall.body_stiffness > WallPenalty::most_scale)
      deck_.warning(
          diagnostics_, card, "",
          fmt::format("the penalty for rigid bodies, RWPNAL RWKSF = {:g}, is taken as {:g}: the step "
                      "allows no stiffer one",
                      penalty_.scale * wall.body_stiffness, WallPenalty::most_scale),
          "give RWPNAL of *CONTROL_CONTACT 1");
    if (wall.welds)
      deck_.warning(diagnostics_, card, "FRIC",
                    "the wall welds nodes that deform; rigid bodies bounce off it",
                    "leave them out by NSIDEX");
  }
  Index index_of(Id node) const {
    Index i = 0;
    while (i < world_.nodes.size() && world_.nodes.id[i] != node) ++i;
    return i;
  }

  const Deck& deck_;
  const Model& model_;
  const RigidWallPenalty& penalty_;
  World& world_;
  Diagnostics& diagnostics_;
  Id number_ = 0;
  std::set<Id> taken_;
  std::vector<char> chosen_;  ///< of the model's nodes
  std::vector<RigidWallAndPoints> walls_;
};

}  // namespace

bool add_rigid_walls(const Deck& deck, const Model& model, const RigidWallPenalty& penalty, World& world,
                     Diagnostics& diagnostics) {
  RigidWallReader reader(deck, model, penalty, world, diagnostics);
  for (const RigidWallPlanar& card : deck.all<RigidWallPlanar>()) reader.add(card);
  for (const RigidWallOrtho& card : deck.all<RigidWallOrtho>()) reader.add(card);
  for (const RigidWallGeometric& card : deck.all<RigidWallGeometric>()) reader.add(card);
  return diagnostics.ok() && reader.finish();
}

}  // namespace courant
