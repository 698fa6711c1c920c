#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <limits>
#include <map>
#include <set>

#include "keyword/registry.hpp"
#include "model/mesh/part_inertia.hpp"
#include "model/transforms/transformation.hpp"
#include "rigid/bodies/body_cards.hpp"
#include "rigid/bodies/body_mass.hpp"
#include "rigid/bodies/build_nodal.hpp"
#include "rigid/bodies/given_inertia.hpp"
#include "rigid/bodies/held_nodes.hpp"
#include "rigid/bodies/mat_rigid.hpp"
#include "rigid/bodies/merge.hpp"
#include "rigid/bodies/nodal_bodies.hpp"
#include "rigid/bodies/node_inertias.hpp"
#include "rigid/bodies/rigid.hpp"
#include "rigid/bodies/rigid_cards.hpp"
#include "rigid/bodies/uneven_loads.hpp"
#include "rigid/switches/deformable_to_rigid.hpp"
#include "state/step_share.hpp"
#include "surfaces/skin.hpp"

namespace courant {
namespace {

/// Of a rigid part.
std::optional<MatRigid> material_of(const Deck& deck, const Model& model, Index part) {
  if (const MatRigid* m = mat_rigid_of(deck, model.parts[static_cast<std::size_t>(part)].mid)) return *m;
  return switched_material(deck, model, part);
}

/// CMO -1: CON1 is a system, the six digits of CON2 hold translations and rotations along its axes. Bodies
/// are held along global ones: that works as long as each held axis is along one of them, or all three are
/// held.
void read_local_constraints(const Deck& deck, const Model& model, const MatRigid& m, RigidBody& body,
                            Diagnostics& diagnostics) {
  const auto error = [&](const char* field, std::string message, const char* hint) {
    deck.error(diagnostics, m, field, std::move(message), hint);
  };
  const auto system = model.coordinate_systems.find(static_cast<Id>(m.con1));
  if (m.con1 != std::floor(m.con1) || system == model.coordinate_systems.end())
    return error("CON1", fmt::format("coordinate system {:g} does not exist", m.con1),
                 "with CMO = -1 it names a *DEFINE_COORDINATE_SYSTEM");
  if (system->second.moves)
    return error("CON1", fmt::format("system {:g} turns with nodes", m.con1), "give one that stays");
  const std::string digits = fmt::format("{:06g}", m.con2);
  if (digits.size() != 6 || digits.find_first_not_of("01") != std::string::npos)
    return error("CON2", fmt::format("expected six digits 0 or 1, got '{:g}'", m.con2),
                 "with CMO = -1: 110001 holds translations along x and y, and rotations about z");
  constexpr Real along = 1 - 1e-9;  // cosine
  for (std::size_t first : {0, 3}) {
    auto& held = first == 0 ? body.held : body.no_turn;
    if (digits.substr(first, 3) == "111") held = {true, true, true};
    for (std::size_t k = 0; k < 3 && held != std::array{true, true, true}; ++k) {
      if (digits[first + k] == '0') continue;
      Eigen::Index nearest = 0;
      if (system->second.axes.col(static_cast<Eigen::Index>(k)).cwiseAbs().maxCoeff(&nearest) < along)
        return error(
            "CON1",
            fmt::format("constraints along axes of system {:g}, which are not along global ones, are "
                        "not supported",
                        m.con1),
            "hold all three axes, or use a system along the global axes");
      held[static_cast<std::size_t>(nearest)] = true;
    }
  }
}

void read_constraints(const Deck& deck, const Model& model, const MatRigid& m, RigidBody& body,
                      Diagnostics& diagnostics) {
  if (!(m.pr < 0.5))
    deck.error(diagnostics, m, "PR", fmt::format("expected a number < 0.5, got '{:g}'", m.pr),
               "the contact stiffness is E / (3 (1 - 2 PR)); 0.3 is steel");
  if (m.cmo == 0) return;  // CON1 and CON2 have no meaning then
  if (m.cmo == -1) return read_local_constraints(deck, model, m, body, diagnostics);
  if (m.cmo != 1) {
    deck.error(diagnostics, m, "CMO", fmt::format("'{:g}' (a constraint of a point) is not supported", m.cmo),
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

const RegisterKeyword<RigidInertia> rigid_inertia{courant_rigid_inertia_table()};

class BodyBuilder {
 public:
  BodyBuilder(const Deck& deck, const Model& model, World& world, Diagnostics& diagnostics)
      : deck_(deck),
        model_(model),
        world_(world),
        diagnostics_(diagnostics),
        merges_(body_merges(deck, model, diagnostics)),
        extra_(extra_nodes(deck, model, diagnostics)),
        starts_(body_starts(deck, model, merges_, diagnostics)),
        loads_(body_force_loads(deck, model, merges_, diagnostics)) {
    for (const PartInertiaCard& card : deck.all<PartInertiaCard>()) {
      given_[card.pid] = &card;
      if (const auto part = model.part_of_id.find(card.pid); part != model.part_of_id.end())
        given_parts_.insert(part->second);
    }
    for (Index n = 0; n < world.nodes.size(); ++n) world_node_[world.nodes.id[n]] = n;
    owner_.assign(world.nodes.size(), -1);
  }

  void add(Index part, const MatRigid& m) {
    Member& member = members_[part];
    member.part = part, member.ro = m.ro;
    RigidBody& b = bodies_of_parts_[part];
    b.part = model_.parts[part].id, b.name = fmt::format("rigid part {}", b.part);
    b.part_index = part, b.parts = merges_.group(part);
    b.c2 = m.ro > 0 ? m.E / m.ro : 0;
    Diagnostics told_before;
    read_constraints(deck_, model_, m, b, checked_.insert(m.mid).second ? diagnostics_ : told_before);
    std::set<Index> nodes;
    for (const ModelShell& shell : model_.shells)
      if (shell.part == part)
        for (const Index n : shell.node) {
          nodes.insert(world_node_.at(model_.nodes[n].id));
          note_spc(model_.nodes[n], member);
        }
    cells_of(part, nodes, member);
    add_solid_masses(m, part, member.cells);
    b.solids = static_cast<Index>(member.cells.size());
    for (const SkinCell& cell : member.cells) b.volume += cell.volume;
    const std::set<Index> of_elements = nodes;
    add_extra_nodes(part, nodes, member);
    member.nodes.assign(nodes.begin(), nodes.end());
    if (const auto given = given_.find(b.part); given != given_.end()) member.given = given->second;
    if (!b.fixed() && !member.given) warn_of_shared_nodes(part, of_elements);
    if (b.parts.size() == 1 && !merges_.merged(part)) complete(b);
  }

  /// Once all parts are known.
  void add_merged() {
    for (auto& [part, b] : bodies_of_parts_)
      if (b.parts.size() > 1 && !merges_.merged(part)) complete(b);
  }

  void add_nodal() {
    for (const NodalBody& nodal : nodal_bodies(deck_, model_, diagnostics_)) {
      RigidBody b;
      if (!build_nodal_body(nodal, deck_, model_, world_node_, world_, b, diagnostics_)) continue;
      if (const auto start = starts_.find(b.part); start != starts_.end()) {
        b.v = start->second.v, b.L = b.J0 * start->second.omega;
        start_velocities(b, world_);
      }
      for (const BodyForceLoad& load : loads_)
        if (load.body == b.part) b.loads.push_back(load);
      look_at_given(deck_.where(nodal.card), b, nodal.given.has_value());
      claim(deck_.where(nodal.card), b);
      bodies_.push_back(std::move(b));
    }
  }

  std::shared_ptr<RigidBodies> finish() {
    for (const RigidBody& b : bodies_)
      for (const Index n : b.nodes) {
        world_.nodes.follow[n] = 1;
        if (b.fixed()) world_.nodes.held[n] = 1;
      }
    return bodies_.empty() ? nullptr : std::make_shared<RigidBodies>(std::move(bodies_), step_share_);
  }

 private:
  /// A body whose parts are known.
  void complete(RigidBody b) {
    const Index part = b.part_index;
    std::set<Index> nodes;
    std::vector<const ModelNode*> constrained;
    for (const Index k : b.parts) {
      const Member& member = members_[k];
      nodes.insert(member.nodes.begin(), member.nodes.end());
      constrained.insert(constrained.end(), member.constrained.begin(), member.constrained.end());
      if (k != part) take_part(bodies_of_parts_[k], b);
    }
    b.nodes.assign(nodes.begin(), nodes.end());
    const MassIntegrals at_nodes = lumped(b.nodes, world_);
    if (at_nodes.m > 0) b.J_lumped = at_nodes.inertia();
    if (!take_masses(b)) return;  // the elements' own errors tell why
    if (!add_node_inertias(deck_, model_, world_node_, world_, b, diagnostics_)) return;
    if (const auto start = starts_.find(b.part); start != starts_.end())
      b.v = start->second.v, b.L = b.J0 * start->second.omega;
    for (const Index n : b.nodes) b.X.push_back(world_.nodes.x.vec(n) - b.x);
    for (const BodyForceLoad& load : loads_)
      if (load.body == b.part) b.loads.push_back(load);
    hold_by_nodes(model_, constrained, world_,
                  {model_.parts[part].where, fmt::format("rigid part {}", b.part),
                   "hold the body with CMO = 1, CON1 and CON2 of its *MAT_RIGID"},
                  b, diagnostics_);
    if (world_.dim == 2) in_plane(part, b);
    refuse_uneven_loads(b, merges_, deck_, model_, world_, diagnostics_);
    if (!can_turn(b))
      diagnostics_.error(
          model_.parts[part].where,
          fmt::format("*PART {}: the nodes of the rigid body lie on a line, so it has no inertia against "
                      "rotation about it",
                      b.part),
          "hold rotations with CMO = 1, CON2 of *MAT_RIGID");
    else
      start_velocities(b, world_);
    look_at_given(model_.parts[part].where, b, std::any_of(b.parts.begin(), b.parts.end(), [&](Index k) {
                    return given_parts_.contains(k);
                  }));
    claim(model_.parts[part].where, b);
    bodies_.push_back(std::move(b));
  }

  /// Takes from a part that is merged into a body what is no mass; the body keeps its own constraints.
  void take_part(const RigidBody& other, RigidBody& b) {
    b.solids += other.solids, b.volume += other.volume;
    b.c2 = std::max(b.c2, other.c2);
    if (other.held == b.held && other.no_turn == b.no_turn) return;
    const Merge& merge = merges_.of(other.part_index);
    deck_.warning(diagnostics_, merge.card, "",
                  fmt::format("part {} is held otherwise (CMO, CON1, CON2) than part {}: the body is held as "
                              "part {}",
                              other.part, b.part, b.part),
                  "give both materials the same constraints");
  }

  /// False where a body has none.
  bool take_masses(RigidBody& b) {
    std::vector<const Member*> spread;
    std::set<Index> nodes, of_given;
    bool any = false;
    for (const Index k : b.parts) {
      const Member& member = members_[k];
      if (!merges_.counts(k, given_parts_)) continue;
      if (!member.given) {
        spread.push_back(&member), nodes.insert(member.nodes.begin(), member.nodes.end());
        continue;
      }
      of_given.insert(member.nodes.begin(), member.nodes.end());
      RigidBody one;
      if (!take_given_inertia(deck_, model_, world_, *member.given, {k, member.nodes}, one, diagnostics_))
        return false;
      add_mass(one, any, b);
    }
    std::size_t sum = 0;
    for (const Member* member : spread) sum += member->nodes.size();
    std::copy_if(b.nodes.begin(), b.nodes.end(), std::back_inserter(b.unweighed),
                 [&](Index n) { return of_given.contains(n) || !nodes.contains(n); });
    if (sum == nodes.size() && of_given.empty()) {  // no part shares nodes with another one
      for (const Member* member : spread)
        any = add_spread({member}, {member->nodes.begin(), member->nodes.end()}, any, b);
      return any;
    }
    std::erase_if(nodes, [&](Index n) { return of_given.contains(n); });
    return spread.empty() ? any : add_spread(spread, nodes, any, b);
  }
  /// Mass that is spread over elements of parts, which weigh by RO where they share nodes.
  bool add_spread(const std::vector<const Member*>& members, const std::set<Index>& nodes, bool any,
                  RigidBody& b) {
    const MassIntegrals at_nodes = lumped({nodes.begin(), nodes.end()}, world_);
    if (!(at_nodes.m > 0)) return add_weightless(members, nodes, any, b);
    const RigidInertia* asked = deck_.last<RigidInertia>();
    RigidBody one;
    take_mass(one, asked && asked->lumped == 1 ? at_nodes : integrated(members, nodes, at_nodes.m, world_));
    add_mass(one, any, b);
    return true;
  }
  /// Shells without a thickness: of no matter where nothing can move them, which needs a position alone.
  bool add_weightless(const std::vector<const Member*>& members, const std::set<Index>& nodes, bool any,
                      RigidBody& b) {
    if (any || nodes.empty() || members.empty()) return any;
    constexpr Real negligible = 1e-9;
    RigidBody one;
    take_mass(one, shape_of(members, nodes, negligible, world_));
    if (!(one.m > 0)) return any;  // errors of the elements tell why
    if (!b.fixed()) {
      diagnostics_.error(
          model_.parts[b.part_index].where,
          fmt::format("*PART {}: its rigid body can move, and has no mass: its shells have no "
                      "thickness",
                      b.part),
          "give T1 of *SECTION_SHELL, or the mass by *PART_INERTIA, or hold the body (CMO 1, CON1 7 and "
          "CON2 7 of *MAT_RIGID)");
      return any;
    }
    add_mass(one, any, b);
    return true;
  }
  static void add_mass(const RigidBody& one, bool& any, RigidBody& b) {
    if (any) return join_mass(b, one);
    b.m = one.m, b.x = one.x, b.v = one.v, b.J0 = one.J0, b.L = one.L;
    any = true;
  }

  void add_extra_nodes(Index part, std::set<Index>& nodes, Member& member) {
    const auto extra = extra_.find(part);
    if (extra == extra_.end()) return;
    for (const ExtraNode& e : extra->second) {
      const ModelNode& node = model_.nodes[static_cast<std::size_t>(e.node)];
      nodes.insert(world_node_.at(node.id));
      note_spc(node, member);
    }
  }

  /// The solids of a part; adds their nodes to those of its body.
  void cells_of(Index part, std::set<Index>& nodes, Member& member) {
    for (const ModelSolid& solid : model_.solids) {
      const std::array<Index, 20> corner = solid.all_corners();
      const int corners = solid.corner_count();
      const bool reported = std::count(corner.begin(), corner.begin() + corners, Index(-1)) > 0;
      if (solid.part != part || reported) continue;  // five to seven, or nine nodes
      SkinCell& cell = member.cells.emplace_back(SkinCell{.id = solid.id, .corners = corners});
      for (std::size_t c = 0; c < static_cast<std::size_t>(corners); ++c) {
        const ModelNode& node = model_.nodes[static_cast<std::size_t>(corner[c])];
        nodes.insert(cell.node[c] = world_node_.at(node.id));
        note_spc(node, member);
      }
    }
  }

  /// The mass of an element goes to its nodes in equal shares; its outer faces can be touched.
  void add_solid_masses(const MatRigid& m, Index part, std::vector<SkinCell>& cells) {
    if (cells.empty()) return;
    for (SkinCell& cell : cells) {
      MassIntegrals sums;
      for (const std::array<Index, 8>& piece : cell.pieces()) {
        Hexahedron x;
        for (std::size_t c = 0; c < x.size(); ++c) x[c] = world_.nodes.x.vec(piece[c]);
        add_solid(x, x, sums);
      }
      cell.volume = sums.m;
      const std::set<Index> different(cell.node.begin(), cell.node.begin() + cell.corners);
      for (const Index n : different) world_.nodes.m[n] += m.ro * cell.volume / Real(different.size());
    }
    add_skin(world_, {part, m.E / (3 * (1 - 2 * m.pr))}, cells);
  }

  void note_spc(const ModelNode& node, Member& member) const {
    if (is_constrained(model_, node)) member.constrained.push_back(&node);
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

  /// Elements at the nodes of a body swing faster where its given mass is below theirs.
  void look_at_given(const Location& where, const RigidBody& b, bool given) {
    if (!given || b.fixed() || !diagnostics_.ok()) return;
    if (of_elements_.empty()) {
      of_elements_.assign(static_cast<std::size_t>(world_.nodes.size()), 0);
      for (const auto& group : world_.groups)
        for (int c = 0; c < group->corners() && group->corners() > 1; ++c)  // lumped masses are no elements
          for (Index e = 0; e < group->size(); ++e)
            of_elements_[static_cast<std::size_t>(group->node.data(c)[e])] +=
                group->mass[e] * group->share(e, c);
    }
    const Real times =
        lightness(b, world_.nodes, [&](Index n) { return of_elements_[static_cast<std::size_t>(n)]; });
    const Real share = courant::step_share(model_.tssfac, std::sqrt(std::max(Real(1), times)));
    if (share == 1) return;
    step_share_ = std::min(step_share_, share);
    diagnostics_.warning(
        where,
        fmt::format("{} has a given mass or inertia that is {:.3g} of what deformable elements "
                    "have at its nodes: the step is {:.3g} of that of the elements",
                    b.name, 1 / times, share),
        "give it their mass besides its own: TM, IXX to IZZ");
  }

  bool is_switched(const RigidBody& b) const {
    return std::any_of(b.parts.begin(), b.parts.end(),
                       [&](const auto part) { return switched_material(deck_, model_, part).has_value(); });
  }

  void claim(const Location& where, const RigidBody& b) {
    for (const Index n : b.nodes) {
      const Index other = owner_[n];
      owner_[n] = Index(bodies_.size());
      if (other < 0 || (b.fixed() && bodies_[other].fixed())) continue;
      const bool of_parts = !b.parts.empty() && !bodies_[other].parts.empty();
      const bool switched = of_parts && (is_switched(b) || is_switched(bodies_[other]));
      diagnostics_.error(
          where,
          fmt::format("node {} belongs to {} and to {}, of which one can move", world_.nodes.id[n],
                      bodies_[other].name, b.name),
          switched
              ? "make them one body: name one as the lead (LRB) of the other in *DEFORMABLE_TO_RIGID, or "
                "merge them by *CONSTRAINED_RIGID_BODIES"
          : of_parts ? "give each part its own nodes, or merge them by *CONSTRAINED_RIGID_BODIES"
                     : "let each node belong to one body: one *CONSTRAINED_NODAL_RIGID_BODY for all, or "
                       "*CONSTRAINED_EXTRA_NODES");
      return;
    }
  }

  const Deck& deck_;
  const Model& model_;
  World& world_;
  Diagnostics& diagnostics_;
  BodyMerges merges_;
  std::map<Index, std::vector<ExtraNode>> extra_;
  std::map<Id, BodyStart> starts_;
  std::vector<BodyForceLoad> loads_;
  std::map<Id, const PartInertiaCard*> given_;
  std::map<Id, Index> world_node_;
  std::vector<Index> owner_;
  std::vector<Real> of_elements_;  ///< mass of deformable elements at each node; empty: not needed
  Real step_share_ = 1;
  std::set<Index> given_parts_;
  std::set<Id> checked_;  // one material may serve several parts
  std::map<Index, Member> members_;
  std::map<Index, RigidBody> bodies_of_parts_;  // as far as a part tells alone
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
  BodyBuilder builder(deck, model, world, diagnostics);
  check_switched_parts(deck, model, diagnostics);
  for (const PartInertiaCard& card : deck.all<PartInertiaCard>())
    if (!mat_rigid_of(deck, card.mid))
      deck.error(diagnostics, card, "MID",
                 fmt::format("*PART_INERTIA is for rigid parts, and material {} is no *MAT_RIGID", card.mid),
                 "give it one, or use *PART");
  for (Index part = 0; part < Index(model.parts.size()); ++part) {
    const ModelPart& p = model.parts[part];
    if (p.has_sph) continue;
    if (const auto m = material_of(deck, model, part)) builder.add(part, *m);
  }
  builder.add_merged();
  builder.add_nodal();
  return builder.finish();
}

}  // namespace courant
