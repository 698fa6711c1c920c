#pragma once
// `courant check`: a deck is read and built, nothing is run, and the user sees what Courant makes of it.
#include <limits>
#include <map>
#include <string>
#include <vector>

#include "app/check/deck_facts.hpp"
#include "app/check/units.hpp"
#include "app/run/simulation.hpp"
#include "model/sets/unused_ids.hpp"

namespace courant {

struct CheckResult {
  bool sound = false;    ///< can be run; with `strict` also: without a warning
  std::string deck;      ///< what was read: files, keywords, mesh
  std::string messages;  ///< of reader and model
  std::string model;     ///< what a run would compute; empty unless the deck can be run
  std::string verdict;   ///< last line
  std::string json;      ///< all of it for programs, one JSON object
};

/// What a run of a sound deck would compute.
struct ModelFacts {
  struct Part {
    static constexpr Real none = -1;  ///< a number that a part does not have
    Id id = 0;
    std::string title;
    Index elements = 0;
    const char* kind = "-";  ///< "sph", "shell", "solid", "rigid"; "-": no elements
    Real mass = none, volume = none, rho = none, c = none;  ///< [M], [L3], [M/L3], [L/T]
    Real spacing = none, h = none;                          ///< [L]
    Real nearest = std::numeric_limits<Real>::infinity();   ///< least distance between two particles [L]
    Real speed = 0;                                         ///< largest at the start [L/T]
  };
  std::vector<Part> parts;
  int dim = 0;
  Real spacing = 0;     ///< of the particles [L]
  Real neighbours = 0;  ///< of a particle, on average
  Index particles = 0, active = 0;
  Real dt = 0, endtim = 0;                 ///< first step and end [T]
  std::string set_by;                      ///< what sets the first step
  std::vector<std::string> advice;         ///< choices that do not suit the scene, and what to type
  double steps = 0;                        ///< to the end, all as long as the first
  double seconds = 0;                      ///< that they would take on one thread
  std::vector<Real> sound_speeds() const;  ///< of the parts that have one [L/T]
};

/// `strict`: warnings and ids that nothing refers to are errors.
CheckResult check_deck(const std::string& path, const ReadOptions& options, bool strict);

// check_deck.cpp: the parts of CheckResult::deck
std::string files_text(const Deck& deck);
std::string parameters_text(const Deck& deck);  ///< empty if the deck has none
std::string keywords_text(const Deck& deck);
std::string mesh_text(const DeckFacts& facts);
/// What a run would need besides what the deck holds: refused keywords by what they lack, and what is missing
/// in a deck for any run. Empty if nothing.
std::string needs_text(const Deck& deck, const DeckFacts& facts);
/// What walls that support particles do to them; empty where there are none.
std::string walls_text(const Simulation& simulation);
std::string unused_text(const Deck& deck, const UnusedIds& unused);

// check_model.cpp
/// Evaluates the first step; the simulation must not be run afterwards.
std::string model_text(Simulation& simulation, ModelFacts& facts);

// check_advice.cpp
/// Sound speed, spacing, smoothing length, tension and contact stiffness of liquids against the height and
/// the speeds of the scene: what does not suit it. `facts` has the parts already.
std::vector<std::string> choice_advice(const Simulation& simulation, const ModelFacts& facts);
std::string advice_text(const std::vector<std::string>& advice);

// check_json.cpp
/// What stays of a deck when a simulation has been built from it.
struct DeckHead {
  explicit DeckHead(const Deck& deck);
  std::string title;
  std::vector<std::string> files;  ///< [0] is the deck itself
  std::map<std::string, KeywordUse> keywords;
};
/// `model`: null where the deck cannot be run.
std::string check_json(const DeckHead& deck, const DeckFacts& facts, const UnusedIds& unused,
                       const ModelFacts* model, const Diagnostics& diagnostics, bool sound);

}  // namespace courant
