#pragma once
// Numbers as Fortran readers take them: 1.5e-3, 1.5d-3, 1.5-3 (implicit exponent), .5, 5., +7. No locale, no
// exceptions.
#include <string>
#include <string_view>

#include "base/real.hpp"

namespace courant {

inline bool is_digit(char c) {
  return c >= '0' && c <= '9';
}

/// `text` without blanks around it. False if it is no finite number, or too large or too small for a double.
bool parse_real(std::string_view text, Real& value);

/// As parse_real and parse_integer, for those that are in nearly every field of nearly every deck: digits
/// with a point and a small exponent, and up to 18 digits. False says nothing about others.
bool parse_plain_real(const char* begin, const char* end, Real& value);
bool parse_plain_integer(const char* begin, const char* end, Id& value);

/// What may have gone wrong where `text` is no number: a hint for the user, or nothing.
std::string number_hint(std::string_view text);

/// As parse_real; a real without fraction ("5.0") is taken too.
bool parse_integer(std::string_view text, Id& value);

}  // namespace courant
