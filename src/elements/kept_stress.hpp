#pragma once
// Whether a law continues from a given stress.
#include <array>
#include <cmath>
#include <span>
#include <vector>

#include "laws/strength/strength.hpp"

namespace courant {

using Stress = std::array<Real, 6>;  ///< xx yy zz xy yz zx [M/LT2]

/// Frobenius norm. [M/LT2]
inline Real size_of(const Stress& s) {
  Real sum = 0;
  for (std::size_t k = 0; k < 6; ++k) sum += (k < 3 ? 1 : 2) * s[k] * s[k];
  return std::sqrt(sum);
}

enum class Keeps {
  all,
  up_to_yield,  ///< what is beyond that is lost in the next step
  nothing,      ///< the stress follows from the deformation alone
};

/// `update`: the law at a block of one point. `history`: of the law, component by component; it stays as it
/// is.
template <class Update>
Keeps keeps_stress(const Stress& stress, std::span<Real* const> history, const Update& update) {
  const auto change_at_rest = [&](const Stress& before) {
    Stress after = before;
    Real rate[6] = {}, compression = 0, sound_speed = 0;
    std::vector<Real> numbers;
    for (const Real* h : history) numbers.push_back(*h);
    std::vector<Real*> copies;
    for (Real& h : numbers) copies.push_back(&h);
    constexpr Real short_step = 1e-15;
    PointBlock points;
    points.count = 1, points.dt = short_step;
    points.sound_speed = &sound_speed, points.compression = &compression;
    for (std::size_t k = 0; k < 6; ++k) points.rate[k] = rate + k, points.stress[k] = &after[k];
    points.history = copies;
    update(points);
    for (std::size_t k = 0; k < 6; ++k) after[k] -= before[k];
    return size_of(after);
  };
  constexpr Real rounding = 1e-6, small = 1e-6;
  const Real size = size_of(stress);
  if (size == 0 || change_at_rest(stress) <= rounding * size) return Keeps::all;
  Stress little = stress;
  for (Real& s : little) s *= small;
  return change_at_rest(little) <= rounding * small * size ? Keeps::up_to_yield : Keeps::nothing;
}

}  // namespace courant
