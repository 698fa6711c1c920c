#include "elements/solid/section_solid.hpp"

#include <fmt/format.h>

#include <map>
#include <set>

#include "keyword/common_rules.hpp"
#include "keyword/registry.hpp"

namespace courant {

namespace {

using namespace rules;
using S = SectionSolid;

const RegisterKeyword<S> section_solid{
    {.names = {"SECTION_SOLID"},
     .purpose = "formulation of solid elements: ELFORM 1, the hexahedron with one point",
     .id_space = IdSpace::section,
     .title_option = true,
     .title = &S::title,
     .cards = {{.fields = {{"SECID", &S::secid, "-", "id that *PART refers to", required_id},
                           {"ELFORM", &S::elform, "-", "formulation; 0 as 1", or_blank(1)},
                           {"AET", &S::aet, "-", "ambient elements"},
                           {},
                           {},
                           {},
                           {"COHOFF", &S::cohoff, "-", "place of the cohesive layer"},
                           {"GASKETT", &S::gaskett, "L", "thickness of the gasket"}}},
               // how many lines these have, their own numbers tell; parts that use such sections are refused
               {.fields = {{"USER", &S::user, "-", "user-defined formulation (ELFORM 101 to 105)"}},
                .repeat = true,
                .when = [](const S& s) { return s.elform >= 101 && s.elform <= 105; }}}}};

void check_fields(const Deck& deck, const S& s, Diagnostics& diagnostics) {
  constexpr int one_point = 1;
  if (s.elform != one_point)
    deck.error(diagnostics, s, "ELFORM", fmt::format("'{}' is not supported", s.elform),
               "supported values: 0, 1 (hexahedron with one point and hourglass control by *HOURGLASS)");
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

void check_solid_sections(const Deck& deck, const Model& model, Diagnostics& diagnostics) {
  std::map<Id, const S*> sections;
  for (const S& s : deck.all<S>()) sections.emplace(s.secid, &s);
  std::set<const S*> checked;  // several parts may name one
  for (const ModelPart& part : model.parts) {
    if (!part.has_solid) continue;
    const auto found = sections.find(part.secid);
    if (found == sections.end())
      deck.error(diagnostics, part.card, "SECID",
                 fmt::format("the solids of part {} need a *SECTION_SOLID with id {}; {}", part.id,
                             part.secid, deck.found_instead(IdSpace::section, part.secid)),
                 "add the section, or correct the id here");
    else if (checked.insert(found->second).second)
      check_fields(deck, *found->second, diagnostics);
  }
}

}  // namespace courant
