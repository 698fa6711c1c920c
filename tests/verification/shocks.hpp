#pragma once
// Shocks that run along x.
#include <utility>
#include <vector>

#include "solid_decks.hpp"

namespace courant::test {

inline void run_until(Simulation& s, Real t) {
  while (s.clock().t < t) s.step(do_nothing);
}

/// Where the pressure p of places at x, which falls along x, passes `level`.
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

}  // namespace courant::test
