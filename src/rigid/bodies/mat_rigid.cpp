#include "rigid/bodies/mat_rigid.hpp"
#include "rigid/bodies/rigid_cards.hpp"

#include <cmath>

#include "base/rotation.hpp"
#include "keyword/registry.hpp"
#include "model/transforms/transformation.hpp"

namespace courant {
namespace {

using M = MatRigid;
constexpr Honour no = Honour::no, output_only = Honour::output_only;

const RegisterKeyword<M> mat_rigid{mat_rigid_table()};

}  // namespace

/// CON1 and CON2 name global axes. Anything else in them is refused later, as it stands.
std::string move_constraints(MatRigid& m, const Affine& motion) {
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
std::string convert_system(MatRigid& m, const Conversion& conversion) {
  if (Vec(m.v1, m.v2, m.v3) == Vec::Zero() && m.lco == std::floor(m.lco) && std::abs(m.lco) < 1e15)
    m.lco = static_cast<Real>(conversion.offsets.shifted(IdSpace::coordinate_system, static_cast<Id>(m.lco)));
  if (m.cmo == -1 && m.con1 == std::floor(m.con1))
    m.con1 =
        static_cast<Real>(conversion.offsets.shifted(IdSpace::coordinate_system, static_cast<Id>(m.con1)));
  return {};
}

const MatRigid* mat_rigid_of(const Deck& deck, Id mid) {
  for (const MatRigid& m : deck.all<MatRigid>())
    if (m.mid == mid) return &m;
  return nullptr;
}

std::optional<Matrix> axes_of_material(const MatRigid& m, const Model& model) {
  const Vec A(m.lco, m.a2, m.a3), V(m.v1, m.v2, m.v3);
  if (V != Vec::Zero()) return axes_from(A, V);
  const auto system = model.coordinate_systems.find(static_cast<Id>(m.lco));
  if (m.lco == 0 || system == model.coordinate_systems.end()) return std::nullopt;
  return system->second.axes;
}

}  // namespace courant
