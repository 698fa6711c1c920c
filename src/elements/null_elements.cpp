#include "elements/null_elements.hpp"

#include "state/reports.hpp"

namespace courant {

namespace {

class NullElements : public Pass, public PartReporter {
 public:
  explicit NullElements(const ElementGroup& group) : group_(group) {}
  std::string name() const override { return group_.fields.name(); }
  void report_part(const World& world, std::vector<PartSums>& parts) const override {
    PartSums& out = parts[static_cast<std::size_t>(group_.part)];
    for (Index e = 0; e < group_.size(); ++e) {
      out.mass += group_.mass[e];
      for (int c = 0; c < group_.corners(); ++c) {
        const Real m = group_.mass[e] / group_.corners();
        const Vec v = world.nodes.v.vec(group_.node.data(c)[e]);
        out.momentum += m * v, out.kinetic += 0.5 * m * v.squaredNorm();
      }
    }
  }

 private:
  const ElementGroup& group_;
};

}  // namespace

std::shared_ptr<Pass> make_null_elements(const ElementGroup& group) {
  return std::make_shared<NullElements>(group);
}

}  // namespace courant
