#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "elements/beam/two_node_forces.hpp"
#include "elements/discrete_beam/cables.hpp"

namespace courant {

namespace {

/// Cables of a part: length since the last motion, the law, forces on the ends.
class CableForces : public TwoNodeForces {
 public:
  CableForces(const CablePart& part, ElementGroup& group, Id part_id, Real tssfac, ElementOptions& options,
              World& world)
      : TwoNodeForces(group, part_id, tssfac, "cable"),
        law_(part.law),
        area_(part.area),
        reference_(part.rest),
        rest_(add("rest_length", "L", 1, false)),
        length_(add("length", "L", 1, false)),
        force_(add("axial_force", "ML/T2", 1, true)) {
    for (Index e = 0; e < group_.size(); ++e) {
      rest_[e] = reference_[at(e)], length_[e] = between_ends(world, e).norm();
      // what it holds from the start is there without work
      force_[e] = pull(e, 0, length_[e]);
      if (law_.F0 == 0) energy_[e] = start_energy(e);
    }
    if (law_.most_strain < CableLaw::never || law_.most_force < CableLaw::never)
      may_fail(force_, options, world);
  }
  void declare(const World& world, Accesses& a) const override {
    a.reads(world.nodes.x, Reach::others).reads(group_.node).reads(group_.mass);
    a.updates(rest_).updates(length_).updates(force_).updates(energy_).writes(*group_.corner_force);
    if (erosion_) erosion_->declare(world, a);
  }

  Real cut_measure(Index e) const override { return area_[at(e)]; }
  bool bends() const override { return false; }
  ElementReport report_element(const World&, Index e, const ElementReportOptions&) const override {
    return {.deleted = dead(e), .resultants = {force_[e]}};
  }

 private:
  Vec between_ends(const World& world, Index e) const {
    return world.nodes.x.vec(group_.node.data(1)[e]) - world.nodes.x.vec(group_.node.data(0)[e]);
  }
  /// K belongs to the length at the start, whatever the preload has made of it.
  Real pull(Index e, Real t, Real length) const {
    if (law_.holds(t)) return law_.preload(t);
    return std::max(law_.F0 + law_.answer(area_[at(e)], reference_[at(e)], length - rest_[e]), Real(0));
  }
  /// What an elongation at the start has taken.
  Real start_energy(Index e) const {
    constexpr int parts = 1000;  // curves may have corners
    const Real dL = length_[e] - rest_[e];
    Real work = 0;
    for (int k = 0; k < parts; ++k)
      work += dL / parts * pull(e, law_.held_until, rest_[e] + dL * (k + 0.5) / parts);
    return law_.held_until > 0 ? 0 : work;
  }

  /// Of an elongation to `length`, where the force is F: along the law, which has a corner where the cable
  /// becomes slack. The trapezoidal rule over that corner would hide energy that too long steps create.
  Real work(Index e, Real t, Real length, Real F) const {
    const Real before = force_[e];
    if ((before > 0) == (F > 0) || law_.holds(t)) return 0.5 * (before + F) * (length - length_[e]);
    Real slack = before > 0 ? length : length_[e], taut = before > 0 ? length_[e] : length;
    const Real from = taut;
    constexpr int halvings = 50;
    for (int k = 0; k < halvings; ++k) {
      const Real middle = 0.5 * (slack + taut);
      (pull(e, t, middle) > 0 ? taut : slack) = middle;
    }
    const Real stored = 0.5 * std::max(before, F) * std::abs(from - taut);
    return before > 0 ? -stored : stored;
  }

  void advance(const World& world, const Clock& clock, Index begin, Index e) override {
    const Vec between = between_ends(world, e);
    const Real length = between.norm();
    const Real F = pull(e, clock.t, length);
    if (law_.holds(clock.t)) rest_[e] = length;
    energy_[e] += work(e, clock.t, length, F);
    force_[e] = F, length_[e] = length;
    const Vec along = length > 0 ? Vec(between / length) : Vec(Vec::Zero());
    for (int k = 0; k < 3; ++k)
      group_.corner_force->data(k)[e] = F * along[k], group_.corner_force->data(3 + k)[e] = -F * along[k];
    // alone, with half its mass at each end: along itself, and across itself as stiff as F over its length
    const Real across = length > 0 ? F / length : 0;
    steps_[at(e)] = std::sqrt(group_.mass[e] / (law_.steepest(area_[at(e)], reference_[at(e)]) + across));
    look_for_failure(begin, e);
  }
  void look_for_failure(Index begin, Index e) const {
    if (!erosion_) return;
    const Real strain = (length_[e] - rest_[e]) / reference_[at(e)];
    if (strain > law_.most_strain)
      erosion_->fail(begin, e, fmt::format("strain {:.4g}", strain));
    else if (force_[e] > law_.most_force)
      erosion_->fail(begin, e, fmt::format("force {:.4g}", force_[e]));
  }

  CableLaw law_;
  std::vector<Real> area_, reference_;
  Field<Real>& rest_;  ///< length at which dL is 0
  Field<Real>&length_, &force_;
};

}  // namespace

void build_cables(const Model& model, const std::vector<CablePart>& parts, const std::vector<Index>& node_of,
                  ElementOptions& options, World& world) {
  for (const CablePart& part : parts) {
    const ModelPart& of_model = model.parts[static_cast<std::size_t>(part.part)];
    if (part.beams.empty()) continue;
    FieldSet& set = world.add_set(fmt::format("beams of part {}", of_model.id));
    set.resize(static_cast<Index>(part.beams.size()));
    ElementGroup& group = *world.groups.emplace_back(std::make_unique<ElementGroup>(set, part.part, 2));
    for (Index e = 0; e < group.size(); ++e) {
      const auto k = static_cast<std::size_t>(e);
      const ModelBeam& beam = *part.beams[k];
      group.id[e] = beam.id, group.mass[e] = part.mass[k], group.V0[e] = part.mass[k] / part.law.ro;
      for (int c = 0; c < 2; ++c) {
        const Index n = node_of[static_cast<std::size_t>(beam.node[static_cast<std::size_t>(c)])];
        group.node.data(c)[e] = n;
        world.nodes.m[n] += part.mass[k] / 2;
      }
    }
    world.passes.add(std::make_shared<CableForces>(part, group, of_model.id, model.tssfac, options, world));
  }
}

}  // namespace courant
