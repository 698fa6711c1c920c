// *NODE_TRANSFORM, *PART_MOVE
#include <fmt/format.h>
#include <cmath>

#include "model/model_builder.hpp"
#include "model/transforms/transformation.hpp"

namespace courant {

namespace {

/// Where a transformation asks for the positions of nodes it matters when nodes are moved.
bool any_names_nodes(const Deck& deck) {
  for (const DefineTransformationCard& card : deck.all<DefineTransformationCard>())
    if (card.names_nodes()) return true;
  return false;
}

}  // namespace

/// A node that several parts of a set share moves once; those of one part that another part has, too, take
/// the edge of that one with them.
void ModelBuilder::move_parts() {
  for (const PartMoveCard& card : deck_.all<PartMoveCard>()) {
    std::vector<Index> parts;
    if (card.ifset == 1) {
      if (const std::vector<Index>* members = part_set(card, "PID", card.pid)) parts = *members;
    } else if (const Index one = part(card, "PID", card.pid); one >= 0) {
      parts = {one};
    }
    for (const Index n : nodes_of_parts(parts))
      model_.nodes[static_cast<std::size_t>(n)].x += Vec(card.xmov, card.ymov, card.zmov);
  }
}

/// In deck order. Numbers of a transformation count in the frame of the file that asks for the motion: if
/// that file is moved itself, so is the motion.
void ModelBuilder::move_nodes() {
  const auto& cards = deck_.all<NodeTransformCard>();
  if (cards.empty()) return;
  std::vector<bool> is_particle(model_.nodes.size(), false);
  for (const ModelSph& sph : model_.sph) is_particle[static_cast<std::size_t>(sph.node)] = true;
  for (const NodeTransformCard& card : cards) {
    const Affine* own = find_transformation(deck_, card.trsid);
    const std::vector<Index>* members = node_set(card, "NSID", card.nsid);
    if (!own) error(card, "TRSID", fmt::format("transformation {} does not exist", card.trsid));
    if (card.immed == 1 && any_names_nodes(deck_))
      error(card, "IMMED", "'1' is not supported where a transformation names nodes",
            "give transformations by points, or move these nodes last (IMMED 0)");
    if (!own || !members) continue;
    const Affine frame = motion_of_file(deck_, deck_.files[static_cast<std::size_t>(card.file)]);
    const Affine motion = frame * *own * frame.inverse();
    const bool stretches = !keeps_lengths(motion);
    for (const Index n : *members) {
      ModelNode& node = model_.nodes[static_cast<std::size_t>(n)];
      node.x = motion * node.x;
      if (!stretches || !is_particle[static_cast<std::size_t>(n)]) continue;
      error(card, "NSID",
            fmt::format("node {} of the set is a particle, and the transformation stretches, which leaves "
                        "open what becomes of masses",
                        node.id),
            "move particles without scaling them");
      break;
    }
  }
}

}  // namespace courant
