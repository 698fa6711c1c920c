// *DATABASE_ELOUT: stress of chosen elements over time.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstdlib>
#include <map>

#include "elements/beam/beam_cards.hpp"
#include "elements/histories/cards_elout.hpp"
#include "elements/histories/element_choice.hpp"
#include "elements/histories/elout_text.hpp"
#include "extension/additions.hpp"
#include "keyword/help/law_names.hpp"
#include "laws/discrete/discrete_law_cards.hpp"
#include "laws/strength/strength.hpp"
#include "model/requests/output_cards.hpp"

namespace courant {

namespace {

constexpr ElementKind kinds_of_elout[] = {ElementKind::solid, ElementKind::beam, ElementKind::shell};

/// What a deck asks for.
struct Elout : Pass {
  struct ListedElement {
    ReportedElement element;
    std::string title;
    Id part = 0;
    int material = 0;
  };
  std::string name() const override { return "elout"; }
  std::array<std::vector<ListedElement>, 3> wanted{};  ///< of each kind, by id
  std::array<int, 3> history{};                        ///< numbers of the law to print
  bool strains = false;
  ElementReportOptions options{};
};

/// Numbers of the materials of a deck, 24 of *MAT_024, by id.
std::map<Id, int> material_numbers(const Deck& deck, const Model& model) {
  std::map<Id, int> out;
  for (const StrengthEntry& kind : strength_registry())
    if (const LawName* name = find_law(kind.keyword))
      for (const auto& [id, law] : kind.all(deck, model)) out.emplace(id, std::atoi(name->number));
  for (const MatCableDiscreteBeam& cable : deck.all<MatCableDiscreteBeam>()) out.emplace(cable.mid, 71);
  return out;
}

class EloutReader {
 public:
  EloutReader(const Deck& deck, const Model& model, const World& world, Diagnostics& diagnostics)
      : choice_(deck, model, world, diagnostics), model_(model) {
    if (std::any_of(deck.all<HistoryElements>().begin(), deck.all<HistoryElements>().end(),
                    [](const HistoryElements& card) { return card.kind() == ElementKind::beam; }) ||
        !deck.all<HistoryElementIds>().empty())
      materials_ = material_numbers(deck, model);
    for (const HistoryElementIds& card : deck.all<HistoryElementIds>())
      for (std::size_t k = 0; k < card.ids.size(); ++k)
        if (card.ids[k] != 0)
          add(choice_.find(card, "ID", card.kind(), card.ids[k], "elout"),
              k < card.headings.size() ? card.headings[k] : "");
    for (const HistoryElements& card : deck.all<HistoryElements>())
      for (const Id id : card.ids)
        if (!card.sets())
          add(choice_.find(card, "ID", card.kind(), id, "elout"), "");
        else
          for (const ReportedElement& one : choice_.set(card, "ID", card.kind(), id, "elout")) add(&one, "");
    for (auto& list : out_->wanted) sort(list);
  }
  std::shared_ptr<Elout> take() { return std::move(out_); }

 private:
  void add(const ReportedElement* one, const std::string& title) {
    if (!one) return;
    const ModelPart& part = model_.parts[static_cast<std::size_t>(one->part())];
    const auto material = materials_.find(part.mid);
    out_->wanted[static_cast<std::size_t>(one->kind)].push_back(
        {*one, title, part.id, material == materials_.end() ? 0 : material->second});
  }
  /// Each once; a heading wins over a mention without one.
  static void sort(std::vector<Elout::ListedElement>& list) {
    std::stable_sort(list.begin(), list.end(),
                     [](const Elout::ListedElement& a, const Elout::ListedElement& b) {
                       return a.element.id() != b.element.id() ? a.element.id() < b.element.id()
                                                               : a.title.empty() < b.title.empty();
                     });
    const auto same = [](const Elout::ListedElement& a, const Elout::ListedElement& b) {
      return a.element.id() == b.element.id();
    };
    list.erase(std::unique(list.begin(), list.end(), same), list.end());
  }

  ElementChoice choice_;
  const Model& model_;
  std::map<Id, int> materials_;
  std::shared_ptr<Elout> out_ = std::make_shared<Elout>();
};

void build_elout(const Deck& deck, const Model& model, World& world, Diagnostics& diagnostics) {
  if (deck.all<HistoryElements>().empty() && deck.all<HistoryElementIds>().empty() &&
      !deck.last<DatabaseElout>())
    return;
  const auto out = EloutReader(deck, model, world, diagnostics).take();
  const auto* card = deck.last<DatabaseElout>();
  if (!card || !(card->dt > 0)) return;
  const auto* control = deck.last<ControlOutput>();
  const auto* extent = deck.last<DatabaseExtentBinary>();
  out->options = {.local_axes = control && control->eocs == 1, .all_points = extent && extent->nintsld == 8};
  out->strains = extent && extent->strflg != 0;
  for (const ElementKind kind : kinds_of_elout)
    out->history[static_cast<std::size_t>(kind)] = card->history_of(kind);
  if (std::all_of(out->wanted.begin(), out->wanted.end(), [](const auto& list) { return list.empty(); }))
    deck.warning(diagnostics, *card, "DT", "no element is named: elout holds no values",
                 "name elements by *DATABASE_HISTORY_SHELL, _SOLID, _BEAM");
  world.passes.add(out);
}
const RegisterAddition elout_addition{"elout", build_elout};

const Elout* elout_of(const World& world) {
  const auto found = world.passes.all<const Elout>();
  return found.empty() ? nullptr : found.front();
}

/// take(kind, elements, content) of each kind that has elements.
template <class Take>
void for_elements(const World& world, const Take& take) {
  const Elout* elout = elout_of(world);
  for (const ElementKind kind : kinds_of_elout) {
    const auto k = static_cast<std::size_t>(kind);
    if (!elout || elout->wanted[k].empty()) continue;
    std::vector<EloutElement> elements;
    for (const Elout::ListedElement& one : elout->wanted[k])
      elements.push_back({one.element.id(), one.part, one.material,
                          one.element.reporter->report_element(world, one.element.e, elout->options)});
    take(kind, elements, EloutContent{elout->options.local_axes, elout->history[k], elout->strains});
  }
}

std::string elout_state(const World& world, const Clock& clock) {
  std::string text;
  for_elements(world, [&](ElementKind kind, const auto& elements, const EloutContent& content) {
    text += elout_text(kind, elements, clock, content);
  });
  return text;
}

void elout_numbers(const World& world, const Clock&, HistoryNumbers& to) {
  for_elements(world, [&](ElementKind kind, const auto& elements, const EloutContent& content) {
    add_elout_numbers(kind, elements, content, to);
  });
}

const RegisterAsciiHistory elout{{.name = "elout",
                                  .interval = interval_in<DatabaseElout>,
                                  .text = elout_state,
                                  .legend =
                                      [](const World& world) {
                                        std::vector<std::pair<Id, std::string>> out;
                                        if (const Elout* elout = elout_of(world))
                                          for (const auto& list : elout->wanted)
                                            for (const Elout::ListedElement& one : list)
                                              if (!one.title.empty())
                                                out.emplace_back(one.element.id(), one.title);
                                        return out;
                                      },
                                  .numbers = elout_numbers,
                                  .binary = binary_in<DatabaseElout>}};

}  // namespace

}  // namespace courant
