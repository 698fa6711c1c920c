#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "elements/element_report.hpp"
#include "elements/held_stress.hpp"
#include "elements/largest_frequency.hpp"
#include "elements/point_strains.hpp"
#include "elements/solid/full_points.hpp"
#include "elements/solid/mode_watch.hpp"
#include "elements/solid/nodal_pressure.hpp"
#include "elements/solid/reference_geometry.hpp"
#include "elements/solid/solid_axes.hpp"
#include "elements/solid/solid_faults.hpp"
#include "elements/solid/solid_reports.hpp"
#include "elements/solid/solids.hpp"
#include "elements/stiffness_damping.hpp"
#include "laws/most_history.hpp"
#include "state/reports.hpp"

namespace courant {

namespace {

/// Solids of a part: strain rates of the last motion, the law, hourglass control, bulk viscosity, and the
/// forces on the corners, which a pass over the nodes gathers. Formulae: in the files of the formulations.
class SolidForces : public Material, public TimeLimit, public SolidReports, public HoldsStress {
 public:
  SolidForces(const SolidPart& part, const ElementGroup& group, Id part_id, Real tssfac,
              const ReferenceGeometry& reference, ElementOptions& options,
              const std::vector<std::array<bool, 3>>& held, World& world)
      : SolidReports(part, group),
        part_id_(part_id),
        tssfac_(tssfac),
        V0_(group.V0),
        rho0_(group.fields.add<Real>({.name = "reference_density", .dimension = "M/L3"})),
        viscous_(group.fields.add<Real>({.name = "bulk_viscosity_pressure", .dimension = "M/LT2"})) {
    control_ = control_of(part);
    const bool several = part.formulation->points > 1;
    if (!several) loops_ = part.formulation->one_point();
    for (const HistoryVariable& h : law_->history())
      history_.push_back(&group.fields.add<Real>({.name = h.name,
                                                  .dimension = h.dimension,
                                                  .components = h.components,
                                                  .output = true,
                                                  .restart = !several}));
    if (several) full_ = std::make_unique<FullPoints>(*part.formulation, group, *law_);
    // the plain modes of corners that coincide resist even a rigid rotation
    if (control_.hourglass == 1 && group.repeats_nodes) control_.hourglass = 2;
    if (control_.QM > 0 && !full_)
      hourglass_force_ =
          &group.fields.add<Real>({.name = "hourglass_force", .dimension = "ML/T2", .components = 12});
    const bool strained = reference.of_part(group.part);
    const std::vector<Real> wave_time = start_state(strained ? &reference : nullptr, world);
    if (options.scaling.step > 0) {
      scaled_ = std::make_unique<ScaledMass>(options.scaling, group_, nullptr, world);
      scaled_->start(wave_time, world);
      for (Index e = 0; e < group_.size(); ++e) take_density(e);
    }
    limit_to_frequency(held, world);
    const auto of_part = static_cast<std::size_t>(group.part);
    const Real coef = options.stiffness_damping[of_part];
    if (const FrequencyRange& range = options.stress_ranges[of_part]; coef != 0 || range.any()) {
      damping_ = std::make_unique<StiffnessDamping>(coef, range, group_, 1, part.formulation->points);
      if (full_) full_->damp_by(damping_.get());
    }
    if (part.pressure) start_pressure();
    if (part.formulation->nodal_pressure) nodal_ = NodalPressure::add(group, part.relative_volume(), world);
    if (const FailureRules& rules = options.failure[static_cast<std::size_t>(group.part)]; rules.any())
      options.eroding.push_back(erosion_ = make_erosion(rules, world));
    if (options.strains) keep_strains();
    if (strained) strain_from(reference, world);
  }
  Index inside_out() const { return inside_out_; }
  std::string name() const override { return group_.fields.name(); }
  const FieldSet& over(const World&) const override { return group_.fields; }
  void declare(const World& world, Accesses& a) const override {
    a.reads(world.nodes.x, Reach::others).reads(world.nodes.v, Reach::others).reads(group_.node);
    a.reads(V0_).reads(rho0_).updates(stress_).updates(internal_).updates(hourglass_);
    a.updates(bulk_viscosity_).updates(viscous_).writes(*group_.corner_force);
    for (const Field<Real>* h : history_) a.updates(*h);
    if (hourglass_force_) a.updates(*hourglass_force_);
    if (memory_) a.updates(*memory_);
    if (full_) full_->declare(a);
    if (nodal_) nodal_->declare(a);
    if (damping_) damping_->declare(a);
    if (erosion_) erosion_->declare(world, a);
    if (strains_) strains_->declare(a);
    if (!scaled_) return;
    scaled_->declare(world, a);
    a.in_finish().updates(rho0_);
  }

  const ElementGroup& of_group() const override { return group_; }
  void hold_by(std::shared_ptr<HeldStress> stress) override { held_ = std::move(stress); }

  void start(World& world, const Clock& clock) override {
    if (held_) held_->start(clock.t);
    for (int k = 0; k < 3; ++k) mesh_.x[k] = world.nodes.x.data(k), mesh_.v[k] = world.nodes.v.data(k);
    for (int c = 0; c < group_.corners(); ++c) mesh_.corner[c] = group_.node.data(c);
    for (int k = 0; k < 6; ++k) state_.stress[k] = stress_.data(k);
    state_.viscous_pressure = viscous_.data(), state_.heats = material_.pressure != nullptr;
    state_.V0 = V0_.data(), state_.rho0 = rho0_.data();
    state_.internal_energy = internal_.data(), state_.hourglass_energy = hourglass_.data();
    state_.bulk_viscosity_energy = bulk_viscosity_.data();
    for (int k = 0; k < 3 * group_.corners(); ++k) state_.corner_force[k] = group_.corner_force->data(k);
    for (int k = 0; hourglass_force_ && k < 12; ++k) state_.hourglass_force[k] = hourglass_force_->data(k);
    history_data_.clear();
    state_.tensors = 0;
    for (Field<Real>* h : history_) {
      const int components = h->info().components;
      for (int k = 0; k < components; ++k) history_data_.push_back(h->data(k));
      if (components != 6) continue;
      for (int k = 0; k < 6; ++k) state_.tensor[state_.tensors][k] = h->data(k);
      ++state_.tensors;
    }
    if (Field<Real>* strain = failure_strain(); strain || strains_) {
      if (!strain) strain = &strains_->field();
      for (int k = 0; k < 6; ++k) state_.tensor[state_.tensors][k] = strain->data(k);
      ++state_.tensors;
    }
    found_.resize(static_cast<std::size_t>(block_count(group_.size())));
    of_pressure_.assign(found_.size(), {});
  }
  void block(World&, const Clock& clock, Index begin, Index end) override {
    PointScratch scratch;
    StableStep& found = found_[static_cast<std::size_t>(begin / block_size)];
    const Index count = end - begin;
    if (erosion_) erosion_->begin_block(begin, count);
    found = advance({{mesh_, control_, state_, *law_}, material_.pressure.get(), nodal_.get()}, clock.dt_old,
                    begin, end, scratch, erosion_ ? &clock : nullptr);
    if (damping_) damping_->shorten(begin, count, scratch.wave_time, scratch.step_limit);
    if (erosion_)
      erosion_->judge(begin, count, tssfac_, scratch.step_limit, scratch.wave_time, scratch.relative_volume,
                      {group_, begin, clock.dt_old});
    if (nodal_) nodal_->keep({begin, count, clock.dt_old}, state_, erosion_.get());
    const bool lighter = scaled_ && scaled_->look(begin, count, scratch.wave_time, scratch.step_limit);
    if (!lighter && !damping_ && !(erosion_ && erosion_->any_dead(begin))) return;
    const Index shortest = least_of(scratch.step_limit, count),
                smallest = least_of(scratch.relative_volume, count);
    found = {scratch.step_limit[shortest], begin + shortest, scratch.relative_volume[smallest],
             begin + smallest};
  }
  void finish(World& world, const Clock& clock) override {
    std::int64_t without_speed = 0;
    for (const StableStep& found : found_)
      if (!(found.least_volume > 0)) stop_for_volume(group_, part_id_, found, clock);
    for (const SolidPressure::Faults& found : of_pressure_) {
      without_speed += found.without_speed;
      if (found.beyond >= 0)
        stop_for_compression(group_, part_id_, material_.pressure->eos().mu_limit(), found.beyond, clock);
    }
    if (without_speed > 0) world.counters["sound_speed_clamped"] += without_speed;
    if (!scaled_) return;
    for (const Index e : scaled_->grow(world)) take_density(e);
  }

  Limit limit(const World&, const Clock&) override {
    const StableStep* least = &found_.front();
    for (const StableStep& found : found_)
      if (!std::isnan(least->step) && !(found.step >= least->step)) least = &found;
    return {tssfac_ * least->step, fmt::format("solid {} of part {}{}", group_.id[least->shortest], part_id_,
                                               by_mesh_ ? " (frequency of its mesh)" : "")};
  }

 private:
  static constexpr Real small_strain = 1e-7;  ///< within which all is linear

  /// What a block of elements moves by, and answers with.
  struct BlockOfSolids : FullPoints::BlockOfSolids {
    const SolidPressure* pressure;
    const NodalPressure* nodal;
  };

  StableStep advance(const BlockOfSolids& of, Real dt, Index begin, Index end, PointScratch& scratch,
                     const Clock* failing = nullptr) {
    const ElementBlock block{begin, end - begin, dt};
    if (full_) return advance_points(of, block, scratch, failing);
    loops_.strain(block, of.mesh, of.control, of.state, scratch);
    if (failing && erosion_->any_dead(begin)) hold_deleted(*erosion_, begin, block.count, scratch);
    NodalPressure::Scratch by_nodes;
    if (of.nodal) of.nodal->strain(block, of.state, scratch, by_nodes);
    std::array<Real*, most_history> history{};
    PointBlock points;
    points.count = end - begin;
    points.dt = dt;
    for (std::size_t k = 0; k < 6; ++k)
      points.rate[k] = scratch.rate[k], points.stress[k] = of.state.stress[k] + begin;
    points.compression = scratch.compression;
    points.sound_speed = scratch.sound_speed;
    for (std::size_t k = 0; k < history_data_.size(); ++k) history[k] = history_data_[k] + begin;
    points.history = std::span<Real* const>(history.data(), history_data_.size());
    if (of.pressure)
      of_pressure_[static_cast<std::size_t>(begin / block_size)] =
          update_with_pressure(of, block, scratch, points);
    else
      of.law.update(points);
    answered(points, begin, 0, failing);
    if (!damping_) return push(of, block, of.state, scratch, by_nodes);
    damping_->add(of.law, 0, points,
                  {begin,
                   {scratch.half_turn[0], scratch.half_turn[1], scratch.half_turn[2]},
                   scratch.middle_volume,
                   scratch.work});
    SolidState damped = of.state;
    for (int k = 0; k < 6; ++k) damped.stress[k] = damping_->damped(0, k);
    return push(of, block, damped, scratch, by_nodes);
  }
  StableStep push(const BlockOfSolids& of, const ElementBlock& block, const SolidState& state,
                  SolidScratch& scratch, const NodalPressure::Scratch& by_nodes) const {
    loops_.work(block, state, scratch);
    if (of.nodal && !state.heats) of.nodal->work(block, state, scratch, by_nodes);
    return loops_.forces(block, of.control, state, scratch);
  }

  /// The same with several points.
  StableStep advance_points(const BlockOfSolids& of, const ElementBlock& block, PointScratch& scratch,
                            const Clock* failing) {
    const FullPoints::Between between{
        [&] {
          if (failing && erosion_->any_dead(block.begin))
            hold_deleted(*erosion_, block.begin, block.count, scratch);
        },
        [&](int point, const PointBlock& points) { answered(points, block.begin, point, failing); }};
    if (!of.pressure) return full_->advance(of, block, scratch, between);
    FullPoints::Fluid fluid{*of.pressure, internal_.data(), memory()};
    const StableStep out = full_->advance(of, fluid, block, scratch, between);
    of_pressure_[static_cast<std::size_t>(block.begin / block_size)] = fluid.found;
    return out;
  }

  /// Behind the law at a point.
  void answered(const PointBlock& points, Index begin, int point, const Clock* failing) const {
    if (held_) held_->hold(point, begin, points);
    if (failing) look_for_failure(points, begin, point, *failing);
    if (strains_ && !failure_strain()) strains_->advance(point, begin, points);
    if (scaled_)  // waves of a body that is as stiff and denser
      for (Index i = 0; i < points.count; ++i)
        points.sound_speed[i] *= std::sqrt(law_->ro / rho0_[begin + i]);
  }

  /// The law gives the deviator, an equation of state the rest.
  SolidPressure::Faults update_with_pressure(const BlockOfSolids& of, const ElementBlock& block,
                                             SolidScratch& scratch, PointBlock& points) const {
    SolidPressure::Scratch own;
    of.pressure->split(block, of.state, internal_.data(), memory(), scratch, own);
    loops_.viscosity(block, of.control, of.state, scratch);
    of.pressure->predict(block, of.state, scratch, own);
    points.pressure = own.pressure, points.energy = own.energy, points.least_pressure = own.least_pressure;
    of.law.update(points);
    return of.pressure->complete(block, of.state, scratch, own);
  }

  Field<Real>* failure_strain() const { return erosion_ ? erosion_->strain() : nullptr; }
  void keep_strains() {
    strains_ = std::make_unique<PointStrains>(group_, material_.formulation->points);
    if (full_ && !failure_strain()) full_->turn_too(strains_->field());
    if (erosion_) erosion_->vanishes(strains_->field());
  }

  void look_for_failure(const PointBlock& points, Index begin, int point, const Clock& clock) const {
    const auto number = [&](int at) {
      return at < 0 ? nullptr : points.history[static_cast<std::size_t>(at)];
    };
    erosion_->look({.point = point,
                    .begin = begin,
                    .count = points.count,
                    .t = clock.t,
                    .dt = points.dt,
                    .rate = points.rate,
                    .stress = points.stress,
                    .plastic = number(plastic_),
                    .by_law = number(fails_)});
  }

  /// Stress, history and energy of the motion from a reference geometry to the start.
  void strain_from(const ReferenceGeometry& reference, World& world) {
    start(world, {});
    const SolidControl slow = control_.without_viscosity();
    reference.go_to(world, mesh_, [&](const SolidMesh& mesh, Real dt) {
      for_each_block(group_.size(), [&](Index begin, Index end) {
        PointScratch scratch;
        found_[static_cast<std::size_t>(begin / block_size)] =
            advance({{mesh, slow, state_, *law_}, nullptr, nullptr}, dt, begin, end, scratch);
      });
      for (const StableStep& found : found_)
        if (inside_out_ < 0 && !(found.least_volume > 0)) inside_out_ = found.smallest;
    });
  }

  /// A free block of few elements is stable only below what a mesh of many is: the step keeps below 2 over
  /// the largest frequency of the group, by the share of the elements' own step that this is at the start.
  /// Means of pressures over nodes only make a mesh softer: it is that of the elements without.
  void limit_to_frequency(const std::vector<std::array<bool, 3>>& held, const World& world) {
    const Index n = group_.size();
    const Real smallest = -maximum(n, [&](Index e) { return -V0_[e]; });
    if (!(smallest > 0)) return;
    const GroupNodes own(group_, held, world.nodes);
    SolidMesh mesh;
    for (std::size_t k = 0; k < 3; ++k) mesh.x[k] = own.x[k].data();
    for (std::size_t c = 0; c < own.corner.size(); ++c) mesh.corner[c] = own.corner[c].data();
    const SolidControl elastic = control_.without_viscosity();
    std::vector<StableStep> found(found_.size());
    // an equation of state answers a change of volume, which nothing moves for here
    const std::shared_ptr<StrengthLaw> linear =
        material_.pressure ? linear_response(*material_.pressure, *law_) : law_;
    SolidState state = state_;
    state.heats = false;
    const Real omega = largest_frequency(
        own.m, own.held, small_strain * std::cbrt(smallest), [&](const NodalVector& u, NodalVector& Ku) {
          for (std::size_t k = 0; k < 3; ++k) mesh.v[k] = u[k].data();
          reset();
          for_each_block(n, [&](Index begin, Index end) {
            PointScratch scratch;
            found[static_cast<std::size_t>(begin / block_size)] =
                advance({{mesh, elastic, state, *linear}, nullptr, nullptr}, 1, begin, end, scratch);
          });
          own.assemble(*group_.corner_force, -1, Ku);
        });
    Real step = std::numeric_limits<Real>::infinity();
    for (const StableStep& f : found) step = std::min(step, f.step);
    reset();
    const Real asked = tssfac_;
    tssfac_ = below_frequency(asked, step, omega);
    by_mesh_ = tssfac_ < asked;
  }

  std::shared_ptr<Erosion> make_erosion(FailureRules rules, World& world) {
    rules.law_points = material_.formulation->failing_points;
    auto out = std::make_shared<Erosion>(rules, group_, material_.formulation->points,
                                         Erosion::Energies{&internal_, &bulk_viscosity_, &hourglass_}, world);
    out->vanishes(stress_);
    for (Field<Real>* h : history_)
      if (h->info().components == 6) out->vanishes(*h);
    if (full_)
      for (Field<Real>* field : full_->of_deleted()) out->vanishes(*field);
    if (full_ && out->strain()) full_->turn_too(*out->strain());
    plastic_ = plastic_strain_of(*law_), fails_ = history_at(*law_, law_->failure_variable());
    return out;
  }

  /// To the state of the start: without stress, history, energies and forces.
  void reset() {
    for (Field<Real>* field : {&stress_, &internal_, &hourglass_, &bulk_viscosity_, &viscous_})
      field->fill(0);
    for (Field<Real>* h : history_) h->fill(0);
    if (full_) full_->reset();
    if (hourglass_force_) hourglass_force_->fill(0);
    group_.corner_force->fill(0);
    lay_directions_and_sizes(*law_, group_, mesh_, history_, full_.get());
  }

  /// Pressure and energy of the equation of state at the start.
  void start_pressure() {
    const Real p = material_.pressure->initial_pressure(), E0 = material_.pressure->eos().E0;
    if (full_) full_->start_pressure(p);
    for (Index e = 0; e < group_.size(); ++e) {
      for (int k = 0; k < 3; ++k) stress_.data(k)[e] = -p;
      internal_[e] = E0 * V0_[e];
    }
    if (const char* field = material_.pressure->eos().memory()) {
      memory_ = &group_.fields.add<Real>({.name = field, .dimension = "-", .output = true});
      memory_->fill(material_.pressure->eos().memory_at_start());
    }
  }

  /// The density that inertia belongs to.
  void take_density(Index e) { rho0_[e] = law_->ro * scaled_->ratio(e); }

  /// Reference volumes and densities; the mass of an element goes to its nodes in equal shares. Returns the
  /// step of each element. [T]
  std::vector<Real> start_state(const ReferenceGeometry* reference, World& world) {
    int numbers = 0, tensors = 0;
    for (const HistoryVariable& h : law_->history()) numbers += h.components, tensors += h.is_tensor();
    constexpr int most_of_law = SolidState::most_tensors - 1;  // one is that of output
    if (numbers > static_cast<int>(most_history) || tensors > most_of_law)
      throw std::logic_error(fmt::format("a law with {} history numbers, {} tensors: more than {}, {}",
                                         numbers, tensors, most_history, most_of_law));
    // volumes by the loops themselves: what they give for V0 = 1
    const Index n = group_.size();
    std::vector<Real> wave_time(static_cast<std::size_t>(n));
    for (Index e = 0; e < n; ++e) V0_[e] = 1, rho0_[e] = law_->ro;
    start(world, {});
    for (std::size_t k = 0; reference && k < 3; ++k) mesh_.x[k] = reference->x[k].data();
    for (Index begin = 0; begin < n; begin += block_size) {
      PointScratch scratch;
      const ElementBlock block{begin, std::min<Index>(block_size, n - begin), 0};
      if (full_) {
        full_->measure({mesh_, control_, state_, *law_}, block, material_.sound_speed(), scratch);
      } else {
        loops_.strain(block, mesh_, control_, state_, scratch);
        std::fill(scratch.sound_speed, scratch.sound_speed + block.count, material_.sound_speed());
        loops_.forces(block, control_, state_, scratch);
      }
      for (Index k = 0; k < block.count; ++k) {
        const Index e = begin + k;
        V0_[e] = scratch.relative_volume[k] / material_.relative_volume();
        if (reference && inside_out_ < 0 && !(V0_[e] > 0)) inside_out_ = e;
        wave_time[static_cast<std::size_t>(e)] = scratch.wave_time[k];
        group_.mass[e] = law_->ro * V0_[e];
        for (int c = 0; c < group_.corners(); ++c)
          world.nodes.m[group_.node.data(c)[e]] += group_.mass[e] * group_.share(e, c);
      }
    }
    reset();
    return wave_time;
  }
  Real* memory() const { return memory_ ? memory_->data() : nullptr; }
  Id part_id_;
  Real tssfac_;                             ///< TSSFAC, or less where the mesh asks for it
  bool by_mesh_ = false;                    ///< it does
  OnePointLoops loops_{};                   ///< where elements have one point
  Field<Real>&V0_, &rho0_, &viscous_;       ///< the last one q of bulk viscosity
  Field<Real>* hourglass_force_ = nullptr;  ///< null: several points, or QM 0
  Field<Real>* memory_ = nullptr;           ///< of the equation of state; null: it has none
  SolidMesh mesh_{};
  SolidState state_{};
  std::vector<Real*> history_data_;
  std::vector<StableStep> found_;  ///< in each block
  std::vector<SolidPressure::Faults> of_pressure_;
  std::shared_ptr<NodalPressure> nodal_;       ///< null: pressures are those of elements
  std::unique_ptr<StiffnessDamping> damping_;  ///< null: none
  std::shared_ptr<HeldStress> held_;           ///< null: none
  /// Of the law's numbers the plastic strain, and what it fails by.
  int plastic_ = -1, fails_ = -1;
  Index inside_out_ = -1;  ///< an element that is so in the reference geometry; -1: none
};

}  // namespace

void add_solid_passes(const Model& model, const std::vector<SolidPart>& parts,
                      const std::vector<Index>& node_of, const ReferenceGeometry& reference,
                      ElementOptions& options, World& world, Diagnostics& diagnostics) {
  const std::vector<std::array<bool, 3>> held = held_at_start(model, node_of, world.nodes);
  for (const auto& group : world.groups) {
    const auto part = static_cast<std::size_t>(group->part);
    if (group->segment) continue;  // shells
    auto pass = std::make_shared<SolidForces>(parts[part], *group, model.parts[part].id, model.tssfac,
                                              reference, options, held, world);
    if (pass->inside_out() >= 0)
      report_inside_out(model.parts[part], group->id[pass->inside_out()], diagnostics);
    world.passes.add(std::move(pass));
  }
  if (auto watch = make_mode_watch(parts, world)) world.passes.add(std::move(watch));
}

}  // namespace courant
