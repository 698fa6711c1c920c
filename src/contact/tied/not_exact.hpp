#pragma once
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "contact/tied/build.hpp"
#include "contact/tied/constraint.hpp"
#include "contact/tied/tied_card.hpp"

namespace courant {

/// Why nodes cannot go with faces exactly, and in which field of the card.
struct WhyNotExact {
  const char* field;
  std::string text, hint;
};
/// `tied`, `corners`: nodes of exact contacts so far, and corners of their faces.
std::optional<WhyNotExact> why_not_exact(const ContactCard& card, const std::vector<Tie>& ties,
                                         const std::set<Index>& tied, const std::set<Index>& corners,
                                         const Model& model, const TiedOptions& options, const World& world);

}  // namespace courant
