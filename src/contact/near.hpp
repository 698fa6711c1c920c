#pragma once
#include "contact/contact.hpp"

namespace courant {

/// What the search for one particle's pushes works with.
struct Contact::Near {
  Index particle = 0;
  Index begin = 0, end = 0;     ///< its candidates
  Vec x = Vec::Zero();          ///< [L]
  Vec origin = Vec::Zero();     ///< a place in front of all walls: x itself, or the ghost [L]
  std::int8_t* side = nullptr;  ///< of the origin, by candidate
};

}  // namespace courant
