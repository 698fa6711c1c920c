#pragma once
// Control cards about physics that a scene may not contain: they then have no effect.
#include <map>
#include <string>
#include <vector>

#include "base/diagnostic.hpp"
#include "keyword/deck.hpp"

namespace courant {

/// What a control card is about.
struct ControlledPhysics {
  const char* control;                  ///< the beginning of its name
  const char* what;                     ///< "particles"
  std::vector<const char*> brought_by;  ///< beginnings of the keywords that bring it into a scene
};

/// nullptr for cards that matter in any deck.
const ControlledPhysics* controlled_physics(const std::string& name);

/// Keeps the faults of such cards until the whole deck has been read: only then is it known what it contains.
class HeldControls {
 public:
  /// Takes the faults of one keyword.
  Diagnostics& held(const std::string& name, const ControlledPhysics& physics, const Location& where);
  bool holds(const std::string& name) const { return held_.count(name) > 0; }
  /// Hands over the faults of what is there; of what is not a note remains, and the keyword is not refused.
  void close(Deck& deck, Diagnostics& diagnostics) const;

 private:
  struct DeferredFaults {
    const ControlledPhysics* physics = nullptr;
    Location where{};
    Diagnostics faults{};
  };
  std::map<std::string, DeferredFaults> held_;
};

}  // namespace courant
