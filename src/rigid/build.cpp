#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <set>

#include "keyword/registry.hpp"
#include "model/mesh/part_inertia.hpp"
#include "model/transforms/transformation.hpp"
#include "rigid/body_cards.hpp"
#include "rigid/deformable_to_rigid.hpp"
#include "rigid/inertia.hpp"
#include "rigid/mat_rigid.hpp"
#include "rigid/rigid.hpp"
#include "surfaces/skin.hpp"

namespace courant {
namespace {

const MatRigid* find(const Deck& deck, Id mid) {
  for (const MatRigid& m : deck.all<MatRigid>())
    if (m.mid == mid) return &m;
  return nullptr;
}

/// Of a rigid part.
std::optional<MatRigid> material_of(const Deck& deck, const Model& model, Index part) {
  if (const MatRigid* m = find(deck, model.parts[static_cast<std::size_t>(part)].mid)) return *m;
  return switched_material(deck, model, part);
}

void read_constraints(const Deck& deck, const MatRigid& m, RigidBody& body, Diagnostics& diagnostics) {
  if (!(m.pr < 0.5))
    deck.error(diagnostics, m, "PR", fmt::format("expected a number < 0.5, got '{:g}'", m.pr),
               "the contact stiffness is E / (3 (1 - 2 PR)); 0.3 is steel");
  if (m.cmo == 0) return;  // CON1 and CON2 have no meaning then
  if (m.cmo != 1) {
    deck.error(diagnostics, m, "CMO",
               fmt::format("'{:g}' (a constraint along local axes or of a point) is not supported", m.cmo),
               "use CMO = 1 with CON1 and CON2 along the global axes");
    return;
  }
  const auto code = [&](const char* field, Real value) {
    if (value >= 0 && value <= 7 && value == std::floor(value)) return int(value);
    deck.error(diagnostics, m, field, fmt::format("expected a code 0 to 7, got '{:g}'", value),
               "7 holds all axes");
    return 0;
  };
  body.held = axes_of_code(code("CON1", m.con1));
  body.no_turn = axes_of_code(code("CON2", m.con2));
}

/// *COURANT_RIGID_INERTIA
struct RigidInertia : Entry {
  int lumped = 0;
};
const RegisterKeyword<RigidInertia> rigid_inertia{
    {.names = {"COURANT_RIGID_INERTIA"},
     .purpose = "where the mass of rigid bodies is",
     .once = true,
     .many = false,
     .cards = {{.fields = {{"LUMPED",
                            &RigidInertia::lumped,
                            "-",
                            "0: spread over the elements, 1: at their nodes, in equal shares",
                            {.allowed = {0, 1}}}}}}}};

/// Masses at the nodes of the body, in equal shares of each element.
MassIntegrals lumped(const RigidBody& b, const World& world) {
  const Nodes& nodes = world.nodes;
  MassIntegrals out{.origin = b.nodes.empty() ? Vec(Vec::Zero()) : nodes.x.vec(b.nodes.front())};
  for (const Index n : b.nodes) out.add_point(nodes.m[n], nodes.x.vec(n), nodes.v.vec(n));
  return out;
}

/// Over the shells of the body, which have one thickness and density, or its solids, and its nodes' shares of
/// deformable solids that are fixed to it. `total`: the mass of all of that [M].
MassIntegrals integrated(const RigidBody& b, const std::vector<SkinCell>& cells, Real total,
                         const World& world) {
  const Nodes& nodes = world.nodes;
  const Segments& g = world.segments;
  const Vec origin = nodes.x.vec(b.nodes.front());
  MassIntegrals solids{.origin = origin}, out{.origin = origin};
  const std::set<Index> mine(b.nodes.begin(), b.nodes.end());
  for (const auto& group : world.groups)
    for (int c = 0; c < group->corners(); ++c)
      for (Index e = 0; e < group->size(); ++e)
        if (const Index n = group->node.data(c)[e]; mine.contains(n))
          solids.add_point(group->mass[e] * group->share(e, c), nodes.x.vec(n), nodes.v.vec(n));
  for (Index s = 0; s < g.size(); ++s) {
    if (g.part[s] != b.part_index) continue;
    const std::array<Index, 4> a = g.nodes(s);
    Quadrilateral x, v;
    for (std::size_t e = 0; e < 4; ++e) x[e] = nodes.x.vec(a[e]), v[e] = nodes.v.vec(a[e]);
    if (!(g.volume[s] > 0)) add_shell(x, v, g.thickness[s], out);
  }
  for (const SkinCell& cell : cells) {
    Hexahedron x, v;
    for (std::size_t c = 0; c < x.size(); ++c)
      x[c] = nodes.x.vec(cell.node[c]), v[c] = nodes.v.vec(cell.node[c]);
    add_solid(x, v, out);
  }
  out *= (total - solids.m) / out.m;  // so far it was the area, or the volume
  out += solids;
  return out;
}

void take_mass(RigidBody& b, const MassIntegrals& sums) {
  b.m = sums.m, b.x = sums.centre();
  b.v = sums.momentum / b.m, b.L = sums.angular_momentum();
  b.J0 = sums.inertia();
}

// Inertia of the axes that may turn; singular if all nodes lie on a line.
bool can_turn(const RigidBody& b) {
  Matrix J = b.J0;
  for (int k = 0; k < 3; ++k)
    if (b.no_turn[k]) {
      J.row(k).setZero();
      J.col(k).setZero();
      J(k, k) = b.J0.trace();
    }
  return std::abs(J.determinant()) > 1e-12 * std::pow(b.J0.trace(), 3) ||
         (b.no_turn[0] && b.no_turn[1] && b.no_turn[2]);
}

void start_velocities(RigidBody& b, World& world) {
  for (int k = 0; k < 3; ++k) {
    if (b.held[k]) b.v[k] = 0;
    if (b.no_turn[k]) b.L[k] = 0;
  }
  b.omega = b.fixed() ? Vec(Vec::Zero()) : b.omega_of(b.q);
  for (std::size_t k = 0; k < b.nodes.size(); ++k) world.nodes.v.set(b.nodes[k], b.v + b.omega.cross(b.X[k]));
}

class Builder {
 public:
  Builder(const Deck& deck, const Model& model, World& world, Diagnostics& diagnostics)
      : deck_(deck),
        model_(model),
        world_(world),
        diagnostics_(diagnostics),
        extra_(extra_nodes(deck, model, diagnostics)),
        starts_(body_starts(deck, model, diagnostics)),
        loads_(body_force_loads(deck, model, diagnostics)) {
    for (const PartInertiaCard& card : deck.all<PartInertiaCard>()) given_[card.pid] = &card;
    for (Index n = 0; n < world.nodes.size(); ++n) world_node_[world.nodes.id[n]] = n;
    owner_.assign(world.nodes.size(), -1);
  }

  void add(Index part, const MatRigid& m) {
    RigidBody b;
    b.part = model_.parts[part].id;
    b.part_index = part;
    b.c2 = m.ro > 0 ? m.E / m.ro : 0;
    Diagnostics told_before;
    read_constraints(deck_, m, b, checked_.insert(m.mid).second ? diagnostics_ : told_before);
    constrained_.clear();
    std::set<Index> nodes;
    for (const ModelShell& shell : model_.shells)
      if (shell.part == part)
        for (const Index n : shell.node) {
          nodes.insert(world_node_.at(model_.nodes[n].id));
          note_spc(model_.nodes[n]);
        }
    std::vector<SkinCell> cells = cells_of(part, nodes);
    add_solid_masses(m, part, cells);
    b.solids = static_cast<Index>(cells.size());
    for (const SkinCell& cell : cells) b.volume += cell.volume;
    const std::set<Index> of_elements = nodes;
    add_extra_nodes(part, nodes);
    b.nodes.assign(nodes.begin(), nodes.end());
    const auto given = given_.find(b.part);
    if (!b.fixed() && given == given_.end()) warn_of_shared_nodes(part, of_elements);
    const MassIntegrals at_nodes = lumped(b, world_);
    if (at_nodes.m > 0) b.J_lumped = at_nodes.inertia();
    if (given != given_.end()) {
      if (!take_given(b, *given->second)) return;
    } else if (at_nodes.m > 0) {
      const RigidInertia* asked = deck_.last<RigidInertia>();
      take_mass(b, asked && asked->lumped == 1 ? at_nodes : integrated(b, cells, at_nodes.m, world_));
    } else {
      return;  // the elements' own errors tell why
    }
    if (const auto start = starts_.find(part); start != starts_.end())
      b.v = start->second.v, b.L = b.J0 * start->second.omega;
    for (const Index n : b.nodes) b.X.push_back(world_.nodes.x.vec(n) - b.x);
    for (const BodyForceLoad& load : loads_)
      if (load.part == part) b.loads.push_back(load);
    hold_by_nodes(part, b);
    if (world_.dim == 2) in_plane(part, b);
    if (!can_turn(b))
      diagnostics_.error(
          model_.parts[part].where,
          fmt::format("*PART {}: the nodes of the rigid body lie on a line, so it has no inertia against "
                      "rotation about it",
                      b.part),
          "hold rotations with CMO = 1, CON2 of *MAT_RIGID");
    else
      start_velocities(b, world_);
    claim(part, b);
    bodies_.push_back(std::move(b));
  }

  std::shared_ptr<RigidBodies> finish() {
    for (const RigidBody& b : bodies_)
      for (const Index n : b.nodes) {
        world_.nodes.follow[n] = 1;
        if (b.fixed()) world_.nodes.held[n] = 1;
      }
    return bodies_.empty() ? nullptr : std::make_shared<RigidBodies>(std::move(bodies_));
  }

 private:
  void add_extra_nodes(Index part, std::set<Index>& nodes) {
    const auto extra = extra_.find(part);
    if (extra == extra_.end()) return;
    for (const ExtraNode& e : extra->second) {
      const ModelNode& node = model_.nodes[static_cast<std::size_t>(e.node)];
      nodes.insert(world_node_.at(node.id));
      note_spc(node);
    }
  }

  /// Mass, centre, inertia and velocity of *PART_INERTIA; false where they are none.
  bool take_given(RigidBody& b, const PartInertiaCard& card) {
    const auto error = [&](const char* field, std::string what, const char* hint) {
      deck_.error(diagnostics_, card, field, std::move(what), hint);
      return false;
    };
    b.m = card.tm, b.x = Vec(card.xc, card.yc, card.zc);
    if (card.nodeid != 0) {
      const auto node = std::find_if(model_.nodes.begin(), model_.nodes.end(),
                                     [&](const ModelNode& n) { return n.id == card.nodeid; });
      if (node == model_.nodes.end())
        return error("NODEID", fmt::format("node {} does not exist", card.nodeid), "define it with *NODE");
      b.x = node->x;
    }
    Matrix axes = Matrix::Identity();
    if (card.ircs == 1 && card.cid != 0) {
      const auto system = model_.coordinate_systems.find(card.cid);
      if (system == model_.coordinate_systems.end())
        return error("CID", fmt::format("coordinate system {} does not exist", card.cid),
                     "define it with *DEFINE_COORDINATE_SYSTEM");
      axes = system->second.axes;
    } else if (card.ircs == 1) {
      const Vec x(card.xl, card.yl, card.zl), in_plane(card.xlip, card.ylip, card.zlip);
      const Vec z = x.cross(in_plane);
      if (!(z.norm() > 0))
        return error("XL", "the vectors of the local axes are parallel, or none",
                     "XL is along the local x axis, XLIP another one in the local xy plane");
      axes.col(0) = x.normalized(), axes.col(2) = z.normalized();
      axes.col(1) = axes.col(2).cross(axes.col(0));
    }
    b.J0 = axes * card.inertia() * axes.transpose();
    const Matrix second = 0.5 * b.J0.trace() * Matrix::Identity() - b.J0;  // of x x^T dm
    if (!is_positive(second, 1e-9 * b.J0.trace()))
      return error("IXX", "no body has such an inertia",
                   "of the principal moments none is larger than the sum of the others");
    b.v = Vec(card.vtx, card.vty, card.vtz), b.L = b.J0 * Vec(card.vrx, card.vry, card.vrz);
    return true;
  }
  /// No eigenvalue is below 0 by more than `slack`.
  static bool is_positive(const Matrix& a, Real slack) {
    const Matrix b = a + slack * Matrix::Identity();
    return b(0, 0) > 0 && b(0, 0) * b(1, 1) - b(0, 1) * b(1, 0) > 0 && b.determinant() > 0;
  }

  /// The solids of a part; adds their nodes to those of its body.
  std::vector<SkinCell> cells_of(Index part, std::set<Index>& nodes) {
    std::vector<SkinCell> cells;
    for (const ModelSolid& solid : model_.solids) {
      if (solid.part != part) continue;
      SkinCell& cell = cells.emplace_back(SkinCell{.id = solid.id});
      const std::array<Index, 8> corner = solid.corners();
      for (std::size_t c = 0; c < corner.size(); ++c) {
        const ModelNode& node = model_.nodes[static_cast<std::size_t>(corner[c])];
        nodes.insert(cell.node[c] = world_node_.at(node.id));
        note_spc(node);
      }
    }
    return cells;
  }

  /// The mass of an element goes to its nodes in equal shares; its outer faces can be touched.
  void add_solid_masses(const MatRigid& m, Index part, std::vector<SkinCell>& cells) {
    if (cells.empty()) return;
    for (SkinCell& cell : cells) {
      Hexahedron x;
      for (std::size_t c = 0; c < x.size(); ++c) x[c] = world_.nodes.x.vec(cell.node[c]);
      MassIntegrals sums;
      add_solid(x, x, sums);
      cell.volume = sums.m;
      const std::set<Index> different(cell.node.begin(), cell.node.end());
      for (const Index n : different) world_.nodes.m[n] += m.ro * cell.volume / Real(different.size());
    }
    add_skin(world_, {part, m.E / (3 * (1 - 2 * m.pr))}, cells);
  }

  std::array<bool, 3> held_rotations(const ModelNode& node) const {
    const auto turns = model_.held_rotations.find(static_cast<Index>(&node - model_.nodes.data()));
    return turns == model_.held_rotations.end() ? std::array<bool, 3>{} : turns->second;
  }
  void note_spc(const ModelNode& node) {
    const std::array<bool, 3> turns = held_rotations(node);
    for (std::size_t k = 0; k < 3; ++k)
      if (node.fixed[k] || turns[k]) return constrained_.push_back(&node);
  }

  /// SPC, TC and RC of nodes hold the body where that is the same as holding motions of its centre and turns
  /// about it along global axes: where of the motions that they forbid, as many are such ones as there are.
  void hold_by_nodes(Index part, RigidBody& b) {
    constexpr Real small = 1e-6;
    if (b.fixed() || constrained_.empty()) return;
    using Motion = Eigen::Matrix<Real, 6, 1>;
    std::vector<Motion> forbidden;  // orthonormal
    const auto rest_of = [&](Motion motion) {
      for (const Motion& one : forbidden) motion -= one.dot(motion) * one;
      return motion;
    };
    const auto forbid = [&](const Motion& motion) {
      const Motion rest = rest_of(motion.normalized());
      if (rest.norm() > small) forbidden.push_back(rest.normalized());
    };
    for (int k = 0; k < 3; ++k) {  // what the material holds
      if (b.held[static_cast<std::size_t>(k)]) forbid(Motion::Unit(k));
      if (b.no_turn[static_cast<std::size_t>(k)]) forbid(Motion::Unit(3 + k));
    }
    Real size = 0;
    for (const Index n : b.nodes) size = std::max(size, (world_.nodes.x.vec(n) - b.x).norm());
    for (const ModelNode* node : constrained_) {
      const std::array<bool, 3> turns = held_rotations(*node);
      for (int k = 0; k < 3; ++k) {
        Motion motion = Motion::Zero();
        motion.head<3>() = Vec::Unit(k), motion.tail<3>() = ((node->x - b.x) / size).cross(Vec::Unit(k));
        if (node->fixed[static_cast<std::size_t>(k)]) forbid(motion);
        if (turns[static_cast<std::size_t>(k)]) forbid(Motion::Unit(3 + k));
      }
    }
    std::array<bool, 6> held{};
    std::size_t count = 0;
    for (int k = 0; k < 6; ++k)
      count += held[static_cast<std::size_t>(k)] = rest_of(Motion::Unit(k)).norm() < small;
    tell_spc(part, count == forbidden.size() ? held : std::array<bool, 6>{});
    if (count != forbidden.size()) return;
    for (std::size_t k = 0; k < 3; ++k)
      b.held[k] = b.held[k] || held[k], b.no_turn[k] = b.no_turn[k] || held[3 + k];
  }

  /// `held`: none where the body cannot be held so.
  void tell_spc(Index part, const std::array<bool, 6>& held) {
    const ModelNode& node = *constrained_.front();
    const bool moves = node.fixed[0] || node.fixed[1] || node.fixed[2];
    const auto text = fmt::format("*BOUNDARY_SPC or {} on node {} of rigid part {}", moves ? "TC" : "RC",
                                  node.id, model_.parts[part].id);
    constexpr const char* instead = "hold the body with CMO = 1, CON1 and CON2 of its *MAT_RIGID";
    std::string axes;
    constexpr const char* names[] = {"x", "y", "z", "turns about x", "turns about y", "turns about z"};
    for (std::size_t k = 0; k < held.size(); ++k)
      if (held[k]) axes += (axes.empty() ? "" : ", ") + std::string(names[k]);
    if (axes.empty())
      return diagnostics_.error(model_.parts[part].where, text + " is not supported", instead);
    diagnostics_.warning(
        model_.parts[part].where,
        fmt::format("{}: {} such nodes hold the whole body: {}", text, constrained_.size(), axes),
        std::string(instead) + ", which says the same without this warning");
  }

  // As LS-DYNA does: what solids have given these nodes counts.
  void warn_of_shared_nodes(Index part, const std::set<Index>& mine) {
    std::set<Index> shared;
    Real mass = 0;
    for (const auto& group : world_.groups)
      for (int c = 0; c < group->corners() && group->corners() > 1; ++c)  // lumped masses are no elements
        for (Index e = 0; e < group->size(); ++e) {
          const Index n = group->node.data(c)[e];
          if (!mine.contains(n) || group->mass[e] == 0) continue;
          shared.insert(n);
          mass += group->mass[e] * group->share(e, c);
        }
    if (shared.empty()) return;
    diagnostics_.warning(model_.parts[part].where,
                         fmt::format("*PART {}: {} of the nodes of the rigid body, the first is {}, are "
                                     "corners of deformable elements, too: "
                                     "they move with the body, which takes their mass there, {:.4g} [M]",
                                     model_.parts[static_cast<std::size_t>(part)].id, shared.size(),
                                     world_.nodes.id[*shared.begin()], mass),
                         "give these nodes of their own where they are not to be fixed to the body");
  }

  // A body of a plane scene stays in the plane; particles have mass per unit depth, so the body must be one
  // unit deep.
  void in_plane(Index part, RigidBody& b) {
    b.held[2] = b.no_turn[0] = b.no_turn[1] = true;
    if (b.fixed()) return;
    Real low = std::numeric_limits<Real>::infinity(), high = -low;
    for (const Index n : b.nodes) {
      low = std::min(low, world_.nodes.x.vec(n).z());
      high = std::max(high, world_.nodes.x.vec(n).z());
    }
    if (std::abs(high - low - 1) > 1e-6)
      diagnostics_.error(
          model_.parts[part].where,
          fmt::format("*PART {}: in a 2D scene particles have mass per unit depth, but this moving body is "
                      "{:.4g} deep in z",
                      b.part, high - low),
          "extrude it by 1 in z");
  }

  void claim(Index part, const RigidBody& b) {
    for (const Index n : b.nodes) {
      const Index other = owner_[n];
      owner_[n] = Index(bodies_.size());
      if (other < 0 || (b.fixed() && bodies_[other].fixed())) continue;
      diagnostics_.error(model_.parts[part].where,
                         fmt::format("node {} belongs to the rigid parts {} and {}, of which one can move",
                                     world_.nodes.id[n], bodies_[other].part, b.part),
                         "give each part its own nodes, or make them one part");
      return;
    }
  }

  const Deck& deck_;
  const Model& model_;
  World& world_;
  Diagnostics& diagnostics_;
  std::map<Index, std::vector<ExtraNode>> extra_;
  std::map<Index, BodyStart> starts_;
  std::vector<BodyForceLoad> loads_;
  std::map<Id, const PartInertiaCard*> given_;
  std::map<Id, Index> world_node_;
  std::vector<Index> owner_;
  std::vector<const ModelNode*> constrained_;  // of the body at hand, by SPC, TC or RC
  std::set<Id> checked_;                       // one material may serve several parts
  std::vector<RigidBody> bodies_;
};

}  // namespace

std::optional<RigidMaterial> rigid_material(const Deck& deck, const Model& model, Index part) {
  const auto m = material_of(deck, model, part);
  if (!m) return std::nullopt;
  return RigidMaterial{m->ro, m->E, m->pr};
}

std::shared_ptr<RigidBodies> build_rigid_bodies(const Deck& deck, const Model& model, World& world,
                                                Diagnostics& diagnostics) {
  Builder builder(deck, model, world, diagnostics);
  check_switched_parts(deck, model, diagnostics);
  for (const PartInertiaCard& card : deck.all<PartInertiaCard>())
    if (!find(deck, card.mid))
      deck.error(diagnostics, card, "MID",
                 fmt::format("*PART_INERTIA is for rigid parts, and material {} is no *MAT_RIGID", card.mid),
                 "give it one, or use *PART");
  for (Index part = 0; part < Index(model.parts.size()); ++part) {
    const ModelPart& p = model.parts[part];
    if (p.has_sph) continue;
    if (const auto m = material_of(deck, model, part)) builder.add(part, *m);
  }
  return builder.finish();
}

}  // namespace courant
