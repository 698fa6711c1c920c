// Nodes, parts and elements.
#include <fmt/format.h>
#include <algorithm>
#include <map>

#include "model/build_model.hpp"
#include "model/mesh/part_composite.hpp"
#include "model/mesh/part_inertia.hpp"
#include "model/model_builder.hpp"
#include "model/transforms/transformation.hpp"

namespace courant {

namespace {

/// Corners without repetition, as a triangle (last one repeated) or a quad; fewer than three: false.
bool normalise_corners(std::array<Index, 4>& corner) {
  std::vector<Index> distinct;
  for (const Index c : corner)
    if (std::find(distinct.begin(), distinct.end(), c) == distinct.end()) distinct.push_back(c);
  if (distinct.size() < 3) return false;
  for (std::size_t k = 0; k < 4; ++k) corner[k] = distinct[std::min(k, distinct.size() - 1)];
  return true;
}

bool has_area(const std::vector<ModelNode>& nodes, const std::array<Index, 4>& corner) {
  const auto x = [&](std::size_t k) -> const Vec& { return nodes[static_cast<std::size_t>(corner[k])].x; };
  const Vec d1 = x(2) - x(0), d2 = x(3) == x(2) ? Vec(x(2) - x(1)) : Vec(x(3) - x(1));
  Real edge2 = 0;
  for (std::size_t k = 0; k < 4; ++k) edge2 = std::max(edge2, (x((k + 1) % 4) - x(k)).squaredNorm());
  constexpr Real sliver = 1e-10;  // height over length: below it round-off decides the normal
  return 0.5 * d1.cross(d2).norm() > sliver * edge2;
}

}  // namespace

void ModelBuilder::build_nodes() {
  const auto& cards = deck_.all<NodeCard>();
  model_.nodes.reserve(cards.size());
  const auto ids = std::minmax_element(cards.begin(), cards.end(),
                                       [](const NodeCard& a, const NodeCard& b) { return a.nid < b.nid; });
  if (!cards.empty()) node_of_id_ = IdIndex(ids.first->nid, ids.second->nid, cards.size());
  for (std::size_t i = 0; i < cards.size(); ++i) {
    const NodeCard& card = cards[i];
    if (node_of_id_.insert(card.nid, static_cast<Index>(model_.nodes.size())) >= 0) {
      if (errors_ >= max_errors) {  // each search runs over all nodes
        ++errors_;
        continue;
      }
      const auto first =
          std::find_if(cards.begin(), cards.end(), [&](const NodeCard& c) { return c.nid == card.nid; });
      duplicate(card, "NID", "node", card.nid, deck_.where(*first));
      continue;
    }
    const Vec x(card.x, card.y, card.z);
    if (!(x.cwiseAbs().maxCoeff() < largest_coordinate))
      error(
          card, "X",
          fmt::format("the coordinates ({:g}, {:g}, {:g}) are too large, perhaps after a change of units or "
                      "a motion of the file",
                      x[0], x[1], x[2]),
          fmt::format("the largest that can be computed with is {:g}", largest_coordinate));
    model_.nodes.push_back({.id = card.nid, .x = x, .v = Vec::Zero(), .fixed = axes_of_code(card.tc)});
  }
}

void ModelBuilder::build_parts() {
  const Entry* first_adaptive = nullptr;
  const auto add = [&](const PartCard& card) {
    if (!model_.part_of_id.try_emplace(card.pid, static_cast<Index>(model_.parts.size())).second)
      return;  // the reader has refused it
    ModelPart part;
    part.id = card.pid;
    part.title = card.title;
    part.secid = card.secid;
    part.mid = card.mid;
    part.eosid = card.eosid;
    part.hgid = card.hgid;
    part.where = deck_.where(card, "PID");
    part.card = card;
    model_.parts.push_back(std::move(part));
    if (card.adpopt == 0) return;
    if (deck_.keywords.contains("CONTROL_ADAPTIVE"))
      deck_.refuse(diagnostics_, card, "ADPOPT", fmt::format("'{}' is not supported", card.adpopt),
                   "leave the field blank to run with the mesh of the deck");
    else if (!first_adaptive)
      first_adaptive = &card;
  };
  for (const PartCard& card : deck_.all<PartCard>()) add(card);
  for (const PartContactCard& card : deck_.all<PartContactCard>()) {
    const std::size_t before = model_.parts.size();
    add(card);
    if (model_.parts.size() == before) continue;
    ModelPart& part = model_.parts.back();
    part.optt = card.optt, part.sft = card.sft, part.ssf = card.ssf;
  }
  for (const PartInertiaCard& card : deck_.all<PartInertiaCard>()) add(card);
  for (const PartCompositeCard& card : deck_.all<PartCompositeCard>()) {
    const std::size_t before = model_.parts.size();
    add(card);
    if (model_.parts.size() == before) continue;
    ModelPart& part = model_.parts.back();
    part.plies = card.plies();
    if (!part.plies.empty()) part.mid = part.plies.front().mid;  // of a rigid part that of all
    check_plies(card, part.plies, fmt::format("part {}", part.id));
  }
  if (first_adaptive)
    diagnostics_.note(deck_.where(*first_adaptive),
                      "ADPOPT of parts has no effect without *CONTROL_ADAPTIVE");
  std::sort(model_.parts.begin(), model_.parts.end(),
            [](const ModelPart& a, const ModelPart& b) { return a.id < b.id; });
  for (std::size_t k = 0; k < model_.parts.size(); ++k)
    model_.part_of_id[model_.parts[k].id] = static_cast<Index>(k);
}

void ModelBuilder::check_part_contacts() {
  for (const PartContactCard& card : deck_.all<PartContactCard>()) {
    const ModelPart& part = model_.parts[static_cast<std::size_t>(model_.part_of_id.at(card.pid))];
    const auto without_effect = [&](const char* field, std::string why) {
      deck_.warning(diagnostics_, card, field, "has no effect: " + why, "leave it blank");
    };
    const char* const thickness = card.optt > 0 ? "OPTT" : "SFT";
    if (card.optt > 0 ? !part.has_shell && !part.has_beam : card.sft != 1 && !part.has_shell)
      without_effect(thickness, fmt::format("part {} has no shells", part.id));
    if (card.optt > 0 && card.sft != 1) without_effect("SFT", "OPTT gives the thickness");
    if (card.ssf != 1 && part.has_sph)
      error(card, "SSF", "particles have no stiffness in contacts that their part scales",
            "give SFSA of the contact");
  }
}

void ModelBuilder::check_plies(const Entry& card, const std::vector<ModelPly>& plies,
                               const std::string& whose) {
  if (plies.empty()) error(card, "MID1", fmt::format("{} has no layers", whose));
  for (std::size_t k = 0; k < plies.size(); ++k) {
    if (plies[k].mid == 0) error(card, "MID1", fmt::format("layer {} of {} has no material", k + 1, whose));
    if (!(plies[k].thickness > 0))
      error(card, "THICK1", fmt::format("layer {} of {} has no thickness", k + 1, whose));
  }
}

void ModelBuilder::build_particles() {
  const auto& cards = deck_.all<ElementSphCard>();
  model_.sph.reserve(cards.size());
  for (const ElementSphCard& card : cards) {
    const Index p = part(card, "PID", card.pid);
    if (card.mass == 0)
      error(card, "MASS", "the particle has no mass", "give a mass > 0, or a volume as a negative number");
    if (card.nend != 0 && card.nend < card.nid)
      error(card, "NEND", fmt::format("expected an id not below NID = {}, got '{}'", card.nid, card.nend));
    if (p < 0) continue;
    model_.parts[static_cast<std::size_t>(p)].has_sph = true;
    const Id last = std::max(card.nid, card.nend);
    const int before = errors_;
    // a faulty range may name millions of nodes: the first missing one is enough. Nor need more particles
    // than nodes be kept: some node has two of them, which check_shared_nodes says
    for (Id nid = card.nid; nid <= last && errors_ == before && model_.sph.size() <= model_.nodes.size();
         ++nid)
      add_particle(card, nid, p);
  }
}

void ModelBuilder::add_particle(const ElementSphCard& card, Id nid, Index p) {
  const Index n = node(card, "NID", nid);
  if (n < 0) return;
  model_.sph.push_back({.node = n, .part = p, .mass = card.mass, .card = card});
}

void ModelBuilder::build_shells() {
  const auto& cards = deck_.all<ElementShellCard>();
  const auto& composites = deck_.all<ElementShellCompositeCard>();
  shell_cards_.reserve(cards.size() + composites.size());
  model_.shells.reserve(cards.size() + composites.size());
  for (const ElementShellCard& card : cards) {
    const Index s = add_shell(card);
    if (s < 0) continue;
    if (card.has_thickness()) model_.shell_thickness[s] = {card.thic1, card.thic2, card.thic3, card.thic4};
    if (card.has_beta()) model_.shell_beta[s] = card.beta;
    if (card.has_offset()) model_.shell_offset[s] = card.offset;
  }
  build_layered_shells(composites);
  shell_cards_ = {};
}

/// Its index; -1: it has a fault.
Index ModelBuilder::add_shell(const ElementShellCard& card) {
  const auto [it, is_new] = shell_cards_.try_emplace(card.eid, &card);
  if (!is_new) duplicate(card, "EID", "shell", card.eid, deck_.where(*it->second));
  ModelShell shell;
  shell.id = card.eid;
  shell.part = part(card, "PID", card.pid);
  shell.node = {node(card, "N1", card.n1), node(card, "N2", card.n2), node(card, "N3", card.n3),
                card.n4 == 0 ? 0 : node(card, "N4", card.n4)};
  if (card.n4 == 0) shell.node[3] = shell.node[2];
  if (shell.part < 0 || *std::min_element(shell.node.begin(), shell.node.end()) < 0) return -1;
  if (!normalise_corners(shell.node) || !has_area(model_.nodes, shell.node)) {
    error(card, "EID", fmt::format("shell {} has no area", card.eid),
          "its corners must be three or four points that are not on one line");
    return -1;
  }
  ModelPart& p = model_.parts[static_cast<std::size_t>(shell.part)];
  if (p.has_sph && !p.has_shell)
    error(card, "PID", fmt::format("part {} has particles already", p.id),
          "give the shells a part of their own");
  p.has_shell = true;
  model_.shells.push_back(shell);
  return static_cast<Index>(model_.shells.size()) - 1;
}

void ModelBuilder::build_layered_shells(const std::vector<ElementShellCompositeCard>& cards) {
  std::map<std::pair<Index, std::vector<Real>>, Index> known;  // by part and what its layers are
  for (const ElementShellCompositeCard& card : cards) {
    const Index s = add_shell(card);
    if (s < 0) continue;
    if (card.has_offset()) model_.shell_offset[s] = card.offset;
    std::vector<ModelPly> plies = card.plies();
    std::pair<Index, std::vector<Real>> key{model_.shells[static_cast<std::size_t>(s)].part, {}};
    for (const ModelPly& ply : plies)
      key.second.insert(key.second.end(), {static_cast<Real>(ply.mid), ply.thickness, ply.angle});
    const auto [found, is_new] = known.try_emplace(std::move(key), static_cast<Index>(model_.layups.size()));
    model_.shell_layup[s] = found->second;
    if (!is_new) continue;
    check_plies(card, plies, fmt::format("shell {}", card.eid));
    model_.layups.push_back({found->first.first, std::move(plies), card});
  }
}

void ModelBuilder::check_shared_nodes() {
  constexpr Index nobody = -1;
  std::vector<Index> owner(model_.nodes.size(), nobody);
  for (std::size_t i = 0; i < model_.sph.size(); ++i) {
    Index& o = owner[static_cast<std::size_t>(model_.sph[i].node)];
    if (o == nobody) {
      o = static_cast<Index>(i);
      continue;
    }
    if (++errors_ > max_errors) continue;
    const Id id = model_.nodes[static_cast<std::size_t>(model_.sph[i].node)].id;
    diagnostics_.error(deck_.where(model_.sph[i].card),
                       fmt::format("*ELEMENT_SPH: node {} is used by two particles, first at {}", id,
                                   deck_.place(model_.sph[static_cast<std::size_t>(o)].card)));
  }
  std::vector<bool> told(model_.nodes.size(), false);
  for (const ModelShell& shell : model_.shells) {
    for (const Index n : shell.node) {
      const Index o = owner[static_cast<std::size_t>(n)];
      if (o == nobody || told[static_cast<std::size_t>(n)]) continue;
      told[static_cast<std::size_t>(n)] = true;
      if (++errors_ > max_errors) continue;
      diagnostics_.error(deck_.where(model_.sph[static_cast<std::size_t>(o)].card),
                         fmt::format("*ELEMENT_SPH: node {} is also a corner of shell {}",
                                     model_.nodes[static_cast<std::size_t>(n)].id, shell.id),
                         "give the particle a node of its own");
    }
  }
  check_shared_nodes_of_solids(owner, told);
}

}  // namespace courant
