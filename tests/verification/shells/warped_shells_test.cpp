// Decks of shells with one point in their plane with warp (BWC 1 of *CONTROL_SHELL).
#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "free_patches.hpp"
#include "same_bits.hpp"
#include "shell_decks.hpp"
#include "solid_decks.hpp"
#include "state/shared_fields.hpp"

namespace courant::test::warped_shells {

namespace {

const std::string heed_warp = "*CONTROL_SHELL\n20.0,1,-1,0,2,1\n";

/// A warped sheet.
ShellDeck bowl(int n, const std::string& control) {
  ShellDeck deck;
  deck.plate(1, 1, n, n, 1, [](const Vec& x) { return Vec(x[0], x[1], 0.3 * x[0] * x[1]); });
  deck.part(1, 0.02, "*MAT_ELASTIC\n         1    7850.0   2.1E+11       0.3\n");
  deck.cards += control + "*CONTROL_HOURGLASS\n4,0.05\n";
  return deck;
}

}  // namespace

TEST(WarpedShells, SmallFreePatchesAreStableAtTssfac09) {
  expect_stable_patches([](ShellDeck& deck) { deck.cards += heed_warp; });
}

// A warped free shell spins: it keeps its energy, and what turns rigidly is not strained.
TEST(WarpedShells, AWarpedShellSpinsWithoutStrain) {
  expect_spin_without_strain([](ShellDeck& deck) { deck.cards += heed_warp; });
}

// Large bending of warped shells keeps the energy of all, drilling included.
TEST(WarpedShells, KeepTheirEnergy) {
  for (const Real tssfac : {0.3, 0.1}) {
    ShellDeck deck = bowl(8, heed_warp);
    deck.cards += fmt::format("*CONTROL_TIMESTEP\n0.0,{}\n", tssfac);
    deck.hold(1, "xyzXYZ", [](const Vec& x) { return x[0] < 1e-9; });
    deck.velocity([](const Vec& x) { return Vec(0, 0, 100 * x[0] * x[0]); });
    auto s = simulation_of(deck.text(1));
    start_ledger(*s);
    Real most = 0;
    while (s->clock().t < 0.01) {
      s->step(do_nothing);
      most = std::max(most, s->world().nodes.x.data(2)[80] - 0.3);
    }
    EXPECT_GT(most, 0.1);
    EXPECT_LT(energy_error(*s), 0.01) << tssfac;
  }
}

TEST(WarpedShells, SameBitsOnAnyNumberOfThreadsAndAfterARestart) {
  ShellDeck deck = bowl(9, heed_warp);
  deck.cards +=
      "*CONTROL_ACCURACY\n         0         2\n*CONTROL_BULK_VISCOSITY\n       1.5      0.06        -2\n";
  deck.hold(1, "xyzXYZ", [](const Vec& x) { return x[0] < 1e-9; });
  deck.velocity([](const Vec& x) { return Vec(20 * x[1], -3, 60 * x[0] * x[0]); });
  expect_same_bits(deck.text(1), 60, 30);
}

}  // namespace courant::test::warped_shells
