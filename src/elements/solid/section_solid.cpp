#include "elements/solid/section_solid.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>
#include <map>
#include <set>

#include "keyword/registry.hpp"

namespace courant {

namespace {

using S = SectionSolid;

const RegisterKeyword<SectionSolid> section_solid{section_solid_table()};

/// Formulations by the number of different nodes of their elements; 0: any. `points`: what LS-DYNA has, of
/// which those of pentahedra are too many here.
struct Formulation {
  int elform, nodes, points;
  const char* shape;
};
constexpr Formulation formulations[] = {{1, 0, 1, ""},
                                        {2, 0, 8, ""},
                                        {-1, 0, 8, ""},
                                        {-2, 0, 8, ""},
                                        {10, 4, 1, "tetrahedra"},
                                        {13, 4, 1, "tetrahedra"},
                                        {15, 6, 2, "pentahedra"},
                                        {115, 6, 1, "pentahedra"}};

const Formulation* formulation_of(const S& s) {
  const auto* found = std::find_if(std::begin(formulations), std::end(formulations),
                                   [&](const Formulation& f) { return f.elform == s.elform; });
  return found == std::end(formulations) ? nullptr : found;
}

void check_shapes(const Deck& deck, const Model& model, Index part, const S& s, Diagnostics& diagnostics) {
  const Formulation* found = formulation_of(s);
  if (!found) return;
  for (const ModelSolid& solid : model.solids)
    if (solid.part == part && found->nodes != 0 && solid.different_corners() != found->nodes)
      return deck.error(diagnostics, s, "ELFORM",
                        fmt::format("{} is a formulation of {}, and solid {} of part {} is none", s.elform,
                                    found->shape, solid.id, model.parts[static_cast<std::size_t>(part)].id),
                        "1 takes all shapes");
  if (found->elform < 0)
    deck.warning(
        diagnostics, s, "ELFORM",
        fmt::format("{} is not there: the solids of part {} are those of ELFORM 2, without the strains that "
                    "make flat elements bend softer",
                    found->elform, model.parts[static_cast<std::size_t>(part)].id),
        "2 says the same without this warning; keep elements of bending parts near cubes");
  if (found->nodes == 6 && found->points > 1)
    deck.warning(diagnostics, s, "ELFORM",
                 fmt::format("{} of part {} have one point here, not {}", found->shape,
                             model.parts[static_cast<std::size_t>(part)].id, found->points));
}

void check_fields(const Deck& deck, const S& s, Diagnostics& diagnostics) {
  if (!formulation_of(s))
    deck.error(
        diagnostics, s, "ELFORM", fmt::format("'{}' is not supported", s.elform),
        "supported values: 0, 1 (one point and hourglass control by *HOURGLASS), 2 (eight points; -1 and -2 "
        "become it), 10 (tetrahedra), 13 (tetrahedra with pressures averaged over nodes), 15 and 115 "
        "(pentahedra)");
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

int solid_formulation(const Deck& deck, const ModelPart& part) {
  for (const S& s : deck.all<S>())
    if (s.secid == part.secid) return s.elform < 0 ? 2 : s.elform;
  return 1;
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
