// Tables of nodes, elements, parts, curves and boxes.
#include "keyword/registry.hpp"
#include "model/cards.hpp"
#include "model/transforms/transformation.hpp"

namespace courant {

namespace {

const RegisterKeyword<NodeCard> node{node_table()};
const RegisterKeyword<ElementSphCard> element_sph{element_sph_table()};
const RegisterKeyword<ElementShellCard> element_shell{element_shell_table()};
const RegisterKeyword<PartCard> part{part_table()};
const RegisterKeyword<DefineCurveCard> define_curve{define_curve_table()};
const RegisterKeyword<DefineBoxCard> define_box{define_box_table()};

}  // namespace

std::string move_shell(ElementShellFields& card, const Affine& motion) {
  return turn_height<&ElementShellFields::offset>(card, motion);
}

std::string move_node(NodeCard& node, const Affine& motion) {
  for (int* code : {&node.tc, &node.rc}) {
    auto held = axes_of_code(*code);
    std::string reason = move_held_axes(held, motion);
    if (!reason.empty() && code == &node.tc) return reason;
    *code = code_of_axes(held);
  }
  return {};
}

/// A stretch changes the volume that belongs to a mass or, where it does not, the lattice, whose h is one
/// number.
std::string keep_spacing(ElementSphCard&, const Affine& motion) {
  if (keeps_lengths(motion)) return {};
  return "the file is scaled by a transformation, which leaves open what becomes of the particles' masses";
}

std::string convert_volume(ElementSphCard& element, const Conversion& conversion) {
  if (element.mass < 0) element.mass *= conversion.units.of("L3") / conversion.units.of("M");
  return {};
}

/// The box around the moved corners; it is the moved box itself where axes become axes.
std::string move_box(DefineBoxCard& box, const Affine& motion) {
  if (!maps_axes(motion))
    return "the file is turned by an angle that is no multiple of 90 degrees, and a box lies along the axes";
  const Vec low(box.xmn, box.ymn, box.zmn), high(box.xmx, box.ymx, box.zmx);
  if ((high.array() < low.array()).any()) return {};  // refused later, as it stands
  const Vec one = motion * low, other = motion * high;
  const Vec now_low = one.cwiseMin(other), now_high = one.cwiseMax(other);
  box.xmn = now_low[0], box.ymn = now_low[1], box.zmn = now_low[2];
  box.xmx = now_high[0], box.ymx = now_high[1], box.zmx = now_high[2];
  return {};
}

}  // namespace courant
