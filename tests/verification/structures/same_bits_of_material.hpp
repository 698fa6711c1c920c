#pragma once
// Parts of one material in motion, with the same bits on any number of threads and after a restart.
#include <string>

#include "same_bits.hpp"
#include "shell_decks.hpp"
#include "solid_decks.hpp"

namespace courant::test {

/// A block of solids thrown against a rigid wall.
inline void expect_same_bits_of_block(const std::string& material) {
  SolidDeck deck;
  deck.block(Vec(3, 2, 2), 6, 4, 4, 1);
  deck.cards = "*PART\nblock\n1,1,1\n*SECTION_SOLID\n1,1\n" + material;
  deck.cards += "*INITIAL_VELOCITY\n0\n-0.5,0.1,-0.2\n*RIGIDWALL_PLANAR\n0\n-0.01,0.0,0.0,1.0,0.0,0.0\n";
  expect_same_bits(deck.text(100), 60, 25);
}

/// A sheet of shells, held at one edge and torn away from it.
inline void expect_same_bits_of_sheet(const std::string& material) {
  ShellDeck deck;
  deck.plate(1, 1, 4, 4, 1);
  deck.part(1, 0.01, material, 3);
  deck.hold(1, "xyz", [](const Vec& x) { return x[0] < 1e-9; });
  deck.cards += "*INITIAL_VELOCITY\n0\n4.0,1.0,2.0\n";
  expect_same_bits(deck.text(100), 60, 25);
}

}  // namespace courant::test
