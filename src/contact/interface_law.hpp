#pragma once
// Laws of an interface: forces of a touch in addition to the penalty.
#include <functional>
#include <memory>
#include <vector>

#include "keyword/deck.hpp"
#include "state/world.hpp"

namespace courant {

/// A particle that touches a wall.
struct TouchState {
  Index particle = 0;
  Vec n = Vec::Zero();         ///< out of the wall [-]
  Vec velocity = Vec::Zero();  ///< of the particle, relative to the wall [L/T]
  Real push = 0;               ///< of the penalty, with damping, along n [ML/T2]
  Real depth = 0;              ///< below the contact distance [L]
  Real stiffness = 0;          ///< of the penalty [M/T2]
  Real mass = 0;               ///< of the particle [M]
};

/// One file per law registers it with its keyword; nothing else is edited. Called by several threads at once.
class InterfaceLaw {
 public:
  virtual ~InterfaceLaw() = default;
  /// On the particle; the wall gets the opposite. Its work on the sliding velocity counts as friction.
  /// [ML/T2]
  virtual Vec force(const TouchState& touch, const Clock& clock) const = 0;
};

struct AskedInterfaceLaw {
  Id contact = 0;  ///< id of the *CONTACT
  std::shared_ptr<InterfaceLaw> law;
  Entry card{};  ///< for messages
};

/// Laws requested by a deck. A law for a contact that does not exist is refused.
using InterfaceLawsOf = std::function<std::vector<AskedInterfaceLaw>(const Deck&)>;
std::vector<InterfaceLawsOf>& interface_law_registry();

struct RegisterInterfaceLaw {
  explicit RegisterInterfaceLaw(InterfaceLawsOf laws) { interface_law_registry().push_back(std::move(laws)); }
};

}  // namespace courant
