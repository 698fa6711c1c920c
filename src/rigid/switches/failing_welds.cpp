// *CONSTRAINED_SPOTWELD and *CONSTRAINED_GENERALIZED_WELD_SPOT that fail: nodes that are one body until the
// weld passes on too large a force between two of them, or until a time.
#include "rigid/switches/failing_welds.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <memory>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "extension/additions.hpp"
#include "rigid/bodies/held_nodes.hpp"
#include "rigid/bodies/rigid_cards.hpp"
#include "rigid/switches/body_for_a_while.hpp"
#include "rigid/switches/switched_parts.hpp"
#include "state/reports.hpp"
#include "state/shared_fields.hpp"

namespace courant {

namespace {

/// (max(f_n, 0)/normal)^n + (f_s/shear)^m >= 1, where both are 0 never; f_n is the tension along the line
/// from the first node to the second, f_s the force across it. [ML/T2]
struct SpotStrength {
  Real normal = 0, shear = 0, n = 2, m = 2;
  Real time = weld_holds;  ///< of failure [T]
  bool breaks() const { return normal > 0 || shear > 0; }
  Real share(const Vec& on_first, const Vec& along) const {
    const Real tension = on_first.dot(along), across = (on_first - tension * along).norm();
    return (normal > 0 ? std::pow(std::max(tension, Real(0)) / normal, n) : 0) +
           (shear > 0 ? std::pow(across / shear, m) : 0);
  }
};

struct FailingWeld : BodyForAWhile {
  SpotStrength strength{};
  Index begun = 0;  ///< 1: it has been a body
};

class FailingWelds : public SwitchedNodes, public Impact, public EnergyTerm, public Restartable {
 public:
  FailingWelds(std::vector<FailingWeld> welds, World& world) : welds_(std::move(welds)), turns_(world) {
    world.counters["failed_welds"] += 0;
  }
  std::string name() const override { return "welds that fail"; }
  std::vector<std::vector<Index>> nodes_of_bodies() const override {
    std::vector<std::vector<Index>> out;
    for (const FailingWeld& weld : welds_) out.push_back(weld.b.nodes);
    return out;
  }

  void strike(World& world, const Clock& clock) override {
    for (FailingWeld& weld : welds_) {
      if (weld.begun == 0) weld.stiffen(world, clock, turns_), weld.begun = 1;
      if (weld.active == 0) continue;
      if (clock.t < weld.strength.time && holds(world, clock, weld)) continue;
      weld.release(world, clock, turns_);
      ++world.counters["failed_welds"];
    }
  }
  void record(World&, const Clock& clock, EnergyLedger&) override {
    for (FailingWeld& weld : welds_) weld.advance(clock);
  }
  void sample(const World&, const Clock&, EnergyLedger&) const override {}
  void keep(Archive& archive) override {
    for (std::size_t k = 0; k < welds_.size(); ++k) {
      const Archive::Group inside(archive, fmt::format("weld {}", k));
      archive("begun", welds_[k].begun);
      welds_[k].keep(archive);
    }
  }

 private:
  /// Moves the weld as one body, unless the force that this takes is beyond its strength: then forces are as
  /// before.
  bool holds(World& world, const Clock& clock, FailingWeld& weld) const {
    Nodes& nodes = world.nodes;
    std::vector<Vec> force, moment;
    for (const Index n : weld.b.nodes) {
      force.push_back(nodes.f.vec(n));
      moment.push_back(turns_.turns(n) ? turns_.moment->vec(n) : Vec(Vec::Zero()));
    }
    weld.move(world, clock, turns_);
    if (!weld.strength.breaks()) return true;
    const Index first = weld.b.nodes[0], second = weld.b.nodes[1];
    const Vec along = (nodes.x.vec(second) - nodes.x.vec(first)).normalized();
    if (weld.strength.share(nodes.f.vec(first) - force[0], along) < 1) return true;
    for (std::size_t k = 0; k < force.size(); ++k) {
      const Index n = weld.b.nodes[k];
      nodes.f.set(n, force[k]);
      if (turns_.turns(n)) turns_.moment->set(n, moment[k]);
    }
    return false;
  }

  std::vector<FailingWeld> welds_;
  NodalTurns turns_;
};

class WeldReader {
 public:
  WeldReader(const Deck& deck, const Model& model, World& world, Diagnostics& diagnostics)
      : deck_(deck), model_(model), world_(world), diagnostics_(diagnostics) {
    for (Index n = 0; n < world.nodes.size(); ++n) node_of_id_[world.nodes.id[n]] = n;
    for (const ModelNode& node : model.nodes) held_[node.id] = is_constrained(model, node);
    for (const ModelInertia& one : model.inertias)
      if (one.turns()) heavy_.insert(model.nodes[static_cast<std::size_t>(one.node)].id);
  }

  void add(const SpotweldCard& card) {
    if (may_fail(card)) add(card, "N2", "EP", {card.n1, card.n2});
  }
  void add(const WeldSpotCard& card) {
    if (!may_fail(card)) return;
    const auto set = model_.node_sets.find(card.nsid);
    if (set == model_.node_sets.end())
      return error(card, "NSID", fmt::format("node set {} does not exist", card.nsid),
                   "define it with *SET_NODE");
    std::vector<Id> ids;
    for (const Index n : set->second) ids.push_back(model_.nodes[static_cast<std::size_t>(n)].id);
    add(card, "NSID", "EPSF", ids);
  }
  void finish() {
    if (!world_.passes.all<const RigidWallReporter>().empty() && !welds_.empty())
      deck_.warning(diagnostics_, *first_, "",
                    "rigid walls stop the nodes of a weld one by one: the weld gets a little behind them",
                    "leave SN, SS and the time of failure blank where a weld meets a wall");
    if (!welds_.empty() && diagnostics_.ok())
      world_.passes.add(std::make_shared<FailingWelds>(std::move(welds_), world_));
  }

 private:
  void error(const Entry& card, const char* field, std::string message, std::string hint) {
    deck_.error(diagnostics_, card, field, std::move(message), std::move(hint));
  }

  template <class Card>
  void add(const Card& card, const char* field, const char* of_strain, const std::vector<Id>& ids) {
    if (card.ep > 0 && card.ep < weld_holds)
      return error(card, of_strain,
                   fmt::format("failure at a plastic strain ('{:g}') is not supported", card.ep),
                   "leave the field blank, or tie the nodes by *CONSTRAINED_TIED_NODES_FAILURE");
    if (model_.phase == RunPhase::relaxation)
      return error(
          card, field, "welds that fail are not supported beside a dynamic relaxation",
          "leave SN, SS and the time of failure blank, or start from the relaxed state by a restart");
    if (world_.dim == 2)
      return error(card, field, "welds that fail are not supported in plane scenes",
                   "leave SN, SS and TF blank");
    FailingWeld weld;
    const auto strength = [](Real given) { return given < weld_holds ? given : 0; };
    weld.strength = {strength(card.sn), strength(card.ss), card.n > 0 ? card.n : 2, card.m > 0 ? card.m : 2,
                     card.tf > 0 ? card.tf : weld_holds};
    for (const Id id : std::set<Id>(ids.begin(), ids.end())) {
      const auto node = node_of_id_.find(id);
      if (node == node_of_id_.end())
        return error(card, field, fmt::format("node {} is no node of elements", id),
                     "name nodes of elements");
      if (const char* why = why_not(node->second)) {
        return error(card, field, fmt::format("node {} {}: the weld cannot fail", id, why),
                     "weld other nodes, or leave SN, SS and the time of failure blank");
      }
      weld.b.nodes.push_back(node->second);
      taken_.insert(node->second);
    }
    if (weld.b.nodes.size() < 2)
      return error(card, field, "the same node twice", "a weld is between two nodes");
    if (!check_strength(card, field, weld)) return;
    if (!first_) first_ = &card;
    weld.b.name = fmt::format("weld of nodes {} and {}", ids[0], ids[1]);
    welds_.push_back(std::move(weld));
  }
  /// A force between nodes has a direction where there are two, apart.
  bool check_strength(const Entry& card, const char* field, const FailingWeld& weld) {
    if (!weld.strength.breaks()) return true;
    const auto x = [&](std::size_t k) { return world_.nodes.x.vec(weld.b.nodes[k]); };
    const bool two = weld.b.nodes.size() == 2;
    if (two && (x(1) - x(0)).norm() > 0) return true;
    error(card, field,
          two ? "the nodes are at one position: tension and shear have no directions"
              : fmt::format("a weld of {} nodes that fails at a force is not supported", weld.b.nodes.size()),
          two ? "move them apart, as sheets are by half of their thicknesses, or leave SN and SS blank"
              : "weld nodes in pairs, or leave SN and SS blank");
    return false;
  }
  const char* why_not(Index n) const {
    const auto* driven = shared_fields::prescribed_motion.find(world_.nodes.fields);
    return world_.nodes.follow[n] == 1           ? "goes with a rigid body"
           : world_.nodes.follow[n] == 2         ? "is tied to a face"
           : held_.at(world_.nodes.id[n])        ? "is held by SPC"
           : driven && (*driven)[n] != 0         ? "is driven by a prescribed motion"
           : heavy_.contains(world_.nodes.id[n]) ? "has an inertia by *ELEMENT_INERTIA"
           : taken_.contains(n)                  ? "belongs to another weld that fails"
           : !(world_.nodes.m[n] > 0)            ? "has no mass"
                                                 : nullptr;
  }

  const Deck& deck_;
  const Model& model_;
  World& world_;
  Diagnostics& diagnostics_;
  std::map<Id, Index> node_of_id_;
  std::map<Id, bool> held_;
  std::set<Id> heavy_;
  std::set<Index> taken_;
  const Entry* first_ = nullptr;  ///< card of the first weld
  std::vector<FailingWeld> welds_;
};

const RegisterAddition failing_welds{"*CONSTRAINED_SPOTWELD", [](const Deck& deck, const Model& model,
                                                                 World& world, Diagnostics& diagnostics) {
                                       const auto& spots = deck.all<SpotweldCard>();
                                       const auto& sets = deck.all<WeldSpotCard>();
                                       if (spots.empty() && sets.empty()) return;
                                       WeldReader reader(deck, model, world, diagnostics);
                                       for (const SpotweldCard& card : spots) reader.add(card);
                                       for (const WeldSpotCard& card : sets) reader.add(card);
                                       reader.finish();
                                     }};

}  // namespace

}  // namespace courant
