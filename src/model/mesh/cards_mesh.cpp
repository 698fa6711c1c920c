// Tables of nodes, elements, parts, curves and boxes.
#include "keyword/common_rules.hpp"
#include "keyword/registry.hpp"
#include "model/cards.hpp"
#include "model/mesh/part_card.hpp"
#include "model/transforms/transformation.hpp"

namespace courant {

namespace {

using namespace rules;

using N = NodeCard;
std::string move_node(N& node, const Affine& motion) {
  for (int* code : {&node.tc, &node.rc}) {
    auto held = axes_of_code(*code);
    std::string reason = move_held_axes(held, motion);
    if (!reason.empty() && code == &node.tc) return reason;
    *code = code_of_axes(held);
  }
  return {};
}
const RegisterKeyword<N> node{
    {.names = {"NODE"},
     .purpose = "coordinates of nodes",
     .id_space = IdSpace::node,
     .cards =
         {{.fields =
               {{"NID", &N::nid, "-", "node id", {.required = true, .check = Check::positive, .width = 8}},
                {"X", &N::x, "L", "x coordinate", {.width = 16, .spatial = Spatial::point}},
                {"Y", &N::y, "L", "y coordinate", {.width = 16}},
                {"Z", &N::z, "L", "z coordinate", {.width = 16}},
                {"TC",
                 &N::tc,
                 "-",
                 "held translations: 0 none, 1 x, 2 y, 3 z, 4 xy, 5 yz, 6 zx, 7 xyz",
                 {.allowed = {0, 1, 2, 3, 4, 5, 6, 7}, .width = 8}},
                {"RC",
                 &N::rc,
                 "-",
                 "held rotations of nodes of shells that deform, same code",
                 {.allowed = {0, 1, 2, 3, 4, 5, 6, 7}, .width = 8}}}}},
     .move = move_node}};

using E = ElementSphCard;
std::string convert_volume(E& element, const Conversion& conversion) {
  if (element.mass < 0) element.mass *= conversion.units.of("L3") / conversion.units.of("M");
  return {};
}
/// A stretch changes the volume that belongs to a mass or, where it does not, the lattice, whose h is one
/// number.
std::string keep_spacing(E&, const Affine& motion) {
  if (keeps_lengths(motion)) return {};
  return "the file is scaled by a transformation, which leaves open what becomes of the particles' masses";
}
const RegisterKeyword<E> element_sph{
    {.names = {"ELEMENT_SPH"},
     .purpose = "SPH particles; a particle has the id of its node",
     .cards =
         {{.fields = {{"NID",
                       &E::nid,
                       "-",
                       "node id",
                       {.required = true, .check = Check::positive, .width = 8, .refers = IdSpace::node}},
                      {"PID",
                       &E::pid,
                       "-",
                       "part id",
                       {.required = true, .check = Check::positive, .width = 8, .refers = IdSpace::part}},
                      {"MASS", &E::mass, "M", "mass; negative: volume, in 2D area, times -1", {.width = 16}},
                      {"NEND",
                       &E::nend,
                       "-",
                       "particles NID to NEND get the same data",
                       {.check = Check::not_negative, .refers = IdSpace::node}}}}},
     .convert = convert_volume,
     .move = keep_spacing}};

using S = ElementShellCard;
const FieldRules element{.required = true, .check = Check::positive, .width = 8};
const FieldRules of_part{.required = true, .check = Check::positive, .width = 8, .refers = IdSpace::part};
const FieldRules corner{.required = true, .check = Check::positive, .width = 8, .refers = IdSpace::node};
const FieldRules last_corner{.check = Check::not_negative, .width = 8, .refers = IdSpace::node};
const FieldRules mid_side{.honour = Honour::no, .width = 8, .refers = IdSpace::node};
const FieldRules thickness{.check = Check::not_negative, .width = 16};
const RegisterKeyword<S> element_shell{
    {.names = {"ELEMENT_SHELL", "ELEMENT_SHELL_THICKNESS", "ELEMENT_SHELL_BETA", "ELEMENT_SHELL_OFFSET",
               "ELEMENT_SHELL_THICKNESS_OFFSET", "ELEMENT_SHELL_BETA_OFFSET"},
     .purpose = "shells of 3 (N4 = N3 or 0) or 4 nodes; _THICKNESS and _BETA add a card, _OFFSET another",
     .id_space = IdSpace::shell,
     .cards = {{.fields = {{"EID", &S::eid, "-", "element id", element},
                           {"PID", &S::pid, "-", "part id", of_part},
                           {"N1", &S::n1, "-", "corner node 1", corner},
                           {"N2", &S::n2, "-", "corner node 2", corner},
                           {"N3", &S::n3, "-", "corner node 3", corner},
                           {"N4", &S::n4, "-", "corner node 4", last_corner},
                           {"N5", &S::n5, "-", "mid-side node", mid_side},
                           {"N6", &S::n6, "-", "mid-side node", mid_side},
                           {"N7", &S::n7, "-", "mid-side node", mid_side},
                           {"N8", &S::n8, "-", "mid-side node", mid_side}}},
               {.fields = {{"THIC1", &S::thic1, "L", "thickness at corner 1, 0: of the section", thickness},
                           {"THIC2", &S::thic2, "L", "thickness at corner 2, 0: of the section", thickness},
                           {"THIC3", &S::thic3, "L", "thickness at corner 3, 0: of the section", thickness},
                           {"THIC4", &S::thic4, "L", "thickness at corner 4, 0: of the section", thickness},
                           {"BETA",
                            &S::beta,
                            "-",
                            "angle of the material in place of its own, degrees; 0 with _THICKNESS: its own",
                            {.width = 16}}},
                .when = [](const S& e) { return e.has_thickness(); }},
               {.fields = {{"OFFSET",
                            &S::offset,
                            "L",
                            "height of the middle surface over the nodes, in the place of NLOC",
                            {.width = 16}}},
                .when = [](const S& e) { return e.has_offset(); }}},
     .move = turn_height<&S::offset>}};

using P = PartCard;
const RegisterKeyword<P> part{{.names = {"PART"},
                               .purpose = "parts: elements of one section and material",
                               .id_space = IdSpace::part,
                               .heading = true,
                               .title = &P::title,
                               .cards = {part_card<P>()}}};

using C = DefineCurveCard;
const RegisterKeyword<C> define_curve{
    {.names = {"DEFINE_CURVE"},
     .purpose =
         "piecewise linear curve: SFO (ordinate + OFFO) at SFA (abscissa + OFFA); constant beyond its ends; "
         "two points with one abscissa are a jump, at which the later one holds",
     .id_space = IdSpace::curve,
     .title_option = true,
     .title = &C::title,
     .cards = {{.fields = {{"LCID", &C::lcid, "-", "curve id", required_id},
                           {"SIDR",
                            &C::sidr,
                            "-",
                            "phase of a load: 0 transient, 1 relaxation, 2 both",
                            {.allowed = {0, 1, 2}}},
                           {"SFA", &C::sfa, "-", "scale of the abscissa", {.standard = 1}},
                           {"SFO", &C::sfo, "-", "scale of the ordinate", {.standard = 1}},
                           {"OFFA", &C::offa, "-", "offset of the abscissa"},
                           {"OFFO", &C::offo, "-", "offset of the ordinate"},
                           {"DATTYP",
                            &C::dattyp,
                            "-",
                            "kind of data: 0 over time, 1 pairs (x, y); the same here, as x may not decrease",
                            {.allowed = {0, 1}}},
                           {"LCINT", &C::lcint, "-", "number of points for resampling", no_effect}}},
               {.fields = {{"A1", &C::a, "-", "abscissa", {.width = 20}},
                           {"O1", &C::o, "-", "ordinate", {.width = 20}}},
                .repeat = true}}}};

using B = DefineBoxCard;
/// The box around the moved corners; it is the moved box itself where axes become axes.
std::string move_box(B& box, const Affine& motion) {
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
const RegisterKeyword<B> define_box{{.names = {"DEFINE_BOX"},
                                     .purpose = "box with sides along the axes",
                                     .id_space = IdSpace::box,
                                     .title_option = true,
                                     .title = &B::title,
                                     .cards = {{.fields = {{"BOXID", &B::boxid, "-", "box id", required_id},
                                                           {"XMN", &B::xmn, "L", "lowest x"},
                                                           {"XMX", &B::xmx, "L", "highest x"},
                                                           {"YMN", &B::ymn, "L", "lowest y"},
                                                           {"YMX", &B::ymx, "L", "highest y"},
                                                           {"ZMN", &B::zmn, "L", "lowest z"},
                                                           {"ZMX", &B::zmx, "L", "highest z"}}}},
                                     .move = move_box}};

}  // namespace

}  // namespace courant
