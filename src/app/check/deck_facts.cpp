#include "app/check/deck_facts.hpp"

#include <algorithm>
#include <cmath>

#include "keyword/registry.hpp"
#include "model/cards.hpp"
#include "model/mesh/part_composite.hpp"
#include "model/mesh/part_inertia.hpp"

namespace courant {

namespace {

/// What elements of a keyword are called, from its name: *ELEMENT_SOLID_ORTHO are solids.
std::string kind_of(const std::string& keyword) {
  const auto begins = [&](const std::string& name) {
    return keyword.rfind(name, 0) == 0 && (keyword.size() == name.size() || keyword[name.size()] == '_');
  };
  struct Kind {
    const char *name, *kind;
  };
  constexpr Kind kinds[] = {{"ELEMENT_SPH", "SPH particles"},
                            {"ELEMENT_SOLID", "solids"},
                            {"ELEMENT_SHELL", "shells"},
                            {"ELEMENT_TSHELL", "thick shells"},
                            {"ELEMENT_BEAM", "beams"},
                            {"ELEMENT_DISCRETE_SPHERE", "discrete spheres"},
                            {"ELEMENT_DISCRETE", "springs and dampers"},
                            {"ELEMENT_SEATBELT", "seat belts"},
                            {"ELEMENT_MASS_PART", "masses added to parts"},
                            {"ELEMENT_MASS", "lumped masses"},
                            {"ELEMENT_INERTIA", "lumped inertias"},
                            {"ELEMENT_PLOTEL", "lines for plots"}};
  for (const Kind& kind : kinds)
    if (begins(kind.name)) return kind.kind;
  return begins("ELEMENT") ? "other elements" : "";
}

struct FieldPlace {
  std::size_t card = 0, field = 0;
  bool found = false;
};

FieldPlace find_field(const KeywordSpec& spec, std::initializer_list<const char*> names) {
  for (std::size_t c = 0; c < spec.cards.size(); ++c)
    for (std::size_t f = 0; f < spec.cards[c].fields.size(); ++f)
      if (std::find(names.begin(), names.end(), spec.cards[c].fields[f].name) != names.end())
        return {c, f, true};
  return {};
}

Real number(const KeywordSpec& spec, const Entry& entry, FieldPlace place) {
  return place.found ? spec.number_of(entry, place.card, place.field) : 0;
}

class FactGatherer {
 public:
  explicit FactGatherer(const Deck& deck) : deck_(deck) {}

  DeckFacts gather() {
    gather_nodes();
    const auto& registry = keyword_registry();
    for (std::size_t k = 0; k < registry.size(); ++k) {
      const auto keyword = static_cast<std::int32_t>(k);
      const std::string& name = registry[k]->names[0];
      if (name.rfind("PART", 0) == 0) gather_parts(*registry[k], keyword);
      if (name.rfind("MAT_", 0) == 0) gather_materials(*registry[k], keyword);
      if (!kind_of(name).empty()) gather_elements(*registry[k], keyword, kind_of(name));
    }
    for (const auto& [name, use] : deck_.keywords)
      if (const std::string kind = kind_of(name); use.lines > 0 && !kind.empty())
        elements_[kind].unread += use.lines;
    for (auto& [kind, facts] : elements_) {
      facts.kind = kind;
      facts_.elements.push_back(facts);
    }
    gather_loads();
    return std::move(facts_);
  }

  DeckFacts gather_for_units() {
    gather_nodes();
    const auto& registry = keyword_registry();
    for (std::size_t k = 0; k < registry.size(); ++k)
      if (registry[k]->names[0].rfind("MAT_", 0) == 0)
        gather_materials(*registry[k], static_cast<std::int32_t>(k));
    gather_loads();
    return std::move(facts_);
  }

 private:
  void gather_nodes() {
    const auto& nodes = deck_.all<NodeCard>();
    facts_.nodes = nodes.size();
    if (nodes.empty()) return;
    facts_.low = facts_.high = Vec(nodes[0].x, nodes[0].y, nodes[0].z);
    for (const NodeCard& n : nodes) {
      const Vec x(n.x, n.y, n.z);
      facts_.low = facts_.low.cwiseMin(x);
      facts_.high = facts_.high.cwiseMax(x);
    }
  }

  void gather_parts(const KeywordSpec& spec, std::int32_t keyword) {
    const FieldPlace pid = find_field(spec, {"PID"}), secid = find_field(spec, {"SECID"}),
                     mid = find_field(spec, {"MID"}), eosid = find_field(spec, {"EOSID"}),
                     tm = find_field(spec, {"TM"});
    if (!pid.found || !secid.found) return;
    spec.for_each(deck_, keyword, [&](const Entry& entry) {
      PartFacts& part = facts_.parts[id(spec, entry, pid)];
      part.defined = true;
      part.secid = id(spec, entry, secid), part.mid = id(spec, entry, mid),
      part.eosid = id(spec, entry, eosid);
      part.mass += number(spec, entry, tm);
    });
    for (const PartCard& card : deck_.all<PartCard>()) facts_.parts[card.pid].title = card.title;
    for (const PartContactCard& card : deck_.all<PartContactCard>())
      facts_.parts[card.pid].title = card.title;
    for (const PartCompositeCard& card : deck_.all<PartCompositeCard>()) {
      facts_.parts[card.pid].defined = true, facts_.parts[card.pid].title = card.title;
      if (!card.mid1.empty()) facts_.parts[card.pid].mid = card.mid1.front();
    }
    for (const PartInertiaCard& card : deck_.all<PartInertiaCard>())
      facts_.parts[card.pid].title = card.title;
  }

  void gather_materials(const KeywordSpec& spec, std::int32_t keyword) {
    const FieldPlace ro = find_field(spec, {"RO"}), E = find_field(spec, {"E"});
    spec.for_each(deck_, keyword, [&](const Entry& entry) {
      facts_.materials.push_back({.keyword = deck_.keyword(entry),
                                  .id = spec.id_of(entry),
                                  .ro = number(spec, entry, ro),
                                  .E = number(spec, entry, E)});
    });
  }

  void gather_elements(const KeywordSpec& spec, std::int32_t keyword, const std::string& kind) {
    const FieldPlace mass = find_field(spec, {"MASS", "ADDMASS"}), pid = find_field(spec, {"PID"}),
                     nid = find_field(spec, {"NID"}), nend = find_field(spec, {"NEND"});
    ElementFacts sum;
    PartFacts* part = nullptr;  // of the last element: mostly that of the next one, too
    Id last_part = 0;
    spec.for_each(deck_, keyword, [&](const Entry& entry) {
      const Id first = id(spec, entry, nid), last = id(spec, entry, nend);
      const auto count = last > first ? static_cast<std::size_t>(last - first) + 1 : 1;
      const Real given = number(spec, entry, mass) * static_cast<Real>(count);
      sum.count += count;
      (given < 0 ? sum.volume : sum.mass) += std::abs(given);
      if (!pid.found) return;
      const Id in_part = id(spec, entry, pid);
      if (!part || in_part != last_part) part = &facts_.parts[in_part];
      last_part = in_part;
      part->elements[kind] += count;
      part->mass += std::max(given, Real(0));
    });
    if (sum.count == 0) return;
    ElementFacts& all = elements_[kind];
    all.count += sum.count, all.mass += sum.mass, all.volume += sum.volume;
  }

  void gather_loads() {
    Vec g = Vec::Zero();
    for (const LoadBodyCard& load : deck_.all<LoadBodyCard>())
      for (const DefineCurveCard& curve : deck_.all<DefineCurveCard>())
        if (curve.lcid == load.lcid && load.name >= 0 && load.name < 3)
          for (const Real value : curve.o)
            g[load.name] = std::max(g[load.name], std::abs(load.sf * curve.sfo * (value + curve.offo)));
    facts_.gravity = g.norm();
    if (const auto* card = deck_.last<ControlTerminationCard>()) facts_.endtim = card->endtim;
  }

  static Id id(const KeywordSpec& spec, const Entry& entry, FieldPlace place) {
    constexpr Real most = 9.0e18;  // numbers come as reals here; ids as large are faults anyway
    return static_cast<Id>(std::clamp(number(spec, entry, place), -most, most));
  }

  const Deck& deck_;
  DeckFacts facts_;
  std::map<std::string, ElementFacts> elements_;
};

}  // namespace

DeckFacts gather_facts(const Deck& deck) {
  return FactGatherer(deck).gather();
}

DeckFacts gather_unit_facts(const Deck& deck) {
  return FactGatherer(deck).gather_for_units();
}

}  // namespace courant
