#pragma once
// Parts that a card names by an id and the type of that id beside it (SURFA and SURFATYP of contacts).
#include <vector>

#include "keyword/deck.hpp"
#include "model/model.hpp"

namespace courant {

/// Indices of the parts that `field` of an entry names: the members of part set `id` for type 2, part `id`
/// for type 3. A set or part that is not there, or a set without members, is an error, and no part is named.
std::vector<Index> parts_named(const Deck& deck, const Model& model, const Entry& entry, const char* field,
                               Id id, int type, Diagnostics& diagnostics);

/// The same as flags by part; an error for each that has no shells.
std::vector<char> shell_parts_named(const Deck& deck, const Model& model, const Entry& entry,
                                    const char* field, Id id, int type, Diagnostics& diagnostics);

}  // namespace courant
