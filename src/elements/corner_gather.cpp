#include "elements/corner_gather.hpp"

#include <vector>

namespace courant {

namespace {

/// Elements write forces of their corners to places of their own; nobody adds to a node but the thread that
/// has its block.
class CornerGather : public Force {
 public:
  explicit CornerGather(const World& world) : first_(static_cast<std::size_t>(world.nodes.size()) + 1, 0) {
    const auto for_each_corner = [&](auto&& f) {
      for (std::size_t g = 0; g < world.groups.size(); ++g) {
        const ElementGroup& group = *world.groups[g];
        for (Index e = 0; e < group.size(); ++e)
          for (int c = 0; c < group.corners(); ++c)
            f(static_cast<std::size_t>(group.node.data(c)[e]),
              Corner{e, static_cast<std::int16_t>(g), static_cast<std::int16_t>(c)});
      }
    };
    for_each_corner([&](std::size_t node, const Corner&) { ++first_[node + 1]; });
    for (std::size_t n = 1; n < first_.size(); ++n) first_[n] += first_[n - 1];
    corners_.resize(static_cast<std::size_t>(first_.back()));
    std::vector<Index> next(first_.begin(), first_.end() - 1);
    for_each_corner([&](std::size_t node, const Corner& corner) {
      corners_[static_cast<std::size_t>(next[node]++)] = corner;
    });
  }
  std::string name() const override { return "corner forces"; }
  const FieldSet& over(const World& world) const override { return world.nodes.fields; }
  void declare(const World& world, Accesses& a) const override {
    a.updates(world.nodes.f);
    for (const auto& group : world.groups) a.reads(group->corner_force, Reach::others);
  }

  void start(World& world, const Clock&) override {
    force_.clear(), base_.clear();
    for (const auto& group : world.groups) {
      base_.push_back(force_.size());
      for (int k = 0; k < 3 * group->corners(); ++k) force_.push_back(group->corner_force.data(k));
    }
  }
  void block(World& world, const Clock&, Index begin, Index end) override {
    Real* const f[3] = {world.nodes.f.data(0), world.nodes.f.data(1), world.nodes.f.data(2)};
    for (Index n = begin; n < end; ++n) {
      Real sum[3] = {0, 0, 0};
      for (Index k = first_[static_cast<std::size_t>(n)]; k < first_[static_cast<std::size_t>(n) + 1]; ++k) {
        const Corner& corner = corners_[static_cast<std::size_t>(k)];
        const Real* const* of =
            force_.data() + base_[static_cast<std::size_t>(corner.group)] + 3 * corner.corner;
        for (int c = 0; c < 3; ++c) sum[c] += of[c][corner.element];
      }
      for (int c = 0; c < 3; ++c) f[c][n] += sum[c];
    }
  }

 private:
  struct Corner {
    Index element;
    std::int16_t group, corner;
  };
  std::vector<Index> first_;     ///< of each node, and the end
  std::vector<Corner> corners_;  ///< those of a node one after the other
  std::vector<const Real*> force_;
  std::vector<std::size_t> base_;  ///< where the components of a group begin in force_
};

}  // namespace

std::shared_ptr<Force> make_corner_gather(const World& world) {
  return std::make_shared<CornerGather>(world);
}

}  // namespace courant
