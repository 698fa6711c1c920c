// How far nodes are from their positions in the deck, in the field files of scenes with elements.
#include <unordered_map>
#include <vector>

#include "extension/additions.hpp"
#include "state/reports.hpp"

namespace courant {

namespace {

class Displacement : public Pass, public FieldFiller {
 public:
  Displacement(const Model& model, World& world)
      : to_(world.nodes.fields.add<Real>(
            {.name = "displacement", .dimension = "L", .components = 3, .output = true, .restart = false})) {
    std::unordered_map<Id, const ModelNode*> of_id;
    for (const ModelNode& node : model.nodes) of_id.emplace(node.id, &node);
    for (Index n = 0; n < world.nodes.size(); ++n) {
      const auto node = of_id.find(world.nodes.id[n]);
      start_.push_back(node == of_id.end() ? world.nodes.x.vec(n) : node->second->x);
    }
  }
  std::string name() const override { return "displacement of nodes"; }
  void fill_fields(World& world) override {
    for (Index n = 0; n < world.nodes.size(); ++n)
      to_.set(n, world.nodes.x.vec(n) - start_[static_cast<std::size_t>(n)]);
  }

 private:
  Field<Real>& to_;
  std::vector<Vec> start_;  ///< [L]
};

const RegisterAddition displacement{
    "displacement of nodes", [](const Deck&, const Model& model, World& world, Diagnostics&) {
      const bool shown = model.output.d3plot.asked() || model.output.d3plot_count > 0;
      if (shown && !world.groups.empty()) world.passes.add(std::make_shared<Displacement>(model, world));
    }};

}  // namespace

}  // namespace courant
