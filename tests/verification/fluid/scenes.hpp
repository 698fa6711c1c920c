#pragma once
// Simulations from the scenes of keyword_decks/, for tests.
#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <map>
#include <memory>
#include <sstream>
#include <string>

#include "../../generate_deck.hpp"
#include "app/run/simulation.hpp"

namespace courant::test {

/// Path of the deck that the scene of a file under the source folder makes, which the caller removes.
inline std::string generated_from(const std::string& file,
                                  const std::map<std::string, std::string>& parameters) {
  static int counter = 0;
  const auto deck = std::filesystem::temp_directory_path() /
                    ("scene_" + std::to_string(::getpid()) + "_" + std::to_string(counter++) + ".k");
  Diagnostics diagnostics;
  EXPECT_TRUE(generate_deck(std::string(SOURCE_DIR) + "/" + file, deck.string(), parameters, diagnostics))
      << diagnostics.text();
  return deck.string();
}

inline std::string generated(const std::string& scene, const std::map<std::string, std::string>& parameters) {
  return generated_from("keyword_decks/" + scene + "/scene.yaml", parameters);
}

/// The deck of a scene of tests/verification/scenes.
inline std::string deck_of_scene(const std::string& name,
                                 const std::map<std::string, std::string>& parameters) {
  const std::string deck = generated_from("tests/verification/scenes/" + name + ".yaml", parameters);
  std::ifstream file(deck);
  std::stringstream text;
  text << file.rdbuf();
  std::filesystem::remove(deck);
  return text.str();
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
