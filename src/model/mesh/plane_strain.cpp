#include "model/mesh/plane_strain.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>

namespace courant {

namespace {

/// Nodes of the solids and shells of each part.
std::vector<std::set<Index>> nodes_of_parts(const Model& model) {
  std::vector<std::set<Index>> out(model.parts.size());
  for (const ModelSolid& solid : model.solids)
    for (const Index n : solid.all_corners())
      if (n >= 0)
        out[static_cast<std::size_t>(solid.part)].insert(n);  // the fault of the others has been reported
  for (const ModelShell& shell : model.shells)
    for (const Index n : shell.node) out[static_cast<std::size_t>(shell.part)].insert(n);
  return out;
}

}  // namespace

void hold_in_plane(Model& model, Diagnostics& diagnostics) {
  const std::vector<std::set<Index>> nodes = nodes_of_parts(model);
  std::set<Index> of_bodies;  // which stay in the plane as a whole
  for (std::size_t part = 0; part < nodes.size(); ++part)
    if (model.parts[part].rigid) of_bodies.insert(nodes[part].begin(), nodes[part].end());
  for (std::size_t part = 0; part < nodes.size(); ++part) {
    if (model.parts[part].rigid) continue;
    Real low = std::numeric_limits<Real>::infinity(), high = -low;
    for (const Index n : nodes[part]) {
      ModelNode& node = model.nodes[static_cast<std::size_t>(n)];
      low = std::min(low, node.x.z()), high = std::max(high, node.x.z());
      if (of_bodies.contains(n)) continue;
      node.fixed[2] = true;
      std::array<bool, 3>& turns = model.held_rotations[n];
      turns[0] = turns[1] = true;
    }
    if (!nodes[part].empty() && !model.parts[part].has_sph && std::abs(high - low - 1) > 1e-6)
      diagnostics.error(model.parts[part].where,
                        fmt::format("*PART {}: in a 2D scene particles have mass per unit depth, but these "
                                    "elements, which deform, are {:.4g} deep in z",
                                    model.parts[part].id, high - low),
                        "make the part one unit of length deep in z, with particles in its middle");
  }
}

}  // namespace courant
