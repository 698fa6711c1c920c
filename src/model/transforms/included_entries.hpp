#pragma once
#include <string_view>

#include "base/diagnostic.hpp"
#include "keyword/deck.hpp"

namespace courant {

/// Does what *INCLUDE_TRANSFORM asks for and can only be done once the whole deck is read: evaluates
/// transformations, moves the entries of the files that name them (TRANID), and changes the units of curves.
/// To be called between read_deck and build_model, of a deck without errors.
void move_included_entries(Deck& deck, Diagnostics& diagnostics);

/// A curve has no units of its own: those of a file with unit factors get them from who uses the curve.
void convert_curves(Deck& deck, Diagnostics& diagnostics);

/// Dimensions of the abscissa and the ordinate of a curve that a field names.
struct CurveDimensions {
  const char* keyword;  ///< its first name
  const char* field;
  const char* abscissa;
  const char* ordinate;
};
/// Null if they are not known.
const CurveDimensions* curve_dimensions(std::string_view keyword, std::string_view field);

}  // namespace courant
