#pragma once
// The law of *MAT_CSCM, for cards that have its parameters by another rule.
#include <memory>

#include "laws/materials/strength_cards.hpp"
#include "laws/strength/strength.hpp"

namespace courant {

inline constexpr Real most_cscm_damage = 0.999;

std::shared_ptr<StrengthLaw> make_cscm(const MatCscmFields& card);

/// What both cards have in front. `expect`: reports a field that is not as it must be.
template <class Card, class Expect>
void check_cscm_state(const Card& card, const Expect& expect) {
  const auto within = [](Real x, Real low, Real high) { return x >= low && x <= high; };
  expect(card.irate == 0 || card.irate == 1, "IRATE", "0 or 1", card.irate, "1: rates of strain count");
  expect(
      within(card.recov, 0, 1) || within(card.recov, 10, 11), "RECOV", "0 to 1, or 10 to 11", card.recov,
      "the share of brittle damage that stays under pressure; from 10 on where the volume is smaller, too");
  expect(card.pred < most_cscm_damage, "PRED", "a number below 0.999", card.pred, "damage at the start");
}

}  // namespace courant
