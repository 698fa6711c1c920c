// *BOUNDARY_PRESCRIBED_MOTION_NODE and _SET.
#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <utility>

#include <fmt/format.h>
#include <Eigen/Geometry>

#include "loads/loads.hpp"
#include "loads/sensors/sensors.hpp"

#include "parallel/parallel.hpp"
#include "state/reports.hpp"
#include "state/shared_fields.hpp"

namespace courant {

namespace {

/// Motions of which a point follows all at once.
using Group = std::vector<std::size_t>;

/// Of each motion whether sensors let it act.
struct SensorGates {
  const SensorBoard* board = nullptr;  ///< null: the deck has none
  std::vector<int> control{};          ///< of the board; -1: none
  bool open(std::size_t motion) const {
    return !board || control[motion] < 0 || board->control_is_on(control[motion]);
  }
};

/// Gives driven points the velocity of the coming half step before they are kicked and moved, and takes
/// the force along it away. What the drive does of work is external.
class PrescribedPoints : public Drive, public Impact, public EnergyTerm, public BoundaryForceReporter {
 public:
  PrescribedPoints(std::vector<PrescribedMotion> motions, SensorGates gates, std::vector<Group> groups,
                   Points points, Field<Index>& group, Field<Real>* work)
      : points_(points),
        motions_(std::move(motions)),
        gates_(std::move(gates)),
        groups_(std::move(groups)),
        group_(group),
        work_(work),
        axes_(points.turns || !points.follow ? nullptr : &shared_fields::driven_axes.add(*points.set)),
        projector_(points.driven_projector().add(*points.set)),
        change_(points.driven_change().add(*points.set)),
        around_(!points_.turns && std::any_of(motions_.begin(), motions_.end(),
                                              [](const PrescribedMotion& m) { return m.around >= 0; })) {}
  std::string name() const override { return "prescribed " + points_.name(); }
  const FieldSet& over(const World&) const override { return points_.fields(); }
  void declare(const World&, Accesses& a) const override {
    a.revises(*points_.v).updates(*points_.f).reads(group_);  // behind the damping of a relaxation
    if (axes_) a.updates(*axes_);
    if (around_) a.reads(*points_.x);
  }

  void start(World&, const Clock& clock) override { choose(clock); }
  void block(World& world, const Clock&, Index begin, Index end) override {
    for (Index i = begin; i < std::min(end, loaded_points(points_, world)); ++i) {
      if (group_[i] == 0) continue;
      if (axes_) (*axes_)[i] = axes_of_[static_cast<std::size_t>(group_[i])];
      for (const Drive* drive : drives_[static_cast<std::size_t>(group_[i])]) {
        const Vec &d = drive->direction, v = points_.v->vec(i), f = points_.f->vec(i);
        points_.v->add(i, (drive->velocity(v, place(i)) - v.dot(d)) * d);
        points_.f->add(i, -f.dot(d) * d);
      }
    }
  }

  /// For all that asks which directions are driven, and with what velocity, in the coming step.
  void strike(World& world, const Clock& clock) override {
    choose(clock);
    for_each(loaded_points(points_, world), [&](Index i) {
      Vec change = Vec::Zero();
      Matrix along = Matrix::Zero();
      for (const Drive* drive : drives_[static_cast<std::size_t>(group_[i])]) {
        const Vec v = points_.v->vec(i);
        change += (drive->velocity(v, place(i)) - v.dot(drive->direction)) * drive->direction;
        along += drive->direction * drive->direction.transpose();
      }
      change_.set(i, change);
      const Real parts[] = {along(0, 0), along(1, 1), along(2, 2), along(0, 1), along(1, 2), along(2, 0)};
      for (int k = 0; k < 6; ++k) projector_.data(k)[i] = parts[k];
    });
  }

  /// The force of the drive makes m dv = (f + drive) dt; its work is drive . (v + dv/2) dt.
  void record(World& world, const Clock& clock, EnergyLedger& ledger) override {
    choose(clock);
    const Index n = loaded_points(points_, world);
    const Real dt = clock.dt_mean();
    const auto work_on = [&](Index i) {
      Real work = 0;
      if (group_[i] == 0) return work;
      for (const Drive* drive : drives_[static_cast<std::size_t>(group_[i])]) {
        const Vec v = points_.v->vec(i);
        const Real before = v.dot(drive->direction), after = drive->velocity(v, place(i));
        const Real force = points_.f->vec(i).dot(drive->direction);
        work += ((*points_.m)[i] * (after - before) - force * dt) * 0.5 * (before + after);
      }
      return work;
    };
    if (work_)
      for (Index i = 0; i < n; ++i) (*work_)[i] += work_on(i);
    ledger.external_work += sum(n, work_on);
    ledger.throughput += sum(n, [&](Index i) { return std::abs(work_on(i)); });
  }
  void sample(const World&, const Clock&, EnergyLedger&) const override {}

  void report_forces(const World& world, const Clock& clock, std::vector<BoundaryForce>& out) const override {
    if (!work_) return;
    for (Index i = 0; i < loaded_points(points_, world); ++i) {
      if (group_[i] == 0) continue;
      BoundaryForce force{
          .kind = points_.turns ? BoundaryForce::Kind::driven_rotation : BoundaryForce::Kind::driven_point,
          .id = (*points_.id)[i],
          .work = (*work_)[i]};
      Vec& sum = points_.turns ? force.moment : force.force;
      for (const std::size_t k : groups_[static_cast<std::size_t>(group_[i])]) {
        if (!drives(k, clock)) continue;
        const Vec& d = motions_[k].direction;
        const Real before = points_.v->vec(i).dot(d);
        const Real after = drive_of(motions_[k], clock).velocity(points_.v->vec(i), place(i));
        const Real acceleration = (after - before) / clock.dt_mean();
        sum += ((*points_.m)[i] * acceleration - points_.f->vec(i).dot(d)) * d;
      }
      out.push_back(force);
    }
  }

 private:
  /// What a motion does in the coming step: v.direction becomes `at_zero` + `keep` v.direction, and, of
  /// points that go round an axis, `per_place`.(x - centre).
  struct Drive {
    Vec direction = Vec::Zero();
    Real at_zero = 0, keep = 0;
    Vec per_place = Vec::Zero(), centre = Vec::Zero();
    Real velocity(const Vec& v, const Vec& x) const {
      return at_zero + keep * v.dot(direction) + per_place.dot(x - centre);
    }
  };
  static Drive drive_of(const PrescribedMotion& m, const Clock& clock) {
    const Real at_zero = m.velocity(clock.t, clock.dt, clock.dt_old, 0);
    if (m.around < 0)
      return {m.direction, at_zero, m.kind == PrescribedMotion::Kind::acceleration ? 1.0 : 0.0};
    if (!(clock.dt > 0)) return {m.direction};
    // the chord of the arc that leads to the position at the end of the step
    const Matrix turn = Eigen::AngleAxisd(at_zero * clock.dt, Vec::Unit(m.around)).toRotationMatrix();
    const Matrix chord = (turn - Matrix::Identity()) / clock.dt;
    return {m.direction, 0, 0, chord.transpose() * m.direction, m.centre};
  }
  Vec place(Index i) const { return around_ ? points_.x->vec(i) : Vec(Vec::Zero()); }

  bool drives(std::size_t k, const Clock& clock) const {
    return motions_[k].drives(clock.t, clock.dt) && gates_.open(k);
  }

  void choose(const Clock& clock) {
    all_.assign(motions_.size(), {});
    for (std::size_t k = 0; k < motions_.size(); ++k)
      if (drives(k, clock)) all_[k] = drive_of(motions_[k], clock);
    drives_.assign(groups_.size(), {});
    axes_of_.assign(groups_.size(), 0);
    for (std::size_t g = 0; g < groups_.size(); ++g)
      for (const std::size_t k : groups_[g]) {
        if (!drives(k, clock)) continue;
        drives_[g].push_back(&all_[k]);
        for (int axis = 0; axis < 3; ++axis)
          if (all_[k].direction[axis] != 0) axes_of_[g] |= 1 << axis;
      }
  }

  Points points_;
  std::vector<PrescribedMotion> motions_;
  SensorGates gates_;
  std::vector<Group> groups_;  ///< the first one is empty
  Field<Index>& group_;        ///< of each point
  Field<Real>* work_;          ///< on each point so far; null: not needed
  Field<Index>* axes_;         ///< null: of rotations, or of particles
  Field<Real>&projector_, &change_;
  std::vector<Index> axes_of_;                     ///< of each group, in this step
  bool around_;                                    ///< some go round an axis
  std::vector<Drive> all_;                         ///< of each motion
  std::vector<std::vector<const Drive*>> drives_;  ///< of each group, those that drive in this step
};

/// A set of points, and where the model's nodes are in it.
struct Driven {
  Points points;
  std::vector<Index> point_of_node;  ///< -1: it is not there
  std::vector<Group> groups_of;      ///< of each point
  bool any = false;
};

class PrescribedBuilder {
 public:
  PrescribedBuilder(const Deck& deck, const Model& model, const MotionLimits& limits, World& world,
                    Diagnostics& diagnostics)
      : deck_(deck), model_(model), limits_(limits), diagnostics_(diagnostics) {
    gates_.board = sensors_of(deck, model, world, diagnostics);
    std::vector<Points> all{points_of(world.particles), points_of(world.nodes)};
    if (has_rotations(world.nodes)) all.push_back(rotations_of(world.nodes));
    for (const Points& points : all) {
      Driven set{points, std::vector<Index>(model.nodes.size(), -1), {}, false};
      const std::vector<Index> node = model_nodes(model, world, points);
      for (std::size_t i = 0; i < node.size(); ++i) {
        const bool follows = points.follow && (*points.follow)[static_cast<Index>(i)];
        if (node[i] >= 0 && !follows)
          set.point_of_node[static_cast<std::size_t>(node[i])] = static_cast<Index>(i);
      }
      set.groups_of.resize(node.size());
      sets_.push_back(std::move(set));
    }
  }

  void add(const PrescribedMotion& motion) {
    if (limits_.dim == 2 && !motion.turns && (motion.direction[2] != 0 || motion.around >= 0))
      return error(motion,
                   "in 2D particles stay in their plane, so nothing moves along z or is driven round an axis",
                   "use DOF 1 or 2");
    motions_.push_back(motion);
    if (gates_.board)
      gates_.control.push_back(gates_.board->control_of(SensorControl::Of::motion, motion.id));
    for (const Index n : motion.nodes)
      if (!add(motion, n)) return;  // one message for each card
  }

  /// Adds a pass for each set of which points are driven; false: there is none.
  bool finish(World& world) {
    bool any = false;
    for (const Driven& set : sets_) {
      if (!set.any) continue;
      any = true;
      world.passes.add(pass_of(set));
    }
    return any;
  }

 private:
  void error(const PrescribedMotion& motion, std::string message, std::string hint) {
    deck_.error(diagnostics_, motion.card, "DOF", std::move(message), std::move(hint));
  }

  std::shared_ptr<PrescribedPoints> pass_of(const Driven& set) const {
    auto& group = set.points.driven().add(*set.points.set);
    std::map<Group, Index> known{{Group(), 0}};
    std::vector<Group> groups{Group()};
    for (std::size_t i = 0; i < set.groups_of.size(); ++i) {
      const auto [it, is_new] = known.try_emplace(set.groups_of[i], static_cast<Index>(groups.size()));
      if (is_new) groups.push_back(set.groups_of[i]);
      group[static_cast<Index>(i)] = it->second;
    }
    // always, so that a restart may ask for other histories
    Field<Real>* work = &set.points.set->add<Real>(
        {.name = set.points.turns ? "drive_work_of_rotations" : "drive_work", .dimension = "ML2/T2"});
    return std::make_shared<PrescribedPoints>(motions_, gates_, std::move(groups), set.points, group, work);
  }

  bool add(const PrescribedMotion& motion, Index n) {
    const ModelNode& node = model_.nodes[static_cast<std::size_t>(n)];
    const auto set = std::find_if(sets_.begin(), sets_.end(), [&](const Driven& s) {
      return s.points.turns == motion.turns && s.point_of_node[static_cast<std::size_t>(n)] >= 0;
    });
    if (set == sets_.end() && motion.turns) {
      error(motion, fmt::format("node {} does not turn: only corners of shells that deform do", node.id),
            "use DOF 1 to 4");
      return false;
    }
    if (set == sets_.end()) {
      error(motion,
            fmt::format("node {} is neither a particle nor a node of deformable elements, which alone can be "
                        "driven beside rigid bodies",
                        node.id),
            "drive the rigid body that it belongs to by *BOUNDARY_PRESCRIBED_MOTION_RIGID, or the corners of "
            "the "
            "face to which it is tied");
      return false;
    }
    const bool particle = set == sets_.begin();
    if (particle && !allowed_for_particles(motion)) return false;
    const char* const what = particle ? "particle" : "node";
    const auto turns_held = model_.held_rotations.find(n);
    const std::array<bool, 3> fixed = !motion.turns                               ? node.fixed
                                      : turns_held == model_.held_rotations.end() ? std::array<bool, 3>{}
                                                                                  : turns_held->second;
    for (int k = 0; k < 3; ++k)
      if (fixed[static_cast<std::size_t>(k)] && motion.direction[k] != 0) {
        error(motion,
              fmt::format("{} {} is held {} {} by *BOUNDARY_SPC or {}", what, node.id,
                          motion.turns ? "about" : "in", "xyz"[k], motion.turns ? "RC" : "TC"),
              "leave out one of the two");
        return false;
      }
    const Index i = set->point_of_node[static_cast<std::size_t>(n)];
    Group& mine = set->groups_of[static_cast<std::size_t>(i)];
    for (const std::size_t other : mine)
      if (const std::string why = clash(motions_[other], motion); !why.empty()) {
        error(motion, fmt::format("of {} {}, {} {}", what, node.id, deck_.place(motions_[other].card), why),
              "let one end (DEATH) before the other starts (BIRTH), or leave it out");
        return false;
      }
    mine.push_back(motions_.size() - 1);
    set->any = true;
    return true;
  }

  bool allowed_for_particles(const PrescribedMotion& motion) {
    if (limits_.boxed) {
      error(motion,
            "prescribed motions and the box BOXID of *CONTROL_SPH exclude each other: outside of it "
            "particles keep their velocity",
            "leave BOXID blank");
      return false;
    }
    constexpr Real along = 1e-9;  // cosine
    for (const Vec& normal : limits_.mirrors)
      if (std::abs(normal.dot(motion.direction)) > along) {
        error(motion,
              "the direction is not along a symmetry plane, which would reflect what is driven through it",
              "drive along the plane, or use a driven rigid plate as the wall");
        return false;
      }
    return true;
  }

  const Deck& deck_;
  const Model& model_;
  const MotionLimits& limits_;
  Diagnostics& diagnostics_;
  std::vector<Driven> sets_;
  SensorGates gates_;
  std::vector<PrescribedMotion> motions_;
};

}  // namespace

bool add_prescribed_points(const std::vector<PrescribedMotion>& motions, const Deck& deck, const Model& model,
                           const MotionLimits& limits, World& world, Diagnostics& diagnostics) {
  const auto drives_nodes = [](const PrescribedMotion& motion) { return motion.body == 0; };
  if (std::none_of(motions.begin(), motions.end(), drives_nodes)) return false;
  PrescribedBuilder builder(deck, model, limits, world, diagnostics);
  for (const PrescribedMotion& motion : motions)
    if (drives_nodes(motion)) builder.add(motion);
  return diagnostics.ok() && builder.finish(world);
}

}  // namespace courant
