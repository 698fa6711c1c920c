#pragma once
// Names of units in the heads of tables.
#include <string>

namespace courant {

/// Exponents of mass, length and time.
struct Dimension {
  int M = 0, L = 0, T = 0;
};

/// From "ML/T2"; what is not understood has no dimension.
Dimension parse_dimension(const std::string& text);

/// How the units of a deck are called; a deck itself names none.
struct PostUnits {
  std::string mass = "kg", length = "m", time = "s";

  /// "m/s", "kg/(m s2)"; "-" without a dimension. With kg, m and s: "Pa", "N", "N/m", "W" and "Hz" where they
  /// fit.
  std::string of(Dimension dimension) const;
};

}  // namespace courant
