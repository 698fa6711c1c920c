#include "rigid/mat_rigid.hpp"

#include <cmath>

#include "keyword/registry.hpp"
#include "model/transforms/transformation.hpp"

namespace courant {
namespace {

using M = MatRigid;
constexpr Honour no = Honour::no, output_only = Honour::output_only;

/// CON1 and CON2 name global axes. Anything else in them is refused later, as it stands.
std::string move_constraints(M& m, const Affine& motion) {
  if (Vec V(m.v1, m.v2, m.v3); V != Vec::Zero()) {
    const Vec A = motion.linear() * Vec(m.lco, m.a2, m.a3);
    V = motion.linear() * V;
    m.lco = A[0], m.a2 = A[1], m.a3 = A[2], m.v1 = V[0], m.v2 = V[1], m.v3 = V[2];
  }
  if (m.cmo != 1) return {};
  for (Real* code : {&m.con1, &m.con2}) {
    if (!(*code > 0 && *code < 7 && *code == std::floor(*code))) continue;
    auto held = axes_of_code(static_cast<int>(*code));
    std::string reason = move_held_axes(held, motion);
    if (!reason.empty()) return reason;
    *code = code_of_axes(held);
  }
  return {};
}

/// LCO is the id of a coordinate system where V is 0, else a number of A.
std::string convert_system(M& m, const Conversion& conversion) {
  if (Vec(m.v1, m.v2, m.v3) == Vec::Zero() && m.lco == std::floor(m.lco) && std::abs(m.lco) < 1e15)
    m.lco = static_cast<Real>(conversion.offsets.shifted(IdSpace::coordinate_system, static_cast<Id>(m.lco)));
  if (m.cmo == -1 && m.con1 == std::floor(m.con1))
    m.con1 =
        static_cast<Real>(conversion.offsets.shifted(IdSpace::coordinate_system, static_cast<Id>(m.con1)));
  return {};
}

const RegisterKeyword<M> mat_rigid{
    {.names = {"MAT_RIGID", "MAT_020"},
     .purpose = "rigid body: density, constraints; E and PR give the contact stiffness only",
     .id_space = IdSpace::material,
     .title_option = true,
     .title = &M::title,
     .cards =
         {{.fields = {{"MID",
                       &M::mid,
                       "-",
                       "id that *PART refers to",
                       {.required = true, .check = Check::positive}},
                      {"RO", &M::ro, "M/L3", "density", {.required = true, .check = Check::positive}},
                      {"E", &M::E, "M/LT2", "Young's modulus", {.required = true, .check = Check::positive}},
                      {"PR", &M::pr, "-", "Poisson ratio", {.check = Check::not_negative}},
                      {"N", &M::n, "-", "coupling with other codes", {.honour = no}},
                      {"COUPLE", &M::couple, "-", "coupling with other codes", {.honour = no}},
                      {"M", &M::m, "-", "coupling with other codes", {.honour = no}},
                      {"ALIAS", &M::alias, "-", "coupling with other codes", {.honour = no}}}},
          {.fields = {{"CMO",
                       &M::cmo,
                       "-",
                       "0 free, 1 held along global axes, -1 along those of a system, as far as they are "
                       "global, too",
                       {}},
                      {"CON1",
                       &M::con1,
                       "-",
                       "held translations: 1 x, 2 y, 3 z, 4 xy, 5 yz, 6 zx, 7 all; CMO -1: the system",
                       {}},
                      {"CON2",
                       &M::con2,
                       "-",
                       "held rotations alike; CMO -1: six digits, 1 holds x, y, z, about x, y, z",
                       {}},
                      {"SPCNID",
                       &M::spcnid,
                       "-",
                       "node of a point constraint",
                       {.honour = no, .refers = IdSpace::node}},
                      {"XSPC",
                       &M::xspc,
                       "L",
                       "point of a point constraint",
                       {.honour = no, .spatial = Spatial::point}},
                      {"YSPC", &M::yspc, "L", "point of a point constraint", {.honour = no}},
                      {"ZSPC", &M::zspc, "L", "point of a point constraint", {.honour = no}}},
           .optional = true},
          {.fields = {{"LCO",
                       &M::lco,
                       "-",
                       "system, or x of A, of the axes of motions _LOCAL; not of the output",
                       {}},
                      {"A2", &M::a2, "-", "these axes: x along A, y by V", {}},
                      {"A3", &M::a3, "-", "these axes: x along A, y by V", {}},
                      {"V1", &M::v1, "-", "these axes: x along A, y by V", {}},
                      {"V2", &M::v2, "-", "these axes: x along A, y by V", {}},
                      {"V3", &M::v3, "-", "these axes: x along A, y by V", {}},
                      {"BNDLCO", &M::bndlco, "-", "local axes in bndout", {.honour = output_only}}},
           .optional = true}},
     .convert = convert_system,
     .move = move_constraints}};

}  // namespace

const MatRigid* mat_rigid_of(const Deck& deck, Id mid) {
  for (const MatRigid& m : deck.all<MatRigid>())
    if (m.mid == mid) return &m;
  return nullptr;
}

}  // namespace courant
