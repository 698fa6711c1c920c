#include "elements/solid/section_solid.hpp"

#include <fmt/format.h>

#include <map>
#include <set>

#include "keyword/registry.hpp"

namespace courant {

namespace {

using S = SectionSolid;

const RegisterKeyword<SectionSolid> section_solid{section_solid_table()};

struct Found {
  const SolidFormulation* formulation = nullptr;
  const Elform* elform = nullptr;
};
Found find_elform(int number) {
  for (const SolidFormulation& one : solid_formulations())
    for (const Elform& elform : one.elforms)
      if (number != 0 && elform.number == number) return {&one, &elform};
  return {};
}

void check_shapes(const Deck& deck, const Model& model, Index part, const S& s, Diagnostics& diagnostics) {
  const auto [formulation, elform] = find_elform(s.elform);
  if (!formulation) return;
  const Id id = model.parts[static_cast<std::size_t>(part)].id;
  for (const ModelSolid& solid : model.solids) {
    if (solid.part != part) continue;
    if (elform->nodes != 0 && solid.different_nodes() != elform->nodes)
      return deck.error(diagnostics, s, "ELFORM",
                        fmt::format("{} is a formulation of {}, and solid {} of part {} is none", s.elform,
                                    elform->shape, solid.id, id),
                        "1 takes all shapes without nodes on edges");
    if (elform->nodes == 0 && solid.has_nodes_on_edges())
      return deck.error(diagnostics, s, "ELFORM",
                        fmt::format("{} is no formulation of {}, as is solid {} of part {}", s.elform,
                                    solid.is_hexahedron_of_twenty() ? "hexahedra of twenty nodes"
                                                                    : "tetrahedra of ten nodes",
                                    solid.id, id),
                        solid.is_hexahedron_of_twenty() ? "23 is one" : "16 is one");
  }
  if (*elform->warning != 0)
    deck.warning(diagnostics, s, "ELFORM", fmt::format(fmt::runtime(elform->warning), id, s.elform),
                 elform->hint);
}

void check_fields(const Deck& deck, const S& s, Diagnostics& diagnostics) {
  if (!find_elform(s.elform).elform) {
    std::map<int, std::string> offers;
    for (const SolidFormulation& one : solid_formulations())
      for (const Elform& elform : one.elforms)
        if (*elform.offer != 0) offers.emplace(elform.number, elform.offer);
    std::string all;
    for (const auto& [number, offer] : offers) all += (all.empty() ? "" : ", ") + offer;
    deck.error(diagnostics, s, "ELFORM", fmt::format("'{}' is not supported", s.elform),
               "supported values: " + all);
  }
  const auto refuse = [&](const char* field, Real value, const char* what) {
    if (value != 0)
      deck.error(diagnostics, s, field, fmt::format("{} are not supported, got '{:g}'", what, value),
                 "leave the field blank");
  };
  refuse("AET", s.aet, "ambient elements");
  refuse("COHOFF", s.cohoff, "cohesive elements");
  refuse("GASKETT", s.gaskett, "gaskets");
}

}  // namespace

// how many lines these have, their own numbers say; parts that use such sections are refused
bool is_formulation_of_users(const SectionSolid& s) {
  return s.elform >= 101 && s.elform <= 105;
}

const SolidFormulation& solid_formulation(const Deck& deck, const ModelPart& part) {
  for (const S& s : deck.all<S>())
    if (s.secid == part.secid)
      if (const SolidFormulation* found = find_elform(s.elform).formulation) return *found;
  return *find_elform(1).formulation;
}

void check_solid_sections(const Deck& deck, const Model& model, Diagnostics& diagnostics) {
  std::map<Id, const S*> sections;
  for (const S& s : deck.all<S>()) sections.emplace(s.secid, &s);
  std::set<const S*> checked;  // several parts may name one
  for (std::size_t k = 0; k < model.parts.size(); ++k) {
    const ModelPart& part = model.parts[k];
    if (!part.has_solid || part.rigid) continue;
    const auto found = sections.find(part.secid);
    if (found == sections.end())
      deck.error(diagnostics, part.card, "SECID",
                 fmt::format("the solids of part {} need a *SECTION_SOLID with id {}; {}", part.id,
                             part.secid, deck.found_instead(IdSpace::section, part.secid)),
                 "add the section, or correct the id here");
    else if (checked.insert(found->second).second)
      check_fields(deck, *found->second, diagnostics);
    if (found != sections.end())
      check_shapes(deck, model, static_cast<Index>(k), *found->second, diagnostics);
  }
}

}  // namespace courant
