#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>
#include <string>
#include <utility>

#include "base/run_error.hpp"
#include "elements/element_laws.hpp"
#include "elements/largest_frequency.hpp"
#include "elements/null_elements.hpp"
#include "elements/point_strains.hpp"
#include "elements/shell/distortion.hpp"
#include "elements/shell/facets.hpp"
#include "elements/shell/flow_stress.hpp"
#include "elements/shell/layer_axes.hpp"
#include "elements/shell/layers.hpp"
#include "elements/shell/shell_faults.hpp"
#include "elements/shell/shells.hpp"
#include "elements/stiffness_damping.hpp"
#include "laws/most_history.hpp"
#include "state/reports.hpp"
#include "state/shared_fields.hpp"

namespace courant {

namespace {

/// Shells of a part, all of one shape: strain rates of the last motion, the law at each point through the
/// thickness, hourglass control, forces and moments on the corners, which passes over the nodes gather.
/// Formulae: shell_loops.hpp.
class ShellForces : public Material, public TimeLimit, public EnergyTerm, public PartReporter {
 public:
  ShellForces(const ShellPart& part, const ElementGroup& group, Id part_id, Real tssfac,
              ElementOptions& options, const std::vector<std::array<bool, 3>>& held, World& world)
      : group_(group),
        layers_(layers_of(part)),
        part_id_(part_id),
        tssfac_(tssfac),
        w_(*shared_fields::angular_velocity.find(world.nodes.fields)),
        inertia_(*shared_fields::rotary_inertia.find(world.nodes.fields)),
        control_(part.control),
        places_(part.full && group.corners() == 4 ? 4 : 1),
        distortion_(part.distorted, group.corners(), places_ > 1),
        loops_(shell_loops(group.corners(), places_, part.control)),
        stress_(layer_stress_of(group, places_ * static_cast<int>(part.zeta.size()))),
        thickness_(thickness_of_shells(group)),
        internal_(group.fields.add<Real>({.name = "internal_energy", .dimension = "ML2/T2", .output = true})),
        hourglass_(
            group.fields.add<Real>({.name = "hourglass_energy", .dimension = "ML2/T2", .output = true})),
        bulk_viscosity_(group.fields.add<Real>({.name = "bulk_viscosity_energy", .dimension = "ML2/T2"})),
        corner_inertia_(corner_inertia_of(group)) {
    state_.points = places_ * static_cast<int>(part.zeta.size());
    for (int p = 0; p < state_.points; ++p) {
      const std::size_t layer = static_cast<std::size_t>(p) % part.zeta.size();
      state_.zeta[p] = part.zeta[layer], state_.share[p] = part.share[layer] / places_;
    }
    if (places_ == 1 ? group.corners() == 4 : control_.drilling > 0)
      hourglass_force_ =
          &group.fields.add<Real>({.name = "hourglass_force",
                                   .dimension = "-",
                                   .components = ShellState::generalised(places_, control_.warps)});
    const bool flows =
        std::any_of(layers_.begin(), layers_.end(), [](const Layer& l) { return l.plastic >= 0; });
    if (places_ == 1 && hourglass_force_ && control_.stiffness && flows)
      flow_stress_ = &group.fields.add<Real>({.name = "flow_stress", .dimension = "M/LT2"});
    if (control_.Q1 != 0 || control_.Q2 != 0)
      viscous_ = &group.fields.add<Real>({.name = "bulk_viscosity_force", .dimension = "M/T2"});
    offset_ = offset_of_shells(group);
    if (part.has_axes()) directions_ = &layer_directions_of(group, layers_.size());
    fails_with_all_ = part.fails_with_all, thins_by_flow_ = part.thins_by_flow;
    stiffens_ = std::any_of(layers_.begin(), layers_.end(), [](const Layer& l) { return l.law->stiffens(); });
    for (int p = 0; p < state_.points; ++p)
      for (const HistoryVariable& h : layer_of(p).law->history())
        history_.push_back(&layer_history_of(group, h, p));
    for (Index e = 0; e < group_.size(); ++e) thickness_[e] = world.segments.thickness[(*group_.segment)[e]];
    lay_sizes();
    start(world, {});
    if (options.scaling.step > 0) scale_masses(options.scaling, world);
    limit_to_frequency(held, world);
    const auto of_part = static_cast<std::size_t>(group.part);
    const Real coef = options.stiffness_damping[of_part];
    if (const FrequencyRange& range = options.stress_ranges[of_part]; coef != 0 || range.any())
      damping_ = std::make_unique<StiffnessDamping>(coef, range, group_, state_.points, 0);
    FailureRules rules = rules_of_layers(part, options.failure[static_cast<std::size_t>(group.part)]);
    rules.distorted = part.distorted == DistortedShells::deleted;
    if (rules.any()) options.eroding.push_back(erosion_ = make_erosion(rules, world));
    if (!options.strains) return;
    strains_.emplace(group, state_.points);
    if (erosion_) erosion_->vanishes(strains_->field());
  }
  std::string name() const override { return group_.fields.name(); }
  const FieldSet& over(const World&) const override { return group_.fields; }
  void declare(const World& world, Accesses& a) const override {
    a.reads(world.nodes.x, Reach::others).reads(world.nodes.v, Reach::others).reads(w_, Reach::others);
    a.reads(group_.node).reads(group_.mass).updates(stress_).updates(internal_);
    a.updates(hourglass_).updates(bulk_viscosity_).updates(thickness_);
    a.writes(group_.sums->force).writes(group_.sums->moment);
    if (group_.corner_force) a.writes(*group_.corner_force).writes(*group_.corner_moment);
    if (hourglass_force_) a.updates(*hourglass_force_);
    if (flow_stress_) a.updates(*flow_stress_);
    if (viscous_) a.updates(*viscous_);
    if (directions_) a.reads(*directions_);
    if (offset_) a.reads(*offset_);
    for (const Field<Real>* h : history_) a.updates(*h);
    if (erosion_) erosion_->declare(world, a);
    if (damping_) damping_->declare(a);
    if (strains_) strains_->declare(a);
    if (!scaled_) return;
    a.reads(scaled_->inertial());
    scaled_->declare(world, a);
  }

  void start(World& world, const Clock&) override {
    for (int k = 0; k < 3; ++k)
      mesh_.x[k] = world.nodes.x.data(k), mesh_.v[k] = world.nodes.v.data(k), mesh_.w[k] = w_.data(k);
    for (int c = 0; c < group_.corners(); ++c) mesh_.corner[c] = group_.node.data(c);
    for (int p = 0; p < state_.points; ++p)
      for (const int k : {0, 1, 3, 4, 5}) state_.stress[6 * p + k] = stress_.data(at_layer(p, k));
    for (int k = 0; hourglass_force_ && k < hourglass_force_->info().components; ++k)
      state_.hourglass[k] = hourglass_force_->data(k);
    state_.thickness = thickness_.data(), state_.mass = (scaled_ ? scaled_->inertial() : group_.mass).data();
    state_.internal_energy = internal_.data(), state_.hourglass_energy = hourglass_.data();
    state_.bulk_viscosity_energy = bulk_viscosity_.data();
    state_.flow_stress = flow_stress_ ? flow_stress_->data() : nullptr;
    state_.viscous_force = viscous_ ? viscous_->data() : nullptr;
    state_.offset = offset_ ? offset_->data() : nullptr;
    history_data_.clear();
    for (Field<Real>* h : history_)
      for (int k = 0; k < h->info().components; ++k) history_data_.push_back(h->data(k));
    if (damping_) {
      damped_ = std::make_unique<ShellState>(state_);
      for (int k = 0; k < 6 * state_.points; ++k) damped_->stress[k] = damping_->damped(k / 6, k % 6);
    }
    found_.resize(static_cast<std::size_t>(block_count(group_.size())));
    distortion_.start(static_cast<std::size_t>(block_count(group_.size())));
  }
  void block(World&, const Clock& clock, Index begin, Index end) override {
    ShellScratch scratch;
    ShellLoops::StableStep& found = found_[static_cast<std::size_t>(begin / block_size)];
    const Index count = end - begin;
    if (erosion_) erosion_->begin_block(begin, count);
    found = advance(mesh_, control_, clock.dt_old, begin, end, scratch, erosion_ ? &clock : nullptr);
    if (damping_) damping_->shorten(begin, count, scratch.wave_time, scratch.step_limit);
    distortion_.look(begin, count, mesh_, scratch, erosion_.get());
    if (erosion_)
      erosion_->judge(begin, count, tssfac_, scratch.step_limit, scratch.wave_time, nullptr,
                      {scratch.corner_force, scratch.corner_moment, clock.dt_old});
    leave_forces(begin, count, scratch);
    const bool lighter = scaled_ && scaled_->look(begin, count, scratch.wave_time, scratch.step_limit);
    if (!lighter && !stiffens_ && !damping_ && !(erosion_ && erosion_->any_dead(begin))) return;
    const Index shortest = least_of(scratch.step_limit, count);
    found = {scratch.step_limit[shortest], begin + shortest};
  }
  void finish(World& world, const Clock& clock) override {
    if (scaled_) scaled_->grow(world);
    if (const Index e = distortion_.found(); e >= 0)
      stop_for_distortion(group_, part_id_, e, distortion_.full(), clock);
    if (!control_.thins) return;
    for (Index e = 0; e < group_.size(); ++e)
      if (!(state_.thickness[e] > 0) && !(erosion_ && erosion_->dead(e)))
        stop_for_thickness(group_, part_id_, e, state_.thickness[e], clock);
  }

  Limit limit(const World&, const Clock&) override {
    const ShellLoops::StableStep* least = &found_.front();
    for (const ShellLoops::StableStep& found : found_)
      if (!std::isnan(least->step) && !(found.step >= least->step)) least = &found;
    return {tssfac_ * least->step, fmt::format("shell {} of part {}{}", group_.id[least->shortest], part_id_,
                                               by_mesh_ ? " (frequency of its mesh)" : "")};
  }

  void record(World&, const Clock&, EnergyLedger&) override {}
  void sample(const World&, const Clock&, EnergyLedger& ledger) const override {
    ledger.internal += total(internal_);
    ledger.hourglass += total(hourglass_);
    ledger.bulk_viscosity += total(bulk_viscosity_);
  }
  void report_part(const World& world, std::vector<PartSums>& parts) const override {
    PartSums& out = parts[static_cast<std::size_t>(group_.part)];
    out.internal += total(internal_) + total(bulk_viscosity_);
    out.hourglass += total(hourglass_);
    if (erosion_) {
      out.eroded_internal += total_of_dead(internal_) + total_of_dead(bulk_viscosity_);
      out.eroded_hourglass += total_of_dead(hourglass_);
    }
    for (Index e = 0; e < group_.size(); ++e) {
      out.mass += group_.mass[e];
      if (scaled_) out.added_mass += scaled_->added(e);
      for (int c = 0; c < group_.corners(); ++c) {
        const Real share = scaled_ ? scaled_->of_corner(e, c) : group_.mass[e] / group_.corners();
        const Index n = group_.node.data(c)[e];
        const Vec v = world.nodes.v.vec(n);
        out.momentum += share * v;
        out.kinetic += 0.5 * share * v.squaredNorm();
        if (world.nodes.m[n] > 0)  // the rotations of a node, by shares of its mass
          out.kinetic += 0.5 * share / world.nodes.m[n] * inertia_[n] * w_.vec(n).squaredNorm();
      }
    }
  }

 private:
  int layers() const { return state_.points / places_; }
  ShellLoops::StableStep advance(const ShellMesh& mesh, const ShellControl& control, Real dt, Index begin,
                                 Index end, ShellScratch& scratch, const Clock* failing = nullptr) const {
    const ShellLoops::Block block{begin, end - begin, dt};
    const ShellState& pushing = damped_ ? *damped_ : state_;
    loops_.strain(block, control, mesh, pushing, scratch);
    if (failing && erosion_->any_dead(begin)) still_dead(begin, block.count, scratch);
    Real rate_zz[block_size], sound_speed[block_size], faster[block_size], stress_zz[block_size] = {};
    std::fill(scratch.thickening, scratch.thickening + block.count, 0);
    std::fill(faster, faster + block.count, 1);
    std::optional<FlowStress> flow;
    FlowThinning thinning;
    if (flow_stress_) flow.emplace(block.count);
    std::array<Real*, most_history> history{};
    std::size_t numbers = 0, first = 0;
    PointBlock points;
    points.count = block.count, points.dt = dt, points.sound_speed = sound_speed;
    for (std::size_t k = 0; k < 6; ++k) points.rate[k] = scratch.rate[k];
    for (int p = 0; p < state_.points; ++p) {
      loops_.at_point(block, p, state_, scratch);
      for (std::size_t k = 0; k < 6; ++k)
        points.stress[k] = k == 2 ? stress_zz : state_.stress[6 * static_cast<std::size_t>(p) + k] + begin;
      const Layer& layer = layer_of(p);
      first += numbers, numbers = layer.numbers;
      for (std::size_t k = 0; k < numbers; ++k) history[k] = history_data_[first + k] + begin;
      points.history = std::span<Real* const>(history.data(), numbers);
      if (thins_by_flow_) thinning.before(points);
      if (flow && layer.plastic >= 0) flow->before(history[static_cast<std::size_t>(layer.plastic)]);
      if (layer.law->axes())
        update_along_axes(*layer.law, directions_->data(2 * (p % layers())) + begin,
                          directions_->data(2 * (p % layers()) + 1) + begin, points, rate_zz);
      else
        layer.law->update_in_plane_stress(points, rate_zz);
      if (flow && layer.plastic >= 0) flow->after(points, state_.share[p]);
      if (layer.law->stiffens())
        for (Index i = 0; i < block.count; ++i)
          faster[i] = std::max(faster[i], sound_speed[i] / layer.law->sound_speed());
      if (failing) look_at_point(p, begin, *failing, points, rate_zz);
      if (strains_ && !(erosion_ && erosion_->strain())) strains_->advance(p, begin, points, rate_zz);
      if (thins_by_flow_) thinning.after(points, *layer.law, layer.plastic >= 0, rate_zz);
      if (damping_) damping_->add_in_plane(*layer.law, p, points, begin);
      for (Index i = 0; i < block.count; ++i) scratch.thickening[i] += state_.share[p] * rate_zz[i];
    }
    if (flow) flow->keep(flow_stress_->data() + begin);
    const ShellLoops::StableStep found = loops_.forces(block, control, pushing, scratch);
    for (Index i = 0; stiffens_ && i < block.count; ++i)
      scratch.step_limit[i] /= faster[i], scratch.wave_time[i] /= faster[i];
    return found;
  }

  std::shared_ptr<Erosion> make_erosion(FailureRules rules, World& world) {
    int can_fail = 0;
    for (int p = 0; p < state_.points; ++p) can_fail += layer_of(p).fails >= 0;
    if (!fails_with_all_ && can_fail > 0) rules.law_points = can_fail;
    if (const int asked = layers_.front().law->failing_layers; asked > 0)
      rules.law_points = asked * (state_.points / layers());
    auto out = std::make_shared<Erosion>(rules, group_, state_.points,
                                         Erosion::Energies{&internal_, &bulk_viscosity_, &hourglass_}, world);
    out->vanishes(stress_);
    for (Field<Real>* h : history_)
      if (h->info().components == 6)
        out->vanishes(*h);
      else if (h->info().name.rfind(beside_deleted, 0) == 0)
        out->weakens(*h);
    return out;
  }

  void look_at_point(int p, Index begin, const Clock& clock, const PointBlock& points,
                     const Real* rate_zz) const {
    FailingPoints failing{.point = p, .begin = begin, .count = points.count, .t = clock.t, .dt = points.dt};
    failing.rate = points.rate, failing.rate[2] = rate_zz;
    failing.stress = points.stress;
    const Layer& layer = layer_of(p);
    if (layer.plastic >= 0) failing.plastic = points.history[static_cast<std::size_t>(layer.plastic)];
    if (layer.fails >= 0) {
      failing.by_law = points.history[static_cast<std::size_t>(layer.fails)];
      failing.law_limit = layer.law->failure_limit();
    }
    erosion_->look(failing);
  }

  /// Dead elements of a block are taken as a square that does not move, and stay without stress.
  void still_dead(Index begin, Index count, ShellScratch& s) const {
    for (Index i = 0; i < count; ++i) {
      if (!erosion_->dead(begin + i)) continue;
      for (std::size_t k = 0; k < 9; ++k) s.place[k][i] = k == 0 || k == 4 ? 1 : 0;
      for (std::size_t k = 0; k < 3; ++k) s.membrane[k][i] = s.curvature[k][i] = 0;
      for (auto& shear : s.shear) shear[i] = 0;
      for (auto& rate : s.hourglass_rate) rate[i] = 0;
      for (auto& quarter : s.quarter)
        for (auto& rate : quarter) rate[i] = 0;
      for (auto& area : s.quarter_area) area[i] = 0.25;
      s.middle_area[i] = 1;
    }
  }

  /// Of dead elements none.
  void leave_forces(Index begin, Index count, ShellScratch& s) const {
    for (Index i = 0; erosion_ && erosion_->any_dead(begin) && i < count; ++i)
      for (int k = 0; erosion_->dead(begin + i) && k < 12; ++k)
        s.corner_force[k][i] = s.corner_moment[k][i] = 0;
    BlockSums& sums = *group_.sums;
    sums.set(sums.force, begin, count, s.corner_force), sums.set(sums.moment, begin, count, s.corner_moment);
    for (int k = 0; group_.corner_force && k < 3 * group_.corners(); ++k) {
      std::copy_n(s.corner_force[k], count, group_.corner_force->data(k) + begin);
      std::copy_n(s.corner_moment[k], count, group_.corner_moment->data(k) + begin);
    }
  }

  void scale_masses(const MassScaling& scaling, World& world) {
    std::vector<Real> wave_time(static_cast<std::size_t>(group_.size()));
    for (Index begin = 0; begin < group_.size(); begin += block_size) {
      ShellScratch scratch;
      const Index end = std::min<Index>(begin + block_size, group_.size());
      advance(mesh_, control_, 0, begin, end, scratch);
      std::copy(scratch.wave_time, scratch.wave_time + (end - begin), wave_time.begin() + begin);
    }
    reset();
    scaled_ = std::make_unique<ScaledMass>(scaling, group_, &corner_inertia_, world);
    scaled_->start(wave_time, world);
    state_.mass = scaled_->inertial().data();
  }

  /// A free patch of few elements is stable only below what a mesh of many is: as for solids, the step keeps
  /// below 2 over the largest frequency of the group, whose rotations are behind the positions of its nodes.
  void limit_to_frequency(const std::vector<std::array<bool, 3>>& held, World& world) {
    constexpr Real small = 1e-7;  // strains, within which all is linear
    const Index n = group_.size();
    const Real least_area = -maximum(n, [&](Index e) { return -group_.V0[e] / thickness_[e]; });
    if (!(least_area > 0)) return;
    const GroupNodes own(group_, held, world.nodes);
    const std::size_t nodes = own.m.size();
    const std::vector<Index> place_node = own.nodes_of_places(*group_.sums);
    std::vector<Real> mass = own.m;
    std::vector<std::array<bool, 3>> all_held = own.held;
    mass.resize(2 * nodes, 0), all_held.resize(2 * nodes, {false, false, false});
    for (const std::vector<Index>& corner : own.corner)
      for (std::size_t e = 0; e < corner.size(); ++e)
        mass[nodes + static_cast<std::size_t>(corner[e])] +=
            corner_inertia_[static_cast<Index>(e)] * (scaled_ ? scaled_->ratio(static_cast<Index>(e)) : 1);
    ShellMesh mesh = mesh_;
    for (std::size_t k = 0; k < 3; ++k) mesh.x[k] = own.x[k].data();
    for (std::size_t c = 0; c < own.corner.size(); ++c) mesh.corner[c] = own.corner[c].data();
    ShellControl elastic = control_;
    elastic.Q1 = elastic.Q2 = 0, elastic.thins = false;
    if (!control_.stiffness) elastic.QM = elastic.QB = elastic.QW = 0;
    std::vector<ShellLoops::StableStep> found(found_.size());
    const Real omega = largest_frequency(mass, all_held, small * std::sqrt(least_area),
                                         [&](const NodalVector& u, NodalVector& Ku) {
                                           for (std::size_t k = 0; k < 3; ++k)
                                             mesh.v[k] = u[k].data(), mesh.w[k] = u[k].data() + nodes;
                                           reset();
                                           for_each_block(n, [&](Index begin, Index end) {
                                             ShellScratch scratch;
                                             found[static_cast<std::size_t>(begin / block_size)] =
                                                 advance(mesh, elastic, 1, begin, end, scratch);
                                             leave_forces(begin, end - begin, scratch);
                                           });
                                           own.assemble(group_.sums->force, place_node, -1, Ku, 0);
                                           own.assemble(group_.sums->moment, place_node, -1, Ku, nodes);
                                         });
    Real step = std::numeric_limits<Real>::infinity();
    for (const ShellLoops::StableStep& f : found) step = std::min(step, f.step);
    reset();
    const Real asked = tssfac_;
    tssfac_ = below_frequency(asked, step, omega);
    by_mesh_ = tssfac_ < asked;
  }

  /// To the state of the start: without stress, history, energies and forces.
  void reset() {
    for (Field<Real>* field : {&stress_, &internal_, &hourglass_, &bulk_viscosity_}) field->fill(0);
    for (Field<Real>* h : history_) h->fill(0);
    lay_sizes();
    if (hourglass_force_) hourglass_force_->fill(0);
    if (flow_stress_) flow_stress_->fill(0);
    if (viscous_) viscous_->fill(0);
  }

  void lay_sizes() {
    for (Field<Real>* h : history_)
      lay_size(*h, group_.size(), [&](Index e) { return std::sqrt(group_.V0[e] / thickness_[e]); });
  }

  Real total(const Field<Real>& field) const {
    return sum(group_.size(), [&](Index e) { return erosion_ && erosion_->dead(e) ? 0 : field[e]; });
  }
  Real total_of_dead(const Field<Real>& field) const {
    return sum(group_.size(), [&](Index e) { return erosion_->dead(e) ? field[e] : 0; });
  }
  /// What is at a point through the thickness.
  struct Layer {
    std::shared_ptr<StrengthLaw> law;
    std::size_t numbers = 0;       ///< that the law keeps
    int plastic = -1, fails = -1;  ///< of them the plastic strain, and what it fails by
  };
  static std::vector<Layer> layers_of(const ShellPart& part) {
    std::vector<Layer> out;
    for (std::size_t k = 0; k < part.zeta.size(); ++k) {
      Layer layer{part.laws.empty() ? part.law : part.laws[k]};
      const StrengthLaw& law = *layer.law;
      for (const HistoryVariable& h : law.history()) layer.numbers += static_cast<std::size_t>(h.components);
      layer.plastic = plastic_strain_of(law);
      const bool can_fail = std::isfinite(law.failure_limit()) || part.laws.empty();
      if (can_fail) layer.fails = history_at(law, law.failure_variable());
      out.push_back(std::move(layer));
    }
    return out;
  }
  const Layer& layer_of(int point) const { return layers_[static_cast<std::size_t>(point % layers())]; }

  const ElementGroup& group_;
  std::vector<Layer> layers_;
  Id part_id_;
  Real tssfac_;
  bool by_mesh_ = false;            ///< the frequency of the mesh lowers the step
  const Field<Real>&w_, &inertia_;  ///< of nodes
  ShellControl control_;
  int places_;  ///< of points in the plane
  DistortionWatch distortion_;
  ShellLoops loops_;
  Field<Real>&stress_, &thickness_, &internal_, &hourglass_, &bulk_viscosity_;
  const Field<Real>& corner_inertia_;  ///< rotary inertia for each corner [ML2]
  Field<Real>* hourglass_force_ = nullptr;
  Field<Real>* flow_stress_ = nullptr;  ///< null: hourglass forces grow without a bound
  Field<Real>* viscous_ = nullptr;      ///< q times the thickness
  std::vector<Field<Real>*> history_;   ///< of the first layer, of the second, ...
  ShellMesh mesh_{};
  ShellState state_{};
  std::vector<Real*> history_data_;
  std::vector<ShellLoops::StableStep> found_;  ///< in each block
  std::unique_ptr<ScaledMass> scaled_;         ///< null: no mass scaling
  std::unique_ptr<StiffnessDamping> damping_;  ///< null: none
  std::unique_ptr<ShellState> damped_;         ///< with the stress that pushes the nodes; null: `state_`
  std::shared_ptr<Erosion> erosion_;           ///< null: nothing fails
  std::optional<PointStrains> strains_;        ///< none: not requested
  const Field<Real>* directions_ = nullptr;    ///< null: no law knows any
  const Field<Real>* offset_ = nullptr;        ///< null: the middle is where the nodes are
  bool fails_with_all_ = false;
  bool thins_by_flow_ = false;  ///< ISTUPD 4
  bool stiffens_ = false;       ///< the law of some layer does
};

}  // namespace

Field<Real>& thickness_of_shells(const ElementGroup& group) {
  return group.fields.add<Real>({.name = "shell_thickness", .dimension = "L", .output = true});
}

namespace {

/// Of shells whose thickness never changes.
void show_thickness(const ElementGroup& group, const World& world) {
  Field<Real>& thickness = thickness_of_shells(group);
  for (Index e = 0; e < group.size(); ++e) thickness[e] = world.segments.thickness[(*group.segment)[e]];
}

}  // namespace

void add_shell_passes(const Model& model, const std::vector<ShellPart>& parts,
                      const std::vector<Index>& node_of, ElementOptions& options, World& world) {
  const bool shown = model.output.d3plot.asked() || model.output.d3plot_count > 0;
  const std::vector<std::array<bool, 3>> held = held_at_start(model, node_of, world.nodes);
  for (const auto& group : world.groups) {
    if (!group->segment) continue;
    if (!group->pushes) {
      show_thickness(*group, world);
      world.passes.add(make_null_elements(*group));
      continue;
    }
    const auto named = static_cast<std::size_t>(group->part);
    const ShellPart& part = parts[named].of(group->layup);
    for (std::size_t k = 0; k < part.zeta.size(); ++k) {
      std::size_t numbers = 0;
      for (const HistoryVariable& h : part.law_of(k).history())
        numbers += static_cast<std::size_t>(h.components);
      if (numbers > most_history)
        throw std::logic_error(
            fmt::format("a law with {} history numbers, more than {}", numbers, most_history));
    }
    if (options.sections) group->keep_corner_forces(), group->keep_corner_moments();
    world.passes.add(std::make_shared<ShellForces>(part, *group, model.parts[named].id, model.tssfac, options,
                                                   held, world));
    world.passes.add(make_shell_report(part, *group, shown, options.strains));
  }
  if (auto watch = make_curvature_watch(parts, world)) world.passes.add(std::move(watch));
}

}  // namespace courant
