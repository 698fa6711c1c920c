#pragma once
// Water at rest with a checkerboard of pressures, which a scheme should even out without moving the water.
#include <cmath>
#include <memory>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "../app/small_scene.hpp"

namespace courant::test {

/// A tank of water, 10 by 10 particles with spacing 0.1 and c0 = 20, between mirrors, from its hydrostatic
/// pressure; every second particle of a checkerboard has `noise` more pressure. `copies`: particles in one
/// place.
inline std::unique_ptr<Simulation> checkerboard_tank(const std::string& more, Real noise, int iavis = 0,
                                                     int copies = 1) {
  std::string text = fmt::format(
      "*KEYWORD\n*CONTROL_TERMINATION\n5.\n*CONTROL_SPH\n1,0,1e20,2\n0,0,0,0,0,0,{}\n*PART\nwater\n1,1,1,1,"
      "1\n"
      "*SECTION_SPH\n1,1.2,1,1,0.12\n*MAT_NULL\n1,1000.0\n*EOS_LINEAR_POLYNOMIAL\n1,0,4e5\n\n"
      "*HOURGLASS\n1,0,0,0,1e-20,1e-20\n"
      "*BOUNDARY_SPH_SYMMETRY_PLANE\n0,0,0,0,1,0\n0,0,0,1,0,0\n1,0,0,0,0,0\n",
      iavis);
  text += gravity_cards + more + "*NODE\n";
  std::string elements = "*ELEMENT_SPH\n", pressures = "*INITIAL_STRESS_SPH\n";
  for (int k = 0; k < 100 * copies; ++k) {
    const int column = k % 10, row = k / 10 % 10;
    text += fmt::format("{},{:.17g},{:.17g},0\n", k + 1, 0.1 * column + 0.05 + 0.001 * (k / 100),
                        0.1 * row + 0.05);
    elements += fmt::format("{},1,10.0\n", k + 1);
    const Real p = 9810 * (0.95 - 0.1 * row) + ((column + row) % 2 == 0 ? noise : 0);
    pressures += fmt::format("{},{:.17g},{:.17g},{:.17g},0,0,0,0\n", k + 1, -p, -p, -p);
  }
  return build_deck(text + elements + pressures + "*END\n",
                    copies == 1);  // copies are too heavy for their position
}

/// Mean square of what two neighbours in a row of that tank differ by, less the change along the row that
/// goes over two of them.
inline Real roughness(const Simulation& s) {
  const Particles& p = s.world().particles;
  std::vector<Real> pressure(static_cast<std::size_t>(p.active));
  for (Index i = 0; i < p.active; ++i) pressure[static_cast<std::size_t>(p.id[i] - 1)] = p.p[i];
  Real sum = 0;
  for (std::size_t k = 1; k < 99; ++k)
    if (k % 10 != 0 && k % 10 != 9)
      sum += std::pow(pressure[k] - 0.5 * (pressure[k - 1] + pressure[k + 1]), 2) / 80;
  return sum;
}

}  // namespace courant::test
