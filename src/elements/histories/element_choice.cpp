#include "elements/histories/element_choice.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "model/sets/sets_cards.hpp"

namespace courant {

const char* element_word(ElementKind kind) {
  constexpr const char* words[] = {"solid", "beam", "shell"};
  return words[static_cast<std::size_t>(kind)];
}

ElementChoice::ElementChoice(const Deck& deck, const Model& model, const World& world,
                             Diagnostics& diagnostics)
    : deck_(deck), model_(model), diagnostics_(diagnostics) {
  for (const auto* reporter : world.passes.all<const ElementReporter>())
    for (Index e = 0; e < reporter->reported().size(); ++e) {
      at_.emplace(std::pair(reporter->kind(), reporter->reported().id[e]), all_.size());
      all_.push_back({reporter->kind(), reporter, e});
    }
}

const ReportedElement* ElementChoice::find(const Entry& card, const char* field, ElementKind kind, Id id,
                                           const char* of) {
  if (const auto found = at_.find({kind, id}); found != at_.end()) return &all_[found->second];
  if (in_model(kind, id))
    deck_.warning(
        diagnostics_, card, field,
        fmt::format("{} {} belongs to a rigid body or is of *MAT_NULL, so that it has no stress: {} "
                    "does not include it",
                    element_word(kind), id, of));
  else
    deck_.error(diagnostics_, card, field, fmt::format("{} {} does not exist", element_word(kind), id));
  return nullptr;
}

std::vector<ReportedElement> ElementChoice::set(const Entry& card, const char* field, ElementKind kind, Id id,
                                                const char* of) {
  std::vector<ReportedElement> out;
  std::size_t rigid = 0;
  for (const Id member : members(card, field, kind, id))
    if (const auto found = at_.find({kind, member}); found != at_.end())
      out.push_back(all_[found->second]);
    else if (in_model(kind, member))
      ++rigid;
    else
      deck_.error(diagnostics_, card, field,
                  fmt::format("{} {} of set {} does not exist", element_word(kind), member, id));
  if (rigid > 0)
    deck_.warning(
        diagnostics_, card, field,
        fmt::format("{} of the {}s of set {} belong to rigid bodies or are of *MAT_NULL, so that they "
                    "have no stress: {} does not include them",
                    rigid, element_word(kind), id, of));
  return out;
}

std::vector<Id> ElementChoice::members(const Entry& card, const char* field, ElementKind kind, Id id) {
  std::vector<Id> out;
  if (kind == ElementKind::beam) {
    for (const SetBeam& set : deck_.all<SetBeam>())
      if (set.sid == id) return set.eids;
  } else {
    const auto& sets = kind == ElementKind::solid ? model_.solid_sets : model_.shell_sets;
    if (const auto found = sets.find(id); found != sets.end()) {
      for (const Index k : found->second) {
        const auto at = static_cast<std::size_t>(k);
        out.push_back(kind == ElementKind::solid ? model_.solids[at].id : model_.shells[at].id);
      }
      return out;
    }
  }
  constexpr const char* keywords[] = {"*SET_SOLID", "*SET_BEAM", "*SET_SHELL_LIST"};
  deck_.error(diagnostics_, card, field, fmt::format("{} set {} does not exist", element_word(kind), id),
              fmt::format("define it with {}", keywords[static_cast<std::size_t>(kind)]));
  return out;
}

bool ElementChoice::in_model(ElementKind kind, Id id) const {
  const auto is_it = [id](const auto& one) { return one.id == id; };
  switch (kind) {
    case ElementKind::solid:
      return std::any_of(model_.solids.begin(), model_.solids.end(), is_it);
    case ElementKind::beam:
      return std::any_of(model_.beams.begin(), model_.beams.end(), is_it);
    case ElementKind::shell:
      break;
  }
  return std::any_of(model_.shells.begin(), model_.shells.end(), is_it);
}

}  // namespace courant
