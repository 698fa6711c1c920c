#pragma once
// Curves that cards name by an id.
#include "keyword/deck.hpp"
#include "model/model.hpp"

namespace courant {

/// The curve that `field` of an entry names; null, and an error, where there is none.
const Curve* curve_named(const Deck& deck, const Model& model, const Entry& entry, const char* field, Id id,
                         Diagnostics& diagnostics);

}  // namespace courant
