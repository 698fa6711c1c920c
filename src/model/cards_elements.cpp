// Tables of solid elements, of masses on nodes and parts, and of sections that go with them. Nothing computes
// them yet: they are read and checked, and the deck is refused by name.
#include "model/cards_elements.hpp"
#include "keyword/common_rules.hpp"
#include "keyword/registry.hpp"

namespace courant {

namespace {

using namespace rules;

FieldRules narrow_id_of(IdSpace space, int width = 8) {
  return {.check = Check::not_negative, .width = width, .refers = space};
}
FieldRules narrow_required_id_of(IdSpace space, int width = 8) {
  return {.required = true, .check = Check::positive, .width = width, .refers = space};
}
const FieldRules element_id{.required = true, .check = Check::positive, .width = 8};

using E = ElementSolidCard;

/// One line of eight nodes, or, where it ends behind PID, a second line of up to ten.
std::vector<CardOf<E>> solid_cards(bool ortho) {
  const FieldRules corner = narrow_id_of(IdSpace::node);
  const auto asks_for_line_2 = [](const E& e) { return e.n1 == 0; };
  std::vector<CardOf<E>> cards = {
      {.fields = {{"EID", &E::eid, "-", "element id", element_id},
                  {"PID", &E::pid, "-", "part id", narrow_required_id_of(IdSpace::part)},
                  {"N1", &E::n1, "-", "node 1; blank: all nodes stand on the next line", corner},
                  {"N2", &E::n2, "-", "node 2", corner},
                  {"N3", &E::n3, "-", "node 3", corner},
                  {"N4", &E::n4, "-", "node 4", corner},
                  {"N5", &E::n5, "-", "node 5; tetrahedron: N4 again, also as N6 to N8", corner},
                  {"N6", &E::n6, "-", "node 6", corner},
                  {"N7", &E::n7, "-", "node 7", corner},
                  {"N8", &E::n8, "-", "node 8", corner}}},
      {.fields = {{"N1", &E::n1, "-", "node 1", narrow_required_id_of(IdSpace::node)},
                  {"N2", &E::n2, "-", "node 2", corner},
                  {"N3", &E::n3, "-", "node 3", corner},
                  {"N4", &E::n4, "-", "node 4", corner},
                  {"N5", &E::n5, "-", "node 5, or middle of an edge of a tetrahedron", corner},
                  {"N6", &E::n6, "-", "node 6", corner},
                  {"N7", &E::n7, "-", "node 7", corner},
                  {"N8", &E::n8, "-", "node 8", corner},
                  {"N9", &E::n9, "-", "node 9", corner},
                  {"N10", &E::n10, "-", "node 10", corner}},
       .when = asks_for_line_2}};
  if (!ortho) return cards;
  const FieldRules direction{.width = 16, .spatial = Spatial::direction}, wide{.width = 16};
  cards.push_back({.fields = {{"A1", &E::a1, "-", "direction a of the material, x", direction},
                              {"A2", &E::a2, "-", "direction a, y", wide},
                              {"A3", &E::a3, "-", "direction a, z", wide}}});
  cards.push_back({.fields = {{"D1", &E::d1, "-", "direction d in the plane of a and b, x", direction},
                              {"D2", &E::d2, "-", "direction d, y", wide},
                              {"D3", &E::d3, "-", "direction d, z", wide}}});
  return cards;
}

const RegisterKeyword<E> element_solid{{.names = {"ELEMENT_SOLID"},
                                        .purpose = "solid elements of 4 to 10 nodes",
                                        .id_space = IdSpace::solid,
                                        .lacking = "solid elements",
                                        .cards = solid_cards(false)}};
const RegisterKeyword<E> element_solid_ortho{{.names = {"ELEMENT_SOLID_ORTHO"},
                                              .purpose = "solid elements with directions of the material",
                                              .id_space = IdSpace::solid,
                                              .lacking = "solid elements",
                                              .cards = solid_cards(true)}};

struct ElementMass : Entry {
  Id eid = 0, nid = 0, pid = 0;
  Real mass = 0;
};
using M = ElementMass;

KeywordOf<M> element_mass(std::string name, std::string purpose, const char* field, IdSpace space) {
  return {.names = {std::move(name)},
          .purpose = std::move(purpose),
          .id_space = IdSpace::mass,
          .lacking = "masses on nodes",
          .cards = {{.fields = {{"EID", &M::eid, "-", "element id", element_id},
                                {field, &M::nid, "-", "what carries it", narrow_required_id_of(space)},
                                {"MASS", &M::mass, "M", "mass of each node", {.width = 16}},
                                {"PID", &M::pid, "-", "part id, for output", narrow_id_of(IdSpace::part)}}}}};
}
const RegisterKeyword<M> element_mass_node{
    element_mass("ELEMENT_MASS", "masses on single nodes", "NID", IdSpace::node)};
const RegisterKeyword<M> element_mass_node_set{
    element_mass("ELEMENT_MASS_NODE_SET", "masses on all nodes of a set", "NSID", IdSpace::node_set)};

struct ElementMassPart : Entry {
  Id pid = 0, lcid = 0;
  Real addmass = 0, finmass = 0;
  int mwd = 0;
};
using P = ElementMassPart;

KeywordOf<P> element_mass_part(std::string name, std::string purpose, const char* field, IdSpace space) {
  return {.names = {std::move(name)},
          .purpose = std::move(purpose),
          .lacking = "masses added to parts",
          .cards = {{.fields = {{field, &P::pid, "-", "what gets it", narrow_required_id_of(space)},
                                {"ADDMASS", &P::addmass, "M", "added mass", {.width = 16}},
                                {"FINMASS", &P::finmass, "M", "mass after the addition", {.width = 16}},
                                {"LCID", &P::lcid, "-", "curve of the mass over time",
                                 narrow_id_of(IdSpace::curve, 16)},
                                {"MWD", &P::mwd, "-", "how it is spread over the nodes", {.width = 8}}}}}};
}
const RegisterKeyword<P> mass_part{
    element_mass_part("ELEMENT_MASS_PART", "mass added to parts", "PID", IdSpace::part)};
const RegisterKeyword<P> mass_part_set{
    element_mass_part("ELEMENT_MASS_PART_SET", "mass added to part sets", "PSID", IdSpace::part_set)};

struct SectionSolid : Entry {
  std::string title;
  Id secid = 0;
  int elform = 1, aet = 0;
  Real cohoff = 0, gaskett = 0;
};
using S = SectionSolid;

const RegisterKeyword<S> section_solid{
    {.names = {"SECTION_SOLID"},
     .purpose = "formulation of solid elements",
     .id_space = IdSpace::section,
     .title_option = true,
     .title = &S::title,
     .lacking = "sections of solid elements",
     .cards = {{.fields = {{"SECID", &S::secid, "-", "id that *PART refers to", required_id},
                           {"ELFORM", &S::elform, "-", "formulation", {.standard = 1}},
                           {"AET", &S::aet, "-", "ambient elements"},
                           {},
                           {},
                           {},
                           {"COHOFF", &S::cohoff, "-", "place of the cohesive layer"},
                           {"GASKETT", &S::gaskett, "L", "thickness of the gasket"}}}}}};

}  // namespace

}  // namespace courant
