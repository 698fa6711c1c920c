#include "generate/initial_state.hpp"

#include <fmt/format.h>

#include <iterator>

namespace courant {

namespace {

constexpr int long_field = 20;

void append_velocities(const ScenePart& part, std::span<const PlacedNode> nodes, const Variables& variables,
                       std::string& out, Diagnostics& diagnostics) {
  out += "*INITIAL_VELOCITY_NODE +\n";
  out += fmt::format("{:>20}{:>20}{:>20}{:>20}\n", "$#               nid", "vx", "vy", "vz");
  for (const PlacedNode& node : nodes) {
    fmt::format_to(std::back_inserter(out), "{:20}", node.id);
    for (const PlaceExpression& component : part.velocity_of_place) {
      const auto v = value_at(component, "velocity", node.x, variables, diagnostics);
      if (!v) return;
      fmt::format_to(std::back_inserter(out), "{:>20}", number_text(*v, long_field));
    }
    out += '\n';
  }
}

/// A fluid at rest with pressure p has sigma = -p I.
void append_pressures(const ScenePart& part, std::span<const PlacedNode> nodes, const Variables& variables,
                      std::string& out, Diagnostics& diagnostics) {
  out += "*INITIAL_STRESS_SPH +\n";
  out += fmt::format("{:>20}{:>20}{:>20}{:>20}\n", "$#               eid", "sigxx", "sigyy", "sigzz");
  for (const PlacedNode& node : nodes) {
    const auto p = value_at(part.pressure, "pressure", node.x, variables, diagnostics);
    if (!p) return;
    const std::string sigma = number_text(-*p, long_field);
    fmt::format_to(std::back_inserter(out), "{:20}{:>20}{:>20}{:>20}\n", node.id, sigma, sigma, sigma);
  }
}

}  // namespace

void append_initial_state(const ScenePart& part, std::span<const PlacedNode> nodes,
                          const Variables& variables, std::string& out, Diagnostics& diagnostics) {
  if (part.velocity_of_place[0].given()) append_velocities(part, nodes, variables, out, diagnostics);
  if (part.pressure.given()) append_pressures(part, nodes, variables, out, diagnostics);
}

}  // namespace courant
