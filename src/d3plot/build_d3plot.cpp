// *COURANT_D3PLOT: takes nodes, elements and parts of the model while they are there.
#include <algorithm>
#include <cstdlib>
#include <memory>
#include <set>
#include <unordered_map>

#include "d3plot/d3plot_cards.hpp"
#include "d3plot/d3plot_model.hpp"
#include "elements/discrete/cards_discrete.hpp"
#include "extension/additions.hpp"
#include "keyword/registry.hpp"
#include "model/requests/output_cards.hpp"

namespace courant {
namespace {

const RegisterKeyword<CourantD3plotCard> courant_d3plot{courant_d3plot_table()};

class MeshBuilder {
 public:
  MeshBuilder(const Deck& deck, const Model& model)
      : model_(model), springs_(deck.all<ElementDiscreteCard>()) {}

  D3plotMesh build(const World& world) {
    mesh_.title = model_.title;
    add_parts();
    add_nodes(world);
    for (const ModelSolid& solid : model_.solids) mesh_.solids.push_back(element(solid));
    for (const ModelBeam& beam : model_.beams)
      mesh_.beams.push_back({beam.id, part(beam.part), nodes(beam.node)});
    for (const ElementDiscreteCard& spring : springs_) add_spring(spring);
    for (const ModelShell& shell : model_.shells)
      mesh_.shells.push_back({shell.id, part(shell.part), nodes(shell.node)});
    for (Index i = 0; i < world.particles.size(); ++i) {
      D3plotElement one{world.particles.id[i], part(world.particles.part[i])};
      one.node[0] = place_.at(one.id);
      mesh_.particles.push_back(one);
    }
    for (auto* list : {&mesh_.solids, &mesh_.beams, &mesh_.shells, &mesh_.particles})
      std::stable_sort(list->begin(), list->end(), [](const auto& a, const auto& b) { return a.id < b.id; });
    return std::move(mesh_);
  }

 private:
  Index part(Index of_model) const { return part_.at(of_model); }

  /// Parts without elements are left out: readers take each for one of a kind of elements.
  void add_parts() {
    std::set<Id> of_springs;
    for (const ElementDiscreteCard& spring : springs_) of_springs.insert(spring.pid);
    for (std::size_t k = 0; k < model_.parts.size(); ++k) {
      const ModelPart& part = model_.parts[k];
      const bool beam = part.has_beam || of_springs.contains(part.id);
      if (!part.has_sph && !part.has_solid && !beam && !part.has_shell) continue;
      const ElementKind kind = part.has_solid ? ElementKind::solid
                               : beam         ? ElementKind::beam
                                              : ElementKind::shell;
      mesh_.parts.push_back({part.id, part.title, kind, part.has_sph, static_cast<Index>(k)});
    }
    std::sort(mesh_.parts.begin(), mesh_.parts.end(),
              [](const auto& a, const auto& b) { return a.id < b.id; });
    for (std::size_t k = 0; k < mesh_.parts.size(); ++k) part_[mesh_.parts[k].index] = static_cast<Index>(k);
  }

  /// Those of the deck, and of particles that the deck has not as nodes.
  void add_nodes(const World& world) {
    std::map<Id, Vec> places;
    for (const ModelNode& node : model_.nodes) places.emplace(node.id, node.x);
    for (Index i = 0; i < world.particles.size(); ++i)
      places.emplace(world.particles.id[i], world.particles.x.vec(i));
    for (const auto& [id, x] : places) {
      place_[id] = static_cast<Index>(mesh_.node_ids.size());
      mesh_.node_ids.push_back(id);
      mesh_.places.push_back(x);
    }
  }

  /// A second end on the ground is that of the first.
  void add_spring(const ElementDiscreteCard& card) {
    const auto at = model_.part_of_id.find(card.pid);
    const auto& known = place_;
    const auto first = known.find(card.n1), second = known.find(card.n2 == 0 ? card.n1 : card.n2);
    if (at == model_.part_of_id.end() || first == known.end() || second == known.end()) return;  // refused
    D3plotElement one{card.eid, part(static_cast<Index>(at->second))};
    one.node[0] = first->second, one.node[1] = second->second, one.spring = true;
    mesh_.beams.push_back(one);
  }

  template <std::size_t n>
  std::array<Index, 8> nodes(const std::array<Index, n>& of_model) const {
    std::array<Index, 8> out{};
    for (std::size_t c = 0; c < std::min<std::size_t>(n, 8); ++c)
      out[c] = of_model[c] < 0 ? -1 : place_.at(model_.nodes[static_cast<std::size_t>(of_model[c])].id);
    return out;
  }
  /// Tetrahedra repeat their fourth node.
  D3plotElement element(const ModelSolid& solid) const {
    std::array<Index, 8> c = solid.corners();
    if (solid.different_corners() == 4) c = {c[0], c[1], c[2], c[4], c[4], c[4], c[4], c[4]};
    return {solid.id, part(solid.part), nodes(c)};
  }

  const Model& model_;
  const std::vector<ElementDiscreteCard>& springs_;
  D3plotMesh mesh_;
  std::unordered_map<Id, Index> place_;
  std::unordered_map<Index, Index> part_;
};

D3plotExtent extent_of(const Deck& deck, const CourantD3plotCard& card) {
  D3plotExtent out;
  out.bits = card.bits;
  if (const auto* x = deck.last<DatabaseExtentBinary>()) {
    out.history_of_solids = x->neiph, out.history_of_shells = x->neips;
    out.points_of_shells = x->maxint == 0 ? 3 : std::abs(x->maxint);
    out.points_of_beams = x->beamip;
    out.stress = x->sigflg != 2, out.plastic = x->epsflg != 2;
    out.resultants = x->rltflg != 2, out.extra = x->engflg != 2;
    out.strains = x->strflg != 0;
    out.points_of_solids = x->nintsld == 8 ? 8 : 1;
  }
  return out;
}

void build_d3plot(const Deck& deck, const Model& model, World& world, Diagnostics&) {
  const auto* card = deck.last<CourantD3plotCard>();
  if (!card) return;
  constexpr Real of_lsdyna = 7 * 512 * 512 * 4;  // bytes
  const Real most = card->size > 0 ? 1e6 * card->size : of_lsdyna;
  world.passes.add(std::make_shared<D3plotModel>(MeshBuilder(deck, model).build(world),
                                                 extent_of(deck, *card), card->vtk == 1,
                                                 static_cast<std::size_t>(most)));
}
const RegisterAddition d3plot{"d3plot", build_d3plot};

}  // namespace

}  // namespace courant
