// *CHANGE_VELOCITY: velocities of particles and nodes that change once, when a run goes on from a restart
// file.
#include <fmt/format.h>

#include <map>
#include <memory>
#include <unordered_map>
#include <unordered_set>
#include <utility>
#include <vector>

#include "extension/builders.hpp"
#include "keyword/registry.hpp"
#include "loads/load_cards.hpp"
#include "loads/loads.hpp"
#include "state/restartable.hpp"

namespace courant {

namespace {

struct ChangeVelocity : ChangeVelocityFields {
  bool only() const { return name == 1; }  // names in the order of the table
};
struct ChangeVelocityNode : ChangeVelocityNodeFields {
  bool only() const { return name == 1; }
};
const RegisterKeyword<ChangeVelocity> change_velocity{change_velocity_table()};
const RegisterKeyword<ChangeVelocityNode> change_velocity_node{change_velocity_node_table()};
const RegisterKeyword<ChangeVelocityZero> change_velocity_zero{change_velocity_zero_table()};

struct NewVelocity {
  Vec v = Vec::Zero(), omega = Vec::Zero();  ///< [L/T], [1/T]
};

/// What the cards change, all of them at once. A run that goes on again has the same cards, and a state that
/// has seen them.
class VelocityChange : public EnergyTerm, public Restartable {
 public:
  VelocityChange(std::map<Id, NewVelocity> of_node, bool others_rest, std::int64_t cards)
      : of_node_(std::move(of_node)), others_rest_(others_rest), cards_(cards) {}
  std::string name() const override { return "changes of velocities"; }
  void record(World&, const Clock&, EnergyLedger&) override {}
  void sample(const World&, const Clock&, EnergyLedger&) const override {}
  void keep(Archive& archive) override {
    std::int64_t cards = cards_;
    if (!archive.loading() || archive.has("cards"))
      archive("cards", cards);
    else
      cards = 0;
    if (archive.loading()) seen_ = cards == cards_;
  }
  void loaded(World& world) override {
    if (std::exchange(seen_, true)) return;
    change(points_of(world.particles), world);
    change(points_of(world.nodes), world);
    if (has_rotations(world.nodes)) change(rotations_of(world.nodes), world);
  }

 private:
  /// What it does to the kinetic energy is work from outside.
  void change(const Points& points, World& world) const {
    Real gained = 0;
    for (Index i = 0; i < loaded_points(points, world); ++i) {
      const auto found = of_node_.find((*points.id)[i]);
      if (found == of_node_.end() && !others_rest_) continue;
      const Vec now = found == of_node_.end() ? Vec(Vec::Zero())
                      : points.turns          ? found->second.omega
                                              : found->second.v;
      gained += 0.5 * (*points.m)[i] * (now.squaredNorm() - points.v->vec(i).squaredNorm());
      points.v->set(i, now);
    }
    world.energy.external_work += gained, world.energy.throughput += std::abs(gained);
  }

  std::map<Id, NewVelocity> of_node_;
  bool others_rest_;
  std::int64_t cards_;
  bool seen_ = true;  ///< by the state: nothing is left to do
};

void add_velocity_change(const Deck& deck, const Model& model, World& world, Diagnostics& diagnostics) {
  const auto& sets = deck.all<ChangeVelocity>();
  const auto& nodes = deck.all<ChangeVelocityNode>();
  const auto& zero = deck.all<ChangeVelocityZero>();
  const std::size_t cards = sets.size() + nodes.size() + zero.size();
  if (cards == 0) return;
  const Entry& first = !sets.empty()    ? Entry(sets.front())
                       : !nodes.empty() ? Entry(nodes.front())
                                        : Entry(zero.front());
  if (!world.goes_on)
    return diagnostics.warning(
        deck.where(first),
        fmt::format("{}: velocities change when a run goes on from a restart file; this "
                    "one starts from the beginning",
                    deck.keyword(first)),
        "run the deck with --restart, or give velocities by *INITIAL_VELOCITY");
  std::map<Id, NewVelocity> of_node;
  bool others_rest = !zero.empty();
  for (const ChangeVelocity& card : sets) {
    const auto set = model.node_sets.find(card.nsid);
    if (set == model.node_sets.end()) {
      deck.error(diagnostics, card, "NSID", fmt::format("node set {} does not exist", card.nsid),
                 "define it with *SET_NODE");
      continue;
    }
    for (const Index n : set->second)
      of_node[model.nodes[static_cast<std::size_t>(n)].id] = {Vec(card.vx, card.vy, card.vz),
                                                              Vec(card.vxr, card.vyr, card.vzr)};
    others_rest = others_rest || !card.only();
  }
  std::unordered_set<Id> known;
  if (!nodes.empty())
    for (const ModelNode& node : model.nodes) known.insert(node.id);
  for (const ChangeVelocityNode& card : nodes) {
    if (!known.contains(card.nid))
      deck.error(diagnostics, card, "NID", fmt::format("node {} does not exist", card.nid), "correct the id");
    of_node[card.nid] = {Vec(card.vx, card.vy, card.vz), Vec(card.vxr, card.vyr, card.vzr)};
    others_rest = others_rest || !card.only();
  }
  for (Index n = 0; n < world.nodes.size(); ++n)
    if (world.nodes.follow[n] != 0 && (others_rest || of_node.contains(world.nodes.id[n])))
      return diagnostics.error(
          deck.where(first),
          fmt::format(
              "{}: node {} goes with a rigid body or a tied face, whose velocity does not change at a "
              "restart",
              deck.keyword(first), world.nodes.id[n]),
          others_rest ? "name the nodes that change with _ONLY, and leave its nodes out" : "leave it out");
  for (const ModelNode& node : model.nodes)
    if (const auto found = of_node.find(node.id); found != of_node.end())
      for (int k = 0; k < 3; ++k)
        if (node.fixed[static_cast<std::size_t>(k)]) found->second.v[k] = 0;
  world.passes.add(
      std::make_shared<VelocityChange>(std::move(of_node), others_rest, static_cast<std::int64_t>(cards)));
}

const RegisterBuilder velocity_changes(BuildPhase::conditions, "changes of velocities", add_velocity_change,
                                       Errors::go_on);

}  // namespace

}  // namespace courant
