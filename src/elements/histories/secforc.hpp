#pragma once
#include <memory>
#include <vector>

#include "elements/histories/cross_section.hpp"
#include "keyword/deck.hpp"

namespace courant {

/// The cross sections of a deck.
struct CrossSections : Pass {
  std::string name() const override { return "cross sections"; }
  std::vector<CrossSection> sections{};
};

/// Those of the present positions. The world has the passes of elements.
std::shared_ptr<CrossSections> read_cross_sections(const Deck& deck, const Model& model, const World& world,
                                                   Diagnostics& diagnostics);

/// Whether it has any: they need the forces of elements on their corners.
bool has_cross_sections(const Deck& deck);

}  // namespace courant
