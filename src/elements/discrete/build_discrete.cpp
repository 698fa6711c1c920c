#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <set>
#include <unordered_map>

#include "elements/discrete/cards_discrete.hpp"
#include "elements/discrete/discrete.hpp"
#include "elements/nodal_rotations.hpp"
#include "extension/additions.hpp"

namespace courant {

namespace {

using NodesById = std::unordered_map<Id, Index>;

NodesById nodes_by_id(const Model& model) {
  NodesById out;
  for (std::size_t n = 0; n < model.nodes.size(); ++n) out.emplace(model.nodes[n].id, static_cast<Index>(n));
  return out;
}

bool has_any(const Deck& deck, const Model& model) {
  return !deck.all<ElementDiscreteCard>().empty() || !deck.all<ElementMassCard>().empty() ||
         !deck.all<ElementMassSetCard>().empty() || !model.inertias.empty();
}

class DiscreteReader {
 public:
  DiscreteReader(const Deck& deck, const Model& model, const std::vector<Index>& node_of, World& world,
                 Diagnostics& diagnostics)
      : deck_(deck),
        model_(model),
        node_of_(node_of),
        world_(world),
        diagnostics_(diagnostics),
        node_of_id_(nodes_by_id(model)) {
    for (const SectionDiscrete& s : deck.all<SectionDiscrete>()) sections_.emplace(s.secid, &s);
    for (const SdOrientation& o : deck.all<SdOrientation>()) orientations_.emplace(o.vid, &o);
  }

  void add_masses() {
    struct Lumped {
      Id id;
      Index node;
      Real mass;
    };
    std::vector<Lumped> masses;
    std::map<Id, const Entry*> known;
    const auto add = [&](const ElementMassCard& card, const std::vector<Index>& nodes) {
      is_new(known, card, card.eid, "mass element");
      for (const Index n : nodes) {
        const Index in_world = node(card, "NID", n);
        if (in_world < 0) return;
        masses.push_back({card.eid, in_world, card.mass});
      }
    };
    for (const ElementMassCard& card : deck_.all<ElementMassCard>())
      if (const Index n = find(card, "NID", card.nid); n >= 0) add(card, {n});
    for (const ElementMassSetCard& card : deck_.all<ElementMassSetCard>()) {
      const auto set = model_.node_sets.find(card.nid);
      if (set == model_.node_sets.end())
        error(card, "NSID", fmt::format("node set {} does not exist", card.nid),
              "define it with *SET_NODE_LIST");
      else
        add(card, set->second);
    }
    if (!model_.inertias.empty()) NodalRotations(world_.nodes.fields);
    for (const ModelInertia& one : model_.inertias)
      if (const Index n = node(one.card, "NID", one.node); n >= 0 && one.mass > 0)
        masses.push_back({one.id, n, one.mass});
    if (masses.empty()) return;
    std::stable_sort(masses.begin(), masses.end(),
                     [](const Lumped& a, const Lumped& b) { return a.id < b.id; });
    FieldSet& set = world_.add_set("lumped masses");
    set.resize(static_cast<Index>(masses.size()));
    ElementGroup& group = *world_.groups.emplace_back(std::make_unique<ElementGroup>(set, no_part, 1));
    for (Index e = 0; e < group.size(); ++e) {
      const Lumped& one = masses[static_cast<std::size_t>(e)];
      group.id[e] = one.id, group.node[e] = one.node, group.mass[e] = one.mass;
      world_.nodes.m[one.node] += one.mass;
    }
  }

  std::vector<SpringPart> springs() {
    std::map<Index, std::vector<const ElementDiscreteCard*>> of_part;  // in the order of parts
    std::map<Id, const Entry*> known;
    for (const ElementDiscreteCard& card : deck_.all<ElementDiscreteCard>()) {
      is_new(known, card, card.eid, "discrete element");
      const auto part = model_.part_of_id.find(card.pid);
      if (part == model_.part_of_id.end())
        error(card, "PID", fmt::format("part {} does not exist", card.pid), "define it with *PART");
      else
        of_part[part->second].push_back(&card);
    }
    std::vector<SpringPart> out;
    if (of_part.empty()) return out;
    const auto laws = find_spring_laws(deck_, model_, diagnostics_);
    for (auto& [index, cards] : of_part) {
      std::stable_sort(cards.begin(), cards.end(),
                       [](const auto* a, const auto* b) { return a->eid < b->eid; });
      SpringPart part;
      const ModelPart& model_part = model_.parts[static_cast<std::size_t>(index)];
      if (!read_part(model_part, *cards.front(), laws, part)) continue;
      FieldSet& set = world_.add_set(fmt::format("springs of part {}", model_part.id));
      set.resize(static_cast<Index>(cards.size()));
      part.group = world_.groups.emplace_back(std::make_unique<ElementGroup>(set, index, 2)).get();
      if (part.turns) {
        NodalRotations(world_.nodes.fields);
        part.group->keep_corner_moments();
      }
      for (std::size_t k = 0; k < cards.size(); ++k) add_spring(*cards[k], static_cast<Index>(k), part);
      out.push_back(std::move(part));
    }
    return out;
  }

 private:
  void error(const Entry& card, const char* field, std::string message, std::string hint = {}) {
    deck_.error(diagnostics_, card, field, std::move(message), std::move(hint));
  }
  void is_new(std::map<Id, const Entry*>& known, const Entry& card, Id eid, const char* what) {
    const auto [it, added] = known.try_emplace(eid, &card);
    if (!added)
      error(card, "EID",
            fmt::format("{} {} is defined twice, first at {}", what, eid, deck_.place(*it->second)));
  }
  /// Of the model; -1 with an error.
  Index find(const Entry& card, const char* field, Id id) {
    const auto found = node_of_id_.find(id);
    if (found != node_of_id_.end()) return found->second;
    error(card, field, fmt::format("node {} has no coordinates", id), "define it with *NODE");
    return -1;
  }
  /// Of the world; -1 with an error.
  Index node(const Entry& card, const char* field, Index n) {
    const Index out = node_of_[static_cast<std::size_t>(n)];
    if (out < 0)
      error(card, field,
            fmt::format("node {} carries a particle", model_.nodes[static_cast<std::size_t>(n)].id),
            "springs and masses act on nodes of elements and of their own");
    return out;
  }

  bool read_part(const ModelPart& part, const ElementDiscreteCard& first,
                 const std::map<Id, std::shared_ptr<SpringLaw>>& laws, SpringPart& out) {
    if (part.has_sph || part.has_shell || part.has_solid) {
      error(first, "PID", fmt::format("part {} has other elements already", part.id),
            "give the springs a part of their own");
      return false;
    }
    const auto section = sections_.find(part.secid);
    if (section == sections_.end()) {
      error(part.card, "SECID",
            fmt::format("the springs of part {} need a *SECTION_DISCRETE with id {}; {}", part.id, part.secid,
                        deck_.found_instead(IdSpace::section, part.secid)));
      return false;
    }
    const SectionDiscrete& s = *section->second;
    if (s.kd > 0 && !(s.v0 > 0))
      error(s, "V0", "expected a number > 0 beside KD", "the force is multiplied by 1 + KD |V|/V0");
    const bool units = std::any_of(deck_.files.begin(), deck_.files.end(),
                                   [](const DeckFile& file) { return file.conversion.units.any(); });
    if (s.turns() && units)
      error(s, "DRO", "torsional springs are not supported in decks with files that have unit factors",
            "their stiffness, offsets and curves have other dimensions than those of translational ones");
    out.turns = s.turns(), out.kd = s.kd, out.v0 = s.v0;
    const auto law = laws.find(part.mid);
    if (law == laws.end()) {
      error(part.card, "MID",
            fmt::format("the springs of part {} need a material of springs or dampers with id {}; {}",
                        part.id, part.mid, deck_.found_instead(IdSpace::material, part.mid)),
            fmt::format("add one of {}, and give its id here", spring_keywords()));
      return false;
    }
    out.law = law->second;
    return out.law != nullptr;
  }

  void add_spring(const ElementDiscreteCard& card, Index e, SpringPart& part) {
    ElementGroup& group = *part.group;
    const bool grounded = card.n2 == 0;
    const Index n1 = find(card, "N1", card.n1), n2 = grounded ? n1 : find(card, "N2", card.n2);
    Vec along = Vec::Zero();
    if (card.vid != 0) {
      const auto found = orientations_.find(card.vid);
      if (found == orientations_.end())
        error(card, "VID", fmt::format("orientation {} does not exist", card.vid),
              "define it with *DEFINE_SD_ORIENTATION");
      else if (along = Vec(found->second->xt, found->second->yt, found->second->zt); !(along.norm() > 0))
        error(*found->second, "XT", "the vector has no direction", "give XT, YT, ZT, not all zero");
      else
        along.normalize();
    } else if (grounded) {
      error(card, "N2",
            fmt::format("a spring to the ground needs a direction, which discrete element {} has not",
                        card.eid),
            "give it VID and *DEFINE_SD_ORIENTATION, or a second node that is held");
      return;
    }
    part.scale.push_back(card.s), part.along.push_back(along), part.shown.push_back(card.pf == 0);
    part.grounded.push_back(grounded), part.ground.push_back(Vec::Zero());
    if (n1 < 0 || n2 < 0) return;
    if (!grounded && n1 == n2)
      return error(card, "N2",
                   fmt::format("discrete element {} begins and ends at node {}", card.eid, card.n1),
                   "give it two nodes, or leave N2 blank for a spring to the ground");
    const Vec x1 = model_.nodes[static_cast<std::size_t>(n1)].x,
              x2 = model_.nodes[static_cast<std::size_t>(n2)].x;
    if (card.vid == 0 && !((x2 - x1).norm() > 0)) {
      error(card, "VID",
            fmt::format("the ends of discrete element {} coincide, so the line between them has no direction",
                        card.eid),
            "give it VID and *DEFINE_SD_ORIENTATION");
      return;
    }
    part.ground.back() = x2;
    const Index in_world[] = {node(card, "N1", n1), node(card, "N2", n2)};
    if (in_world[0] < 0 || in_world[1] < 0) return;
    group.id[e] = card.eid;
    for (int c = 0; c < 2; ++c) group.node.data(c)[e] = in_world[c];
    stretch_of(part)[e] = card.offset;
  }

  const Deck& deck_;
  const Model& model_;
  const std::vector<Index>& node_of_;
  World& world_;
  Diagnostics& diagnostics_;
  NodesById node_of_id_;
  std::map<Id, const SectionDiscrete*> sections_;
  std::map<Id, const SdOrientation*> orientations_;
};

}  // namespace

Field<Real>& stretch_of(const SpringPart& part) {
  return part.group->fields.add<Real>({.name = part.turns ? "relative_rotation" : "stretch",
                                       .dimension = part.turns ? "-" : "L",
                                       .output = true});
}

std::vector<Index> discrete_nodes(const Deck& deck, const Model& model) {
  std::vector<Index> out;
  if (!has_any(deck, model)) return out;
  const NodesById of_id = nodes_by_id(model);
  const auto add = [&](Id id) {
    if (const auto n = of_id.find(id); n != of_id.end()) out.push_back(n->second);
  };
  for (const ElementDiscreteCard& card : deck.all<ElementDiscreteCard>()) add(card.n1), add(card.n2);
  for (const ElementMassCard& card : deck.all<ElementMassCard>()) add(card.nid);
  for (const ElementMassSetCard& card : deck.all<ElementMassSetCard>())
    if (const auto set = model.node_sets.find(card.nid); set != model.node_sets.end())
      out.insert(out.end(), set->second.begin(), set->second.end());
  for (const ModelInertia& one : model.inertias) out.push_back(one.node);
  return out;
}

std::vector<SpringPart> build_discrete(const Deck& deck, const Model& model,
                                       const std::vector<Index>& node_of, World& world,
                                       Diagnostics& diagnostics) {
  add_part_masses(deck, model, world, diagnostics);
  if (!has_any(deck, model)) return {};
  DiscreteReader reader(deck, model, node_of, world, diagnostics);
  reader.add_masses();
  return reader.springs();
}

}  // namespace courant
