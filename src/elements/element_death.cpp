// *DEFINE_ELEMENT_DEATH and *DELETE: elements that are deleted at a time, or when a run goes on.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <limits>
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

struct DeleteAtRestart : DeleteAtRestartFields {
  bool is_part() const { return name == 0; }  // names in the order of the table
  bool of_solids() const { return name == 1; }
  std::array<Id, 8> ids() const { return {id1, id2, id3, id4, id5, id6, id7, id8}; }
};
const RegisterKeyword<DeleteAtRestart> delete_at_restart{delete_part_table()};

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
  /// From the step with which the run goes on.
  void take(const DeleteAtRestart& card) {
    field_ = "ID1";
    constexpr Real at_once = -std::numeric_limits<Real>::infinity();
    for (const Id id : card.ids()) {
      if (id == 0) continue;
      if (card.is_part())
        take_part(card, id);
      else if (card.of_solids())
        take_set(card, id, at_once, model_.solids, model_.solid_sets, "solid");
      else
        take_set(card, id, at_once, model_.shells, model_.shell_sets, "shell");
    }
  }
  void take(const ElementDeath& card) {
    field_ = "EID";
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
    if (card.is_set()) return take_set(card, card.eid, card.time, elements, sets, kind);
    const auto one = known.find(card.eid);
    if (one == known.end()) return error(card, fmt::format("{} {} does not exist", kind, card.eid));
    take_element(card, card.time, elements[static_cast<std::size_t>(one->second)], kind);
  }
  template <class Element>
  void take_set(const Entry& card, Id id, Real time, const std::vector<Element>& elements,
                const std::map<Id, std::vector<Index>>& sets, const char* kind) {
    const auto set = sets.find(id);
    if (set == sets.end()) return error(card, fmt::format("{} set {} does not exist", kind, id));
    for (const Index m : set->second)
      if (!take_element(card, time, elements[static_cast<std::size_t>(m)], kind)) return;
  }
  void take_part(const DeleteAtRestart& card, Id id) {
    const auto part = model_.part_of_id.find(id);
    if (part == model_.part_of_id.end()) return error(card, fmt::format("part {} does not exist", id));
    bool any = false;
    const auto take = [&](const auto& elements, const char* kind) {
      for (const auto& element : elements) {
        if (element.part != part->second) continue;
        any = true;
        if (!take_element(card, -std::numeric_limits<Real>::infinity(), element, kind)) return;
      }
    };
    take(model_.solids, "solid"), take(model_.shells, "shell");
    if (!any) error(card, fmt::format("part {} has neither solids nor shells", id));
  }
  template <class Element>
  bool take_element(const Entry& card, Real time, const Element& element, const char* kind) {
    const auto part = static_cast<std::size_t>(element.part);
    if (!laws_[part]) {
      error(card, fmt::format("{} {} is of part {}, whose elements are rigid or have no stress: it cannot be "
                              "deleted",
                              kind, element.id, model_.parts[part].id));
      return false;
    }
    const auto [known_death, is_new] = rules_[part].deaths.emplace(element.id, time);
    if (!is_new) known_death->second = std::min(known_death->second, time);
    return true;
  }
  void error(const Entry& card, std::string message) {
    deck_.error(diagnostics_, card, field_, std::move(message), "name solids or shells that deform");
  }

  const Deck& deck_;
  const Model& model_;
  const std::vector<std::shared_ptr<StrengthLaw>>& laws_;
  std::vector<FailureRules>& rules_;
  Diagnostics& diagnostics_;
  const char* field_ = "EID";  ///< of the card at work
  std::unordered_map<Id, Index> solid_, shell_;
};

}  // namespace

void take_deaths(const Deck& deck, const Model& model, const std::vector<std::shared_ptr<StrengthLaw>>& laws,
                 bool goes_on, std::vector<FailureRules>& rules, Diagnostics& diagnostics) {
  const auto& cards = deck.all<ElementDeath>();
  const auto& at_restart = deck.all<DeleteAtRestart>();
  if (!at_restart.empty() && !goes_on)
    deck.warning(diagnostics, at_restart.front(), "ID1",
                 "elements are deleted when a run goes on from a restart file; this one starts from the "
                 "beginning",
                 "run the deck with --restart, or delete elements by *DEFINE_ELEMENT_DEATH");
  if (cards.empty() && (at_restart.empty() || !goes_on)) return;
  for (const auto& [name, use] : deck.keywords)  // what they hold in the state depends on what may fail
    if (!at_restart.empty() && goes_on &&
        (name.starts_with("CONTACT_ERODING") || name.starts_with("CONTACT_TIED")))
      diagnostics.error(deck.where(at_restart.front()),
                        fmt::format("{}: deletion at a restart is not supported beside *{}",
                                    deck.keyword(at_restart.front()), name),
                        "delete elements by *DEFINE_ELEMENT_DEATH from the start of the first run on");
  DeathReader reader(deck, model, laws, rules, diagnostics);
  for (const ElementDeath& card : cards) reader.take(card);
  for (const DeleteAtRestart& card : at_restart)
    if (goes_on) reader.take(card);
}

}  // namespace courant
