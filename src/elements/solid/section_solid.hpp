#pragma once
#include <string>
#include <vector>

#include "keyword/deck.hpp"
#include "model/model.hpp"

namespace courant {

/// *SECTION_SOLID
struct SectionSolid : Entry {
  std::string title;
  Id secid = 0;
  int elform = 0, aet = 0;
  std::vector<std::string> user{};  ///< cards of what is not supported
  Real cohoff = 0, gaskett = 0;
};

/// ELFORM of a part of solids; 2 where it becomes that, 1 where there is no section.
int solid_formulation(const Deck& deck, const ModelPart& part);

/// Checks that each part with solids has a section with a formulation that is there. Sections that no such
/// part names may be of any kind.
void check_solid_sections(const Deck& deck, const Model& model, Diagnostics& diagnostics);

}  // namespace courant
