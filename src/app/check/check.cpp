#include "app/check/check.hpp"

#include <fmt/format.h>
#include <utility>

#include "base/run_error.hpp"
#include "model/transforms/included_entries.hpp"

namespace courant {

namespace {

std::string counted(int number, const char* what) {
  return fmt::format("{} {}{}", number, what, number == 1 ? "" : "s");
}

std::string verdict_of(const CheckResult& result, const Diagnostics& diagnostics, std::size_t unused,
                       bool strict) {
  std::string found =
      counted(diagnostics.errors(), "error") + ", " + counted(diagnostics.warnings(), "warning");
  if (unused > 0) found += fmt::format(", {} unused id{}", unused, unused == 1 ? "" : "s");
  if (result.sound) return fmt::format("The deck can be run: {}\n", found);
  if (diagnostics.ok() && strict) return fmt::format("{}; refused because of --strict\n", found);
  return fmt::format("{}; the deck cannot be run\n", found);
}

/// Empty where the deck cannot be run; `diagnostics` then state why.
std::string model_part(const std::string& path, Deck deck, const DeckFacts& facts, ModelFacts& model,
                       Diagnostics& diagnostics) {
  const auto simulation = Simulation::from_deck(path, std::move(deck), diagnostics);
  if (!simulation) return "";
  try {
    const std::string text = model_text(*simulation, model);
    return units_text(facts, model.sound_speeds()) + text;
  } catch (const RunError& fault) {  // a run would stop at its first step
    diagnostics.error({path, 0, 0}, fault.what(), fault.hint);
    return "";
  }
}

}  // namespace

CheckResult check_deck(const std::string& path, const ReadOptions& options, bool strict) {
  CheckResult result;
  Diagnostics diagnostics;
  Deck deck = read_deck(path, options, diagnostics);
  if (!diagnostics.broken()) move_included_entries(deck, diagnostics);
  const DeckFacts facts = gather_facts(deck);
  const UnusedIds unused = find_unused_ids(deck);
  const std::string needs = needs_text(deck, facts), unused_ids = unused_text(deck, unused);
  if (!deck.title.empty()) result.deck = deck.title + "\n";
  result.deck +=
      files_text(deck) + parameters_text(deck) + keywords_text(deck) + mesh_text(facts) + unused_ids;
  const DeckHead head(deck);
  ModelFacts model;
  result.model = model_part(path, std::move(deck), facts, model, diagnostics);
  result.messages = diagnostics.text();
  if (result.model.empty()) result.deck += units_text(facts, {}) + needs;
  const std::size_t count = unused.named.size() + unused.nodes.size();
  result.sound = diagnostics.ok() && !(strict && (diagnostics.warnings() > 0 || count > 0));
  result.verdict = verdict_of(result, diagnostics, count, strict);
  result.json =
      check_json(head, facts, unused, result.model.empty() ? nullptr : &model, diagnostics, result.sound);
  return result;
}

}  // namespace courant
