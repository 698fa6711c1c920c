#pragma once
// A run that goes on from a restart, on another number of threads, has the same bits.
#include <gtest/gtest.h>

#include <string>

#include "app/run/simulation.hpp"
#include "parallel/parallel.hpp"
#include "small_scene.hpp"
#include "state/saved_state.hpp"

namespace courant::test {

inline void expect_same_after_restart(const std::string& deck, int before, int after) {
  const auto whole = build_deck(deck, false);
  const auto second = build_deck(deck, false);
  ASSERT_TRUE(whole && second);
  const int had = threads();
  set_threads(1);
  steps(*whole, before);
  SavedState state;
  Archive saving = Archive::saver(state);
  whole->keep(saving);
  Archive loading = Archive::loader(state);
  second->keep(loading);
  steps(*whole, after);
  set_threads(2);
  steps(*second, after);
  set_threads(had);
  const Nodes &a = whole->world().nodes, &b = second->world().nodes;
  Real moved = 0;
  for (Index n = 0; n < a.size(); ++n) {
    EXPECT_EQ(a.x.vec(n), b.x.vec(n)) << a.id[n];
    EXPECT_EQ(a.v.vec(n), b.v.vec(n)) << a.id[n];
    moved = std::max(moved, a.v.vec(n).norm());
  }
  EXPECT_GT(moved, 0);
}

}  // namespace courant::test
