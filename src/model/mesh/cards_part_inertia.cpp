// *PART_INERTIA: a rigid part whose mass and inertia are given.
#include "model/mesh/inertia_table.hpp"
#include "model/mesh/part_card.hpp"

namespace courant {

namespace {

using Inertia = PartInertiaCard;

KeywordOf<Inertia> part_inertia_keyword() {
  KeywordOf<Inertia> out{
      .names = {"PART_INERTIA"},
      .purpose = "rigid parts whose mass, centre, inertia and initial velocity are given",
      .id_space = IdSpace::part,
      .heading = true,
      .title = &Inertia::title,
      .cards = {part_card<Inertia>()},
      .move = [](Inertia& card, const Affine& motion) { return turn_inertia(card, motion); }};
  for (CardOf<Inertia>& card : inertia_cards<Inertia>("CID")) out.cards.push_back(std::move(card));
  out.cards.back().when = [](const Inertia& card) { return card.ircs == 1; };
  return out;
}
const RegisterKeyword<Inertia> part_inertia{part_inertia_keyword()};

}  // namespace

/// The tensor turns with the file, unless it is in axes of its own, which turn.
std::string turn_inertia(PartInertiaCard& card, const Affine& motion) {
  const bool mirrored = motion.linear().determinant() < 0;
  if (mirrored) card.vrx = -card.vrx, card.vry = -card.vry, card.vrz = -card.vrz;
  if (card.ircs != 0) {  // the third of the local axes is reversed
    if (mirrored) card.ixz = -card.ixz, card.iyz = -card.iyz;
    return {};
  }
  const Matrix turned = motion.linear() * card.inertia() * motion.linear().transpose();
  card.ixx = turned(0, 0), card.iyy = turned(1, 1), card.izz = turned(2, 2);
  card.ixy = turned(0, 1), card.ixz = turned(0, 2), card.iyz = turned(1, 2);
  return {};
}

}  // namespace courant
