// *BOUNDARY_SPC and TC of *NODE.
#include "loads/loads.hpp"
#include "state/reports.hpp"
#include "state/shared_fields.hpp"
#include "state/tied_mass.hpp"

namespace courant {

namespace {

/// Which directions the deck holds of a node of the model.
std::array<bool, 3> held_by_deck(const Model& model, Index node, const Points& points) {
  if (!points.turns) return model.nodes[static_cast<std::size_t>(node)].fixed;
  const auto held = model.held_rotations.find(node);
  return held == model.held_rotations.end() ? std::array<bool, 3>{} : held->second;
}

/// Neither force nor velocity along the fixed directions.
class FixedPoints : public Constraint, public BoundaryForceReporter {
 public:
  /// `node`: of each point, index into Model::nodes.
  FixedPoints(const Model& model, std::span<const Index> node, Points points, bool measured)
      : points_(points), fixed_(points.held().add(*points.set)) {
    for (Index i = 0; i < points.set->size(); ++i) {
      const Index n = node[static_cast<std::size_t>(i)];
      if (n < 0 || (points.follow && (*points.follow)[i])) continue;
      const std::array<bool, 3> fixed = held_by_deck(model, n, points);
      fixed_[i] = fixed[0] + 2 * fixed[1] + 4 * fixed[2];
      for (int k = 0; k < 3; ++k)  // outside the box, too, where the pass below does not come
        if (fixed_[i] & (1 << k)) points.v->data(k)[i] = 0;
    }
    if (measured || model.output.history("spcforc").asked())
      support_ =
          &(points.turns ? shared_fields::support_moment : shared_fields::support_force).add(*points.set);
  }
  std::string name() const override { return "fixed " + points_.name() + " (SPC)"; }
  const FieldSet& over(const World&) const override { return points_.fields(); }
  void declare(const World&, Accesses& a) const override {
    a.reads(fixed_).revises(*points_.f).updates(*points_.v);
    if (support_) a.writes(*support_);
  }
  void block(World&, const Clock&, Index begin, Index end) override {
    if (support_)
      for (Index i = begin; i < end; ++i)
        for (int k = 0; k < 3; ++k)
          support_->data(k)[i] = fixed_[i] & (1 << k) ? 0 - points_.f->data(k)[i] : 0;
    for (Index i = begin; i < end; ++i)
      for (int k = 0; k < 3; ++k)
        if (fixed_[i] & (1 << k)) points_.f->data(k)[i] = points_.v->data(k)[i] = 0;
  }
  void report_forces(const World& world, const Clock&, std::vector<BoundaryForce>& out) const override {
    if (!support_) return;
    for (Index i = 0; i < loaded_points(points_, world); ++i)
      if (fixed_[i] != 0) out.push_back(reaction(i));
  }

 private:
  BoundaryForce reaction(Index i) const {
    const Id id = (*points_.id)[i];
    if (points_.turns) return {BoundaryForce::Kind::held_rotation, id, Vec::Zero(), support_->vec(i), 0};
    return {BoundaryForce::Kind::held_point, id, support_->vec(i), Vec::Zero(), 0};
  }

  Points points_;
  Field<Index>& fixed_;
  Field<Real>* support_ = nullptr;  ///< null: not needed
};

}  // namespace

std::shared_ptr<Constraint> make_fixed_points(const Model& model, Points points, World& world,
                                              bool measured) {
  const std::vector<Index> node = model_nodes(model, world, points);
  const auto is_fixed = [&](std::size_t i) {
    if (node[i] < 0 || (points.follow && (*points.follow)[static_cast<Index>(i)])) return false;
    const std::array<bool, 3> fixed = held_by_deck(model, node[i], points);
    return fixed[0] || fixed[1] || fixed[2];
  };
  for (std::size_t i = 0; i < node.size(); ++i)
    if (is_fixed(i)) return std::make_shared<FixedPoints>(model, node, points, measured);
  return nullptr;
}

}  // namespace courant
