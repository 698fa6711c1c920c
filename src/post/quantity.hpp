#pragma once
// Expressions over the particles of a state, for recipes.
#include <string>
#include <vector>

#include "base/compiled_expression.hpp"
#include "post/results.hpp"
#include "post/units.hpp"
#include "post/yaml_map.hpp"

namespace courant {

/// x y z vx vy vz speed p rho h m V e part id active t: the names that expressions over particles may use. V:
/// m/rho; e: internal energy per reference volume.
const std::vector<std::string>& quantity_variables();

struct Quantity {
  std::string name, unit;
  CompiledExpression of;
};

/// A quantity from "vx", or from {name: u, of: vx / 1.5, unit: "-"}. Faults are reported. Single variables
/// know their unit, other expressions have "?" unless the recipe names one.
Quantity read_quantity(const MapReader& map, const YAML::Node& node, const char* key, const PostUnits& units);

/// An expression of a recipe over `names`; faults are reported at the node.
CompiledExpression read_expression(const MapReader& map, const YAML::Node& node, const char* key,
                                   const std::vector<std::string>& names);

/// Adds the arrays of a field file that the expression needs.
void note_arrays(const CompiledExpression& of, std::vector<ParticleArray>& arrays);

/// Values for all particles; shape: (frame.size()). NaN where the expression has none.
std::vector<Real> evaluate(const CompiledExpression& of, const ParticleFrame& frame);

}  // namespace courant
