#pragma once
// Simulations from the scenes of keyword_decks/, for tests.
#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <map>
#include <memory>
#include <string>

#include "app/simulation.hpp"
#include "generate/generate.hpp"

namespace courant::test {

inline std::string generated(const std::string& scene, const std::map<std::string, std::string>& parameters) {
  static int counter = 0;
  const auto deck = std::filesystem::temp_directory_path() /
                    (scene + "_" + std::to_string(::getpid()) + "_" + std::to_string(counter++) + ".k");
  Diagnostics diagnostics;
  EXPECT_TRUE(generate_deck(std::string(SOURCE_DIR) + "/keyword_decks/" + scene + "/scene.yaml",
                            deck.string(), parameters, diagnostics))
      << diagnostics.text();
  return deck.string();
}

inline std::unique_ptr<Simulation> simulation(const std::string& scene,
                                              const std::map<std::string, std::string>& parameters) {
  const std::string deck = generated(scene, parameters);
  Diagnostics diagnostics;
  auto s = Simulation::build(deck, {}, diagnostics);
  std::filesystem::remove(deck);
  EXPECT_TRUE(s != nullptr) << diagnostics.text();
  if (s) {  // the ledger counts from the state at t = 0
    std::string who;
    s->evaluate(who);
    sample_energy(s->world(), s->clock());
    s->world().energy.initial = s->world().energy.total();
  }
  return s;
}

}  // namespace courant::test
