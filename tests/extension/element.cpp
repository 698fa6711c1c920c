// *ELEMENT_EXAMPLE_SPRING: linear springs between any two nodes that are no particles.
#include <cmath>
#include <limits>
#include <unordered_map>
#include <unordered_set>

#include "extension/additions.hpp"
#include "extension/compiled_against.hpp"
#include "keyword/common_rules.hpp"
#include "keyword/registry.hpp"
#include "parallel/parallel.hpp"

namespace {

using namespace courant;

struct Card : Entry {
  Id eid = 0, n1 = 0, n2 = 0;
  Real k = 0, m = 0;
};

const RegisterKeyword<Card> keyword{
    {.names = {"ELEMENT_EXAMPLE_SPRING"},
     .purpose = "spring between two nodes, at its length of rest at the start",
     .cards = {{.fields = {{"EID", &Card::eid, "-", "element id", rules::required_id},
                           {"N1", &Card::n1, "-", "node id", rules::required_id_of(IdSpace::node)},
                           {"N2", &Card::n2, "-", "node id", rules::required_id_of(IdSpace::node)},
                           {"K", &Card::k, "M/T2", "stiffness", {.required = true, .check = Check::positive}},
                           {"M",
                            &Card::m,
                            "M",
                            "mass of the spring, half for each node",
                            {.check = Check::not_negative}}}}}}};

class Springs : public Material, public TimeLimit, public EnergyTerm {
 public:
  Springs(ElementGroup& group, Real tssfac)
      : group_(group),
        tssfac_(tssfac),
        K(group.fields.add<Real>({.name = "stiffness", .dimension = "M/T2"})),
        L0(group.fields.add<Real>({.name = "rest_length", .dimension = "L"})),
        energy_(group.fields.add<Real>({.name = "internal_energy", .dimension = "ML2/T2", .output = true})) {}

  void set(Index e, Real stiffness, const World& world) {
    K[e] = stiffness;
    L0[e] = along(e, world).norm();
  }

  std::string name() const override { return group_.fields.name(); }
  const FieldSet& over(const World&) const override { return group_.fields; }
  void declare(const World& world, Accesses& a) const override {
    a.reads(world.nodes.x, Reach::others).reads(group_.node).reads(K).reads(L0);
    a.writes(energy_).writes(*group_.corner_force);
    a.in_finish().reads(world.nodes.m, Reach::others);
  }
  void block(World& world, const Clock&, Index begin, Index end) override {
    for (Index e = begin; e < end; ++e) {
      const Vec d = along(e, world);
      const Real length = d.norm(), stretch = length - L0[e];
      const Vec pull = length > 0 ? Vec(K[e] * stretch / length * d) : Vec(Vec::Zero());
      for (int k = 0; k < 3; ++k) {
        group_.corner_force->data(k)[e] = pull[k];
        group_.corner_force->data(3 + k)[e] = -pull[k];
      }
      energy_[e] = 0.5 * K[e] * stretch * stretch;
    }
  }

  /// 2/omega of two free masses, which is never above that of the whole.
  Limit limit(const World& world, const Clock&) override {
    Limit least{std::numeric_limits<Real>::infinity(), ""};
    for (Index e = 0; e < group_.size(); ++e) {
      const Real m1 = world.nodes.m[group_.node.data(0)[e]], m2 = world.nodes.m[group_.node.data(1)[e]];
      const Real dt = tssfac_ * 2 / std::sqrt(K[e] * (1 / m1 + 1 / m2));
      if (dt < least.dt) least = {dt, "spring " + std::to_string(group_.id[e])};
    }
    return least;
  }
  void record(World&, const Clock&, EnergyLedger&) override {}
  void sample(const World&, const Clock&, EnergyLedger& ledger) const override {
    ledger.internal += sum(group_.size(), [&](Index e) { return energy_[e]; });
  }

 private:
  Vec along(Index e, const World& world) const {
    return world.nodes.x.vec(group_.node.data(1)[e]) - world.nodes.x.vec(group_.node.data(0)[e]);
  }
  ElementGroup& group_;
  Real tssfac_;
  Field<Real>&K, &L0, &energy_;
};

const RegisterAddition added{
    "springs",
    [](const Deck& deck, const Model& model, World& world, Diagnostics& diagnostics) {
      const std::vector<Card>& cards = deck.all<Card>();
      if (cards.empty()) return;
      std::unordered_map<Id, Index> node_of_id;
      for (Index n = 0; n < world.nodes.size(); ++n)
        if (!world.nodes.follow[n]) node_of_id[world.nodes.id[n]] = n;
      FieldSet& set = world.add_set("springs");
      set.resize(static_cast<Index>(cards.size()));
      ElementGroup& group = *world.groups.emplace_back(std::make_unique<ElementGroup>(set, no_part, 2));
      const auto springs = std::make_shared<Springs>(group, model.tssfac);
      for (std::size_t k = 0; k < cards.size(); ++k) {
        const Card& card = cards[k];
        const auto e = static_cast<Index>(k);
        const auto n1 = node_of_id.find(card.n1), n2 = node_of_id.find(card.n2);
        if (n1 == node_of_id.end() || n2 == node_of_id.end()) {
          deck.error(diagnostics, card, n1 == node_of_id.end() ? "N1" : "N2",
                     "expected a node that is no particle and of no rigid body");
          continue;
        }
        group.id[e] = card.eid;
        group.node.data(0)[e] = n1->second;
        group.node.data(1)[e] = n2->second;
        group.mass[e] = card.m;
        for (int c = 0; c < 2; ++c) world.nodes.m[group.node.data(c)[e]] += card.m / 2;
        springs->set(e, card.k, world);
      }
      world.passes.add(springs);
    },
    [](const Deck& deck, const Model& model) {
      std::vector<Index> nodes;
      std::unordered_set<Id> ids;
      for (const Card& card : deck.all<Card>()) ids.insert({card.n1, card.n2});
      for (std::size_t n = 0; n < model.nodes.size(); ++n)
        if (ids.contains(model.nodes[n].id)) nodes.push_back(static_cast<Index>(n));
      return nodes;
    }};

}  // namespace
