#pragma once
// The state does not depend on the number of threads, nor on a restart.
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "parallel/parallel.hpp"
#include "solid_decks.hpp"
#include "state/restartable.hpp"

namespace courant::test {

/// All real numbers of the world, set by set.
inline std::vector<Real> state_of(const World& world) {
  std::vector<Real> out;
  for (const FieldSet* set : world.sets())
    for (const auto& field : set->all())
      if (const auto* reals = dynamic_cast<const Field<Real>*>(field.get()))
        for (int k = 0; k < reals->info().components; ++k)
          out.insert(out.end(), reals->data(k), reals->data(k) + set->size());
  return out;
}

/// After `steps`, on 1, 2 and 4 threads, and with a restart from the state after `saved_at`.
inline void expect_same_bits(const std::string& deck, int steps, int saved_at) {
  std::vector<Real> reference;
  for (const int threads : {1, 2, 4}) {
    set_threads(threads);
    auto s = simulation_of(deck);
    for (int k = 0; k < steps; ++k) s->step(do_nothing);
    const std::vector<Real> state = state_of(s->world());
    if (reference.empty()) reference = state;
    EXPECT_TRUE(reference == state) << threads << " threads";
  }
  set_threads(0);
  auto first = simulation_of(deck);
  for (int k = 0; k < saved_at; ++k) first->step(do_nothing);
  SavedState saved;
  Archive save = Archive::saver(saved);
  first->keep(save);
  auto second = simulation_of(deck);
  Archive load = Archive::loader(saved);
  second->keep(load);
  for (int k = saved_at; k < steps; ++k) second->step(do_nothing);
  EXPECT_TRUE(reference == state_of(second->world())) << "after a restart";
}

}  // namespace courant::test
