#pragma once
// The known word nearest to a mistyped one.
#include <cstddef>
#include <string>
#include <vector>

namespace courant {

/// Letters to insert, delete or replace to turn one word into the other.
std::size_t edit_distance(const std::string& a, const std::string& b);

/// The candidate with the fewest edits from `word`, or empty if none is near.
std::string nearest_word(const std::string& word, const std::vector<std::string>& candidates);

}  // namespace courant
