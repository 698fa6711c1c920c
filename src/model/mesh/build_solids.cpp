// Solid elements.
#include <fmt/format.h>
#include <algorithm>
#include <iterator>
#include <limits>
#include <map>
#include <set>
#include <unordered_map>
#include <utility>

#include "model/mesh/mesh_cards.hpp"
#include "model/mesh/solid_edges.hpp"
#include "model/model_builder.hpp"

namespace courant {

namespace {

constexpr const char* inside_out = "inside out, or without a volume";
constexpr const char* bent_inwards = "a tetrahedron of ten nodes that is inside out at one of its points";
constexpr const char* crushed = "a hexahedron of twenty nodes that is inside out at one of its points";
constexpr std::size_t least_corners = 4, corners_of_hexahedron = 8;

/// What is wrong with the nodes of a solid; nullptr: nothing.
const char* wrong_nodes(const ModelSolid& solid) {
  const auto& node = solid.node;
  constexpr std::size_t of_tetrahedron = 10;
  const auto any_from = [&](std::size_t k) {
    return std::any_of(node.begin() + static_cast<std::ptrdiff_t>(k), node.end(),
                       [](Index n) { return n >= 0; });
  };
  if (any_from(corners_of_hexahedron)) {
    const bool twenty = any_from(of_tetrahedron);
    std::set<Index> different(node.begin(), node.end());
    different.erase(-1);
    if (different.size() == (twenty ? node.size() : of_tetrahedron)) return nullptr;
    return twenty ? "of eleven to nineteen nodes, or of twenty that are not all different"
                  : "of nine nodes, or of ten that are not all different";
  }
  if (solid.different_corners() < static_cast<int>(least_corners)) return "of less than four different nodes";
  const auto corner = solid.corners();
  if (std::count(corner.begin(), corner.end(), Index(-1)) > 0) return "of five to seven nodes";
  return nullptr;
}

}  // namespace

void ModelBuilder::build_solids() {
  const auto& cards = deck_.all<ElementSolidCard>();
  std::unordered_map<Id, const ElementSolidCard*> first;
  first.reserve(cards.size());
  model_.solids.reserve(cards.size());
  std::vector<bool> told(model_.parts.size(),
                         false);  // of which parts was said that they hold something else
  for (const ElementSolidCard& card : cards) {
    const auto [it, is_new] = first.try_emplace(card.eid, &card);
    if (!is_new) duplicate(card, "EID", "solid element", card.eid, deck_.where(*it->second));
    const Id ids[] = {card.n1,  card.n2,  card.n3,  card.n4,  card.n5,  card.n6,  card.n7,
                      card.n8,  card.n9,  card.n10, card.n11, card.n12, card.n13, card.n14,
                      card.n15, card.n16, card.n17, card.n18, card.n19, card.n20};
    ModelSolid solid;
    solid.id = card.eid;
    solid.part = part(card, "PID", card.pid);
    solid.node.fill(-1);
    bool whole = solid.part >= 0;
    for (std::size_t k = 0; k < solid.node.size(); ++k) {
      if (ids[k] == 0) continue;
      solid.node[k] = node(card, "EID", ids[k]);
      whole = whole && solid.node[k] >= 0;
    }
    if (std::find(ids, ids + least_corners, 0) != ids + least_corners) {
      error(card, "EID", fmt::format("solid element {} has less than four nodes", card.eid));
      whole = false;
    }
    if (!whole) continue;
    order_edge_nodes(solid);
    if (wants_edge_nodes(card) && !make_edge_nodes(card, solid)) continue;
    add_to_part(card, solid, told);
    model_.solids.push_back(solid);
    solid_cards_.push_back(&card);
  }
}

void ModelBuilder::add_to_part(const ElementSolidCard& card, const ModelSolid& solid,
                               std::vector<bool>& told) {
  const auto index = static_cast<std::size_t>(solid.part);
  ModelPart& p = model_.parts[index];
  if (!p.has_sph && !p.has_shell) {
    p.has_solid = true;
  } else if (!told[index]) {
    told[index] = true;
    error(card, "PID", fmt::format("part {} has {} already", p.id, p.has_sph ? "particles" : "shells"),
          "give the solids a part of their own");
  }
}

/// Once nodes are where the run starts.
void ModelBuilder::check_solids() {
  position_edge_nodes();
  check_solid_shapes();
  if (errors_ == 0) warn_of_loose_edges();
  if (const auto* control = deck_.last<ControlSolid>()) check_control_solid(*control);
}

/// Edges between two corners that solids share, with a node on it in one of them alone.
void ModelBuilder::warn_of_loose_edges() {
  using Edge = std::pair<Index, Index>;
  const auto edge = [](Index a, Index b) { return Edge(std::min(a, b), std::max(a, b)); };
  struct Middle {
    Index node = -1;
    std::size_t solid = 0;
    bool loose = false;
  };
  std::map<Edge, Middle> middles;
  Index count = 0;
  const Middle* first = nullptr;
  std::size_t other = 0;
  const auto note = [&](Middle& middle, std::size_t solid) {
    if (middle.loose) return;
    middle.loose = true;
    if (count++ == 0) first = &middle, other = solid;
  };
  for (std::size_t k = 0; k < model_.solids.size(); ++k) {
    const ModelSolid& solid = model_.solids[k];
    for (std::size_t e = 0; e < solid.edges_with_nodes().size(); ++e) {
      const auto& [a, b] = solid.edges_with_nodes()[e];
      const Index middle = solid.node[solid.first_on_edge() + e];
      const auto [known, is_new] = middles.try_emplace(edge(solid.node[a], solid.node[b]), Middle{middle, k});
      if (!is_new && known->second.node != middle) note(known->second, k);
    }
  }
  for (std::size_t k = 0; !middles.empty() && k < model_.solids.size(); ++k) {
    if (model_.solids[k].has_nodes_on_edges()) continue;
    const auto corner = model_.solids[k].corners();
    for (const auto& [a, b] : edges_of_hexahedron)
      if (const auto found = middles.find(edge(corner[a], corner[b]));
          corner[a] != corner[b] && found != middles.end())
        note(found->second, k);
  }
  if (count == 0) return;
  diagnostics_.warning(
      deck_.where(*solid_cards_[first->solid]),
      fmt::format(
          "{} edge{} of solids with nodes on edges {} a node that other solids with the same two corners do "
          "not have, first node {} of element {} beside element {}: there the mesh opens",
          count, count > 1 ? "s" : "", count > 1 ? "have" : "has",
          model_.nodes[static_cast<std::size_t>(first->node)].id, model_.solids[first->solid].id,
          model_.solids[other].id),
      "mesh all of it with nodes on edges, or let the parts share no nodes and tie them by *CONTACT_TIED");
}

void ModelBuilder::check_solid_shapes() {
  // a mesh has many of a kind: the first one of a part stands for all
  std::map<std::pair<Index, std::string>, std::pair<const ElementSolidCard*, int>> found;
  std::vector<std::pair<Index, std::string>> order;
  const auto note = [&](const ElementSolidCard* card, Index part, const char* what) {
    auto& [first, count] = found[{part, what}];
    if (++count > 1) return;
    first = card;
    order.emplace_back(part, what);
  };
  for (std::size_t k = 0; k < model_.solids.size(); ++k) {
    const ModelSolid& solid = model_.solids[k];
    const char* wrong = wrong_nodes(solid);
    if (wrong)
      note(solid_cards_[k], solid.part, wrong);
    else if (!(volume(solid) > 0))
      note(solid_cards_[k], solid.part,
           solid.is_hexahedron_of_twenty() ? crushed
           : solid.has_nodes_on_edges()    ? bent_inwards
                                           : inside_out);
  }
  for (const auto& key : order) {
    const auto& [card, count] = found[key];
    const bool bent = key.second == bent_inwards, of_twenty = key.second == crushed,
               turned = bent || of_twenty || key.second == inside_out;
    const std::string others = count > 1 ? fmt::format(" (and so {} {} more of part {})",
                                                       count > 2 ? "are" : "is", count - 1, card->pid)
                                         : "";
    error(
        *card, "EID",
        turned
            ? fmt::format("solid element {} is {}{}", card->eid, key.second, others)
            : fmt::format("solid element {} is {}, which is not supported{}", card->eid, key.second, others),
        bent ? "N1 to N3 run counter-clockwise seen from N4, N5 to N10 are near the middles of edges 12, 23, "
               "31, 14, 24, 34"
        : of_twenty ? "N1 to N4 run around one face, counter-clockwise seen from the other one, N9 to N20 "
                      "are near the "
                      "middles of edges"
        : turned
            ? "N1 to N4 run around one face, counter-clockwise seen from the other one, N5 to N8 are above "
              "them"
            : "give a hexahedron eight nodes, a pentahedron N1 N2 N3 N4 N5 N5 N6 N6, a pyramid N5 four "
              "times, a tetrahedron N4 five times");
  }
}

/// The least volume that one of the four points of a tetrahedron of ten nodes represents, times four, as its
/// loops have them (src/elements/solid). [L3]
Real ModelBuilder::least_volume(const ModelSolid& solid) const {
  const auto x = [&](std::size_t k) { return model_.nodes[static_cast<std::size_t>(solid.node[k])].x; };
  constexpr std::size_t on_edge[4][4] = {{0, 4, 6, 7}, {4, 0, 5, 8}, {6, 5, 0, 9}, {7, 8, 9, 0}};
  Real out = std::numeric_limits<Real>::infinity();
  for (std::size_t point = 0; point < 4; ++point) {
    Matrix slopes = Matrix::Zero();  // by the coordinates of the last three corners
    for (std::size_t a = 0; a < 4; ++a)
      for (std::size_t b = 0; b < 4; ++b) {
        const Real of_a = a == point ? 0.58541019662496845446 : 0.13819660112501051518;
        const Vec term = a == b ? Vec((4 * of_a - 1) * x(a)) : Vec(4 * of_a * x(on_edge[a][b]));
        if (b > 0) slopes.col(static_cast<int>(b) - 1) += term;
        if (b == 0)
          for (int k = 0; k < 3; ++k) slopes.col(k) -= term;
      }
    out = std::min(out, slopes.determinant() / 6);
  }
  return out;
}

/// Of a hexahedron with bilinear faces, from its modes xi, eta, zeta, eta zeta, zeta xi, xi eta (elements).
/// [L3]
Real ModelBuilder::volume(const ModelSolid& solid) const {
  if (solid.is_hexahedron_of_twenty()) return least_volume_of_twenty(solid);
  if (solid.has_nodes_on_edges()) return least_volume(solid);
  constexpr int sign[6][8] = {{-1, 1, 1, -1, -1, 1, 1, -1}, {-1, -1, 1, 1, -1, -1, 1, 1},
                              {-1, -1, -1, -1, 1, 1, 1, 1}, {1, 1, -1, -1, -1, -1, 1, 1},
                              {1, -1, -1, 1, -1, 1, 1, -1}, {1, -1, 1, -1, 1, -1, 1, -1}};
  const std::array<Index, 8> corner = solid.corners();
  std::array<Vec, 6> a;
  for (std::size_t m = 0; m < a.size(); ++m) {
    a[m] = Vec::Zero();
    for (std::size_t k = 0; k < corner.size(); ++k)
      a[m] += sign[m][k] * model_.nodes[static_cast<std::size_t>(corner[k])].x;
  }
  return (a[0].dot(a[1].cross(a[2])) +
          (a[0].dot(a[5].cross(a[4])) + a[3].dot(a[2].cross(a[4]) + a[5].cross(a[1]))) / 3) /
         64;
}

void ModelBuilder::check_control_solid(const ControlSolid& card) {
  if (model_.solids.empty()) {
    if (deck_.all<ElementSolidCard>().empty())
      diagnostics_.note(deck_.where(card),
                        fmt::format("{}: the deck has no solids: no effect", deck_.keyword(card)));
    return;
  }
  const auto refuse = [&](const char* field, Id value, const char* what) {
    if (value != 0)
      error(card, field, fmt::format("'{}' is not supported: {}", value, what), "leave the field blank");
  };
  refuse("PSFAIL", card.psfail, "no solid is taken out of the run by its volume");
  if (std::none_of(model_.solids.begin(), model_.solids.end(),
                   [](const ModelSolid& solid) { return solid.different_nodes() == 10; }))
    return;
  if (card.niptets != 0 && card.niptets != 4)
    deck_.warning(diagnostics_, card, "NIPTETS",
                  fmt::format("tetrahedra of ten nodes have four points here, not {}", card.niptets));
  const Id order[] = {card.pm1, card.pm2, card.pm3, card.pm4, card.pm5,
                      card.pm6, card.pm7, card.pm8, card.pm9, card.pm10};
  for (std::size_t k = 0; k < std::size(order); ++k)
    if (order[k] != 0 && order[k] != static_cast<Id>(k) + 1)
      return error(card, "PM1", "another order of the ten nodes of tetrahedra is not supported",
                   "order the nodes in *ELEMENT_SOLID as the keyword reference has them");
}

/// `owner`: the particle that a node carries, or -1. `told`: nodes of which a message was given.
void ModelBuilder::check_shared_nodes_of_solids(const std::vector<Index>& owner, std::vector<bool>& told) {
  for (const ModelSolid& solid : model_.solids) {
    for (const Index n : solid.node) {
      const Index o = n < 0 ? -1 : owner[static_cast<std::size_t>(n)];
      if (o < 0 || told[static_cast<std::size_t>(n)]) continue;
      told[static_cast<std::size_t>(n)] = true;
      if (++errors_ > max_errors) continue;
      diagnostics_.error(deck_.where(model_.sph[static_cast<std::size_t>(o)].card),
                         fmt::format("*ELEMENT_SPH: node {} is also a corner of solid element {}",
                                     model_.nodes[static_cast<std::size_t>(n)].id, solid.id),
                         "give the particle a node of its own");
    }
  }
}

}  // namespace courant
