#pragma once
// Patches of shells that nothing holds, with noise.
#include <algorithm>
#include <array>
#include <functional>
#include <random>

#include "shell_decks.hpp"
#include "solid_decks.hpp"
#include "state/shared_fields.hpp"

namespace courant::test {

/// Largest speed of a node, or of its turning, in the first and in the last of three thousand steps from
/// noise.
struct Growth {
  Real early = 0, late = 0;
};

template <class Random>
Growth growth_of_noise(Simulation& s, Random& random, std::uniform_real_distribution<Real>& number) {
  World& world = s.world();
  Field<Real>& turning = *shared_fields::angular_velocity.find(world.nodes.fields);
  for (Index i = 0; i < world.nodes.size(); ++i) {
    world.nodes.v.set(i, 1e-9 * Vec(number(random), number(random), number(random)));
    turning.set(i, 1e-9 * Vec(number(random), number(random), number(random)));
  }
  const auto fastest = [&] {
    Real most = 0;
    for (Index i = 0; i < world.nodes.size(); ++i)
      most = std::max({most, world.nodes.v.vec(i).norm(), turning.vec(i).norm()});
    return most;
  };
  Growth out;
  for (int k = 0; k < 3000; ++k) {
    s.step(do_nothing);
    if (k < 1000) out.early = std::max(out.early, fastest());
    if (k >= 2000) out.late = std::max(out.late, fastest());
  }
  return out;
}

/// Patches of quadrilaterals that nothing holds: warped at random and in the plane, thick and thin, up to
/// nearly incompressible. `make`: what they are besides a part of one sheet.
inline void expect_stable_patches(const std::function<void(ShellDeck&)>& make) {
  std::mt19937 random(11);
  std::uniform_real_distribution<Real> number(-1, 1);
  for (const char* nu : {"0.0", "0.3", "0.49"})
    for (const auto& [nx, ny] : {std::array{1, 1}, {1, 4}, {3, 3}})
      for (const Real t : {0.01, 0.1, 0.7})
        for (const Real uneven : {0.0, 0.1, 0.2}) {
          ShellDeck deck;
          deck.plate(nx, ny, nx, ny, 1, [&](const Vec& x) {
            const Vec by = uneven * Vec(number(random), number(random), number(random));
            return Vec(x + by + Vec(uneven * x[1], 0, 0));
          });
          deck.part(1, t, fmt::format("*MAT_ELASTIC\n         1       1.0       1.0{:>10}\n", nu));
          make(deck);
          deck.cards += "*CONTROL_TIMESTEP\n       0.0       0.9\n";
          auto s = simulation_of(deck.text(1e9));
          const Growth noise = growth_of_noise(*s, random, number);
          EXPECT_LT(noise.late, 2 * noise.early)
              << " nu " << nu << " " << nx << ny << " t " << t << " " << uneven;
        }
}

/// A warped free sheet spins: it keeps its energy, and what turns rigidly is not strained.
inline void expect_spin_without_strain(const std::function<void(ShellDeck&)>& make) {
  ShellDeck deck;
  deck.plate(1, 1, 2, 2, 1, [](const Vec& x) { return Vec(x[0] - 0.5, x[1] - 0.5, 0.3 * x[0] * x[1]); });
  deck.part(1, 0.02, "*MAT_ELASTIC\n         1       1.0     1.0E4       0.3\n");
  make(deck);
  auto s = simulation_of(deck.text(1e9));
  World& world = s->world();
  const Vec omega(0.4, -0.3, 0.8);
  for (Index n = 0; n < world.nodes.size(); ++n) {
    world.nodes.v.set(n, omega.cross(world.nodes.x.vec(n)));
    shared_fields::angular_velocity.find(world.nodes.fields)->set(n, omega);
  }
  start_ledger(*s);
  const Real start = world.energy.initial;
  for (int k = 0; k < 4000; ++k) s->step(do_nothing);
  EXPECT_LT(energy_error(*s), 1e-3);
  EXPECT_LT(world.energy.internal + world.energy.hourglass, 1e-3 * start);
}

}  // namespace courant::test
