// A deck with errors that say nothing of the rest of it: what is wrong there is told in the same go.
#include "app/simulation.hpp"

namespace courant {

std::unique_ptr<Simulation> Simulation::from_deck(const std::string& deck_path, Deck deck,
                                                  Diagnostics& diagnostics, const DeckRecord* before,
                                                  RunPhase phase) {
  if (diagnostics.broken()) return nullptr;  // what could not be read would only cause more messages
  Diagnostics rest;                          // of a deck that is refused already: its errors alone
  Diagnostics& told = diagnostics.ok() ? diagnostics : rest;
  told.set_aside(true);
  auto s = from_read_deck(deck_path, std::move(deck), told, before, phase);
  told.set_aside(false);
  for (const Diagnostic& one : rest.all())
    if (one.severity == Severity::error) diagnostics.add(one);
  return diagnostics.ok() ? std::move(s) : nullptr;
}

}  // namespace courant
