#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "elements/beam/cables.hpp"
#include "elements/element_report.hpp"
#include "state/reports.hpp"

namespace courant {

namespace {

/// Cables of a part: length since the last motion, the law, forces on the ends, which a pass over the nodes
/// gathers.
class CableForces : public Material,
                    public TimeLimit,
                    public EnergyTerm,
                    public PartReporter,
                    public ElementReporter {
 public:
  CableForces(const CablePart& part, ElementGroup& group, Id part_id, Real tssfac, ElementOptions& options,
              World& world)
      : law_(part.law),
        area_(part.area),
        reference_(part.rest),
        group_(group),
        part_id_(part_id),
        tssfac_(tssfac),
        rest_(add("rest_length", "L", false)),
        length_(add("length", "L", false)),
        force_(add("axial_force", "ML/T2", true)),
        energy_(add("internal_energy", "ML2/T2", true)),
        steps_(area_.size()) {
    for (Index e = 0; e < group_.size(); ++e) {
      rest_[e] = reference_[at(e)], length_[e] = between_ends(world, e).norm();
      // what it holds from the start is there without work
      force_[e] = pull(e, 0, length_[e]);
      if (law_.F0 == 0) energy_[e] = start_energy(e);
    }
    if (law_.most_strain < CableLaw::never || law_.most_force < CableLaw::never) {
      erosion_ = std::make_shared<Erosion>(FailureRules{}, group_, 1,
                                           Erosion::Energies{&energy_, nullptr, nullptr}, world);
      erosion_->vanishes(force_);
      options.eroding.push_back(erosion_);
    }
  }
  std::string name() const override { return group_.fields.name(); }
  const FieldSet& over(const World&) const override { return group_.fields; }
  void declare(const World& world, Accesses& a) const override {
    a.reads(world.nodes.x, Reach::others).reads(group_.node).reads(group_.mass);
    a.updates(rest_).updates(length_).updates(force_).updates(energy_).writes(*group_.corner_force);
    if (erosion_) erosion_->declare(world, a);
  }

  void block(World& world, const Clock& clock, Index begin, Index end) override {
    if (erosion_) erosion_->begin_block(begin, end - begin);
    for (Index e = begin; e < end; ++e) advance(world, clock, begin, e);
    if (!erosion_) return;
    std::array<Real, block_size> unused{};
    erosion_->judge(begin, end - begin, tssfac_, steps_.data() + begin, unused.data(), nullptr);
  }

  Limit limit(const World&, const Clock&) override {
    std::size_t least = 0;
    for (std::size_t e = 0; e < steps_.size(); ++e)
      if (!std::isnan(steps_[least]) && !(steps_[e] >= steps_[least])) least = e;
    return {tssfac_ * steps_[least],
            fmt::format("cable {} of part {}", group_.id[static_cast<Index>(least)], part_id_)};
  }
  void record(World&, const Clock&, EnergyLedger&) override {}
  void sample(const World&, const Clock&, EnergyLedger& ledger) const override { ledger.internal += total(); }
  void report_part(const World& world, std::vector<PartSums>& parts) const override {
    PartSums& out = parts[at(group_.part)];
    out.internal += total();
    for (Index e = 0; e < group_.size(); ++e) {
      out.mass += group_.mass[e];
      if (dead(e)) out.eroded_internal += energy_[e];
      for (int c = 0; c < 2; ++c) {
        const Vec v = world.nodes.v.vec(group_.node.data(c)[e]);
        out.momentum += group_.mass[e] / 2 * v;
        out.kinetic += group_.mass[e] / 4 * v.squaredNorm();
      }
    }
  }

  ElementKind kind() const override { return ElementKind::beam; }
  const ElementGroup& reported() const override { return group_; }
  Real cut_measure(Index e) const override { return area_[at(e)]; }
  bool bends() const override { return false; }
  ElementReport report_element(const World&, Index e, const ElementReportOptions&) const override {
    return {.deleted = dead(e), .resultants = {force_[e]}};
  }

 private:
  static std::size_t at(Index e) { return static_cast<std::size_t>(e); }
  Field<Real>& add(const char* field, const char* dimension, bool output) {
    return group_.fields.add<Real>({.name = field, .dimension = dimension, .output = output});
  }
  bool dead(Index e) const { return erosion_ && erosion_->dead(e); }
  Real total() const {
    return sum(group_.size(), [&](Index e) { return dead(e) ? 0 : energy_[e]; });
  }
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

  void advance(const World& world, const Clock& clock, Index begin, Index e) {
    const Vec between = between_ends(world, e);
    const Real length = between.norm();
    if (dead(e)) return;  // who judges takes its forces
    const Real F = pull(e, clock.t, length);
    if (law_.holds(clock.t)) rest_[e] = length;
    energy_[e] += 0.5 * (force_[e] + F) * (length - length_[e]);
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
  ElementGroup& group_;
  Id part_id_;
  Real tssfac_;
  Field<Real>& rest_;  ///< length at which dL is 0
  Field<Real>&length_, &force_, &energy_;
  std::vector<Real> steps_;
  std::shared_ptr<Erosion> erosion_;  ///< null: nothing breaks
};

}  // namespace

void build_cables(const Model& model, const std::vector<CablePart>& parts, const std::vector<Index>& node_of,
                  ElementOptions& options, World& world, Diagnostics& diagnostics) {
  for (const CablePart& part : parts) {
    const ModelPart& of_model = model.parts[static_cast<std::size_t>(part.part)];
    if (world.dim == 2)
      return diagnostics.error(of_model.where, "cables are not supported in 2D scenes (IDIM 2)",
                               "make the scene three-dimensional");
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
