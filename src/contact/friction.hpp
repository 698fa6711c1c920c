#pragma once
// Coulomb's law of contacts, with coefficients that may depend on the parts.
#include <algorithm>
#include <cmath>
#include <map>
#include <memory>
#include <utility>

#include "base/real.hpp"

namespace courant {

class Deck;
class Diagnostics;
struct Model;
struct ContactCard;

/// Names as on the cards. [-, -, T/L, M/LT2]
struct Friction {
  Real fs = 0, fd = 0, dc = 0, vc = 0;
  bool rubs() const { return fs > 0 || fd > 0; }
  /// Largest force at a speed of slip. [ML/T2]
  Real most(Real slip, Real normal_force, Real area) const {
    const Real coulomb = (fd + (fs - fd) * std::exp(-dc * slip)) * normal_force;
    return vc > 0 ? std::min(coulomb, vc * area) : coulomb;
  }
};

/// Of pairs of parts, the lower index first.
using FrictionTable = std::map<std::pair<Index, Index>, Friction>;

/// Of one contact; with a table its own numbers are those of all pairs that are not in it.
struct FrictionLaw : Friction {
  std::shared_ptr<const FrictionTable> table{};  ///< null: none
  const Friction& between(Index a, Index b) const {
    if (!table) return *this;
    const auto found = table->find(std::minmax(a, b));
    return found == table->end() ? static_cast<const Friction&>(*this) : found->second;
  }
  bool rubs() const {
    return any([](const Friction& mu) { return mu.rubs(); });
  }
  bool limits_stress() const {
    return any([](const Friction& mu) { return mu.vc > 0; });
  }

 private:
  template <class Has>
  bool any(const Has& has) const {
    return has(*this) || (table && std::any_of(table->begin(), table->end(),
                                               [&](const auto& pair) { return has(pair.second); }));
  }
};

/// FS to VC with FSF and VSF, or with FS -2 those of *DEFINE_FRICTION. Refuses by name: other FS below 0,
/// tables and parts that do not exist.
FrictionLaw friction_of_card(const Deck& deck, const Model& model, const ContactCard& card,
                             Diagnostics& diagnostics);

}  // namespace courant
