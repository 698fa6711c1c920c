#include "rigid/bodies/merge.hpp"
#include "rigid/bodies/rigid_cards.hpp"

#include <fmt/format.h>

#include "keyword/registry.hpp"
#include "rigid/bodies/nodal_bodies.hpp"
#include "rigid/switches/deformable_to_rigid.hpp"

namespace courant {

namespace {

const RegisterKeyword<RigidBodiesCard> rigid_bodies_keyword{constrained_rigid_bodies_table()};

class MergeReader {
 public:
  MergeReader(const Deck& deck, const Model& model, Diagnostics& diagnostics)
      : deck_(deck), model_(model), diagnostics_(diagnostics) {}

  void add(const Entry& card, const char* lead_field, Id lead_id, const char* field, Id id, bool counts) {
    const Index lead = rigid_part(card, lead_field, lead_id), part = rigid_part(card, field, id);
    if (lead < 0 || part < 0) return;
    if (lead == part)
      return error(card, field, fmt::format("part {} cannot be merged into itself", id), "name another part");
    if (const auto before = merges_.find(part); before != merges_.end())
      return error(card, field,
                   fmt::format("part {} is merged into part {} already, {}", id, id_of(before->second.lead),
                               deck_.place(before->second.card)),
                   "merge a part once; leads may be merged themselves");
    for (Index k = lead; merges_.contains(k); k = merges_.at(k).lead)
      if (merges_.at(k).lead == part)
        return error(
            card, lead_field,
            fmt::format("part {} is merged into part {}, so the merges would form a ring", lead_id, id),
            "one part of the body must be merged into no other");
    merges_[part] = {lead, counts, card};
  }
  /// Parts that *DEFORMABLE_TO_RIGID alone makes rigid move with the rigid parts that they share nodes with.
  void join_switched() {
    std::map<Index, Index> first_part;  // of each node of rigid parts
    const auto join = [&](Index part, const auto& corners) {
      if (!model_.parts[static_cast<std::size_t>(part)].rigid) return;
      for (const Index n : corners)
        if (const auto [at, is_new] = first_part.try_emplace(n, part); !is_new) meet(at->second, part, n);
    };
    for (const ModelShell& shell : model_.shells) join(shell.part, shell.node);
    for (const ModelSolid& solid : model_.solids) join(solid.part, solid.corners());
  }
  BodyMerges finish() { return BodyMerges(std::move(merges_)); }

 private:
  void error(const Entry& card, const char* field, std::string message, std::string hint) {
    deck_.error(diagnostics_, card, field, std::move(message), std::move(hint));
  }
  Id id_of(Index part) const { return model_.parts[static_cast<std::size_t>(part)].id; }
  /// Index of a rigid part; -1 where it is none.
  Index rigid_part(const Entry& card, const char* field, Id id) {
    const auto part = model_.part_of_id.find(id);
    if (nodal_body_ids(deck_, model_).contains(id))
      error(card, field, fmt::format("{} is a rigid body of nodes, which cannot be merged with parts", id),
            "let its nodes go with the part by *CONSTRAINED_EXTRA_NODES_SET instead");
    else if (part == model_.part_of_id.end())
      error(card, field, fmt::format("part {} does not exist", id), "define it with *PART");
    else if (!model_.parts[static_cast<std::size_t>(part->second)].rigid)
      error(card, field, fmt::format("part {} is no rigid body", id), "its material must be a *MAT_RIGID");
    else
      return part->second;
    return -1;
  }

  Index last_lead(Index part) const {
    while (merges_.contains(part)) part = merges_.at(part).lead;
    return part;
  }
  /// Two rigid parts share a node. Of a switched one and another, the other leads; of two, the first.
  void meet(Index a, Index b, Index node) {
    a = last_lead(a), b = last_lead(b);
    if (a == b) return;
    const Entry *of_a = switched_alone(deck_, id_of(a)), *of_b = switched_alone(deck_, id_of(b));
    const bool a_is_made = of_a && !is_rigid_material(a), b_is_made = of_b && !is_rigid_material(b);
    if (!a_is_made && !b_is_made) return;  // the builder of bodies refuses that
    const bool b_leads = a_is_made && (!b_is_made || b < a);
    const Index lead = b_leads ? b : a, part = b_leads ? a : b;
    const Entry& card = b_leads ? *of_a : *of_b;
    deck_.warning(
        diagnostics_, card, "LRB",
        fmt::format("part {} shares node {} with rigid part {}: the two move as one body, with the "
                    "name and the constraints of part {}",
                    id_of(part), model_.nodes[static_cast<std::size_t>(node)].id, id_of(lead), id_of(lead)),
        fmt::format("LRB {} says the same without this warning", id_of(lead)));
    merges_[part] = {lead, true, card};
  }
  bool is_rigid_material(Index part) const {
    return mat_rigid_of(deck_, model_.parts[static_cast<std::size_t>(part)].mid) != nullptr;
  }

  const Deck& deck_;
  const Model& model_;
  Diagnostics& diagnostics_;
  std::map<Index, Merge> merges_;
};

}  // namespace

Index BodyMerges::lead(Index part) const {
  while (merged(part)) part = of(part).lead;
  return part;
}

std::vector<Index> BodyMerges::group(Index first) const {
  std::vector<Index> out{first};
  for (const auto& [part, merge] : merges_)
    if (lead(part) == first) out.push_back(part);
  return out;
}

bool BodyMerges::counts(Index part, const std::set<Index>& given) const {
  for (; merged(part); part = of(part).lead)
    if (given.contains(of(part).lead) && !of(part).counts) return false;
  return true;
}

BodyMerges body_merges(const Deck& deck, const Model& model, Diagnostics& diagnostics) {
  MergeReader reader(deck, model, diagnostics);
  for (const RigidBodiesCard& card : deck.all<RigidBodiesCard>())
    reader.add(card, "PIDL", card.pidl, "PIDC", card.pidc, card.iflag == 1);
  for (const SwitchedLead& one : switched_leads(deck, model))
    reader.add(one.card, "LRB", one.lead, "PID", one.part, true);
  reader.join_switched();
  return reader.finish();
}

}  // namespace courant
