#pragma once
// What the cards of a deck add up to, whether or not it can be run: for `courant check`.
#include <map>
#include <string>
#include <vector>

#include "keyword/deck.hpp"

namespace courant {

struct ElementFacts {
  std::string kind;        ///< "SPH particles", "solids"
  std::size_t count = 0;   ///< as read
  Real mass = 0;           ///< sum of what the cards give [M]
  Real volume = 0;         ///< sum of masses given as volumes [L3]
  std::size_t unread = 0;  ///< lines below keywords that have no table
};

struct PartFacts {
  std::string title;
  bool defined = false;  ///< by *PART; else only elements name it
  Id secid = 0, mid = 0, eosid = 0;
  std::map<std::string, std::size_t> elements;  ///< number of each kind
  Real mass = 0;                                ///< given by elements [M]
};

struct MaterialFacts {
  std::string keyword;  ///< "*MAT_NULL"
  Id id = 0;
  Real ro = 0, E = 0;  ///< [M/L3], [M/LT2]; 0: none
};

struct DeckFacts {
  std::size_t nodes = 0;
  Vec low = Vec::Zero(), high = Vec::Zero();  ///< corners of the box round all nodes [L]
  std::vector<ElementFacts> elements;
  std::map<Id, PartFacts> parts;
  std::vector<MaterialFacts> materials;
  Real gravity = 0;  ///< largest base acceleration of *LOAD_BODY [L/T2]
  Real endtim = 0;   ///< [T]
};

/// Call before the cards of the mesh are released.
DeckFacts gather_facts(const Deck& deck);
/// Nodes, materials, gravity and end alone, from which units are guessed.
DeckFacts gather_unit_facts(const Deck& deck);

}  // namespace courant
