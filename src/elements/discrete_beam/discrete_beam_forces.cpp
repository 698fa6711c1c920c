#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include <Eigen/Geometry>

#include "base/rotation.hpp"
#include "elements/beam/two_node_forces.hpp"
#include "elements/discrete_beam/discrete_beams.hpp"
#include "elements/nodal_rotations.hpp"
#include "state/shared_fields.hpp"

namespace courant {

namespace {

using Quaternion = Eigen::Quaterniond;

/// Discrete beams of a part: displacements and angles along the triad since the last motion, the laws, forces
/// and moments on the ends. Theory: docs/theory_structures.md.
class DiscreteBeamForces : public TwoNodeForces {
 public:
  DiscreteBeamForces(const DiscreteBeamPart& part, ElementGroup& group, Id part_id, Real tssfac,
                     ElementOptions& options, World& world)
      : TwoNodeForces(group, part_id, tssfac, "discrete beam"),
        law_(part.law),
        triad_(part.triad),
        inertia_(part.inertia),
        w_(shared_fields::angular_velocity.find(world.nodes.fields)),
        axes_(add("triad", "-", 4, false)),
        displacement_(add("displacement", "-", 6, false)),
        answer_(add("end_forces", "-", 6, false)),
        state_(add("law_state", "-", 6 * SpringLaw::numbers, false)) {
    for (Index e = 0; e < group_.size(); ++e) {
      put_triad(e, Quaternion(part.axes[at(e)]));
      for (std::size_t d = 0; d < 6; ++d) answer_.data(static_cast<int>(d))[e] = law_->springs[d].preload;
    }
    if (law_->limits.any()) may_fail(answer_, options, world);
  }
  void declare(const World& world, Accesses& a) const override {
    a.reads(world.nodes.x, Reach::others).reads(world.nodes.v, Reach::others);
    if (w_) a.reads(*w_, Reach::others);
    a.reads(group_.node).reads(group_.mass).updates(axes_).updates(displacement_).updates(answer_);
    a.updates(state_).updates(energy_).writes(*group_.corner_force);
    if (group_.corner_moment) a.writes(*group_.corner_moment);
    if (erosion_) erosion_->declare(world, a);
  }

  Real cut_measure(Index) const override { return 1; }
  ElementReport report_element(const World&, Index e, const ElementReportOptions&) const override {
    const auto f = [&](int d) { return answer_.data(d)[e]; };
    return {.deleted = dead(e), .resultants = {f(0), f(1), f(2), f(4), f(5), f(3)}};
  }

 private:
  Quaternion triad(Index e) const {
    const auto q = [&](int k) { return axes_.data(k)[e]; };
    return Quaternion(q(0), q(1), q(2), q(3));
  }
  void put_triad(Index e, const Quaternion& q) {
    const Real values[] = {q.w(), q.x(), q.y(), q.z()};
    for (int k = 0; k < 4; ++k) axes_.data(k)[e] = values[k];
  }

  Real turning_energy(Index e, Index node) const override {
    return w_ ? inertia_[at(e)] / 4 * w_->vec(node).squaredNorm() : 0;
  }

  /// How the ends of a beam moved over the last half step.
  struct Ends {
    Vec between, v;            ///< from end 1 to 2 now; relative velocity
    std::array<Vec, 2> omega;  ///< of the ends
  };
  Ends ends_of(const World& world, Index e) const {
    const Index n[] = {group_.node.data(0)[e], group_.node.data(1)[e]};
    const auto turning = [&](int c) { return w_ ? w_->vec(n[c]) : Vec(Vec::Zero()); };
    return {world.nodes.x.vec(n[1]) - world.nodes.x.vec(n[0]),
            world.nodes.v.vec(n[1]) - world.nodes.v.vec(n[0]),
            {turning(0), turning(1)}};
  }
  /// After a share of the step; `between`: then.
  Quaternion turned_triad(const Quaternion& before, const Ends& ends, Real dt, const Vec& between) const {
    Vec omega = triad_.node < 0   ? ends.omega[0]
                : triad_.node > 0 ? ends.omega[1]
                                  : Vec(0.5 * (ends.omega[0] + ends.omega[1]));
    const Matrix axes = before.toRotationMatrix();
    for (int k = 0; k < 3; ++k)
      if (triad_.held[at(k)]) omega -= omega.dot(axes.col(k)) * axes.col(k);
    const Quaternion turned = turned_by(dt * omega, before);
    if (!triad_.line || !(between.norm() > 0)) return turned;
    return (Quaternion::FromTwoVectors(turned * Vec::UnitX(), between) * turned).normalized();
  }

  void advance(const World& world, const Clock& clock, Index begin, Index e) override {
    const Ends ends = ends_of(world, e);
    const Vec middle = ends.between - 0.5 * clock.dt_old * ends.v;
    const Quaternion before = triad(e), now = turned_triad(before, ends, clock.dt_old, ends.between);
    const Matrix half = turned_triad(before, ends, 0.5 * clock.dt_old, middle).toRotationMatrix();
    put_triad(e, now);
    const Vec apart =
        triad_.lever ? Vec(ends.v - 0.5 * (ends.omega[0] + ends.omega[1]).cross(middle)) : ends.v;
    const Vec rate[] = {half.transpose() * apart, half.transpose() * (ends.omega[1] - ends.omega[0])};
    std::array<SpringAnswer, 6> answer;
    for (int d = 0; d < 6; ++d) answer[at(d)] = answer_of(e, d, rate[d / 3][d % 3], clock.dt_old);
    leave(e, now.toRotationMatrix(), ends.between);
    steps_[at(e)] = step_of(e, answer, now.toRotationMatrix(), ends.between);
    if (erosion_) look_for_failure(begin, e);
  }

  SpringAnswer answer_of(Index e, int d, Real rate, Real dt) {
    Real& displacement = displacement_.data(d)[e];
    Real& force = answer_.data(d)[e];
    const SpringMotion motion{displacement + rate * dt, rate, rate * dt};
    Real state[SpringLaw::numbers];
    const auto kept = [&](int k) -> Real& { return state_.data(SpringLaw::numbers * d + k)[e]; };
    for (int k = 0; k < SpringLaw::numbers; ++k) state[k] = kept(k);
    const SpringAnswer out = law_->springs[at(d)].answer(motion, state);
    for (int k = 0; k < SpringLaw::numbers; ++k) kept(k) = state[k];
    energy_[e] += 0.5 * (force + out.force) * motion.change;
    displacement = motion.stretch, force = out.force;
    return out;
  }

  void leave(Index e, const Matrix& axes, const Vec& between) {
    const auto of = [&](int first) {
      return Vec(axes * Vec(answer_.data(first)[e], answer_.data(first + 1)[e], answer_.data(first + 2)[e]));
    };
    const Vec pull = of(0), turn = of(3);
    const Vec lever = triad_.lever ? Vec(0.5 * between.cross(pull)) : Vec(Vec::Zero());
    for (int k = 0; k < 3; ++k) {
      group_.corner_force->data(k)[e] = pull[k], group_.corner_force->data(3 + k)[e] = -pull[k];
      if (!group_.corner_moment) continue;
      group_.corner_moment->data(k)[e] = lever[k] + turn[k];
      group_.corner_moment->data(3 + k)[e] = lever[k] - turn[k];
    }
  }

  /// Alone, with half its mass and inertia at each end. Springs along axes at right angles act on different
  /// motions, but all with a lever turn both ends alike; those about axes turn them against each other.
  Real step_of(Index e, const std::array<SpringAnswer, 6>& answer, const Matrix& axes,
               const Vec& between) const {
    const Real m = group_.mass[e], J = inertia_[at(e)];
    const auto most = [&](Real SpringAnswer::*what) {
      Real along = 0, lever = 0, about = 0;
      for (int k = 0; k < 3; ++k) {
        const Real of = answer[at(k)].*what;
        along = std::max(along, 4 * of / m);
        if (triad_.lever) lever += of * between.cross(Vec(axes.col(k))).squaredNorm() / J;
        if (J > 0) about = std::max(about, 4 * answer[at(3 + k)].*what / J);
      }
      return std::max(along + lever, about);
    };
    // K dt^2/4 + C dt/2 = 1
    const Real half = 0.25 * most(&SpringAnswer::damping),
               below = half + std::sqrt(half * half + 0.25 * most(&SpringAnswer::stiffness));
    return below == 0 ? std::numeric_limits<Real>::infinity() : 1 / below;
  }

  void look_for_failure(Index begin, Index e) const {
    SixOfBeam forces, displacements;
    for (int d = 0; d < 6; ++d)
      forces[at(d)] = answer_.data(d)[e], displacements[at(d)] = displacement_.data(d)[e];
    const std::string why = law_->limits.failure(forces, displacements);
    if (!why.empty()) erosion_->fail(begin, e, why);
  }

  std::shared_ptr<const DiscreteBeamLaw> law_;
  DiscreteTriad triad_;
  std::vector<Real> inertia_;
  const Field<Real>* w_;  ///< of nodes; null: nothing turns
  Field<Real>& axes_;     ///< of the triad: quaternion w x y z
  Field<Real>&displacement_, &answer_;
  Field<Real>& state_;  ///< of each spring, one after the other
};

void fill_group(const DiscreteBeamPart& part, const std::vector<Index>& node_of, bool turns,
                ElementGroup& group, World& world) {
  for (Index e = 0; e < group.size(); ++e) {
    const auto k = static_cast<std::size_t>(e);
    const ModelBeam& beam = *part.beams[k];
    group.id[e] = beam.id, group.V0[e] = part.volume[k], group.mass[e] = part.volume[k] * part.law->ro;
    for (int c = 0; c < 2; ++c) {
      const Index n = node_of[static_cast<std::size_t>(beam.node[static_cast<std::size_t>(c)])];
      group.node.data(c)[e] = n;
      world.nodes.m[n] += group.mass[e] / 2;
      if (turns) NodalRotations(world.nodes.fields).inertia[n] += part.inertia[k] / 2;
    }
  }
}

}  // namespace

void build_discrete_beams(const Model& model, const std::vector<DiscreteBeamPart>& parts,
                          const std::vector<Index>& node_of, ElementOptions& options, World& world,
                          Diagnostics& diagnostics) {
  for (const DiscreteBeamPart& part : parts) {
    const ModelPart& of_model = model.parts[static_cast<std::size_t>(part.part)];
    if (world.dim == 2)
      return diagnostics.error(of_model.where, "discrete beams are not supported in 2D scenes (IDIM 2)",
                               "make the scene three-dimensional");
    if (part.beams.empty()) continue;
    FieldSet& set = world.add_set(fmt::format("beams of part {}", of_model.id));
    set.resize(static_cast<Index>(part.beams.size()));
    ElementGroup& group = *world.groups.emplace_back(std::make_unique<ElementGroup>(set, part.part, 2));
    const bool turns =
        std::any_of(part.inertia.begin(), part.inertia.end(), [](Real inertia) { return inertia > 0; });
    if (turns) {
      NodalRotations(world.nodes.fields);
      group.keep_corner_moments();
    }
    fill_group(part, node_of, turns, group, world);
    world.passes.add(
        std::make_shared<DiscreteBeamForces>(part, group, of_model.id, model.tssfac, options, world));
  }
}

}  // namespace courant
