// *LOAD_NODE_POINT and _SET: forces on particles and nodes.
#include <algorithm>
#include <cmath>
#include <map>

#include <fmt/format.h>

#include "keyword/registry.hpp"
#include "loads/interpolation.hpp"
#include "loads/load_cards.hpp"
#include "loads/loads.hpp"
#include "loads/middle_velocity.hpp"
#include "model/definitions/named_curve.hpp"
#include "model/transforms/transformation.hpp"
#include "parallel/parallel.hpp"
#include "state/shared_fields.hpp"

namespace courant {

namespace {

struct LoadNodePoint : LoadNodeCard {
  static constexpr const char* field = "NID";
};
struct LoadNodeSet : LoadNodeCard {
  static constexpr const char* field = "NSID";
};

const RegisterKeyword<LoadNodePoint> load_node_point_keyword{load_node_point_table()};
const RegisterKeyword<LoadNodeSet> load_node_set_keyword{load_node_set_table()};

class NodalLoadReader {
 public:
  NodalLoadReader(const Deck& deck, const Model& model, const World& world, Diagnostics& diagnostics)
      : deck_(deck),
        model_(model),
        world_(world),
        diagnostics_(diagnostics),
        has_rotations_(shared_fields::no_rotation.find(world.nodes.fields) != nullptr) {
    for (std::size_t n = 0; n < model.nodes.size(); ++n)
      node_of_id_[model.nodes[n].id] = static_cast<Index>(n);
    for (auto* chosen : {&is_loaded_, &turns_, &of_bodies_}) chosen->assign(model.nodes.size(), 0);
    for (const ModelSph& s : model.sph) is_loaded_[static_cast<std::size_t>(s.node)] = 1;
    const Nodes& nodes = world.nodes;
    const std::set<Id> hand_on = interpolated_nodes(deck);
    const Field<Index>* none = shared_fields::no_rotation.find(nodes.fields);
    for (Index i = 0; i < nodes.size(); ++i) {
      const auto found = node_of_id_.find(nodes.id[i]);
      if (found == node_of_id_.end()) continue;
      const auto n = static_cast<std::size_t>(found->second);
      if (nodes.follow[i] < 2 || hand_on.contains(nodes.id[i])) is_loaded_[n] = 1;
      if (nodes.follow[i] == 1) of_bodies_[n] = 1, some_of_bodies_ = true;
      if (none && (*none)[i] == 0) turns_[n] = 1;
    }
  }

  void add(const LoadNodeCard& card, const char* field, std::vector<Index> nodes) {
    NodalLoad load{.direction = {}, .curve = {}, .sf = card.sf, .nodes = std::move(nodes), .card = card};
    const Curve* curve = curve_named(deck_, model_, card, "LCID", card.lcid, diagnostics_);
    if (!curve) return;
    load.curve = *curve;
    const bool follows = card.dof == follower || card.dof == follower_moment;
    if (follows ? !read_follower(card, load) : !read_direction(card, load.direction)) return;
    load.turns = card.dof > follower;
    for (const Index n : load.nodes)
      if (load.turns && of_bodies_[static_cast<std::size_t>(n)] && load.follows)
        return error(
            card, field,
            fmt::format("node {} belongs to a rigid body, on which a moment that follows M1, M2, M3 is "
                        "not supported",
                        model_.nodes[static_cast<std::size_t>(n)].id),
            "use DOF 5, 6, 7: a moment about x, y, z");
      else if (load.turns && !turns_[static_cast<std::size_t>(n)] && !of_bodies_[static_cast<std::size_t>(n)])
        return error(
            card, field,
            fmt::format("node {} does not turn: only corners of shells that deform, nodes of beams and "
                        "of rigid bodies feel moments",
                        model_.nodes[static_cast<std::size_t>(n)].id),
            "give the moment as forces on two nodes");
      else if (!is_loaded_[static_cast<std::size_t>(n)])
        return error(card, field,
                     fmt::format("node {} is neither a particle nor a node of elements or bodies, on which "
                                 "alone forces act",
                                 model_.nodes[static_cast<std::size_t>(n)].id),
                     "leave it out");
    loads_.push_back(std::move(load));
  }
  void add(const LoadNodePoint& card) {
    const auto n = node_of_id_.find(card.nid);
    if (n == node_of_id_.end())
      return error(card, "NID", fmt::format("node {} does not exist", card.nid), "define it with *NODE");
    add(card, "NID", {n->second});
  }
  void add(const LoadNodeSet& card) {
    const auto set = model_.node_sets.find(card.nid);
    if (set == model_.node_sets.end())
      return error(card, "NSID", fmt::format("node set {} does not exist", card.nid),
                   "define it with *SET_NODE");
    add(card, "NSID", set->second);
  }
  std::vector<NodalLoad> finish() { return std::move(loads_); }

 private:
  void error(const LoadNodeCard& card, const char* field, std::string message, std::string hint) {
    deck_.error(diagnostics_, card, field, std::move(message), std::move(hint));
  }

  /// DOF 4, and DOF 8 for a moment: along the normal of M1, M2, M3, at right hand.
  bool read_follower(const LoadNodeCard& card, NodalLoad& load) {
    load.follows.emplace();
    std::size_t k = 0;
    std::array<Vec, 3> x;
    for (const auto& [field, id] :
         {std::pair("M1", card.m1), std::pair("M2", card.m2), std::pair("M3", card.m3)}) {
      Index at = -1;
      for (Index i = 0; i < world_.nodes.size(); ++i)
        if (world_.nodes.id[i] == id) at = i;
      const auto of_model = node_of_id_.find(id);
      if (at < 0 && of_model == node_of_id_.end()) {
        error(card, field, fmt::format("node {} does not exist", id),
              "the normal of M1, M2, M3 is the direction: define it with *NODE");
        return false;
      }
      if (at < 0 && std::any_of(model_.sph.begin(), model_.sph.end(),
                                [&](const ModelSph& one) { return one.node == of_model->second; })) {
        error(card, field,
              fmt::format("node {} is a particle, whose motion the direction would not follow", id),
              "name nodes of elements or bodies, or nodes that rest");
        return false;
      }
      // nodes of no element or body rest: -1 - index into Model::nodes
      x[k] = at < 0 ? model_.nodes[static_cast<std::size_t>(of_model->second)].x : world_.nodes.x.vec(at);
      (*load.follows)[k++] = at < 0 ? -1 - of_model->second : at;
    }
    const Vec a = x[1] - x[0], b = x[2] - x[0];
    constexpr Real least_sine = 1e-6;
    if (!(a.cross(b).norm() > least_sine * a.norm() * b.norm())) {
      error(card, "M3", "M1, M2 and M3 lie on a line: they have no normal", "name nodes of a triangle");
      return false;
    }
    return true;
  }

  bool read_direction(const LoadNodeCard& card, Vec& direction) {
    const int size = std::abs(card.dof);
    const bool moment = card.dof >= 5 && card.dof <= 7 && (has_rotations_ || some_of_bodies_);
    if ((card.dof < 1 || card.dof > 3) && !moment) {
      error(card, "DOF",
            size >= 5 && size <= 8 ? fmt::format("a moment (DOF {}) is not supported", card.dof)
                                   : fmt::format("expected 1, 2 or 3, got '{}'", card.dof),
            size >= 5 && size <= 7 ? "on a rigid body use *LOAD_RIGID_BODY with the part id of the body"
                                   : "use DOF 1, 2, 3: a force along x, y, z; 4 follows M1, M2, M3");
      return false;
    }
    Matrix axes = Matrix::Identity();
    if (card.cid != 0) {
      const auto system = model_.coordinate_systems.find(card.cid);
      const bool known = system != model_.coordinate_systems.end();
      if (!known || system->second.moves) {
        error(card, "CID",
              known ? fmt::format("system {} turns with nodes, which forces do not", card.cid)
                    : fmt::format("coordinate system {} does not exist", card.cid),
              known ? "use a fixed system" : "define it with *DEFINE_COORDINATE_SYSTEM");
        return false;
      }
      axes = system->second.axes;
    }
    direction = axes.col(moment ? card.dof - 5 : card.dof - 1);
    if (moment || world_.dim == 3 || direction[2] == 0) return true;
    error(card, "DOF", "in 2D nothing moves along z", "use DOF 1 or 2");
    return false;
  }

  static constexpr int follower = 4, follower_moment = 8;
  const Deck& deck_;
  const Model& model_;
  const World& world_;
  Diagnostics& diagnostics_;
  std::map<Id, Index> node_of_id_;
  bool has_rotations_ = false, some_of_bodies_ = false;
  std::vector<char> is_loaded_, turns_, of_bodies_;  ///< of the model's nodes
  std::vector<NodalLoad> loads_;
};

/// Loads that act on a point all at once.
using Loads = std::vector<std::size_t>;

class NodalForces : public Force, public EnergyTerm {
 public:
  NodalForces(const Model& model, std::vector<NodalLoad> loads, std::vector<Loads> groups, Points points,
              Field<Index>& group)
      : loads_(std::move(loads)), groups_(std::move(groups)), points_(points), group_(group) {
    for (const NodalLoad& load : loads_)
      for (const Index node : load.follows.value_or(std::array<Index, 3>{}))
        if (node < 0) resting_[node] = model.nodes[static_cast<std::size_t>(-1 - node)].x;
  }
  std::string name() const override { return "forces on " + points_.name(); }
  const FieldSet& over(const World&) const override { return points_.fields(); }
  void declare(const World& world, Accesses& a) const override {
    a.updates(*points_.f).reads(group_);
    if (std::any_of(loads_.begin(), loads_.end(), [](const NodalLoad& load) { return load.follows; }))
      a.in_start().reads(world.nodes.x, Reach::others);
  }

  void start(World& world, const Clock& clock) override {
    forces_.assign(groups_.size(), Vec::Zero());
    means_.assign(groups_.size(), Vec::Zero());
    for (std::size_t g = 0; g < groups_.size(); ++g)
      for (const std::size_t k : groups_[g]) {
        const NodalLoad& load = loads_[k];
        const Real now = load.curve(clock.t), before = load.curve(clock.t - clock.dt_old);
        const Vec along = direction_of(load, world);
        forces_[g] += load.sf * now * along;
        means_[g] += load.sf * 0.5 * (now + before) * along;
      }
  }
  void block(World&, const Clock&, Index begin, Index end) override {
    for (Index i = begin; i < end; ++i)
      if (group_[i] != 0) points_.f->add(i, force(i));
  }
  void record(World& world, const Clock& clock, EnergyLedger& ledger) override {
    const MiddleVelocity v(points_, clock);
    // what others move has its velocity from them: the work of the step that was
    const auto work_on = [&](Index i) -> Real {
      if (group_[i] == 0) return 0;
      if (!points_.turns && points_.follow && (*points_.follow)[i] != 0)
        return means_[static_cast<std::size_t>(group_[i])].dot(points_.v->vec(i)) * clock.dt_old;
      return force(i).dot(v(i)) * clock.dt_mean();
    };
    const Index n = loaded_points(points_, world);
    ledger.external_work += sum(n, work_on);
    ledger.throughput += sum(n, [&](Index i) { return std::abs(work_on(i)); });
  }
  void sample(const World&, const Clock&, EnergyLedger&) const override {}

 private:
  Vec direction_of(const NodalLoad& load, const World& world) const {
    if (!load.follows) return load.direction;
    const auto x = [&](std::size_t k) -> Vec {
      const Index node = (*load.follows)[k];
      return node < 0 ? resting_.at(node) : world.nodes.x.vec(node);
    };
    return Vec(x(1) - x(0)).cross(Vec(x(2) - x(0))).normalized();
  }
  const Vec& force(Index i) const { return forces_[static_cast<std::size_t>(group_[i])]; }
  std::map<Index, Vec> resting_;  ///< nodes of M1, M2, M3 below 0
  std::vector<NodalLoad> loads_;
  std::vector<Loads> groups_;  ///< the first one is empty
  Points points_;
  Field<Index>& group_;      ///< of each point
  std::vector<Vec> forces_;  ///< of each group now
  std::vector<Vec> means_;   ///< of each group over the last step
};

}  // namespace

/// Directions are axes; those of a system of their own move with it.
std::string keep_force_axes(LoadNodeCard& card, const Affine& motion) {
  if (card.cid != 0 || motion.linear() == Matrix::Identity()) return {};
  return "its direction is an axis, which a transformation that turns or stretches the file would change";
}
CurveOf curve_of_force(const LoadNodeCard& card) {
  return {"T", std::abs(card.dof) > 4 ? "ML2/T2" : "ML/T2"};
}

std::vector<NodalLoad> nodal_loads(const Deck& deck, const Model& model, const World& world,
                                   Diagnostics& diagnostics) {
  const auto& points = deck.all<LoadNodePoint>();
  const auto& sets = deck.all<LoadNodeSet>();
  if (points.empty() && sets.empty()) return {};
  NodalLoadReader reader(deck, model, world, diagnostics);
  for (const LoadNodePoint& card : points) reader.add(card);
  for (const LoadNodeSet& card : sets) reader.add(card);
  return reader.finish();
}

std::shared_ptr<Force> make_nodal_loads(const std::vector<NodalLoad>& loads, const Model& model,
                                        Points points, World& world) {
  if (loads.empty()) return nullptr;
  std::vector<Loads> loads_of(model.nodes.size());
  for (std::size_t k = 0; k < loads.size(); ++k)
    if (loads[k].turns == points.turns)
      for (const Index n : loads[k].nodes) loads_of[static_cast<std::size_t>(n)].push_back(k);
  const std::vector<Index> node = model_nodes(model, world, points);
  std::vector<Index> group_of(node.size(), 0);
  std::map<Loads, Index> known{{Loads(), 0}};
  std::vector<Loads> groups{Loads()};
  for (std::size_t i = 0; i < node.size(); ++i) {
    const Index follows = points.follow ? (*points.follow)[static_cast<Index>(i)] : 0;
    if (node[i] < 0 || (points.turns && follows != 0)) continue;
    const Loads& mine = loads_of[static_cast<std::size_t>(node[i])];
    const auto [it, is_new] = known.try_emplace(mine, static_cast<Index>(groups.size()));
    if (is_new) groups.push_back(mine);
    group_of[i] = it->second;
  }
  if (groups.size() == 1) return nullptr;
  auto& group =
      points.set->add<Index>({.name = points.turns ? "nodal_moments" : "nodal_loads", .dimension = "-"});
  for (std::size_t i = 0; i < node.size(); ++i) group[static_cast<Index>(i)] = group_of[i];
  return std::make_shared<NodalForces>(model, loads, std::move(groups), points, group);
}

}  // namespace courant
