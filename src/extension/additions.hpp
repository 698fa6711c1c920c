#pragma once
// Additions by one file to every world whose deck requests them: a load, an element, an output. The file
// registers its keywords and an addition, in the library or in a shared object loaded by `courant run
// --load`; nothing else is edited.
#include <functional>
#include <string>
#include <utility>
#include <vector>

#include "extension/builders.hpp"
#include "keyword/deck.hpp"
#include "model/model.hpp"
#include "state/history_numbers.hpp"
#include "state/world.hpp"

namespace courant {

/// ElementGroup::part of elements that belong to no *PART.
inline constexpr Index no_part = -1;

struct RegisterAddition {
  using Build = std::function<void(const Deck&, const Model&, World&, Diagnostics&)>;
  using FindNodes = std::function<std::vector<Index>(const Deck&, const Model&)>;
  /// `name`: for messages. `build` reads its cards and adds passes, fields or element groups to the world.
  /// Called when particles, nodes, elements and bodies are there, before stages are made; particles are in
  /// the order of the model. Faults go to the diagnostics. `nodes` of its elements, indices into
  /// Model::nodes: they are then in World::nodes, whether shells and solids use them or not; particles never
  /// are. An addition must give them mass. Empty: no nodes.
  RegisterAddition(std::string name, Build build, FindNodes nodes = {});
};

/// A history that a file adds: as text, in binout and in history.h5.
struct AsciiHistory {
  std::string name;  ///< of the file in the run's folder
  /// Interval requested by a deck; 0: not requested [T]
  std::function<Real(const Deck&)> interval;
  /// One state, taken at t^n with x, p and f known.
  std::function<std::string(const World&, const Clock&)> text;
  /// Ids and titles of its legend, taken once; empty: the file has no legend.
  std::function<std::vector<std::pair<Id, std::string>>(const World&)> legend{};
  /// Lines behind the legend, once.
  std::string columns{};
  /// The same numbers for binout and history.h5; empty: not written there.
  std::function<void(const World&, const Clock&, HistoryNumbers&)> numbers{};
  /// BINARY of its card: 2 binout, 3 binout and text, else text; none: text.
  std::function<int(const Deck&)> binary{};
};

std::vector<AsciiHistory>& ascii_histories();

struct RegisterAsciiHistory {
  explicit RegisterAsciiHistory(AsciiHistory history) { ascii_histories().push_back(std::move(history)); }
};

}  // namespace courant
