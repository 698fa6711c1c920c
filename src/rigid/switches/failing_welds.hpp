#pragma once
#include "base/real.hpp"

namespace courant {

/// Forces and times of *CONSTRAINED_SPOTWELD and *CONSTRAINED_GENERALIZED_WELD_SPOT that mean "never".
inline constexpr Real weld_holds = 1e20;

/// Whether a weld can fail; otherwise its nodes are a rigid body to the end.
template <class Card>
bool may_fail(const Card& card) {
  const auto given = [](Real value) { return value > 0 && value < weld_holds; };
  return given(card.sn) || given(card.ss) || given(card.tf) || given(card.ep);
}

}  // namespace courant
