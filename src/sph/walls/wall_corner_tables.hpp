#pragma once
// Integrals of a kernel over walls that meet at right angles, in tables.
#include <array>
#include <vector>

#include "sph/kernel/kernel_choice.hpp"

namespace courant {

/// What a kernel of h = 1 gives of a plane (in 2D: a line) at distance d and of what is behind it, beyond a
/// second plane at a, and a third at b, all at right angles. d, a, b >= 0.
class WallCornerTables {
 public:
  WallCornerTables(KernelChoice kernel, int dim);
  /// int W dS over the part of the plane beyond a.
  Real plane(Real d, Real a) const { return at(plane_, d, a); }
  /// The same beyond a and b.
  Real plane(Real d, Real a, Real b) const { return at(corner_, d, a, b); }
  /// int s W dS over the part beyond a, s along the normal of the second plane.
  Real moment(Real d, Real a) const { return at(lever_, d, a); }
  /// The same beyond a and b.
  Real moment(Real d, Real a, Real b) const { return at(corner_lever_, d, a, b); }
  /// int W dV behind both, or all three.
  Real behind(Real a, Real b) const { return at(edge_, a, b); }
  Real behind(Real a, Real b, Real c) const { return at(three_, a, b, c); }

 private:
  static constexpr int n2 = 160, n3 = 48;
  Real at(const std::vector<Real>& table, Real x, Real y) const;
  Real at(const std::vector<Real>& table, Real x, Real y, Real z) const;

  Real support_ = 2;
  std::vector<Real> plane_, lever_, edge_, corner_, corner_lever_, three_;
};

}  // namespace courant
