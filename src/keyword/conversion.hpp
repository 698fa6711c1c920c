#pragma once
// The effect of *INCLUDE_TRANSFORM on the entries of a file: offsets of ids, factors of units, a motion of
// points.
#include <array>
#include <Eigen/Geometry>
#include <string>
#include <string_view>
#include <vector>

#include "base/real.hpp"
#include "keyword/id_space.hpp"

namespace courant {

/// Offsets of card 2 and 3; 0: none.
struct IdOffsets {
  Id node = 0, element = 0, part = 0, material = 0, set = 0, curve = 0, definition = 0, other = 0;
  Id of(IdSpace space) const;
  /// `id` with the offset of its space. 0 stays 0 (it names nothing); a negative id is a flagged one, its
  /// absolute value grows.
  Id shifted(IdSpace space, Id id) const;
  bool any() const;
};

/// FCTMAS, FCTTIM, FCTLEN: a number in the file's units times these is one in the deck's.
struct UnitFactors {
  Real mass = 1, time = 1, length = 1;
  /// Factor of a number whose dimension is written like "M/LT2" or "L3"; 1 for "-".
  Real of(std::string_view dimension) const;
  bool any() const { return mass != 1 || time != 1 || length != 1; }
};

/// A motion of points: x -> M x + t.
using Affine = Eigen::Transform<Real, 3, Eigen::Affine>;

/// Of one included file; of a file included by an included one, both together.
struct Conversion {
  IdOffsets offsets;
  UnitFactors units;
  std::string prefix, suffix;       ///< of titles
  std::vector<Id> transformations;  ///< *DEFINE_TRANSFORMATION ids, to be applied in this order
  bool any() const { return offsets.any() || units.any() || !prefix.empty() || !suffix.empty(); }
  /// The conversion of a file that is included with `inner` by a file with this conversion.
  Conversion then(const Conversion& inner) const;
};

}  // namespace courant
