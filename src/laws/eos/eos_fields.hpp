#pragma once
// Fields that the cards of all equations of state have.
#include "keyword/card.hpp"
#include "keyword/common_rules.hpp"

namespace courant {

template <class Card>
FieldOf<Card> eosid_field() {
  return {"EOSID", &Card::eosid, "-", "id that *PART refers to", rules::required_id};
}
template <class Card>
FieldOf<Card> v0_field() {
  return {
      "V0", &Card::V0, "-", "initial relative volume rho0/rho", {.standard = 1, .check = Check::positive}};
}

}  // namespace courant
