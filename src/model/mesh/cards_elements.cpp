// Tables of solid elements.
#include "model/mesh/cards_elements.hpp"

#include <utility>
#include <vector>

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

using Solid = ElementSolidCard;

/// One line of eight nodes, or, where it ends behind PID, a second line of up to ten.
std::vector<CardOf<Solid>> solid_cards(bool ortho) {
  const FieldRules corner = narrow_id_of(IdSpace::node);
  const auto asks_for_line_2 = [](const Solid& e) { return e.n1 == 0; };
  std::vector<CardOf<Solid>> cards = {
      {.fields = {{"EID", &Solid::eid, "-", "element id", element_id},
                  {"PID", &Solid::pid, "-", "part id", narrow_required_id_of(IdSpace::part)},
                  {"N1", &Solid::n1, "-", "node 1; blank: all nodes stand on the next line", corner},
                  {"N2", &Solid::n2, "-", "node 2", corner},
                  {"N3", &Solid::n3, "-", "node 3", corner},
                  {"N4", &Solid::n4, "-", "node 4", corner},
                  {"N5", &Solid::n5, "-", "node 5; tetrahedron: N4 again, also as N6 to N8", corner},
                  {"N6", &Solid::n6, "-", "node 6", corner},
                  {"N7", &Solid::n7, "-", "node 7", corner},
                  {"N8", &Solid::n8, "-", "node 8", corner}}},
      {.fields = {{"N1", &Solid::n1, "-", "node 1", narrow_required_id_of(IdSpace::node)},
                  {"N2", &Solid::n2, "-", "node 2", corner},
                  {"N3", &Solid::n3, "-", "node 3", corner},
                  {"N4", &Solid::n4, "-", "node 4", corner},
                  {"N5", &Solid::n5, "-", "node 5, or middle of an edge of a tetrahedron", corner},
                  {"N6", &Solid::n6, "-", "node 6", corner},
                  {"N7", &Solid::n7, "-", "node 7", corner},
                  {"N8", &Solid::n8, "-", "node 8", corner},
                  {"N9", &Solid::n9, "-", "node 9", corner},
                  {"N10", &Solid::n10, "-", "node 10", corner}},
       .when = asks_for_line_2}};
  if (!ortho) return cards;
  const FieldRules direction{.width = 16, .spatial = Spatial::direction}, wide{.width = 16};
  cards.push_back({.fields = {{"A1", &Solid::a1, "-", "direction a of the material, x", direction},
                              {"A2", &Solid::a2, "-", "direction a, y", wide},
                              {"A3", &Solid::a3, "-", "direction a, z", wide}}});
  cards.push_back({.fields = {{"D1", &Solid::d1, "-", "direction d in the plane of a and b, x", direction},
                              {"D2", &Solid::d2, "-", "direction d, y", wide},
                              {"D3", &Solid::d3, "-", "direction d, z", wide}}});
  return cards;
}

/// A mirror turns elements inside out: with the lower face as the upper one they are what they were.
std::string move_solid(Solid& card, const Affine& motion) {
  if (motion.linear().determinant() < 0 && card.n8 != 0) {
    std::swap(card.n1, card.n5), std::swap(card.n2, card.n6);
    std::swap(card.n3, card.n7), std::swap(card.n4, card.n8);
  }
  return {};
}

const RegisterKeyword<Solid> element_solid{{.names = {"ELEMENT_SOLID"},
                                            .purpose = "solid elements: hexahedra of eight different nodes",
                                            .id_space = IdSpace::solid,
                                            .cards = solid_cards(false),
                                            .move = move_solid}};
const RegisterKeyword<Solid> element_solid_ortho{{.names = {"ELEMENT_SOLID_ORTHO"},
                                                  .purpose = "solid elements with directions of the material",
                                                  .id_space = IdSpace::solid,
                                                  .lacking = "directions of the material in solids",
                                                  .cards = solid_cards(true)}};

using Control = ControlSolid;
const FieldRules narrow{.honour = Honour::ignored, .width = 8};

const RegisterKeyword<Control> control_solid{
    {.names = {"CONTROL_SOLID"},
     .purpose = "options of solids: FMATRIX and PSFAIL must be 0",
     .once = true,
     .many = false,
     .cards = {{.fields = {{"ESORT", &Control::esort, "-", "formulation of degenerate solids", no_effect},
                           {"FMATRIX", &Control::fmatrix, "-", "deformation gradient"},
                           {"NIPTETS", &Control::niptets, "-", "points of tetrahedra", no_effect_but(4)},
                           {"SWLOCL", &Control::swlocl, "-", "output of spot welds", no_effect_but(1)},
                           {"PSFAIL", &Control::psfail, "-", "parts whose solids may fail by their volume",
                            id_of(IdSpace::part_set)},
                           {"T10JTOL", &Control::t10jtol, "-", "warnings about tetrahedra", no_effect},
                           {"ICOH", &Control::icoh, "-", "cohesive solids", no_effect},
                           {"TET13K", &Control::tet13k, "-", "stiffness of tetrahedra", no_effect}}},
               {.fields = {{"PM1", &Control::pm1, "-", "order of the nodes of tetrahedra", narrow},
                           {"PM2", &Control::pm2, "-", "the same", narrow},
                           {"PM3", &Control::pm3, "-", "the same", narrow},
                           {"PM4", &Control::pm4, "-", "the same", narrow},
                           {"PM5", &Control::pm5, "-", "the same", narrow},
                           {"PM6", &Control::pm6, "-", "the same", narrow},
                           {"PM7", &Control::pm7, "-", "the same", narrow},
                           {"PM8", &Control::pm8, "-", "the same", narrow},
                           {"PM9", &Control::pm9, "-", "the same", narrow},
                           {"PM10", &Control::pm10, "-", "the same", narrow}},
                .optional = true},
               {.fields = {{"TET13V", &Control::tet13v, "-", "pressure of tetrahedra", no_effect}},
                .optional = true}}}};

}  // namespace

}  // namespace courant
