// *CONSTRAINED_GLOBAL and *BOUNDARY_SPC_SYMMETRY_PLANE: nodes on planes are held.
#include <fmt/format.h>
#include <algorithm>
#include <cmath>

#include "model/cards.hpp"
#include "model/model_builder.hpp"
#include "model/transforms/transformation.hpp"

namespace courant {

namespace {

/// Of the extent of all nodes: how far from a plane nodes are on it where TOL is blank.
constexpr Real usual_tolerance = 1e-6;

/// The translation across the plane, and the rotations about axes in it.
std::array<bool, 3> all_but(Eigen::Index axis) {
  std::array<bool, 3> out{true, true, true};
  out[static_cast<std::size_t>(axis)] = false;
  return out;
}

}  // namespace

/// Those at most `tolerance` away; 0: the usual one. [L]
std::vector<Index> ModelBuilder::nodes_on_plane(const Vec& through, const Vec& normal, Real tolerance) const {
  if (!(tolerance > 0) && !model_.nodes.empty()) {
    Vec low = model_.nodes[0].x, high = low;
    for (const ModelNode& n : model_.nodes) low = low.cwiseMin(n.x), high = high.cwiseMax(n.x);
    tolerance = usual_tolerance * (high - low).norm();
  }
  std::vector<Index> out;
  for (std::size_t n = 0; n < model_.nodes.size(); ++n)
    if (std::abs(normal.dot(model_.nodes[n].x - through)) <= tolerance) out.push_back(static_cast<Index>(n));
  return out;
}

void ModelBuilder::hold_planes(bool turn) {
  const auto hold = [&](const Entry& card, const std::vector<Index>& nodes, const std::array<bool, 3>& axes,
                        const std::array<bool, 3>& turns) {
    if (nodes.empty())
      diagnostics_.warning(deck_.where(card), fmt::format("{}: no node is on the plane", deck_.keyword(card)),
                           "give TOL, or a point of the plane");
    for (const Index n : nodes) {
      auto& fixed = model_.nodes[static_cast<std::size_t>(n)].fixed;
      for (std::size_t k = 0; k < 3; ++k) fixed[k] = fixed[k] || axes[k];
      if (turn && turns != std::array<bool, 3>{}) hold_rotations(n, turns);
    }
  };
  for (const auto& card : deck_.all<ConstrainedGlobal>()) {
    if (card.dir < 1 || card.dir > 3) continue;
    const Vec normal = Vec::Unit(card.dir - 1);
    hold(card, nodes_on_plane(Vec(card.x, card.y, card.z), normal, card.tol), axes_of_code(card.tc),
         axes_of_code(card.rc));
  }
  for (const auto& card : deck_.all<SymmetryPlaneCard>()) {
    const Vec normal(card.vx, card.vy, card.vz);
    Eigen::Index axis = 0;
    constexpr Real along = 1 - 1e-9;  // cosine
    if (!(normal.norm() > 0) || normal.normalized().cwiseAbs().maxCoeff(&axis) < along) {
      error(
          card, "VX", "a plane of symmetry across no global axis is not supported",
          "turn the deck so that the normal is along a global axis, or hold the nodes by *BOUNDARY_SPC with "
          "a CID");
      continue;
    }
    std::vector<Index> nodes = nodes_on_plane(Vec(card.x, card.y, card.z), Vec::Unit(axis), card.tol);
    if (card.pid != 0) {
      const Index of = part(card, "PID", card.pid);
      if (of < 0) continue;
      std::vector<Index> its = nodes_of_parts({of}), both;
      std::sort(its.begin(), its.end());
      std::set_intersection(nodes.begin(), nodes.end(), its.begin(), its.end(), std::back_inserter(both));
      nodes = std::move(both);
    }
    std::array<bool, 3> across{};
    across[static_cast<std::size_t>(axis)] = true;
    hold(card, nodes, across, all_but(axis));
  }
}

}  // namespace courant
