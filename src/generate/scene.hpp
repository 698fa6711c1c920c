#pragma once
// A scene as its YAML file describes it, checked and with all expressions evaluated.
#include <array>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "base/diagnostic.hpp"
#include "base/real.hpp"
#include "generate/place_expression.hpp"

namespace courant {

/// Ids of nodes and elements have eight columns.
inline constexpr Id largest_i8 = 99999999;

/// A box filled with particles at the centres of cubes (squares in 2D) of side `spacing`.
struct SceneLattice {
  int dim = 3;                      ///< 2: low and high have two components, particles lie in the plane z = 0
  Vec low = Vec::Zero();            ///< [L]
  Real spacing = 0;                 ///< [L]
  std::array<Id, 3> n = {0, 0, 1};  ///< cells along x, y, z
  PlaceExpression where;            ///< if given, only cells whose centre has a value > 0 have a particle
  Real jitter = 0;                  ///< largest shift along each axis, of the spacing [-]
  Id count() const { return n[0] * n[1] * n[2]; }  ///< of cells
  Real volume() const {
    return dim == 2 ? spacing * spacing : spacing * spacing * spacing;
  }  ///< [L3], 2D: per depth
};

/// A parallelogram of four-noded shells.
struct ScenePlate {
  Vec origin = Vec::Zero(), edge1 = Vec::Zero(), edge2 = Vec::Zero();  ///< [L]
  std::array<Id, 2> n = {1, 1};                                        ///< shells along the edges
};

struct ScenePart {
  Id id = 0;
  std::string title;
  Id section = 0, material = 0, eos = 0, hourglass = 0;
  bool has_velocity = false;
  Vec velocity = Vec::Zero();                        ///< initial [L/T]
  std::array<PlaceExpression, 3> velocity_of_place;  ///< [L/T], given where one of them names x, y or z
  PlaceExpression pressure;                          ///< initial [M/LT2]
  Real density = 0;    ///< > 0: elements carry a mass [M/L3]; 0: a volume, and RO of the material counts
  bool merge = false;  ///< plates of the part share the nodes they have in common
  Id first_id = 0;     ///< of nodes and elements; 0: the next free one
  std::vector<SceneLattice> lattices;
  std::vector<ScenePlate> plates;
  Location where;
};

struct Scene {
  std::string title;
  std::vector<std::pair<std::string, Real>> parameters;  ///< in file order, after overrides
  Variables variables;                                   ///< the same by name
  std::vector<ScenePart> parts;
  std::vector<std::string> keywords;  ///< deck text, placeholders filled
  std::vector<std::string> files;     ///< that it was read from
};

/// Reads and checks a scene. `overrides` replace values of `parameters`; one that names no parameter is an
/// error. All faults go to `diagnostics` with their line; the result counts only if `diagnostics.ok()`.
Scene read_scene(const std::string& path, const std::map<std::string, std::string>& overrides,
                 Diagnostics& diagnostics);

}  // namespace courant
