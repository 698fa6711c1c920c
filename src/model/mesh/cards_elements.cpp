// Tables of solid elements.
#include "model/mesh/mesh_cards.hpp"

#include <utility>

#include "keyword/registry.hpp"

namespace courant {

namespace {

const RegisterKeyword<ElementSolidCard> element_solid{element_solid_table()};
const RegisterKeyword<ElementSolidCard> element_solid_ortho{element_solid_ortho_table()};
const RegisterKeyword<ControlSolid> control_solid{control_solid_table()};

}  // namespace

bool has_twenty_nodes(const ElementSolidCard& card) {
  return card.name == 1;  // in the order of the table
}

/// A mirror turns elements inside out: with the lower face as the upper one they are what they were.
std::string move_solid(ElementSolidCard& card, const Affine& motion) {
  if (motion.linear().determinant() >= 0) return {};
  if (has_twenty_nodes(card)) {  // the nodes of the lower face, and those on its edges, for the upper one's
    for (const auto& [lower, upper] : {std::pair{&ElementSolidCard::n9, &ElementSolidCard::n17},
                                       {&ElementSolidCard::n10, &ElementSolidCard::n18},
                                       {&ElementSolidCard::n11, &ElementSolidCard::n19},
                                       {&ElementSolidCard::n12, &ElementSolidCard::n20}})
      std::swap(card.*lower, card.*upper);
  } else if (card.n10 != 0) {  // a tetrahedron with nodes on its edges
    std::swap(card.n1, card.n2), std::swap(card.n6, card.n7), std::swap(card.n8, card.n9);
    return {};
  }
  if (card.n8 != 0) {
    std::swap(card.n1, card.n5), std::swap(card.n2, card.n6);
    std::swap(card.n3, card.n7), std::swap(card.n4, card.n8);
  }
  return {};
}

}  // namespace courant
