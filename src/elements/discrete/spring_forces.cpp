#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>
#include <utility>

#include "elements/discrete/discrete.hpp"
#include "state/reports.hpp"
#include "state/shared_fields.hpp"

namespace courant {

namespace {

/// Springs and dampers of a part: stretch and its rate since the last motion, the law, forces or moments on
/// the ends, which passes over the nodes gather.
class SpringForces : public Material, public EnergyTerm, public PartReporter, public SpringReporter {
 public:
  SpringForces(SpringPart part, World& world)
      : part_(std::move(part)),
        group_(*part_.group),
        turning_(part_.turns ? shared_fields::angular_velocity.find(world.nodes.fields) : nullptr),
        stretch_(stretch_of(part_)),
        force_(part_.turns ? add("torsion_moment", "ML2/T2", 1, true) : add("axial_force", "ML/T2", 1, true)),
        energy_(add("internal_energy", "ML2/T2", 1, true)),
        state_(add("law_state", "-", SpringLaw::numbers, false)),
        start_(add("start_length", "L", 1, false)),
        direction_(add("direction", "-", 3, false)),
        bounds_(static_cast<std::size_t>(group_.size())) {
    for (Index e = 0; e < group_.size(); ++e) {
      const Vec d = between_ends(world, e), along = part_.along[at(e)];
      start_[e] = part_.turns ? 0 : (is_free(e) ? d.norm() : d.dot(along)) - stretch_[e];
      direction_.set(e, is_free(e) ? Vec(d.normalized()) : along);
      if (stretch_[e] != 0) load(e);
    }
  }
  const SpringPart& part() const { return part_; }
  const std::vector<SpringAnswer>& bounds() const { return bounds_; }
  Vec direction(Index e) const { return direction_.vec(e); }

  std::string name() const override { return group_.fields.name(); }
  const FieldSet& over(const World&) const override { return group_.fields; }
  void declare(const World& world, Accesses& a) const override {
    a.reads(world.nodes.x, Reach::others).reads(world.nodes.v, Reach::others);
    if (turning_) a.reads(*turning_, Reach::others);
    a.reads(group_.node).reads(start_).updates(stretch_).updates(force_).updates(energy_).updates(state_);
    a.updates(direction_).writes(*group_.corner_force);
    if (group_.corner_moment) a.writes(*group_.corner_moment);
  }

  void block(World& world, const Clock& clock, Index begin, Index end) override {
    for (Index e = begin; e < end; ++e) {
      const Vec d = between_ends(world, e);
      const Real length = d.norm();
      if (is_free(e) && length > 0) direction_.set(e, d / length);
      const Vec along = direction_.vec(e);
      SpringMotion motion;
      motion.rate = difference(part_.turns ? *turning_ : world.nodes.v, e).dot(along);
      if (part_.turns)
        motion.stretch = stretch_[e] + motion.rate * clock.dt_old;
      else
        motion.stretch = (is_free(e) ? length : d.dot(along)) - start_[e];
      motion.change = motion.stretch - stretch_[e], motion.dt = clock.dt_old;
      const SpringAnswer answer = scaled(motion, e);
      energy_[e] += 0.5 * (force_[e] + answer.force) * motion.change;
      stretch_[e] = motion.stretch, force_[e] = answer.force;
      SpringAnswer& bound = bounds_[at(e)] = answer;
      // across itself a stretched spring is as stiff as its force over its length
      if (is_free(e) && !part_.turns && length > 0)
        bound.stiffness = std::max(bound.stiffness, std::abs(answer.force) / length);
      leave(e, answer.force * along);
    }
  }

  void record(World&, const Clock&, EnergyLedger&) override {}
  void sample(const World&, const Clock&, EnergyLedger& ledger) const override {
    const Real all = total();
    ledger.internal += all, ledger.discrete += all;
  }
  void report_part(const World&, std::vector<PartSums>& parts) const override {
    parts[static_cast<std::size_t>(group_.part)].internal += total();
  }
  void report_springs(std::vector<SpringForce>& out) const override {
    for (Index e = 0; e < group_.size(); ++e)
      if (part_.shown[at(e)]) out.push_back(spring(e));
  }
  std::optional<SpringForce> find_spring(Id id) const override {
    for (Index e = 0; e < group_.size(); ++e)
      if (group_.id[e] == id) return spring(e);
    return std::nullopt;
  }
  const ElementGroup& spring_group() const override { return group_; }
  SpringForce spring(Index e) const override {
    return {group_.id[e], part_.turns, force_[e] * direction_.vec(e), force_[e], stretch_[e]};
  }

 private:
  Field<Real>& add(const char* field, const char* dimension, int components, bool output) {
    return group_.fields.add<Real>(
        {.name = field, .dimension = dimension, .components = components, .output = output});
  }
  static std::size_t at(Index e) { return static_cast<std::size_t>(e); }
  bool is_free(Index e) const { return part_.along[at(e)].isZero(); }
  Real total() const {
    return sum(group_.size(), [&](Index e) { return energy_[e]; });
  }
  Vec between_ends(const World& world, Index e) const {
    const Vec x1 = world.nodes.x.vec(group_.node.data(0)[e]);
    return (part_.grounded[at(e)] ? part_.ground[at(e)] : world.nodes.x.vec(group_.node.data(1)[e])) - x1;
  }
  Vec difference(const Field<Real>& of_nodes, Index e) const {
    const Vec first = of_nodes.vec(group_.node.data(0)[e]);
    return part_.grounded[at(e)] ? Vec(-first) : Vec(of_nodes.vec(group_.node.data(1)[e]) - first);
  }
  /// Slowly from rest to OFFSET, so that laws with a memory have it, and the energy is there that it took.
  void load(Index e) {
    constexpr int parts = 1000;  // curves may have corners
    SpringMotion motion;
    motion.change = stretch_[e] / parts;
    for (int k = 1; k <= parts; ++k) {
      motion.stretch = stretch_[e] * k / parts;
      const Real force = scaled(motion, e).force;
      energy_[e] += 0.5 * (force_[e] + force) * motion.change;
      force_[e] = force;
    }
  }
  SpringAnswer scaled(const SpringMotion& motion, Index e) {
    Real state[SpringLaw::numbers];
    for (int k = 0; k < SpringLaw::numbers; ++k) state[k] = state_.data(k)[e];
    SpringAnswer out = part_.law->answer(motion, state);
    for (int k = 0; k < SpringLaw::numbers; ++k) state_.data(k)[e] = state[k];
    const Real quick = part_.kd > 0 ? part_.kd / part_.v0 : 0, factor = 1 + quick * std::abs(motion.rate);
    const Real S = part_.scale[at(e)];
    return {S * factor * out.force, S * factor * out.stiffness,
            S * (factor * out.damping + quick * std::abs(out.force))};
  }
  /// `pull`: on the first end; the second one gets the opposite, unless it is the ground.
  void leave(Index e, const Vec& pull) {
    Field<Real>& to = part_.turns ? *group_.corner_moment : *group_.corner_force;
    for (int k = 0; k < 3; ++k) {
      to.data(k)[e] = pull[k];
      to.data(3 + k)[e] = part_.grounded[at(e)] ? 0 : -pull[k];
      if (part_.turns) group_.corner_force->data(k)[e] = group_.corner_force->data(3 + k)[e] = 0;
    }
  }

  SpringPart part_;
  ElementGroup& group_;
  const Field<Real>* turning_;
  Field<Real>&stretch_, &force_, &energy_, &state_;
  Field<Real>& start_;      ///< at which it has no stretch
  Field<Real>& direction_;  ///< from the first end to the second
  std::vector<SpringAnswer> bounds_;
};

/// The step of all springs. They have no mass: a node or body shares its inverse mass g out among the springs
/// s on it, by what they ask for. Forces at t^n of positions there and of velocities half a step before are
/// stable as long as for each spring
///   sum over its ends of sum_s g (k_s dt^2/4 + c_s dt/2) <= f^2,
/// f = TSSFAC where springs are alone. Nodes of other elements, whose step may take f^2 of it already, leave
/// 1 - f^2.
class SpringLimit : public TimeLimit {
 public:
  SpringLimit(const Deck& deck, std::vector<std::shared_ptr<SpringForces>> springs, WallBodies bodies,
              Real tssfac, Real longest, World& world, Diagnostics& diagnostics)
      : springs_(std::move(springs)),
        bodies_(std::move(bodies)),
        tssfac_(tssfac),
        longest_(longest),
        inertia_(shared_fields::rotary_inertia.find(world.nodes.fields)) {
    std::set<Index> bodies_of_others;
    std::vector<char> node_of_others(static_cast<std::size_t>(world.nodes.size()), 0);
    for (const auto& group : world.groups) {
      if (group->corners() == 1 || is_mine(*group)) continue;
      for (int c = 0; c < group->corners(); ++c)
        for (Index e = 0; e < group->size(); ++e) {
          const Index n = group->node.data(c)[e];
          node_of_others[static_cast<std::size_t>(n)] = 1;
          if (const Index b = bodies_.body(n); b >= 0) bodies_of_others.insert(b);
        }
    }
    std::vector<Index> slot_of_node(static_cast<std::size_t>(world.nodes.size()) * 2, -1);
    std::vector<Index> slot_of_body(static_cast<std::size_t>(world.nodes.size()) + 1, -1);
    for (std::size_t p = 0; p < springs_.size(); ++p) {
      const SpringPart& part = springs_[p]->part();
      for (Index e = 0; e < part.group->size(); ++e)
        for (int c = 0; c < (part.grounded[static_cast<std::size_t>(e)] ? 1 : 2); ++c) {
          const Index n = part.group->node.data(c)[e], b = bodies_.body(n);
          check_turns(deck, part, e, n, b, world, diagnostics);
          Index& slot = b >= 0 ? slot_of_body[static_cast<std::size_t>(b)]
                               : slot_of_node[static_cast<std::size_t>(2 * n + part.turns)];
          if (slot < 0) slot = static_cast<Index>(shared_.size()), shared_.push_back(0);
          if (b >= 0 ? bodies_of_others.count(b) > 0 : node_of_others[static_cast<std::size_t>(n)] != 0)
            shared_[static_cast<std::size_t>(slot)] = 1;
          ends_.push_back({p, e, n, b, slot});
        }
    }
  }
  std::string name() const override { return "springs (step)"; }

  Limit limit(const World& world, const Clock&) override {
    std::vector<Real> k(shared_.size(), 0), c(shared_.size(), 0);
    for (const End& end : ends_) {
      const SpringAnswer& bound = springs_[end.part]->bounds()[static_cast<std::size_t>(end.element)];
      const Real g = give(end, world);
      k[static_cast<std::size_t>(end.slot)] += g * bound.stiffness;
      c[static_cast<std::size_t>(end.slot)] += g * bound.damping;
    }
    Limit least{longest_, "ENDTIM / 1000"};
    for (std::size_t i = 0; i < ends_.size(); ++i) {
      const bool pair = i + 1 < ends_.size() && ends_[i + 1].part == ends_[i].part &&
                        ends_[i + 1].element == ends_[i].element;
      Real K = 0, C = 0;
      bool shared = false;
      for (std::size_t j = i; j < i + 1 + pair; ++j) {
        const auto slot = static_cast<std::size_t>(ends_[j].slot);
        K += k[slot], C += c[slot], shared = shared || shared_[slot] != 0;
      }
      const Real own = tssfac_ * tssfac_, rest = std::max(least_rest, 1 - own);
      const Real dt = step(K, C, shared ? std::min(own, rest) : own);
      if (dt < least.dt || std::isnan(dt)) least = {dt, who(ends_[i])};
      i += pair;
    }
    return least;
  }

 private:
  struct End {
    std::size_t part;
    Index element, node, body, slot;
  };
  static constexpr Real least_rest = 0.1;  ///< where TSSFAC is about 1

  bool is_mine(const ElementGroup& group) const {
    return std::any_of(springs_.begin(), springs_.end(),
                       [&](const auto& s) { return s->part().group == &group; });
  }
  void check_turns(const Deck& deck, const SpringPart& part, Index e, Index n, Index body, const World& world,
                   Diagnostics& diagnostics) const {
    if (!part.turns || body >= 0 || (inertia_ && (*inertia_)[n] > 0)) return;
    diagnostics.error(
        {deck.files[0].name},
        fmt::format("torsional spring {}: node {} does not turn", part.group->id[e], world.nodes.id[n]),
        "only nodes of rigid bodies, of shells that deform and of beams do");
  }
  /// Of an end, along the spring. Joints, whose answer is known within a step alone, can only lessen it.
  /// [1/M], [1/ML2]
  Real give(const End& end, const World& world) const {
    const SpringForces& springs = *springs_[end.part];
    const Vec along = springs.direction(end.element);
    if (springs.part().turns)
      return end.body >= 0 ? bodies_.turn(end.body, along) : 1 / (*inertia_)[end.node];
    return end.body >= 0 ? bodies_.give_alone(end.body, world.nodes.x.vec(end.node), along)
           : world.nodes.m[end.node] > mass_of_held ? 1 / world.nodes.m[end.node]
                                                    : 0;
  }
  /// Of K dt^2/4 + C dt/2 = most. [T]
  static Real step(Real K, Real C, Real most) {
    const Real half = 0.25 * C, below = half + std::sqrt(half * half + 0.25 * K * most);
    return below == 0 ? std::numeric_limits<Real>::infinity() : most / below;
  }
  std::string who(const End& end) const {
    return fmt::format("spring or damper {}", springs_[end.part]->part().group->id[end.element]);
  }

  std::vector<std::shared_ptr<SpringForces>> springs_;
  WallBodies bodies_;
  Real tssfac_, longest_;
  const Field<Real>* inertia_;
  std::vector<End> ends_;     ///< of a spring one after the other
  std::vector<char> shared_;  ///< by slot, a node, its rotation, or a body: other elements are on it
};

}  // namespace

void add_discrete_passes(const Deck& deck, std::vector<SpringPart> parts, WallBodies bodies, Real tssfac,
                         Real longest, World& world, Diagnostics& diagnostics) {
  std::vector<std::shared_ptr<SpringForces>> springs;
  for (SpringPart& part : parts)
    springs.push_back(world.passes.add(std::make_shared<SpringForces>(std::move(part), world)));
  world.passes.add(std::make_shared<SpringLimit>(deck, std::move(springs), std::move(bodies), tssfac, longest,
                                                 world, diagnostics));
}

}  // namespace courant
