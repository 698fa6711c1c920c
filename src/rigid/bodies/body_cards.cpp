#include "rigid/bodies/body_cards.hpp"
#include "rigid/bodies/rigid_cards.hpp"

#include <cmath>
#include <optional>
#include <set>

#include <fmt/format.h>

#include "keyword/common_rules.hpp"
#include "keyword/registry.hpp"
#include "rigid/bodies/nodal_bodies.hpp"

namespace courant {

namespace {

struct ExtraNodesCard : Entry {
  Id pid = 0, id = 0;
  int iflag = 0;
};
struct ExtraNodesNode : ExtraNodesCard {
  static constexpr const char* field = "NID";
};
struct ExtraNodesSet : ExtraNodesCard {
  static constexpr const char* field = "NSID";
};

template <class T>
KeywordOf<T> extra_nodes_keyword(std::string name, std::string purpose, IdSpace refers) {
  return {.names = {std::move(name)},
          .purpose = std::move(purpose),
          .cards = {{.fields = {{"PID", &T::pid, "-", "rigid part", rules::required_id_of(IdSpace::part)},
                                {T::field, &T::id, "-", "what goes with it", rules::required_id_of(refers)},
                                {"IFLAG",
                                 &T::iflag,
                                 "-",
                                 "1: their mass counts besides that of *PART_INERTIA",
                                 {.allowed = {0}}}}}}};
}
const RegisterKeyword<ExtraNodesNode> extra_nodes_node{extra_nodes_keyword<ExtraNodesNode>(
    "CONSTRAINED_EXTRA_NODES_NODE", "a node that goes with a rigid body", IdSpace::node)};
const RegisterKeyword<ExtraNodesSet> extra_nodes_set{extra_nodes_keyword<ExtraNodesSet>(
    "CONSTRAINED_EXTRA_NODES_SET", "nodes of a set that go with a rigid body", IdSpace::node_set)};

using Start = InitialVelocityRigidBody;

/// Directions of a system of their own move with it.
const RegisterKeyword<Start> initial_velocity_keyword{initial_velocity_rigid_body_table()};

using Load = LoadRigidBody;

const RegisterKeyword<Load> load_rigid_body_keyword{load_rigid_body_table()};

class BodyCardReader {
 public:
  BodyCardReader(const Deck& deck, const Model& model, Diagnostics& diagnostics)
      : deck_(deck), model_(model), diagnostics_(diagnostics), of_nodes_(nodal_body_ids(deck, model)) {}

  /// Index of a rigid part.
  std::optional<Index> rigid_part(const Entry& card, Id pid) {
    const auto part = model_.part_of_id.find(pid);
    if (part == model_.part_of_id.end())
      return error(card, "PID", fmt::format("part {} does not exist", pid),
                   of_nodes_.contains(pid) ? "it is a body of nodes: add nodes to its set"
                                           : "define it with *PART, or with *CONSTRAINED_NODAL_RIGID_BODY");
    if (!model_.parts[static_cast<std::size_t>(part->second)].rigid)
      return error(card, "PID", fmt::format("part {} is no rigid body", pid),
                   "its material must be a *MAT_RIGID");
    return part->second;
  }
  /// `pid`, where it is a body of nodes or a part that gives its body its name: what is said of the whole
  /// body.
  std::optional<Id> whole_body(const Entry& card, Id pid, const BodyMerges& merges) {
    if (of_nodes_.contains(pid)) return pid;
    const auto part = rigid_part(card, pid);
    if (!part) return std::nullopt;
    if (!merges.merged(*part)) return pid;
    const Id lead = model_.parts[static_cast<std::size_t>(merges.lead(*part))].id;
    return error(
        card, "PID",
        fmt::format("part {} is merged into part {}, {}", pid, lead, deck_.place(merges.of(*part).card)),
        fmt::format("name part {}: this is about the whole body and its centre", lead));
  }
  /// Axes of a system that is at rest; 0: global.
  std::optional<Matrix> axes(const Entry& card, const char* field, Id id) {
    if (id == 0) return Matrix::Identity();
    const auto system = model_.coordinate_systems.find(id);
    if (system == model_.coordinate_systems.end())
      return error(card, field, fmt::format("coordinate system {} does not exist", id),
                   "define it with *DEFINE_COORDINATE_SYSTEM");
    if (system->second.moves)
      return error(card, field, fmt::format("system {} turns with nodes", id), "use a fixed one");
    return system->second.axes;
  }
  std::nullopt_t error(const Entry& card, const char* field, std::string message, std::string hint) {
    deck_.error(diagnostics_, card, field, std::move(message), std::move(hint));
    return std::nullopt;
  }

 private:
  const Deck& deck_;
  const Model& model_;
  Diagnostics& diagnostics_;
  std::set<Id> of_nodes_;
};

}  // namespace

/// In a mirror the sense of a rotation is turned round.
std::string mirror_rotation(InitialVelocityRigidBody& card, const Affine& motion) {
  if (card.icid == 0 && motion.linear().determinant() < 0)
    card.vxr = -card.vxr, card.vyr = -card.vyr, card.vzr = -card.vzr;
  return {};
}

CurveOf curve_of_body_force(const LoadRigidBody& card) {
  return {"T", card.dof >= 5 ? "ML2/T2" : "ML/T2"};
}

std::string keep_axes(LoadRigidBody& card, const Affine& motion) {
  if (card.cid != 0 || motion.linear() == Matrix::Identity()) return {};
  return "its direction is an axis, which a transformation that turns or stretches the file would change";
}

std::map<Index, std::vector<ExtraNode>> extra_nodes(const Deck& deck, const Model& model,
                                                    Diagnostics& diagnostics) {
  std::map<Index, std::vector<ExtraNode>> out;
  const auto& single = deck.all<ExtraNodesNode>();
  const auto& sets = deck.all<ExtraNodesSet>();
  if (single.empty() && sets.empty()) return out;
  BodyCardReader reader(deck, model, diagnostics);
  std::map<Id, Index> node_of_id;
  std::set<Index> particles;
  for (std::size_t n = 0; n < model.nodes.size(); ++n) node_of_id[model.nodes[n].id] = static_cast<Index>(n);
  for (const ModelSph& s : model.sph) particles.insert(s.node);
  const auto add = [&](const ExtraNodesCard& card, const char* field, const std::vector<Index>& nodes) {
    const auto body = reader.rigid_part(card, card.pid);
    if (!body) return;
    for (const Index n : nodes) {
      if (particles.contains(n)) {
        reader.error(card, field,
                     fmt::format("node {} is a particle", model.nodes[static_cast<std::size_t>(n)].id),
                     "nodes of elements, and nodes of nothing, can go with a rigid body");
        return;
      }
      out[*body].push_back({n, card, field});
    }
  };
  for (const ExtraNodesNode& card : single) {
    const auto node = node_of_id.find(card.id);
    if (node == node_of_id.end())
      reader.error(card, "NID", fmt::format("node {} does not exist", card.id), "define it with *NODE");
    else
      add(card, "NID", {node->second});
  }
  for (const ExtraNodesSet& card : sets) {
    const auto set = model.node_sets.find(card.id);
    if (set == model.node_sets.end())
      reader.error(card, "NSID", fmt::format("node set {} does not exist", card.id),
                   "define it with *SET_NODE");
    else
      add(card, "NSID", set->second);
  }
  return out;
}

std::map<Id, BodyStart> body_starts(const Deck& deck, const Model& model, const BodyMerges& merges,
                                    Diagnostics& diagnostics) {
  std::map<Id, BodyStart> out;
  BodyCardReader reader(deck, model, diagnostics);
  for (const InitialVelocityRigidBody& card : deck.all<InitialVelocityRigidBody>()) {
    const auto body = reader.whole_body(card, card.pid, merges);
    const auto axes = reader.axes(card, "ICID", card.icid);
    if (body && out.contains(*body)) {
      reader.error(card, "PID", fmt::format("part {} has an initial velocity already", card.pid),
                   "give it once");
      continue;
    }
    if (body && axes)
      out[*body] = {*axes * Vec(card.vx, card.vy, card.vz), *axes * Vec(card.vxr, card.vyr, card.vzr)};
  }
  return out;
}

std::vector<BodyForceLoad> body_force_loads(const Deck& deck, const Model& model, const BodyMerges& merges,
                                            Diagnostics& diagnostics) {
  std::vector<BodyForceLoad> out;
  BodyCardReader reader(deck, model, diagnostics);
  for (const LoadRigidBody& card : deck.all<LoadRigidBody>()) {
    const auto body = reader.whole_body(card, card.pid, merges);
    const auto axes = reader.axes(card, "CID", card.cid);
    if (!body || !axes) continue;
    const bool turns = card.dof >= 5 && card.dof <= 7;
    if (!turns && (card.dof < 1 || card.dof > 3)) {
      reader.error(card, "DOF",
                   card.dof == 4 || card.dof == 8
                       ? fmt::format("a load that follows nodes (DOF {}) is not supported", card.dof)
                       : fmt::format("expected 1, 2, 3, 5, 6 or 7, got '{}'", card.dof),
                   "1 to 3: a force along x, y, z, 5 to 7: a moment about them");
      continue;
    }
    const auto curve = model.curves.find(card.lcid);
    if (curve == model.curves.end()) {
      reader.error(card, "LCID",
                   card.lcid < 0 ? "curves over a displacement are not supported"
                                 : fmt::format("curve {} does not exist", card.lcid),
                   "define a curve over time with *DEFINE_CURVE");
      continue;
    }
    out.push_back({*body, axes->col((card.dof - 1) % 4), turns, curve->second, card.sf});
  }
  return out;
}

}  // namespace courant
