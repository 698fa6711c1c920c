#pragma once
#include <vector>

#include "elements/histories/cross_section.hpp"

namespace courant {

/// The cross sections of a deck.
struct CrossSections : Pass {
  std::string name() const override { return "cross sections"; }
  std::vector<CrossSection> sections{};
};

}  // namespace courant
