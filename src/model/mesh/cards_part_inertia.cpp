// *PART_INERTIA: a rigid part whose mass and inertia are given.
#include "keyword/registry.hpp"
#include "model/mesh/part_card.hpp"
#include "model/mesh/part_inertia.hpp"

namespace courant {

namespace {

using Inertia = PartInertiaCard;

const RegisterKeyword<Inertia> part_inertia{
    {.names = {"PART_INERTIA"},
     .purpose = "rigid parts whose mass, centre, inertia and initial velocity are given",
     .id_space = IdSpace::part,
     .heading = true,
     .title = &Inertia::title,
     .cards = {part_card<Inertia>(),
               {.fields = {{"XC", &Inertia::xc, "L", "centre of mass, without NODEID", rules::point},
                           {"YC", &Inertia::yc, "L", "centre of mass"},
                           {"ZC", &Inertia::zc, "L", "centre of mass"},
                           {"TM", &Inertia::tm, "M", "mass", rules::required_positive},
                           {"IRCS",
                            &Inertia::ircs,
                            "-",
                            "axes of the inertia: 0 global, 1 those of the last card",
                            {.allowed = {0, 1}}},
                           {"NODEID", &Inertia::nodeid, "-", "node at the centre of mass",
                            rules::optional_id_of(IdSpace::node)}}},
               {.fields = {{"IXX", &Inertia::ixx, "ML2", "of the tensor about the centre",
                            rules::required_positive},
                           {"IXY", &Inertia::ixy, "ML2", "of the tensor about the centre"},
                           {"IXZ", &Inertia::ixz, "ML2", "of the tensor about the centre"},
                           {"IYY", &Inertia::iyy, "ML2", "of the tensor about the centre",
                            rules::required_positive},
                           {"IYZ", &Inertia::iyz, "ML2", "of the tensor about the centre"},
                           {"IZZ", &Inertia::izz, "ML2", "of the tensor about the centre",
                            rules::required_positive}}},
               {.fields = {{"VTX", &Inertia::vtx, "L/T", "initial velocity of the centre", rules::direction},
                           {"VTY", &Inertia::vty, "L/T", "initial velocity of the centre"},
                           {"VTZ", &Inertia::vtz, "L/T", "initial velocity of the centre"},
                           {"VRX", &Inertia::vrx, "1/T", "initial angular velocity, global axes",
                            rules::direction},
                           {"VRY", &Inertia::vry, "1/T", "initial angular velocity"},
                           {"VRZ", &Inertia::vrz, "1/T", "initial angular velocity"}}},
               {.fields = {{"XL", &Inertia::xl, "-", "vector along the local x axis", rules::direction},
                           {"YL", &Inertia::yl, "-", "vector along the local x axis"},
                           {"ZL", &Inertia::zl, "-", "vector along the local x axis"},
                           {"XLIP", &Inertia::xlip, "-", "vector in the local xy plane", rules::direction},
                           {"YLIP", &Inertia::ylip, "-", "vector in the local xy plane"},
                           {"ZLIP", &Inertia::zlip, "-", "vector in the local xy plane"},
                           {"CID", &Inertia::cid, "-", "system whose axes they are, instead",
                            rules::optional_id_of(IdSpace::coordinate_system)}},
                .when = [](const Inertia& card) { return card.ircs == 1; }}},
     .move = [](Inertia& card, const Affine& motion) { return turn_inertia(card, motion); }}};

}  // namespace

/// The tensor turns with the file, unless it stands in axes of its own, which turn.
std::string turn_inertia(PartInertiaCard& card, const Affine& motion) {
  const bool mirrored = motion.linear().determinant() < 0;
  if (mirrored) card.vrx = -card.vrx, card.vry = -card.vry, card.vrz = -card.vrz;
  if (card.ircs != 0) {  // the third of the local axes is the other way round
    if (mirrored) card.ixz = -card.ixz, card.iyz = -card.iyz;
    return {};
  }
  const Matrix turned = motion.linear() * card.inertia() * motion.linear().transpose();
  card.ixx = turned(0, 0), card.iyy = turned(1, 1), card.izz = turned(2, 2);
  card.ixy = turned(0, 1), card.ixz = turned(0, 2), card.iyz = turned(1, 2);
  return {};
}

}  // namespace courant
