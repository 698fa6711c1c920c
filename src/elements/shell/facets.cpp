#include "elements/shell/facets.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace courant {

namespace {

constexpr Real flat = 1;  // degrees between normals of neighbours

Vec normal_of(const World& world, const std::array<Index, 4>& node) {
  const auto x = [&](std::size_t c) { return world.nodes.x.vec(node[c]); };
  return (x(2) - x(0)).cross(x(3) - x(1)).normalized();
}

/// One line of a shell.
struct Side {
  std::array<Index, 2> ends;  ///< ascending
  std::size_t part;
  Vec normal;  ///< of the shell that runs along the line from its lesser end on
  bool operator<(const Side& other) const { return ends < other.ends; }
};

void add_sides(const World& world, const std::array<Index, 4>& node, std::size_t part,
               std::vector<Side>& sides) {
  const Vec normal = normal_of(world, node);
  for (std::size_t c = 0; c < 4; ++c) {
    const Index a = node[c], b = node[(c + 1) % 4];
    if (a < b)
      sides.push_back({{a, b}, part, normal});
    else
      sides.push_back({{b, a}, part, -normal});
  }
}

}  // namespace

void note_facets(const Model& model, const std::vector<ShellPart>& parts, World& world,
                 Diagnostics& diagnostics) {
  std::vector<Side> sides;
  for (std::size_t s = 0; s < model.shells.size(); ++s) {
    const auto part = static_cast<std::size_t>(model.shells[s].part);
    const ShellPart& p = parts[part];
    const auto node = world.segments.nodes(static_cast<Index>(s));
    if (!p.law || p.null || p.full || p.control.warps || p.control.shear_factor == 0 || node[2] == node[3])
      continue;
    add_sides(world, node, part, sides);
  }
  std::stable_sort(sides.begin(), sides.end());
  std::vector<Real> angle(parts.size(), 0);
  for (std::size_t k = 1; k < sides.size(); ++k) {
    const Side &one = sides[k - 1], &other = sides[k];
    if (one.ends != other.ends) continue;
    // neighbours of one sense run along the line in two directions
    const Real between = std::acos(std::clamp<Real>(-one.normal.dot(other.normal), -1, 1)) * 180 / pi;
    angle[other.part] = std::max(angle[other.part], std::min(between, 180 - between));
  }
  std::vector<std::size_t> bent;
  for (std::size_t k = 0; k < parts.size(); ++k)
    if (angle[k] > flat) bent.push_back(k);
  if (bent.empty()) return;
  const Real largest = *std::max_element(angle.begin(), angle.end());
  Real& most = world.maxima["angle_between_facets"];
  most = std::max(most, largest);
  std::string names;
  for (const std::size_t k : bent) names += fmt::format("{}{}", names.empty() ? "" : ", ", model.parts[k].id);
  diagnostics.note(
      model.parts[bent.front()].where,
      fmt::format("shells of part{} {} meet at angles of up to {:.3g} degrees, and formulation 2 "
                  "has no stiffness about the normal: where curved surfaces and open sections "
                  "bend or twist elastically, they are too soft",
                  bent.size() == 1 ? "" : "s", names, largest),
      "give BWC 1 of *CONTROL_SHELL, or ELFORM 16");
}

}  // namespace courant
