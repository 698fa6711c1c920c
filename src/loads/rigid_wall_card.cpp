#include "loads/rigid_wall_card.hpp"

#include <vector>

#include "keyword/common_rules.hpp"
#include "keyword/registry.hpp"
#include "model/transforms/transformation.hpp"

namespace courant {

namespace {

/// With every choice of options in LS-DYNA's order: bit k of the index of a name tells of option k.
std::vector<std::string> wall_names() {
  std::vector<std::string> names{"RIGIDWALL_PLANAR"};
  for (const char* option : {"_FINITE", "_MOVING", "_FORCES", "_DISPLAY"})
    for (std::size_t k = 0, n = names.size(); k < n; ++k) names.push_back(names[k] + option);
  return names;
}

/// Its lengths are no places, and edge m follows from the others by the right hand.
std::string keep_lengths(const RigidWallPlanar& wall, const Affine& motion) {
  constexpr Real round_off = 1e-9;
  const Matrix A = motion.linear();
  const bool turns = (A.transpose() * A - Matrix::Identity()).norm() < round_off && A.determinant() > 0;
  if (turns || !(wall.finite() || wall.offset > 0)) return {};
  return "its lengths LENL, LENM and OFFSET would change in a transformation that stretches or mirrors the "
         "file";
}

using W = RigidWallPlanar;
constexpr FieldRules not_negative{.check = Check::not_negative};
constexpr FieldRules idle_id_of(IdSpace space) {
  return {.honour = Honour::ignored, .refers = space};
}
const RegisterKeyword<W> rigid_wall_planar{
    {.names = wall_names(),
     .purpose =
         "plane that particles and nodes of deformable elements do not pass; nodes of rigid bodies and "
         "those of prescribed motions do",
     .id_space = IdSpace::rigid_wall,
     .id_option = true,
     .title = &W::title,
     .id = &W::id,
     .cards =
         {{.fields = {{"NSID", &W::nsid, "-", "nodes that it holds, 0 all",
                       rules::optional_id_of(IdSpace::node_set)},
                      {"NSIDEX", &W::nsidex, "-", "nodes left out", rules::optional_id_of(IdSpace::node_set)},
                      {"BOXID", &W::boxid, "-", "only those in this box at the start",
                       rules::optional_id_of(IdSpace::box)},
                      {"OFFSET", &W::offset, "L", "only those so near at the start, 0 all", not_negative},
                      {"BIRTH", &W::birth, "T", "when it starts to hold"},
                      {"DEATH", &W::death, "T", "when it ends", rules::or_blank(1e20)},
                      {"RWKSF", &W::rwksf, "-", "stiffness towards rigid bodies", no_effect_but(1)}}},
          {.fields = {{"XT", &W::xt, "L", "tail of the normal, on the plane, x", rules::point},
                      {"YT", &W::yt, "L", "tail of the normal, y"},
                      {"ZT", &W::zt, "L", "tail of the normal, z"},
                      {"XH", &W::xh, "L", "head of the normal, towards what it holds, x", rules::point},
                      {"YH", &W::yh, "L", "head of the normal, y"},
                      {"ZH", &W::zh, "L", "head of the normal, z"},
                      {"FRIC", &W::fric, "-",
                       "0 slides, to 1 Coulomb, 1 does not slide, 2 welded and slides, 3 welded",
                       not_negative},
                      {"WVEL", &W::wvel, "L/T", "FRIC 2, 3: is welded by an impact faster than this",
                       not_negative}}},
          {.fields = {{"XHEV", &W::xhev, "L", "head of the edge l, which starts at the tail, x",
                       rules::point},
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
           .when = [](const W& w) { return w.display(); }}},
     .move = [](W& wall, const Affine& motion) { return keep_lengths(wall, motion); }}};

}  // namespace

}  // namespace courant