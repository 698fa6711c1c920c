// Cards of initial conditions, constraints and loads: how they move with their file.
#include <cmath>

#include "keyword/registry.hpp"
#include "model/cards.hpp"
#include "model/conditions/condition_cards.hpp"
#include "model/transforms/transformation.hpp"

namespace courant {

namespace {

const RegisterKeyword<InitialVelocityCard> initial_velocity{initial_velocity_table()};
const RegisterKeyword<InitialVelocityNodeCard> initial_velocity_node{initial_velocity_node_table()};
const RegisterKeyword<InitialVelocityGenerationCard> initial_velocity_generation{
    initial_velocity_generation_table()};
const RegisterKeyword<BoundarySpcNodeCard> boundary_spc_node{boundary_spc_node_table()};
const RegisterKeyword<BoundarySpcSetCard> boundary_spc_set{boundary_spc_set_table()};
const RegisterKeyword<ConstrainedGlobal> constrained_global{constrained_global_table()};
const RegisterKeyword<SymmetryPlaneCard> symmetry_plane{boundary_spc_symmetry_plane_table()};
const RegisterKeyword<LoadBodyCard> load_body{load_body_x_table()};
const RegisterKeyword<LoadBodyVectorCard> load_body_vector{load_body_vector_table()};
const RegisterKeyword<LoadBodyRotationCard> load_body_rotation{load_body_rx_table()};
const RegisterKeyword<LoadBodyPartsCard> load_body_parts{load_body_parts_table()};
const RegisterKeyword<LoadGravityPartCard> load_gravity_part{load_gravity_part_table()};

}  // namespace

std::string move_constraint(BoundarySpcCard& card, const Affine& motion) {
  if (card.cid != 0) return {};                 // along the axes of a system that moves
  for (int* dof : {&card.dofx, &card.dofrx}) {  // three in a row
    int* flags[] = {dof, dof == &card.dofx ? &card.dofy : &card.dofry,
                    dof == &card.dofx ? &card.dofz : &card.dofrz};
    std::array<bool, 3> held{};
    for (std::size_t k = 0; k < 3; ++k) held[k] = *flags[k] == 1;
    std::string reason = move_held_axes(held, motion);
    if (!reason.empty() && dof == &card.dofx) return reason;
    for (std::size_t k = 0; k < 3; ++k) *flags[k] = held[k];
  }
  return {};
}

std::string move_plane(ConstrainedGlobal& card, const Affine& motion) {
  if (card.dir < 1 || card.dir > 3) return {};  // refused later, as it is
  for (int* code : {&card.tc, &card.rc, &card.dir}) {
    auto held = axes_of_code(*code);
    std::string reason = move_held_axes(held, motion);
    if (!reason.empty()) return reason;
    *code = code_of_axes(held);
  }
  return {};
}

std::string move_rotation(LoadBodyCard& card, const Affine& motion) {
  const std::string reason = refuse_stretch(motion, "angular velocities");
  if (!reason.empty()) return reason;
  const Vec axis = Vec::Unit(card.name), turned = motion.linear() * axis;
  constexpr Real along = 1 - 1e-9;  // cosine; which way it points does not matter
  return std::abs(turned.dot(axis)) < along
             ? "the axis of the rotation would not be along the same global axis"
             : std::string();
}

std::string move_node_velocity(InitialVelocityNodeCard& card, const Affine& motion) {
  return card.icid != 0 ? std::string() : move_velocity(card.vx, card.vy, card.vz, motion);
}

std::string move_velocities(InitialVelocityCard& card, const Affine& motion) {
  if (card.icid != 0) return {};  // along the axes of a system that moves
  std::string reason = move_velocity(card.vx, card.vy, card.vz, motion);
  return reason.empty() ? move_velocity(card.vxe, card.vye, card.vze, motion) : reason;
}

IdSpace kind_of_irigid(const InitialVelocityCard& card) {
  return card.irigid < 0 ? IdSpace::none : IdSpace::part_set;
}

IdSpace kind_of_id(const InitialVelocityGenerationCard& card) {
  return card.styp == 1 ? IdSpace::part_set : card.styp == 2 ? IdSpace::part : IdSpace::node_set;
}

std::string move_generation(InitialVelocityGenerationCard& card, const Affine& motion) {
  constexpr Real axis_by_nodes = -999;
  if (card.icid != 0) return {};
  std::string reason = move_velocity(card.vx, card.vy, card.vz, motion);
  if (!reason.empty() || card.omega == 0) return reason;
  reason = refuse_stretch(motion, "velocities");
  if (!reason.empty()) return reason;
  if (card.nx != axis_by_nodes) {
    const Vec axis = motion.linear() * Vec(card.nx, card.ny, card.nz);
    card.nx = axis[0], card.ny = axis[1], card.nz = axis[2];
  }
  if (motion.linear().determinant() < 0) card.omega = -card.omega;  // in a mirror things turn the other way
  return {};
}

}  // namespace courant
