// *DEFINE_ELEMENT_DEATH: elements that are deleted at a time.
#include <fmt/format.h>

#include <algorithm>
#include <unordered_map>

#include "elements/element_cards.hpp"
#include "elements/erosion.hpp"
#include "keyword/registry.hpp"

namespace courant {

namespace {

struct ElementDeath : ElementDeathFields {
  bool of_solids() const { return name < 2; }  // names in the order of the table
  bool is_set() const { return name % 2 == 1; }
};
const RegisterKeyword<ElementDeath> element_death{define_element_death_solid_table()};

/// Where elements of one kind are in the model, by their numbers.
template <class Element>
std::unordered_map<Id, Index> index_of(const std::vector<Element>& elements) {
  std::unordered_map<Id, Index> out;
  for (std::size_t e = 0; e < elements.size(); ++e) out.emplace(elements[e].id, static_cast<Index>(e));
  return out;
}

class DeathReader {
 public:
  DeathReader(const Deck& deck, const Model& model, const std::vector<std::shared_ptr<StrengthLaw>>& laws,
              std::vector<FailureRules>& rules, Diagnostics& diagnostics)
      : deck_(deck),
        model_(model),
        laws_(laws),
        rules_(rules),
        diagnostics_(diagnostics),
        solid_(index_of(model.solids)),
        shell_(index_of(model.shells)) {}
  void take(const ElementDeath& card) {
    if (card.of_solids())
      take_from(card, model_.solids, solid_, model_.solid_sets, "solid");
    else
      take_from(card, model_.shells, shell_, model_.shell_sets, "shell");
  }

 private:
  template <class Element>
  void take_from(const ElementDeath& card, const std::vector<Element>& elements,
                 const std::unordered_map<Id, Index>& known, const std::map<Id, std::vector<Index>>& sets,
                 const char* kind) {
    std::vector<Index> members;
    if (card.is_set()) {
      const auto set = sets.find(card.eid);
      if (set == sets.end()) return error(card, fmt::format("{} set {} does not exist", kind, card.eid));
      members = set->second;
    } else {
      const auto one = known.find(card.eid);
      if (one == known.end()) return error(card, fmt::format("{} {} does not exist", kind, card.eid));
      members = {one->second};
    }
    for (const Index m : members) {
      const Element& element = elements[static_cast<std::size_t>(m)];
      const auto part = static_cast<std::size_t>(element.part);
      if (!laws_[part])
        return error(card, fmt::format("{} {} is of part {}, whose elements are rigid or have no stress: it "
                                       "cannot be deleted",
                                       kind, element.id, model_.parts[part].id));
      const auto [known_death, is_new] = rules_[part].deaths.emplace(element.id, card.time);
      if (!is_new) known_death->second = std::min(known_death->second, card.time);
    }
  }
  void error(const ElementDeath& card, std::string message) {
    deck_.error(diagnostics_, card, "EID", std::move(message), "name solids or shells that deform");
  }

  const Deck& deck_;
  const Model& model_;
  const std::vector<std::shared_ptr<StrengthLaw>>& laws_;
  std::vector<FailureRules>& rules_;
  Diagnostics& diagnostics_;
  std::unordered_map<Id, Index> solid_, shell_;
};

}  // namespace

void take_deaths(const Deck& deck, const Model& model, const std::vector<std::shared_ptr<StrengthLaw>>& laws,
                 std::vector<FailureRules>& rules, Diagnostics& diagnostics) {
  const auto& cards = deck.all<ElementDeath>();
  if (cards.empty()) return;
  DeathReader reader(deck, model, laws, rules, diagnostics);
  for (const ElementDeath& card : cards) reader.take(card);
}

}  // namespace courant
