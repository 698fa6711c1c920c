#pragma once
// LS-DYNA's materials and equations of state have a number and a name: *MAT_009 is *MAT_NULL. Decks may use
// either.
#include <string>
#include <string_view>
#include <vector>

namespace courant {

/// A law of LS-DYNA. Only a few of them are supported.
struct LawName {
  const char* family;  ///< "MAT" or "EOS"
  const char* number;  ///< "009"; "077_H" where several laws share a number
  const char* name;    ///< "NULL"
};

/// The law that a keyword names in whole words, by number or name, with any options behind it: MAT_024_TITLE,
/// MAT_ELASTIC_FLUID. `length` states how many characters of `keyword` name it. nullptr: none that is known
/// here.
const LawName* find_law(std::string_view keyword, std::size_t* length = nullptr);

/// Whether the second word of a *MAT or *EOS keyword is a number: MAT_295, EOS_021, MAT_S01, MAT_077_H.
bool has_law_number(std::string_view keyword);

/// Adds the numbers to names of laws, and the names to numbers: {"MAT_NULL"} -> {"MAT_NULL", "MAT_009"}. The
/// first name stays the first.
void add_law_names(std::vector<std::string>& names);

}  // namespace courant
