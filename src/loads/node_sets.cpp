// *CONSTRAINED_NODE_SET.
#include "loads/node_sets.hpp"
#include "loads/load_cards.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <map>

#include "keyword/registry.hpp"
#include "model/transforms/transformation.hpp"
#include "state/shared_fields.hpp"
#include "state/tied_mass.hpp"

namespace courant {

namespace {

using CN = ConstrainedNodeSet;

const RegisterKeyword<CN> constrained_node_set{constrained_node_set_table()};

/// Nodes that share their acceleration along some axes: that of the sum of their forces and masses.
struct SharedAxes {
  std::vector<Index> nodes{};  ///< indices into World::nodes
  std::array<bool, 3> axes{};
  Real until = 1e20;  ///< [T]
};

/// f_i = m_i (sum f / sum m), so that all have one acceleration, and what joins them does no work.
class NodeSets : public Constraint {
 public:
  NodeSets(std::vector<SharedAxes> sets, World& world)
      : sets_(std::move(sets)), a_(sets_.size(), Vec::Zero()), on_(sets_.size(), 1) {
    set_of_.assign(static_cast<std::size_t>(world.nodes.size()), {-1, -1, -1});
    Field<Index>& alike = shared_fields::alike_axes.add(world.nodes.fields);
    Field<Index>& joined = shared_fields::joined_nodes.add(world.nodes.fields);
    for (std::size_t s = 0; s < sets_.size(); ++s)
      for (const Index n : sets_[s].nodes) joined[n] = 1 + sets_[s].nodes.front();
    for (std::size_t s = 0; s < sets_.size(); ++s)
      for (const Index n : sets_[s].nodes)
        for (std::size_t k = 0; k < 3; ++k)
          if (sets_[s].axes[k]) {
            set_of_[static_cast<std::size_t>(n)][k] = static_cast<Index>(s);
            alike[n] |= static_cast<Index>(1) << k;
          }
  }
  std::string name() const override { return "node sets that move alike"; }
  const FieldSet& over(const World& world) const override { return world.nodes.fields; }
  void declare(const World& world, Accesses& a) const override {
    a.in_start().reads(world.nodes.f, Reach::others).reads(world.nodes.m, Reach::others);
    a.in_block().revises(world.nodes.f).reads(world.nodes.m);
  }
  void start(World& world, const Clock& clock) override {
    for (std::size_t s = 0; s < sets_.size(); ++s) {
      on_[s] = clock.t < sets_[s].until;
      Vec force = Vec::Zero();
      Real mass = 0;
      for (const Index n : sets_[s].nodes) force += world.nodes.f.vec(n), mass += world.nodes.m[n];
      a_[s] = force / mass;
    }
  }
  void block(World& world, const Clock&, Index begin, Index end) override {
    for (Index n = begin; n < end; ++n)
      for (std::size_t k = 0; k < 3; ++k) {
        const Index s = set_of_[static_cast<std::size_t>(n)][k];
        if (s < 0 || !on_[static_cast<std::size_t>(s)]) continue;
        const auto axis = static_cast<int>(k);
        world.nodes.f.data(axis)[n] = world.nodes.m[n] * a_[static_cast<std::size_t>(s)][axis];
      }
  }

 private:
  std::vector<SharedAxes> sets_;
  std::vector<Vec> a_;  ///< of each set [L/T2]
  std::vector<char> on_;
  std::vector<std::array<Index, 3>> set_of_;  ///< of each node, along each axis; -1: none
};

class NodeSetBuilder {
 public:
  NodeSetBuilder(const Deck& deck, const Model& model, World& world, Diagnostics& diagnostics)
      : deck_(deck),
        model_(model),
        world_(world),
        diagnostics_(diagnostics),
        driven_(shared_fields::prescribed_motion.find(world.nodes.fields)) {
    for (Index n = 0; n < world.nodes.size(); ++n) world_node_[world.nodes.id[n]] = n;
  }

  void add(const CN& card) {
    for (const auto& [name, use] : deck_.keywords)
      if (name.starts_with("RIGIDWALL"))
        return error(card, "", fmt::format("it is not supported beside *{}", name),
                     "use plates of *MAT_RIGID with *CONTACT as walls");
    const auto set = model_.node_sets.find(card.nsid);
    if (set == model_.node_sets.end() || set->second.empty())
      return error(card, "NSID",
                   fmt::format("node set {} {}", card.nsid,
                               set == model_.node_sets.end() ? "does not exist" : "is empty"),
                   "define it with *SET_NODE");
    SharedAxes shared{.nodes = {}, .axes = axes_of_code(card.dof), .until = card.tf > 0 ? card.tf : 1e20};
    for (const Index n : set->second)
      if (!add_node(card, n, shared)) return;
    std::sort(shared.nodes.begin(), shared.nodes.end());
    shared.nodes.erase(std::unique(shared.nodes.begin(), shared.nodes.end()), shared.nodes.end());
    start(card, shared);
    sets_.push_back(std::move(shared));
  }
  std::vector<SharedAxes> finish() { return std::move(sets_); }

 private:
  void error(const CN& card, const char* field, std::string message, std::string hint) {
    deck_.error(diagnostics_, card, field, std::move(message), std::move(hint));
  }

  bool add_node(const CN& card, Index of_model, SharedAxes& shared) {
    const ModelNode& node = model_.nodes[static_cast<std::size_t>(of_model)];
    const auto refuse = [&](const char* message, const char* hint) {
      error(card, "NSID", fmt::format("node {} {}", node.id, message), hint);
      return false;
    };
    const auto found = world_node_.find(node.id);
    if (found == world_node_.end())
      return refuse("belongs to no element", "name nodes of solids, shells and beams");
    const Index n = found->second;
    if (world_.nodes.follow[n] != 0)
      return refuse("goes with a rigid body, or with a face to which it is tied", "leave it out");
    if (!(world_.nodes.m[n] > 0)) return refuse("has no mass", "give it one by *ELEMENT_MASS");
    if (driven_ && (*driven_)[n] != 0)
      return refuse("is driven by *BOUNDARY_PRESCRIBED_MOTION", "drive all nodes of the set instead");
    for (std::size_t k = 0; k < 3; ++k) {
      if (!shared.axes[k]) continue;
      if (node.fixed[k])
        return refuse("is held along such an axis by *BOUNDARY_SPC or TC",
                      "hold all nodes of the set instead");
      const auto [before, is_new] = taken_.try_emplace({n, k}, sets_.size());
      if (!is_new && before->second != sets_.size())
        return refuse("is in another *CONSTRAINED_NODE_SET with such an axis", "join the sets");
    }
    shared.nodes.push_back(n);
    return true;
  }

  /// One velocity, with the momentum that they have.
  void start(const CN& card, const SharedAxes& shared) {
    Nodes& nodes = world_.nodes;
    Vec momentum = Vec::Zero();
    Real mass = 0, energy = 0, lost = 0;
    for (const Index n : shared.nodes) {
      momentum += nodes.m[n] * nodes.v.vec(n), mass += nodes.m[n];
      energy += 0.5 * nodes.m[n] * nodes.v.vec(n).squaredNorm();
    }
    for (const Index n : shared.nodes)
      for (int k = 0; k < 3; ++k) {
        if (!shared.axes[static_cast<std::size_t>(k)]) continue;
        Real& v = nodes.v.data(k)[n];
        const Real mean = momentum[k] / mass;
        lost += 0.5 * nodes.m[n] * (v * v - mean * mean);
        v = mean;
      }
    constexpr Real rounding = 1e-6;
    if (lost > rounding * energy)
      deck_.warning(
          diagnostics_, card, "NSID",
          fmt::format("velocities at the start do not fit: {:.4g} of {:.4g} of kinetic energy [ML2/T2] "
                      "of the nodes is lost, as in a plastic impact",
                      lost, energy),
          "give them the same velocity");
  }

  const Deck& deck_;
  const Model& model_;
  World& world_;
  Diagnostics& diagnostics_;
  const Field<Index>* driven_;  ///< null: nothing is
  std::map<Id, Index> world_node_;
  std::map<std::pair<Index, std::size_t>, std::size_t> taken_;  ///< node and axis, by number of set
  std::vector<SharedAxes> sets_;
};

}  // namespace

std::string keep_shared_axes(ConstrainedNodeSet& card, const Affine& motion) {
  if (card.dof == 7 || motion.linear() == Matrix::Identity()) return {};
  return "its directions are axes, which a transformation that turns or stretches the file would change";
}

std::shared_ptr<Constraint> make_node_sets(const Deck& deck, const Model& model, World& world,
                                           Diagnostics& diagnostics) {
  const auto& cards = deck.all<CN>();
  if (cards.empty()) return nullptr;
  NodeSetBuilder builder(deck, model, world, diagnostics);
  for (const CN& card : cards) builder.add(card);
  return diagnostics.ok() ? std::make_shared<NodeSets>(builder.finish(), world) : nullptr;
}

}  // namespace courant
