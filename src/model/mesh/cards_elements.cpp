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

/// A mirror turns elements inside out: with the lower face as the upper one they are what they were.
std::string move_solid(ElementSolidCard& card, const Affine& motion) {
  if (motion.linear().determinant() >= 0) return {};
  if (card.n10 != 0) {  // a tetrahedron with nodes on its edges
    std::swap(card.n1, card.n2), std::swap(card.n6, card.n7), std::swap(card.n8, card.n9);
  } else if (card.n8 != 0) {
    std::swap(card.n1, card.n5), std::swap(card.n2, card.n6);
    std::swap(card.n3, card.n7), std::swap(card.n4, card.n8);
  }
  return {};
}

}  // namespace courant
