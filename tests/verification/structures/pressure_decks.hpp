#pragma once
// Decks whose pressure comes from an equation of state, and shocks that run along x.
#include <string>
#include <utility>
#include <vector>

#include "solid_decks.hpp"

namespace courant::test {

inline void run_until(Simulation& s, Real t) {
  while (s.clock().t < t) s.step(do_nothing);
}

/// Where the pressure p of positions at x, which falls along x, passes `level`.
template <class Place>
Real front_of(const std::vector<Place>& places, Real level) {
  for (std::size_t k = places.size() - 1; k > 0; --k) {
    const Place &a = places[k - 1], &b = places[k];
    if (a.p >= level && b.p < level) return a.x + (a.p - level) / (a.p - b.p) * (b.x - a.x);
  }
  return 0;
}

/// The speed of a front, of which `us` is about right, from 0.4 to 0.7 of a column of length 1, and the
/// places then.
template <class PlacesOf>
auto shock_of(Simulation& s, Real us, Real level, const PlacesOf& places_of) {
  run_until(s, 0.4 / us);
  const Real first = front_of(places_of(s), level), t = s.clock().t;
  run_until(s, 0.7 / us);
  auto places = places_of(s);
  const Real speed = (front_of(places, level) - first) / (s.clock().t - t);
  return std::pair(speed, std::move(places));
}

/// Adds to `deck` a cube of p = mu + E that is sheared at a constant volume, by 0.01 in the unit of time.
inline void shear_a_cube(SolidDeck& deck, int elform, const std::string& material) {
  deck.block(Vec(1, 1, 1), 1, 1, 1, 1);
  deck.cards = fmt::format(
      "*PART\ncube\n1,1,1,1\n*SECTION_SOLID\n1,{}\n{}*EOS_LINEAR_POLYNOMIAL\n1,0.0,1.0,0.0,0.0,1.0\n0.0,1.0\n"
      "*CONTROL_TIMESTEP\n0.0,0.1\n",
      elform, material);
  deck.node_set(1, [](const Vec& x) { return x[1] < 0.5; });
  deck.node_set(2, [](const Vec& x) { return x[1] > 0.5; });
  deck.cards +=
      "*BOUNDARY_SPC_SET\n1,0,1,1,1\n2,0,0,1,1\n*BOUNDARY_PRESCRIBED_MOTION_SET\n2,1,0,1\n*DEFINE_CURVE\n1\n"
      "0.0,0.01\n1e9,0.01\n";
}

/// nx x ny particles, 0.1 apart in the plane, that are shot at the wall y = 0. `cards`: their material.
inline std::string particles_against_a_wall(int nx, int ny, Real mass, Real speed, const std::string& cards) {
  std::string nodes, particles;
  int id = 0;
  for (int j = 0; j < ny; ++j)
    for (int i = 0; i < nx; ++i) {
      nodes += fmt::format("{:8}{:16.8f}{:16.8f}{:16.8f}\n", ++id, 0.05 + 0.1 * i, 0.051 + 0.1 * j, 0.0);
      particles += fmt::format("{:8}{:8}{:16.8f}\n", id, 1, mass);
    }
  return "*KEYWORD\n*CONTROL_TERMINATION\n1.0\n*CONTROL_SPH\n1,0,1e20,2\n*PART\nblock\n1,1,1,1\n*SECTION_"
         "SPH\n1,1.3,"
         "1.0,1.0\n" +
         cards +
         fmt::format("*RIGIDWALL_PLANAR\n0\n0.0,0.0,0.0,0.0,1.0,0.0\n*INITIAL_VELOCITY\n0\n0.0,{},0.0\n",
                     -speed) +
         "*NODE\n" + nodes + "*ELEMENT_SPH\n" + particles + "*END\n";
}

}  // namespace courant::test
