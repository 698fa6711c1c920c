#pragma once
// Numbers as Fortran readers take them: 1.5e-3, 1.5d-3, 1.5-3 (implicit exponent), .5, 5., +7. No locale, no
// exceptions.
#include <string_view>

#include "base/real.hpp"

namespace courant {

/// `text` without blanks around it. False if it is no finite number, or too large or too small for a double.
bool parse_real(std::string_view text, Real& value);

/// As parse_real; a real without fraction ("5.0") is taken too.
bool parse_integer(std::string_view text, Id& value);

}  // namespace courant
