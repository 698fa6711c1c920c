#include "loads/walls/rigid_wall_card.hpp"

#include <string>

#include "keyword/registry.hpp"
#include "model/transforms/transformation.hpp"

namespace courant {

namespace {

/// Its lengths are no positions, and edge m follows from the others by the right hand.
std::string keep_lengths(bool has_lengths, const Affine& motion) {
  constexpr Real round_off = 1e-9;
  const Matrix A = motion.linear();
  const bool turns = (A.transpose() * A - Matrix::Identity()).norm() < round_off && A.determinant() > 0;
  if (turns || !has_lengths) return {};
  return "its lengths would change in a transformation that stretches or mirrors the file";
}

const RegisterKeyword<RigidWallPlanar> rigid_wall_planar{rigidwall_planar_table()};
const RegisterKeyword<RigidWallOrtho> rigid_wall_ortho{rigidwall_planar_ortho_table()};
const RegisterKeyword<RigidWallGeometric> rigid_wall_geometric{rigidwall_geometric_flat_table()};

}  // namespace

std::string keep_lengths_of_plane(RigidWallFields& fields, const Affine& motion) {
  const auto& wall = static_cast<const RigidWallPlanar&>(fields);
  return keep_lengths(wall.finite() || wall.offset > 0, motion);
}
std::string keep_lengths_of_shape(RigidWallFields& g, const Affine& motion) {
  return keep_lengths(g.lenl > 0 || g.lenm > 0 || g.lenp > 0 || g.radcyl > 0 || g.radsph > 0, motion);
}
CurveOf curve_of_wall(const RigidWallFields& wall) {
  return {"T", wall.opt == 1 ? "L" : "L/T"};
}

}  // namespace courant