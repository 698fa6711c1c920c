#pragma once
#include "elements/discrete/discrete_cards.hpp"
#include "keyword/card.hpp"

namespace courant {

struct SectionDiscrete : SectionDiscreteFields {
  bool turns() const { return dro == 1; }
};

struct ElementMassSetCard : ElementMassCard {};

}  // namespace courant
