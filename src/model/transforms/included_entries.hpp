#pragma once
#include "base/diagnostic.hpp"
#include "keyword/deck.hpp"
#include "keyword/keyword_table.hpp"

namespace courant {

/// Does what *INCLUDE_TRANSFORM asks for and can only be done once the whole deck is read: evaluates
/// transformations, moves the entries of the files that name them (TRANID), and changes the units of curves.
/// To be called between read_deck and build_model, of a deck without errors.
void move_included_entries(Deck& deck, Diagnostics& diagnostics);

/// A curve has no units of its own: those of a file with unit factors get them from who uses the curve.
void convert_curves(Deck& deck, Diagnostics& diagnostics);

/// What the numbers of the curve are that a field of an entry names; not known() where its table does not
/// say.
CurveOf curve_of(const FieldSpec& field, const Entry& entry);

}  // namespace courant
