#include "elements/solid/reference_geometry.hpp"

#include <fmt/format.h>

#include <set>
#include <string_view>
#include <unordered_map>

#include "elements/element_cards.hpp"
#include "elements/initial_cards.hpp"
#include "keyword/registry.hpp"

namespace courant {

namespace {

const RegisterKeyword<ReferenceNode> reference_node{initial_foam_reference_geometry_table()};

/// Materials of the deck whose field REF is not 0, whatever their law.
std::set<Id> materials_with_reference(const Deck& deck) {
  std::set<Id> out;
  const auto& registry = keyword_registry();
  for (std::size_t k = 0; k < registry.size(); ++k) {
    const KeywordSpec& spec = *registry[k];
    if (!spec.names.front().starts_with("MAT_")) continue;
    for (std::size_t c = 0; c < spec.cards.size(); ++c)
      for (std::size_t f = 0; f < spec.cards[c].fields.size(); ++f)
        if (std::string_view(spec.cards[c].fields[f].name) == "REF")
          spec.for_each(deck, static_cast<std::int32_t>(k), [&](const Entry& entry) {
            if (spec.number_of(entry, c, f) != 0) out.insert(spec.id_of(entry));
          });
  }
  return out;
}

}  // namespace

void ReferenceGeometry::go_to(const World& world, const SolidMesh& mesh,
                              const std::function<void(const SolidMesh&, Real)>& take) const {
  constexpr int steps = 400;  // of the second order: a stretch of 2 has the stress within some 1e-6
  constexpr Real dt = 1e12;
  std::array<std::vector<Real>, 3> at = x, speed = x;
  const auto count = x[0].size();
  SolidMesh moved = mesh;
  for (std::size_t k = 0; k < 3; ++k) {
    for (std::size_t n = 0; n < count; ++n)
      speed[k][n] = (world.nodes.x.data(static_cast<int>(k))[n] - x[k][n]) / steps / dt;
    moved.x[k] = at[k].data(), moved.v[k] = speed[k].data();
  }
  for (int step = 1; step <= steps; ++step) {
    for (std::size_t k = 0; k < 3; ++k)
      for (std::size_t n = 0; n < count; ++n) at[k][n] = x[k][n] + step * dt * speed[k][n];
    take(moved, dt);
  }
}

void report_inside_out(const ModelPart& part, Id solid, Diagnostics& diagnostics) {
  diagnostics.error(part.where,
                    fmt::format("solid {} of part {} is inside out in the reference geometry, or on the path "
                                "from there to the start",
                                solid, part.id),
                    "check the nodes of *INITIAL_FOAM_REFERENCE_GEOMETRY");
}

ReferenceGeometry reference_geometry(const Deck& deck, const Model& model,
                                     const std::vector<SolidPart>& parts, const std::vector<Index>& node_of,
                                     const World& world, Diagnostics& diagnostics) {
  ReferenceGeometry out;
  const auto& cards = deck.all<ReferenceNode>();
  const std::set<Id> materials = materials_with_reference(deck);
  for (const ModelPart& part : model.parts)
    if (!cards.empty() && (part.has_shell || part.has_sph) && materials.contains(part.mid))
      diagnostics.warning(part.where, fmt::format("REF of material {} has no effect on part {}, which has no "
                                                  "solids",
                                                  part.mid, part.id));
  if (cards.empty()) {
    for (const ModelPart& part : model.parts)
      if (materials.contains(part.mid))
        diagnostics.note(part.where,
                         fmt::format("REF of material {} of part {} has no effect: the deck has no "
                                     "*INITIAL_FOAM_REFERENCE_GEOMETRY",
                                     part.mid, part.id));
    return out;
  }
  std::unordered_map<Id, Index> index;
  for (std::size_t n = 0; n < model.nodes.size(); ++n)
    if (node_of[n] >= 0) index.emplace(model.nodes[n].id, node_of[n]);
  const Index count = world.nodes.size();
  for (int k = 0; k < 3; ++k)
    out.x[static_cast<std::size_t>(k)].assign(world.nodes.x.data(k), world.nodes.x.data(k) + count);
  std::vector<char> given(static_cast<std::size_t>(count), 0);
  for (const ReferenceNode& card : cards) {
    const auto found = index.find(card.nid);
    if (found == index.end()) continue;
    const auto n = static_cast<std::size_t>(found->second);
    given[n] = 1, out.x[0][n] = card.x, out.x[1][n] = card.y, out.x[2][n] = card.z;
  }
  // nodes on edges that the deck does not have, or not here, keep their positions between the ends
  for (const ModelSolid& solid : model.solids)
    for (std::size_t e = 0; e < solid.edges_with_nodes().size(); ++e) {
      const auto at = [&](Index n) { return static_cast<std::size_t>(node_of[static_cast<std::size_t>(n)]); };
      const auto [first, second] = solid.edges_with_nodes()[e];
      const std::size_t a = at(solid.node[static_cast<std::size_t>(first)]),
                        b = at(solid.node[static_cast<std::size_t>(second)]),
                        n = at(solid.node[solid.first_on_edge() + e]);
      if (given[n] != 0 || (given[a] == 0 && given[b] == 0)) continue;
      for (std::size_t k = 0; k < 3; ++k) {
        const Real* x = world.nodes.x.data(static_cast<int>(k));
        out.x[k][n] = x[n] + 0.5 * (out.x[k][a] - x[a] + out.x[k][b] - x[b]);
      }
    }
  out.parts.assign(model.parts.size(), 0);
  bool any = false;
  for (const auto& group : world.groups) {
    const auto part = static_cast<std::size_t>(group->part);
    const ModelPart& of = model.parts[part];
    if (group->segment || !parts[part].law || !materials.contains(of.mid)) continue;
    for (int c = 0; c < group->corners(); ++c)
      for (Index e = 0; e < group->size(); ++e)
        if (given[static_cast<std::size_t>(group->node.data(c)[e])] != 0) out.parts[part] = 1;
    any = any || out.parts[part] != 0;
    if (out.parts[part] != 0 && (parts[part].pressure || parts[part].formulation->nodal_pressure))
      deck.error(diagnostics, of.card, "SECID",
                 fmt::format("a reference geometry of the solids of part {} is not supported: {}", of.id,
                             parts[part].pressure ? "their pressure is that of an equation of state"
                                                  : "their pressure is averaged over nodes (ELFORM 13)"),
                 "leave out REF of the material, or use another formulation");
  }
  if (!any)
    diagnostics.warning(deck.where(cards.front()),
                        fmt::format("{} has no effect: none of its {} nodes is of solids with a material "
                                    "whose REF is 1",
                                    deck.keyword(cards.front()), cards.size()),
                        "set REF of rubbers and foams, or leave out the card");
  return out;
}

}  // namespace courant
