#pragma once
// A layer of water that flows along x, periodic along it, for tests of viscosity.
#include <functional>
#include <string>

#include <fmt/format.h>

#include "base/real.hpp"

namespace courant::test::shear_layer {

inline constexpr Real jet_dx = 0.2;
inline constexpr int columns = 8, rows = 60;

/// A layer from y = -6 to 6, periodic along x, between mirrors, that flows along x with u(y).
inline std::string layer(const std::function<Real(Real y)>& u, const std::string& more) {
  std::string text =
      "*KEYWORD\n*CONTROL_TERMINATION\n50.\n*CONTROL_SPH\n1,0,1e20,2\n0,0,0,0,0,0,0\n*PART\nwater\n1,1,1,1,"
      "1\n"
      "*SECTION_SPH\n1,1.3,1,1\n*MAT_NULL\n1,1000.0\n*EOS_LINEAR_POLYNOMIAL\n1,0,4e5\n\n"
      "*HOURGLASS\n1,0,0,0,1e-20,1e-20\n"
      "*DEFINE_VECTOR\n1,0,0,0,1,0,0\n2,1.6,0,0,0,0,0\n*BOUNDARY_SPH_PERIODIC\n1,2\n"
      "*BOUNDARY_SPH_SYMMETRY_PLANE\n0,-6,0,0,0,0\n0,6,0,0,0,0\n" +
      more + "*NODE\n";
  std::string elements = "*ELEMENT_SPH\n", velocities = "*INITIAL_VELOCITY_NODE\n";
  for (int k = 0; k < columns * rows; ++k) {
    const Real y = (k / columns + 0.5 - rows / 2) * jet_dx;
    text += fmt::format("{},{:.17g},{:.17g},0\n", k + 1, (k % columns + 0.5) * jet_dx, y);
    elements += fmt::format("{},1,{}\n", k + 1, 1000 * jet_dx * jet_dx);
    velocities += fmt::format("{},{:.17g}\n", k + 1, u(y));
  }
  return text + elements + velocities + "*END\n";
}

}  // namespace courant::test::shear_layer
