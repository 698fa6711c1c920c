// Nodes on the edges of solids: their order in hexahedra of twenty nodes, and those that _H8TOH20 and
// _TET4TOTET10 of *ELEMENT_SOLID add.
#include <fmt/format.h>

#include <algorithm>
#include <limits>

#include "model/mesh/mesh_cards.hpp"
#include "model/mesh/solid_edges.hpp"
#include "model/model_builder.hpp"

namespace courant {

/// Nodes 9 to 20 are three fours, on the edges of the lower face, of the upper one and between them, in an
/// order in which programs differ. That with the least sum of squares from the middles of the edges counts:
/// any other one gives an element without a volume.
void ModelBuilder::order_edge_nodes(ModelSolid& solid) const {
  if (!solid.is_hexahedron_of_twenty()) return;
  const auto x = [&](Index n) { return model_.nodes[static_cast<std::size_t>(n)].x; };
  std::array<std::size_t, 3> order{0, 1, 2}, best = order;
  Real least = std::numeric_limits<Real>::infinity();
  do {
    Real sum = 0;
    for (std::size_t e = 0; e < std::size(edges_of_hexahedron); ++e) {
      const auto& [a, b] = edges_of_hexahedron[e];
      const Index n = solid.node[8 + 4 * order[e / 4] + e % 4];
      sum += (x(n) -
              0.5 * (x(solid.node[static_cast<std::size_t>(a)]) + x(solid.node[static_cast<std::size_t>(b)])))
                 .squaredNorm();
    }
    if (sum < least) least = sum, best = order;
  } while (std::next_permutation(order.begin(), order.end()));
  const std::array<Index, 20> given = solid.node;
  for (std::size_t e = 0; e < std::size(edges_of_hexahedron); ++e)
    solid.node[8 + e] = given[8 + 4 * best[e / 4] + e % 4];
}

bool ModelBuilder::wants_edge_nodes(const ElementSolidCard& card) {
  return card.name >= 2;  // in the order of the table
}

/// The ids of new nodes follow the largest of the deck, in the order of the elements.
bool ModelBuilder::make_edge_nodes(const ElementSolidCard& card, ModelSolid& solid) {
  const bool hexahedron = card.name == 2;
  const int corners = hexahedron ? 8 : 4;
  if (solid.has_nodes_on_edges() || solid.different_corners() != corners) {
    error(card, "EID",
          hexahedron ? fmt::format("solid element {} is no hexahedron of eight different nodes", card.eid)
                     : fmt::format("solid element {} is no tetrahedron of four different nodes", card.eid),
          "give other shapes by *ELEMENT_SOLID, in a part of their own");
    return false;
  }
  if (!hexahedron) {
    const std::array<Index, 8> own = solid.corners();
    solid.node = {own[0], own[1], own[2], own[4]};
  }
  if (!first_made_) first_made_ = &card;
  const std::span<const SolidEdge> edges =
      hexahedron ? std::span<const SolidEdge>(edges_of_hexahedron) : edges_of_tetrahedron;
  std::fill(solid.node.begin() + corners, solid.node.end(), Index(-1));
  for (std::size_t e = 0; e < edges.size(); ++e) {
    const auto ends = std::minmax(solid.node[static_cast<std::size_t>(edges[e][0])],
                                  solid.node[static_cast<std::size_t>(edges[e][1])]);
    const auto [known, is_new] =
        made_.try_emplace({ends.first, ends.second}, static_cast<Index>(model_.nodes.size()));
    if (is_new) {
      const Id last = model_.nodes.back().id;  // nodes are in the order of their ids
      const auto x = [&](Index n) { return model_.nodes[static_cast<std::size_t>(n)].x; };
      model_.nodes.push_back({.id = last + 1, .x = 0.5 * (x(ends.first) + x(ends.second)), .v = Vec::Zero()});
    }
    solid.node[static_cast<std::size_t>(corners) + e] = known->second;
  }
  return true;
}

/// Once the nodes of the deck are where the run starts: they may have moved.
void ModelBuilder::position_edge_nodes() {
  for (const auto& [ends, n] : made_)
    model_.nodes[static_cast<std::size_t>(n)].x = 0.5 * (model_.nodes[static_cast<std::size_t>(ends[0])].x +
                                                         model_.nodes[static_cast<std::size_t>(ends[1])].x);
}

/// What holds both ends of an edge holds the node on it, and it has their mean velocity.
void ModelBuilder::finish_edge_nodes() {
  for (const auto& [ends, n] : made_) {
    const ModelNode &a = model_.nodes[static_cast<std::size_t>(ends[0])],
                    &b = model_.nodes[static_cast<std::size_t>(ends[1])];
    ModelNode& node = model_.nodes[static_cast<std::size_t>(n)];
    node.v = 0.5 * (a.v + b.v);
    for (std::size_t k = 0; k < 3; ++k) node.fixed[k] = a.fixed[k] && b.fixed[k];
  }
  if (!first_made_) return;
  Index first = made_.begin()->second;
  for (const auto& made : made_) first = std::min(first, made.second);
  diagnostics_.note(
      deck_.where(*first_made_),
      fmt::format("{}: {} nodes are added on edges, ids from {}; one is held where both ends of its edge "
                  "are held from the start to the end along global axes, and has the mean of their initial "
                  "velocities; sets of nodes, and so prescribed motions, have none of them",
                  deck_.keyword(*first_made_), made_.size(),
                  model_.nodes[static_cast<std::size_t>(first)].id));
}

/// The least volume that one of the 27 points represents, as if all did as much (src/elements/solid). [L3]
Real ModelBuilder::least_volume_of_twenty(const ModelSolid& solid) const {
  constexpr Real apart = 0.774596669241483377;
  constexpr int sign[8][3] = {{-1, -1, -1}, {1, -1, -1}, {1, 1, -1}, {-1, 1, -1},
                              {-1, -1, 1},  {1, -1, 1},  {1, 1, 1},  {-1, 1, 1}};
  Real out = std::numeric_limits<Real>::infinity();
  for (int point = 0; point < 27; ++point) {
    const Vec xi = apart * Vec(point % 3 - 1, point / 3 % 3 - 1, point / 9 - 1);
    Matrix slopes = Matrix::Zero();
    for (std::size_t c = 0; c < solid.node.size(); ++c) {
      Vec at;  // of the node: +-1, 0 along its edge
      for (int i = 0; i < 3; ++i)
        at[i] = c < 8
                    ? sign[c][i]
                    : 0.5 * (sign[edges_of_hexahedron[c - 8][0]][i] + sign[edges_of_hexahedron[c - 8][1]][i]);
      const Vec own = xi.cwiseProduct(at);
      for (int i = 0; i < 3; ++i) {
        const int j = (i + 1) % 3, l = (i + 2) % 3;
        Real slope;
        if (c < 8)
          slope = at[i] / 8 * (1 + own[j]) * (1 + own[l]) * (2 * own[i] + own[j] + own[l] - 1);
        else if (at[i] == 0)
          slope = -xi[i] / 2 * (1 + own[j]) * (1 + own[l]);
        else  // along the edge, the one coordinate of which is 0, 1 - xi^2 is left
          slope = at[i] / 4 * (at[j] == 0 ? 1 - xi[j] * xi[j] : 1 + own[j]) *
                  (at[l] == 0 ? 1 - xi[l] * xi[l] : 1 + own[l]);
        slopes.col(i) += slope * model_.nodes[static_cast<std::size_t>(solid.node[c])].x;
      }
    }
    out = std::min(out, 8 * slopes.determinant());
  }
  return out;
}

}  // namespace courant
