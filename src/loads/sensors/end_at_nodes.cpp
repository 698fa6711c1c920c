// *TERMINATION_NODE, _DELETED_SHELLS and _DELETED_SOLIDS: ends of runs by what nodes and elements do.
#include <fmt/format.h>

#include <algorithm>

#include "extension/additions.hpp"
#include "keyword/registry.hpp"
#include "loads/load_cards.hpp"
#include "state/ending.hpp"
#include "state/shared_fields.hpp"

namespace courant {

namespace {

constexpr Real nowhere = 1e21;

const RegisterKeyword<TerminationNode> termination_node{termination_node_table()};

class EndAtNode : public Ending {
 public:
  EndAtNode(const TerminationNode& card, Index node) : card_(card), node_(node) {}
  std::string name() const override { return "end at a node"; }
  std::optional<std::string> ended(const World& world, const Clock&) const override {
    const int k = card_.stop - 1;
    const Real x = world.nodes.x.vec(node_)[k];
    const bool above = x >= card_.maxc;
    if (!above && x > card_.minc) return std::nullopt;
    return fmt::format("node {}: {} = {:.6g} has come to {} = {:.6g} of *TERMINATION_NODE", card_.nid,
                       "xyz"[k], x, above ? "MAXC" : "MINC", above ? card_.maxc : card_.minc);
  }

 private:
  TerminationNode card_;
  Index node_;
};

const RegisterAddition end_at_node{
    "*TERMINATION_NODE", [](const Deck& deck, const Model&, World& world, Diagnostics& diagnostics) {
      for (const TerminationNode& card : deck.all<TerminationNode>()) {
        Index node = 0;
        while (node < world.nodes.size() && world.nodes.id[node] != card.nid) ++node;
        if (node == world.nodes.size()) {
          deck.error(diagnostics, card, "NID", fmt::format("node {} belongs to no element or body", card.nid),
                     "take a corner of a shell or solid, or a node of a rigid body");
          continue;
        }
        const auto pass = std::make_shared<EndAtNode>(card, node);
        if (const auto why = pass->ended(world, {}))
          deck.error(diagnostics, card, "STOP", *why + " already at the start",
                     "a blank field is no bound; 0 is the coordinate 0");
        world.passes.add(pass);
      }
    }};

const RegisterKeyword<TerminationDeleted> termination_deleted{termination_deleted_shells_table()};

class EndAtDeletions : public Ending {
 public:
  EndAtDeletions(const TerminationDeleted& card, Index part) : card_(card), part_(part) {}
  std::string name() const override { return "end at deletions"; }
  std::optional<std::string> ended(const World& world, const Clock&) const override {
    Id gone = 0;
    for (const auto& group : world.groups)
      if (const auto* eroded = group->part == part_ ? shared_fields::eroded.find(group->fields) : nullptr)
        gone += std::count(eroded->data(), eroded->data() + group->size(), shared_fields::deleted);
    if (gone < card_.nds) return std::nullopt;
    return fmt::format("part {}: {} elements are deleted, NDS = {} of *TERMINATION_DELETED_{}", card_.pid,
                       gone, card_.nds, card_.name == 0 ? "SHELLS" : "SOLIDS");
  }

 private:
  TerminationDeleted card_;
  Index part_;
};

const RegisterAddition end_at_deletions{
    "*TERMINATION_DELETED", [](const Deck& deck, const Model& model, World& world, Diagnostics& diagnostics) {
      for (const TerminationDeleted& card : deck.all<TerminationDeleted>()) {
        const char* what = card.name == 0 ? "shells" : "solids";
        const auto part = model.part_of_id.find(card.pid);
        Index elements = 0, may_fail = 0;
        for (const auto& group : world.groups) {
          if (part == model.part_of_id.end() || group->part != part->second) continue;
          if ((group->segment != nullptr) != (card.name == 0) || group->corners() < 3) continue;
          elements += group->size();
          if (shared_fields::eroded.find(group->fields)) may_fail += group->size();
        }
        if (elements < card.nds) {
          deck.error(diagnostics, card, elements == 0 ? "PID" : "NDS",
                     fmt::format("part {} has {} {} that deform", card.pid, elements, what),
                     "name a part with so many of them");
        } else if (may_fail == 0) {
          deck.warning(diagnostics, card, "PID",
                       fmt::format("{} of part {} never fail: it does nothing", what, card.pid),
                       "give their material a criterion of failure");
        } else {
          world.passes.add(std::make_shared<EndAtDeletions>(card, part->second));
        }
      }
    }};

}  // namespace

/// Coordinates belong to the deck, not to the nodes of a file.
std::string keep_coordinate(TerminationNode&, const Affine& motion) {
  if (motion.matrix().isApprox(Affine::Identity().matrix(), 1e-12)) return {};
  return "its coordinates do not move with a file that is moved";
}

}  // namespace courant
