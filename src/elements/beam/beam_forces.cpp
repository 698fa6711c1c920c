#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "base/run_error.hpp"
#include "elements/beam/beam_axes.hpp"
#include "elements/beam/beam_damping.hpp"
#include "elements/beam/beam_frame.hpp"
#include "elements/beam/beams.hpp"
#include "elements/beam/elastic_beam.hpp"
#include "elements/element_laws.hpp"
#include "elements/element_report.hpp"
#include "elements/mass_scaling.hpp"
#include "elements/null_elements.hpp"
#include "laws/strength/beam_stress.hpp"
#include "state/reports.hpp"
#include "state/shared_fields.hpp"

namespace courant {

namespace {

using Quaternion = Eigen::Quaterniond;
/// Beams of a part: they turn with their ends and nodes as far as these are rigid, and what is left deforms
/// them. Theory: docs/theory_structures.md.
class BeamForces : public Material,
                   public TimeLimit,
                   public EnergyTerm,
                   public PartReporter,
                   public WeldReporter,
                   public ElementReporter,
                   public FieldFiller,
                   public BeamAxes {
 public:
  BeamForces(BeamPart part, Id part_id, Real tssfac, bool shown, ElementOptions& options, World& world)
      : part_(std::move(part)),
        group_(*part_.group),
        part_id_(part_id),
        tssfac_(tssfac),
        turns_(part_.kind != BeamKind::truss),
        w_(turns_ ? shared_fields::angular_velocity.find(world.nodes.fields) : nullptr),
        inertia_(turns_ ? shared_fields::rotary_inertia.find(world.nodes.fields) : nullptr),
        start_(add("start_length", "L", 1)),
        deformation_(add("deformation", "-", count6)),
        answer_(add("end_forces", "-", count6)),
        ends_(add("end_orientations", "-", 8)),
        stress_(add("point_stress", "M/LT2", std::max<int>(1, 3 * static_cast<int>(part_.points.size())))),
        energy_(group_.fields.add<Real>({.name = "internal_energy", .dimension = "ML2/T2", .output = true})),
        damping_(options.stiffness_damping[at(group_.part)], options.stress_ranges[at(group_.part)], group_),
        steps_(static_cast<std::size_t>(group_.size())),
        why_(part_.weld ? static_cast<std::size_t>(group_.size()) : 0),
        folded_(static_cast<std::size_t>(group_.size()), 0) {
    for (std::size_t p = 0; p < part_.points.size(); ++p)
      for (const HistoryVariable& h : part_.law->history())
        history_.push_back(&group_.fields.add<Real>({.name = fmt::format("{}_of_point_{}", h.name, p + 1),
                                                     .dimension = h.dimension,
                                                     .components = h.components}));
    numbers_ = part_.law->history().size();
    const Real K = part_.law->bulk_modulus();
    G_ = part_.law->shear_modulus(), E_ = 9 * K * G_ / (3 * K + G_);
    for (Index e = 0; e < group_.size(); ++e) {
      start_[e] = between_ends(world.nodes.x, e).norm();
      for (int c = 0; c < 2; ++c) put_end(e, c, Quaternion(part_.axes[at(e)]));
    }
    for (Field<Real>* h : history_) lay_size(*h, group_.size(), [&](Index e) { return start_[e]; });
    if (shown) add_shown_fields();
    if (part_.weld) sections_.emplace(*part_.weld, group_);
    scale_masses(scaling_of(part_, options.scaling), world);
    const FailureRules& rules = options.failure[at(group_.part)];
    if (rules.any() || (part_.weld && part_.weld->fails())) make_erosion(rules, options, world);
  }
  std::string name() const override { return group_.fields.name(); }
  const FieldSet& over(const World&) const override { return group_.fields; }
  void declare(const World& world, Accesses& a) const override {
    a.reads(world.nodes.x, Reach::others).reads(group_.node).reads(group_.mass).reads(start_);
    if (turns_) a.reads(*w_, Reach::others).updates(ends_).writes(*group_.corner_moment);
    a.updates(deformation_).updates(answer_).updates(energy_).writes(*group_.corner_force);
    if (!part_.points.empty()) a.updates(stress_);
    if (!part_.releases.empty()) a.reads(world.nodes.v, Reach::others);
    for (const Field<Real>* h : history_) a.updates(*h);
    if (sections_) sections_->declare(a);
    if (scaled_) a.reads(scaled_->inertial());
    if (erosion_) erosion_->declare(world, a);
    damping_.declare(a);
  }

  void finish(World&, const Clock& clock) override {
    const auto folded = std::find(folded_.begin(), folded_.end(), 1);
    if (folded == folded_.end()) return;
    const ReadsForMessage unchecked;
    throw RunError(
        fmt::format("beam {} of part {} is bent or twisted too far: an end has turned by more than {:g} rad "
                    "against the middle of the beam at time {:.6g}, cycle {}",
                    group_.id[static_cast<Index>(folded - folded_.begin())], part_id_, most_turn, clock.t,
                    clock.cycle),
        StopCause::element,
        "it bears no such load: check the load and the units of its section and material, take more elements "
        "along it, or let it fail (*MAT_ADD_EROSION, FAIL of its material)");
  }
  void block(World& world, const Clock& clock, Index begin, Index end) override {
    Change change;
    if (erosion_) erosion_->begin_block(begin, end - begin);
    for (Index e = begin; e < end; ++e) move(world, clock, e, e - begin, change);
    if (part_.kind == BeamKind::resultant)
      for (Index e = begin; e < end; ++e) change.after[e - begin] = resultants(e, change.now[e - begin]);
    else
      integrate(clock, begin, end, change);
    for (Index e = begin; e < end; ++e) finish_one(clock, e, e - begin, change);
    if (erosion_) judge(clock, begin, end);
  }

  Limit limit(const World&, const Clock&) override {
    const Index least = least_of(steps_.data(), group_.size());
    return {tssfac_ * steps_[at(least)], fmt::format("beam {} of part {}", group_.id[least], part_id_)};
  }
  void record(World&, const Clock&, EnergyLedger&) override {}
  void sample(const World&, const Clock&, EnergyLedger& ledger) const override { ledger.internal += total(); }
  void report_part(const World& world, std::vector<PartSums>& parts) const override {
    PartSums& out = parts[static_cast<std::size_t>(group_.part)];
    out.internal += total();
    for (Index e = 0; e < group_.size(); ++e) {
      out.mass += group_.mass[e];
      if (scaled_) out.added_mass += scaled_->added(e);
      if (dead(e)) out.eroded_internal += energy_[e];
      for (int c = 0; c < 2; ++c) {
        const Real share = scaled_ ? scaled_->of_corner(e, c) : group_.mass[e] / 2;
        const Index n = group_.node.data(c)[e];
        const Vec v = world.nodes.v.vec(n);
        out.momentum += share * v;
        out.kinetic += 0.5 * share * v.squaredNorm();
        if (turns_ && world.nodes.m[n] > 0)  // the rotations of a node, by shares of its mass
          out.kinetic += 0.5 * share / world.nodes.m[n] * (*inertia_)[n] * w_->vec(n).squaredNorm();
      }
    }
  }

  void report_welds(const World& world, std::vector<WeldForce>& out) const override {
    for (Index e = 0; sections_ && e < group_.size(); ++e)
      out.push_back(sections_->report(e, group_.id[e], between_ends(world.nodes.x, e).norm()));
  }

  const ElementGroup& beams() const override { return group_; }
  bool knows_section() const override { return turns_; }
  void declare_axes(const World&, Accesses& a) const override {
    if (turns_) a.reads(ends_, Reach::others);
  }
  Matrix axes_of(const World& world, Index e) const override {
    const Vec between = between_ends(world.nodes.x, e);
    Matrix axes = Matrix::Identity();
    if (!turns_) {
      axes.col(0) = between.normalized();
      return axes;
    }
    std::array<Quaternion, 2> ends{end_of(e, 0), end_of(e, 1)};
    return turn_ends(between, {Vec::Zero(), Vec::Zero()}, ends).frame.axes;
  }
  ElementKind kind() const override { return ElementKind::beam; }
  const ElementGroup& reported() const override { return group_; }
  Real cut_measure(Index e) const override { return part_.measures[at(e)].A; }
  bool bends() const override { return turns_; }
  ElementReport report_element(const World& world, Index e, const ElementReportOptions&) const override {
    ElementReport out{.deleted = dead(e)};
    const auto g = [&](Part6 k) { return answer_.data(k)[e]; };
    const Real L = between_ends(world.nodes.x, e).norm();
    out.resultants = {g(elongation),
                      -(g(turn1_t) + g(turn2_t)) / L,
                      (g(turn1_s) + g(turn2_s)) / L,
                      (g(turn2_s) - g(turn1_s)) / 2,
                      (g(turn2_t) - g(turn1_t)) / 2,
                      g(twist)};
    const int plastic = plastic_strain_of(*part_.law);
    for (std::size_t p = 0; p < part_.points.size(); ++p) {
      PointReport& point = out.points.emplace_back();
      for (std::size_t k = 0; k < 3; ++k)
        point.stress[std::array<std::size_t, 3>{0, 3, 5}[k]] = stress_.data(static_cast<int>(3 * p + k))[e];
      for (std::size_t k = p * numbers_; k < (p + 1) * numbers_; ++k)
        for (int c = 0; c < history_[k]->info().components; ++c)
          point.history.push_back(history_[k]->data(c)[e]);
      if (plastic >= 0) point.plastic = point.history[at(plastic)];
    }
    return out;
  }

  /// Pull, and moments of the section about r, s and t at both ends: tension, and on the side of +s or -t
  /// pressure, are positive.
  void fill_fields(World&) override {
    if (!shown_pull_) return;
    for (Index e = 0; e < group_.size(); ++e) {
      const auto g = [&](Part6 k) { return answer_.data(k)[e]; };
      (*shown_pull_)[e] = g(elongation);
      if (turns_) {
        shown_moment_[0]->set(e, Vec(g(twist), -g(turn1_s), -g(turn1_t)));
        shown_moment_[1]->set(e, Vec(g(twist), g(turn2_s), g(turn2_t)));
      }
      for (const auto& [to, first] : shown_history_) {
        Real most = history_[first]->data()[e];
        for (std::size_t k = first; k < history_.size(); k += numbers_)
          most = std::max(most, history_[k]->data()[e]);
        (*to)[e] = most;
      }
    }
  }

 private:
  static constexpr Real most_turn = 1.5;  ///< of an end against r, s, t; at half of pi twist has two answers
  /// Of the beams of a block.
  struct Change {
    std::array<Six, block_size> now{}, after{};
    std::array<TurnedEnds, block_size> turned{};
  };
  static std::size_t at(Index e) { return static_cast<std::size_t>(e); }
  Field<Real>& add(const char* field, const char* dimension, int components) {
    return group_.fields.add<Real>({.name = field, .dimension = dimension, .components = components});
  }
  Real total() const {
    return sum(group_.size(), [&](Index e) { return dead(e) ? 0 : energy_[e]; });
  }
  bool dead(Index e) const { return erosion_ && erosion_->dead(e); }
  /// That inertia and the step belong to. [M]
  Real inertial_mass(Index e) const { return scaled_ ? scaled_->inertial()[e] : group_.mass[e]; }
  Real step_of(Index e, Real length, Real pull) const {
    const BeamMeasures& m = part_.measures[at(e)];
    const Real mass = inertial_mass(e);
    const Real inertia = turns_ ? end_inertia(part_.kind, *part_.law, m, mass, start_[e]) : 0;
    return 2 / std::sqrt(largest_square(part_.kind, *part_.law, m, mass, inertia, start_[e], length, pull));
  }

  /// Inertia grows in the same ratio as mass.
  void scale_masses(const MassScaling& rules, World& world) {
    if (rules.step == 0) return;
    Field<Real>* const inertia = turns_ ? &add("corner_inertia", "ML2", 1) : nullptr;
    std::vector<Real> step;
    for (Index e = 0; e < group_.size(); ++e) {
      if (inertia)
        (*inertia)[e] = end_inertia(part_.kind, *part_.law, part_.measures[at(e)], group_.mass[e], start_[e]);
      step.push_back(step_of(e, start_[e], 0));
    }
    scaled_ = std::make_unique<ScaledMass>(rules, group_, inertia, world);
    scaled_->start(step, world);
  }
  void make_erosion(const FailureRules& rules, ElementOptions& options, World& world) {
    erosion_ =
        std::make_shared<Erosion>(rules, group_, std::max<int>(1, static_cast<int>(part_.points.size())),
                                  Erosion::Energies{&energy_, nullptr, nullptr}, world);
    erosion_->vanishes(stress_), erosion_->vanishes(answer_);
    if (sections_) erosion_->vanishes(sections_->field());
    for (Field<Real>* h : history_)
      if (h->info().components == 6) erosion_->vanishes(*h);
    plastic_ = plastic_strain_of(*part_.law), fails_ = history_at(*part_.law, part_.law->failure_variable());
    options.eroding.push_back(erosion_);
  }

  void judge(const Clock& clock, Index begin, Index end) {
    std::array<Real, block_size> unused{};
    std::array<bool, block_size> before{};
    for (Index e = begin; e < end; ++e)
      if (!(before[at(e - begin)] = dead(e)) && sections_ && !why_[at(e)].empty())
        erosion_->fail(begin, e, why_[at(e)]);
    erosion_->judge(begin, end - begin, tssfac_, steps_.data() + begin, unused.data(), nullptr,
                    {group_, begin, clock.dt_old});
    for (Index e = begin; sections_ && e < end; ++e)
      if (dead(e) && !before[at(e - begin)]) sections_->failed(e, clock.t);
  }
  Vec between_ends(const Field<Real>& of, Index e) const {
    return of.vec(group_.node.data(1)[e]) - of.vec(group_.node.data(0)[e]);
  }
  Quaternion end_of(Index e, int c) const {
    const auto q = [&](int k) { return ends_.data(4 * c + k)[e]; };
    return Quaternion(q(0), q(1), q(2), q(3));
  }
  void put_end(Index e, int c, const Quaternion& q) {
    const Real values[] = {q.w(), q.x(), q.y(), q.z()};
    for (int k = 0; k < 4; ++k) ends_.data(4 * c + k)[e] = values[k];
  }

  void move(const World& world, const Clock& clock, Index e, Index i, Change& change) {
    Six& now = change.now[at(i)];
    TurnedEnds& turned = change.turned[at(i)];
    BeamFrame& frame = turned.frame;
    const Vec between = between_ends(world.nodes.x, e);
    now = {};
    if (dead(e)) {  // taken as it is at rest
      for (int k = 0; k < count6; ++k) now[at(k)] = deformation_.data(k)[e];
      frame = {start_[e], Matrix::Identity()};
      return;
    }
    if (!turns_) {
      frame.length = between.norm();
      frame.axes.col(0) = between / frame.length;
    } else {
      std::array<Quaternion, 2> ends{end_of(e, 0), end_of(e, 1)};
      std::array<Vec, 2> angle;
      for (int c = 0; c < 2; ++c) angle[at(c)] = clock.dt_old * w_->vec(group_.node.data(c)[e]);
      const BeamReleases* const releases = releases_of(e);
      turned = releases ? turn_ends(between, between - clock.dt_old * between_ends(world.nodes.v, e), angle,
                                    *releases, ends)
                        : turn_ends(between, angle, ends);
      for (int c = 0; c < 2; ++c) put_end(e, c, ends[at(c)]);
      const auto& [turn1, turn2] = turned.turn;
      now[twist] = turn2[0] - turn1[0];
      // s is the mean of both ends': beyond half a turn of twist it would point the other way
      folded_[at(e)] = turn1.norm() > most_turn || turn2.norm() > most_turn ||
                       std::abs(now[twist] - deformation_.data(twist)[e]) > pi;
      now[turn1_s] = turn1[1], now[turn2_s] = turn2[1], now[turn1_t] = turn1[2], now[turn2_t] = turn2[2];
    }
    now[elongation] = frame.length - start_[e];
  }

  const BeamReleases* releases_of(Index e) const {
    return part_.releases.empty() || !part_.releases[at(e)].any() ? nullptr : &part_.releases[at(e)];
  }
  Six resultants(Index e, const Six& d) const {
    const ElasticBeam beam{E_, G_, start_[e]};
    return part_.releases.empty()
               ? resultant_end_forces(beam, part_.measures[at(e)], d)
               : released_end_forces(beam, part_.measures[at(e)], part_.releases[at(e)], d);
  }
  /// Stress at the points of the section in the middle of the beam, and its resultants.
  void integrate(const Clock& clock, Index begin, Index end, Change& change) {
    const Index n = end - begin;
    std::array<std::array<Real, block_size>, 3> rate{}, unused{};
    std::array<Real, block_size> across{}, none{};
    std::array<Real, block_size> sound{};
    std::array<Six, block_size> middle{};  // axial force, torsion, moments about s and t, shear along s and t
    PointBlock points;
    points.count = n, points.dt = clock.dt_old, points.sound_speed = sound.data();
    points.rate = {rate[0].data(), nullptr, nullptr, rate[1].data(), nullptr, rate[2].data()};
    const Real per_time = clock.dt_old > 0 ? 1 / clock.dt_old : 0;
    std::vector<Real*> numbers;
    for (std::size_t p = 0; p < part_.points.size(); ++p) {
      const SectionPoint& point = part_.points[p];
      for (Index i = 0; i < n; ++i) {
        const BeamMeasures& m = part_.measures[at(begin + i)];
        const Six d = change_of(begin + i, change.now[at(i)]);
        const Real L = change.turned[at(i)].frame.length - 0.5 * d[elongation], s = point.s * m.half_s,
                   t = point.t * m.half_t;
        rate[0][at(i)] =
            per_time / L * (d[elongation] - s * (d[turn2_t] - d[turn1_t]) + t * (d[turn2_s] - d[turn1_s]));
        rate[1][at(i)] = 0.5 * per_time * (-0.5 * (d[turn1_t] + d[turn2_t]) - t * d[twist] / L);
        rate[2][at(i)] = 0.5 * per_time * (0.5 * (d[turn1_s] + d[turn2_s]) + s * d[twist] / L);
      }
      const auto mine = [&](int k) { return stress_.data(3 * static_cast<int>(p) + k) + begin; };
      points.stress = {mine(0), unused[0].data(), unused[1].data(), mine(1), unused[2].data(), mine(2)};
      numbers.clear();
      for (std::size_t k = p * numbers_; k < (p + 1) * numbers_; ++k)
        for (int c = 0; c < history_[k]->info().components; ++c)
          numbers.push_back(history_[k]->data(c) + begin);
      points.history = numbers;
      update_in_beam(*part_.law, points, across.data());
      if (erosion_)
        erosion_->look({.point = static_cast<int>(p),
                        .begin = begin,
                        .count = n,
                        .t = clock.t,
                        .dt = clock.dt_old,
                        .rate = {rate[0].data(), across.data(), across.data(), rate[1].data(), none.data(),
                                 rate[2].data()},
                        .stress = points.stress,
                        .plastic = plastic_ < 0 ? nullptr : numbers[at(plastic_)],
                        .by_law = fails_ < 0 ? nullptr : numbers[at(fails_)]});
      for (Index i = 0; i < n; ++i) {
        const BeamMeasures& m = part_.measures[at(begin + i)];
        const Real A = point.share * m.A, s = point.s * m.half_s, t = point.t * m.half_t;
        const Real xx = mine(0)[i], xs = mine(1)[i], xt = mine(2)[i];
        Six& sum = middle[at(i)];
        sum[0] += A * xx, sum[1] += A * (s * xt - t * xs);
        sum[2] += A * t * xx, sum[3] -= A * s * xx, sum[4] += A * xs, sum[5] += A * xt;
      }
    }
    for (Index i = 0; i < n; ++i) {
      const BeamMeasures& m = part_.measures[at(begin + i)];
      Six& sum = middle[at(i)];
      if (part_.preload.any() && !dead(begin + i))
        part_.preload.hold(begin + i, clock.t, part_.points, m, stress_, sum);
      if (sections_ && !dead(begin + i)) why_[at(begin + i)] = sections_->look(begin + i, sum, clock.t);
      const Real half = turns_ ? 0.5 * change.turned[at(i)].frame.length * m.shear_area / m.A : 0;
      change.after[at(i)] = {sum[0],
                             sum[1],
                             -sum[2] + half * sum[5],
                             sum[2] + half * sum[5],
                             -sum[3] - half * sum[4],
                             sum[3] - half * sum[4]};
    }
  }
  Six change_of(Index e, const Six& now) const {
    Six out;
    for (int k = 0; k < count6; ++k) out[at(k)] = now[at(k)] - deformation_.data(k)[e];
    return out;
  }

  /// Energy, forces and moments on the ends, and the step.
  void finish_one(const Clock& clock, Index e, Index i, const Change& change) {
    if (dead(e)) return;  // the pass that finds failures removes its forces
    const Six& now = change.now[at(i)];
    Six g = change.after[at(i)];
    const Real pull = g[elongation];
    Real work = 0;
    const Six damping = damping_.any() ? damped(clock, e, change_of(e, now), work) : Six{};
    for (int k = 0; k < count6; ++k) {
      work += 0.5 * (answer_.data(k)[e] + g[at(k)]) * (now[at(k)] - deformation_.data(k)[e]);
      answer_.data(k)[e] = g[at(k)], deformation_.data(k)[e] = now[at(k)];
    }
    energy_[e] += work;
    for (int k = 0; damping_.any() && k < count6; ++k) g[at(k)] += damping[at(k)];
    const TurnedEnds& turned = change.turned[at(i)];
    NodalForces on{g[elongation] * turned.frame.axes.col(0)};
    if (turns_)
      on = nodal_forces(turned, releases_of(e), g[elongation],
                        {Vec(-g[twist], g[turn1_s], g[turn1_t]), Vec(g[twist], g[turn2_s], g[turn2_t])});
    for (int k = 0; k < 3; ++k) {
      group_.corner_force->data(k)[e] = on.force[k], group_.corner_force->data(3 + k)[e] = -on.force[k];
      for (int c = 0; turns_ && c < 2; ++c) group_.corner_moment->data(3 * c + k)[e] = on.moment[at(c)][k];
    }
    steps_[at(e)] = step_of(e, turned.frame.length, pull) *
                    (turns_ ? bent_step(turned, part_.measures[at(e)].thickness2(start_[e])) : 1);
    if (damping_.any()) damping_.shorten(e, steps_[at(e)]);
  }
  /// Forces of damping on the ends, by those of an elastic beam.
  Six damped(const Clock& clock, Index e, const Six& d, Real& work) {
    return damping_.forces(clock, e, d,
                           part_.kind == BeamKind::resultant
                               ? resultants(e, d)
                               : integrated_end_forces({E_, G_, start_[e]}, part_, part_.measures[at(e)], d),
                           work);
  }

  void add_shown_fields() {
    const auto show = [&](const char* field, const char* dimension, int components) {
      return &group_.fields.add<Real>({.name = field,
                                       .dimension = dimension,
                                       .components = components,
                                       .output = true,
                                       .restart = false});
    };
    shown_pull_ = show("axial_force", "ML/T2", 1);
    if (turns_) shown_moment_ = {show("moment_at_end_1", "ML2/T2", 3), show("moment_at_end_2", "ML2/T2", 3)};
    const std::vector<HistoryVariable> kinds = part_.law->history();
    for (std::size_t k = 0; k < kinds.size() && !part_.points.empty(); ++k)
      if (kinds[k].components == 1)
        shown_history_.emplace_back(show(kinds[k].name.c_str(), kinds[k].dimension.c_str(), 1), k);
  }
  BeamPart part_;
  ElementGroup& group_;
  Id part_id_;
  Real tssfac_, E_ = 0, G_ = 0;
  bool turns_;
  const Field<Real>*w_, *inertia_;  ///< of nodes
  Field<Real>& start_;              ///< length without stress
  Field<Real>&deformation_, &answer_;
  Field<Real>& ends_;    ///< axes of the ends: quaternions w x y z, of end 1 and 2
  Field<Real>& stress_;  ///< of each point xx, xs, xt
  Field<Real>& energy_;
  BeamDamping damping_;
  std::vector<Field<Real>*> history_;  ///< of the first point, of the second, ...
  std::size_t numbers_ = 0;            ///< of them, a point
  std::vector<Real> steps_;
  std::optional<WeldSections> sections_;  ///< of welds
  std::unique_ptr<ScaledMass> scaled_;    ///< null: none
  std::shared_ptr<Erosion> erosion_;      ///< null: nothing fails
  int plastic_ = -1, fails_ = -1;         ///< of a point's numbers the plastic strain, and what it fails by
  std::vector<std::string> why_;          ///< welds fail in this step
  std::vector<char> folded_;              ///< ends turned so far that their sense is unknown
  Field<Real>* shown_pull_ = nullptr;
  std::array<Field<Real>*, 2> shown_moment_{};
  std::vector<std::pair<Field<Real>*, std::size_t>> shown_history_;
};

}  // namespace

void add_beam_passes(const Model& model, const std::vector<BeamPart>& parts, ElementOptions& options,
                     World& world) {
  const bool shown = model.output.d3plot.asked() || model.output.d3plot_count > 0;
  for (const BeamPart& part : parts)
    if (part.group && part.null)
      world.passes.add(make_null_elements(*part.group));
    else if (part.group)
      world.passes.add(std::make_shared<BeamForces>(part, model.parts[static_cast<std::size_t>(part.part)].id,
                                                    model.tssfac, shown, options, world));
}

}  // namespace courant
