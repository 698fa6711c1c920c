#include <algorithm>

#include "keyword/read/number.hpp"

namespace courant {

namespace {

/// Mantissa and exponent of a number, whose value may be beyond the range of a double.
bool looks_like_number(std::string_view text) {
  const std::size_t letter = text.find_first_of("eEdD");
  if (letter == std::string_view::npos) return false;
  std::string_view mantissa = text.substr(0, letter), exponent = text.substr(letter + 1);
  for (std::string_view* part : {&mantissa, &exponent})
    if (!part->empty() && (part->front() == '-' || part->front() == '+')) part->remove_prefix(1);
  return std::any_of(mantissa.begin(), mantissa.end(), is_digit) &&
         mantissa.find_first_not_of("0123456789.") == std::string_view::npos && !exponent.empty() &&
         std::all_of(exponent.begin(), exponent.end(), is_digit) &&
         std::count(mantissa.begin(), mantissa.end(), '.') <= 1;
}

}  // namespace

std::string number_hint(std::string_view text) {
  if (text.empty()) return {};
  if (text[0] == '*') return "a keyword begins in column 1";
  if (text.find('$') != std::string_view::npos) return "a comment is a line of its own, with $ in column 1";
  if (std::any_of(text.begin(), text.end(), [](char c) { return static_cast<signed char>(c) < ' '; }))
    return "a character in it is not ASCII: a blank or a sign of a text program?";
  // Fortran readers skip blanks within a number or take them for zeros; we do not guess
  if (text.find("  ") == std::string_view::npos && text.find(' ') != std::string_view::npos &&
      is_digit(text.back()))
    return "a number must not contain blanks; is it within the columns of its field?";
  Real value = 0;
  if (looks_like_number(text) && !parse_real(text, value))
    return "numbers other than 0 range from 1e-307 to 1e308";
  return {};
}

}  // namespace courant
