#include "loads/rigid_wall_card.hpp"

#include <initializer_list>
#include <string>
#include <utility>
#include <vector>

#include "keyword/common_rules.hpp"
#include "keyword/registry.hpp"
#include "model/transforms/transformation.hpp"

namespace courant {

namespace {

/// With every choice of options in LS-DYNA's order: bit k of the index of a name tells of option k.
std::vector<std::string> with_options(std::vector<std::string> names,
                                      std::initializer_list<const char*> options) {
  for (const char* option : options)
    for (std::size_t k = 0, n = names.size(); k < n; ++k) names.push_back(names[k] + option);
  return names;
}
std::vector<std::string> planar_names(const std::string& first) {
  return with_options({first}, {"_FINITE", "_MOVING", "_FORCES", "_DISPLAY"});
}
/// Bits 0 and 1 of the index tell the shape, in the order of RigidWallGeometric::Shape.
std::vector<std::string> geometric_names() {
  const std::string all = "RIGIDWALL_GEOMETRIC";
  return with_options({all + "_FLAT", all + "_PRISM", all + "_CYLINDER", all + "_SPHERE"},
                      {"_MOTION", "_DISPLAY"});
}

/// Its lengths are no places, and edge m follows from the others by the right hand.
std::string keep_lengths(bool has_lengths, const Affine& motion) {
  constexpr Real round_off = 1e-9;
  const Matrix A = motion.linear();
  const bool turns = (A.transpose() * A - Matrix::Identity()).norm() < round_off && A.determinant() > 0;
  if (turns || !has_lengths) return {};
  return "its lengths would change in a transformation that stretches or mirrors the file";
}

constexpr FieldRules not_negative{.check = Check::not_negative};
constexpr FieldRules idle_id_of(IdSpace space) {
  return {.honour = Honour::ignored, .refers = space};
}
/// Those of a plane: the first two, and of its options.
template <class W>
std::vector<CardOf<W>> first_cards_of_plane() {
  return {
      {.fields = {{"NSID", &W::nsid, "-", "nodes that it holds, 0 all",
                   rules::optional_id_of(IdSpace::node_set)},
                  {"NSIDEX", &W::nsidex, "-", "nodes left out", rules::optional_id_of(IdSpace::node_set)},
                  {"BOXID", &W::boxid, "-", "only those in this box at the start",
                   rules::optional_id_of(IdSpace::box)},
                  {"OFFSET", &W::offset, "L", "only those so near at the start, 0 all", not_negative},
                  {"BIRTH", &W::birth, "T", "when it starts to hold"},
                  {"DEATH", &W::death, "T", "when it ends", rules::or_blank(1e20)},
                  {"RWKSF", &W::rwksf, "-", "stiffness towards rigid bodies", no_effect_but(1)}}},
      {.fields = {
           {"XT", &W::xt, "L", "tail of the normal, on the plane, x", rules::point},
           {"YT", &W::yt, "L", "tail of the normal, y"},
           {"ZT", &W::zt, "L", "tail of the normal, z"},
           {"XH", &W::xh, "L", "head of the normal, towards what it holds, x", rules::point},
           {"YH", &W::yh, "L", "head of the normal, y"},
           {"ZH", &W::zh, "L", "head of the normal, z"},
           {"FRIC", &W::fric, "-", "0 slides, to 1 Coulomb, 1 does not slide, 2 welded and slides, 3 welded",
            not_negative},
           {"WVEL", &W::wvel, "L/T", "FRIC 2, 3: is welded by an impact faster than this", not_negative}}}};
}
template <class W>
std::vector<CardOf<W>> option_cards_of_plane() {
  return {
      {.fields = {{"XHEV", &W::xhev, "L", "head of the edge l, which starts at the tail, x", rules::point},
                  {"YHEV", &W::yhev, "L", "head of the edge l, y"},
                  {"ZHEV", &W::zhev, "L", "head of the edge l, z"},
                  {"LENL", &W::lenl, "L", "length of edge l, 0 infinite", not_negative},
                  {"LENM", &W::lenm, "L", "length of edge m = normal x l, 0 infinite", not_negative}},
       .when = [](const W& w) { return w.finite(); }},
      {.fields = {{"MASS", &W::mass, "M", "mass of the wall", rules::required_positive},
                  {"V0", &W::v0, "L/T", "its speed at the start, along the normal"}},
       .when = [](const W& w) { return w.moving(); }},
      {.fields = {{"SOFT", &W::soft, "-", "cycles that stop a point: one", {.allowed = {0, 1}}},
                  {"SSID",
                   &W::ssid,
                   "-",
                   "areas of the output",
                   {.honour = Honour::output_only, .refers = IdSpace::segment_set}},
                  {"N1", &W::n1, "-", "node of the display", idle_id_of(IdSpace::node)},
                  {"N2", &W::n2, "-", "node of the display", idle_id_of(IdSpace::node)},
                  {"N3", &W::n3, "-", "node of the display", idle_id_of(IdSpace::node)},
                  {"N4", &W::n4, "-", "node of the display", idle_id_of(IdSpace::node)}},
       .when = [](const W& w) { return w.forces(); }},
      {.fields = {{"PID", &W::pid, "-", "part of the display", idle_id_of(IdSpace::part)},
                  {"RO", &W::ro, "M/L3", "its density", no_effect},
                  {"E", &W::E, "M/LT2", "its modulus", no_effect},
                  {"PR", &W::pr, "-", "its Poisson ratio", no_effect}},
       .optional = true,
       .when = [](const W& w) { return w.display(); }}};
}
template <class W>
KeywordOf<W> plane_keyword(const std::string& name, std::string purpose,
                           const std::vector<CardOf<W>>& of_friction) {
  KeywordOf<W> out{.names = planar_names(name),
                   .purpose = std::move(purpose),
                   .id_space = IdSpace::rigid_wall,
                   .id_option = true,
                   .title = &W::title,
                   .id = &W::id,
                   .cards = first_cards_of_plane<W>(),
                   .move = [](W& wall, const Affine& motion) {
                     return keep_lengths(wall.finite() || wall.offset > 0, motion);
                   }};
  const std::vector<CardOf<W>> of_options = option_cards_of_plane<W>();
  for (const auto* more : {&of_friction, &of_options})
    out.cards.insert(out.cards.end(), more->begin(), more->end());
  return out;
}
const RegisterKeyword<RigidWallPlanar> rigid_wall_planar{plane_keyword<RigidWallPlanar>(
    "RIGIDWALL_PLANAR",
    "plane that particles and nodes of deformable elements do not pass; nodes of rigid bodies and those of "
    "prescribed motions do",
    {})};

using O = RigidWallOrtho;
const RegisterKeyword<O> rigid_wall_ortho{plane_keyword<O>(
    "RIGIDWALL_PLANAR_ORTHO", "plane as *RIGIDWALL_PLANAR, with friction that differs by direction",
    {{.fields = {{"SFRICA", &O::sfrica, "-", "friction at rest along a", not_negative},
                 {"SFRICB", &O::sfricb, "-", "friction at rest along b", not_negative},
                 {"DFRICA", &O::dfrica, "-", "friction of what slides, along a", not_negative},
                 {"DFRICB", &O::dfricb, "-", "friction of what slides, along b", not_negative},
                 {"DECAYA", &O::decaya, "T/L", "DFRICA + (SFRICA - DFRICA) exp(-DECAYA speed)", not_negative},
                 {"DECAYB", &O::decayb, "T/L", "the same along b", not_negative}}},
     {.fields = {{"NODE1", &O::node1, "-", "d goes from this node", rules::optional_id_of(IdSpace::node)},
                 {"NODE2", &O::node2, "-", "to this one", rules::optional_id_of(IdSpace::node)},
                 {"D1", &O::d1, "-", "d, without NODE1, x: a is along it, b = normal x a", rules::direction},
                 {"D2", &O::d2, "-", "d, y"},
                 {"D3", &O::d3, "-", "d, z"}}}})};

using G = RigidWallGeometric;
const RegisterKeyword<G> rigid_wall_geometric{
    {.names = geometric_names(),
     .purpose = "plate, prism, cylinder or sphere that particles and nodes of deformable elements do not "
                "enter; nodes of rigid bodies and those of prescribed motions do",
     .id_space = IdSpace::rigid_wall,
     .id_option = true,
     .title = &G::title,
     .id = &G::id,
     .cards =
         {{.fields = {{"NSID", &G::nsid, "-", "nodes that it holds, 0 all",
                       rules::optional_id_of(IdSpace::node_set)},
                      {"NSIDEX", &G::nsidex, "-", "nodes left out", rules::optional_id_of(IdSpace::node_set)},
                      {"BOXID", &G::boxid, "-", "only those in this box at the start",
                       rules::optional_id_of(IdSpace::box)},
                      {"BIRTH", &G::birth, "T", "when it starts to hold"},
                      {"DEATH", &G::death, "T", "when it ends", rules::or_blank(1e20)}}},
          {.fields = {{"XT", &G::xt, "L",
                       "tail: corner of plate and prism, end of the cylinder's axis, centre of the sphere, x",
                       rules::point},
                      {"YT", &G::yt, "L", "tail, y"},
                      {"ZT", &G::zt, "L", "tail, z"},
                      {"XH", &G::xh, "L", "head of the normal, or of the cylinder's axis, x", rules::point},
                      {"YH", &G::yh, "L", "head, y"},
                      {"ZH", &G::zh, "L", "head, z"},
                      {"FRIC", &G::fric, "-", "0 slides, to 1 Coulomb, 1 does not slide", not_negative}}},
          {.fields = {{"XHEV", &G::xhev, "L", "head of the edge l, which starts at the tail, x",
                       rules::point},
                      {"YHEV", &G::yhev, "L", "head of the edge l, y"},
                      {"ZHEV", &G::zhev, "L", "head of the edge l, z"},
                      {"LENL", &G::lenl, "L", "length of edge l, 0 infinite", not_negative},
                      {"LENM", &G::lenm, "L", "length of edge m = normal x l, 0 infinite", not_negative},
                      {"LENP", &G::lenp, "L", "prism: length against the normal, 0 infinite", not_negative}},
           .when = [](const G& g) { return g.has_edge(); }},
          {.fields = {{"RADCYL", &G::radcyl, "L", "radius of the cylinder", rules::required_positive},
                      {"LENCYL", &G::lencyl, "L", "its length from the tail on, 0 infinite both ways",
                       not_negative},
                      {"NSEGS",
                       &G::nsegs,
                       "-",
                       "sections for which forces are written: none",
                       {.allowed = {0, 1}}}},
           .when = [](const G& g) { return g.shape() == G::Shape::cylinder; }},
          {.fields = {{"VL", &G::vl, "L", "where a section begins", no_effect},
                      {"HEIGHT", &G::height, "L", "its height", no_effect}},
           .when = [](const G& g) { return g.shape() == G::Shape::cylinder && g.nsegs > 0; }},
          {.fields = {{"RADSPH", &G::radsph, "L", "radius of the sphere", rules::required_positive}},
           .when = [](const G& g) { return g.shape() == G::Shape::sphere; }},
          {.fields = {{"LCID", &G::lcid, "-", "its motion over time", rules::required_id_of(IdSpace::curve)},
                      {"OPT", &G::opt, "-", "0: of velocities, 1: of displacements", {.allowed = {0, 1}}},
                      {"VX", &G::vx, "-", "direction of the motion, x", rules::direction},
                      {"VY", &G::vy, "-", "direction of the motion, y"},
                      {"VZ", &G::vz, "-", "direction of the motion, z"}},
           .when = [](const G& g) { return g.moves(); }},
          {.fields = {{"PID", &G::pid, "-", "part of the display", idle_id_of(IdSpace::part)},
                      {"RO", &G::ro, "M/L3", "its density", no_effect},
                      {"E", &G::E, "M/LT2", "its modulus", no_effect},
                      {"PR", &G::pr, "-", "its Poisson ratio", no_effect}},
           .optional = true,
           .when = [](const G& g) { return g.display(); }}},
     .move = [](G& g, const Affine& motion) {
       return keep_lengths(g.lenl > 0 || g.lenm > 0 || g.lenp > 0 || g.radcyl > 0 || g.radsph > 0, motion);
     }}};

}  // namespace

}  // namespace courant