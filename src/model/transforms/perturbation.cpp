// *PERTURBATION_NODE
#include <cmath>

#include "keyword/registry.hpp"
#include "model/model_builder.hpp"
#include "model/transforms/transform_cards.hpp"
#include "model/transforms/transformation.hpp"

namespace courant {

namespace {

/// AMPL 0 is 1 of the units of the deck, whatever units its file has.
KeywordTable perturbation_keyword() {
  KeywordTable out = perturbation_node_table();
  out.cards[1].fields[0].rules.standard = 0;
  return out;
}
const RegisterKeyword<PerturbationNodeCard> perturbation_node{perturbation_keyword()};

}  // namespace

std::string keep_perturbed_axes(PerturbationNodeCard& card, const Affine& motion) {
  if ((card.icoord == 1 && card.cid > 0) || motion.matrix() == Affine::Identity().matrix()) return {};
  return "its waves are those of coordinates, which a transformation of the file would change";
}

/// Waves of several keywords add up: all are of the coordinates before any of them.
void ModelBuilder::perturb_nodes() {
  const auto& cards = deck_.all<PerturbationNodeCard>();
  if (cards.empty()) return;
  std::vector<Vec> before;
  for (const ModelNode& node : model_.nodes) before.push_back(node.x);
  for (const PerturbationNodeCard& card : cards) {
    if (card.icoord == 1 && card.cid == 0)
      error(card, "CID", "ICOORD 1 needs a system", "give CID, or ICOORD 0");
    const CoordinateSystem* system =
        card.icoord == 0 || card.cid == 0 ? nullptr : coordinate_system(card, "CID", card.cid);
    const std::vector<Index>* members = card.nsid == 0 ? nullptr : node_set(card, "NSID", card.nsid);
    if ((card.icoord == 1 && !system) || (card.nsid != 0 && !members)) continue;
    if (card.cid != 0 && card.icoord == 0)
      deck_.warning(diagnostics_, card, "CID", "has no effect with ICOORD 0", "give ICOORD 1");
    const Vec length(card.xwl, card.ywl, card.zwl), offset(card.xoff, card.yoff, card.zoff);
    if (length == Vec::Zero())
      deck_.warning(diagnostics_, card, "XWL", "moves nothing: all wave lengths are 0",
                    "give a wave length along one direction");
    const Matrix axes = system ? system->axes : Matrix(Matrix::Identity());
    const Vec origin = system ? system->origin : Vec(Vec::Zero());
    Vec direction = Vec::Zero();
    for (int k = 0; k < 3; ++k)
      if (axes_of_code(card.cmp)[static_cast<std::size_t>(k)]) direction += axes.col(k);
    const auto move = [&](std::size_t n) {
      const Vec x = axes.transpose() * (before[n] - origin) + offset;
      Real wave = 0;
      for (int k = 0; k < 3; ++k)
        if (length[k] != 0) wave += std::sin(2 * pi * x[k] / length[k]);
      model_.nodes[n].x += card.scl * (card.ampl == 0 ? 1 : card.ampl) * wave * direction;
    };
    if (members)
      for (const Index n : *members) move(static_cast<std::size_t>(n));
    else
      for (std::size_t n = 0; n < model_.nodes.size(); ++n) move(n);
  }
}

}  // namespace courant
