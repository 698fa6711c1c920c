#include "contact/tied/constraint.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <map>

#include "parallel/parallel.hpp"
#include "state/shared_fields.hpp"

namespace courant {

namespace {

/// Rotations of nodes, where the scene has them and ties ask for them.
struct TurningFields {
  Field<Real>*angle = nullptr, *speed = nullptr, *moment = nullptr, *inertia = nullptr;
  Field<Index>* none = nullptr;
  TurningFields(const TiedConstraint& tied, const World& world) {
    if (std::find(tied.turns.begin(), tied.turns.end(), 1) == tied.turns.end()) return;
    const FieldSet& nodes = world.nodes.fields;
    angle = shared_fields::rotation.find(nodes), speed = shared_fields::angular_velocity.find(nodes);
    moment = shared_fields::moment.find(nodes), inertia = shared_fields::rotary_inertia.find(nodes);
    none = shared_fields::no_rotation.find(nodes);
  }
  explicit operator bool() const { return angle != nullptr; }
};

Vec mean_of(const FacePoint& at, const Field<Real>& value) {
  Vec out = Vec::Zero();
  for (std::size_t e = 0; e < static_cast<std::size_t>(at.corners); ++e)
    out += at.N[e] * value.vec(at.node[e]);
  return out;
}

/// Hands the forces of tied nodes to the corners of their faces.
class TiedForces : public Constraint {
 public:
  TiedForces(std::shared_ptr<const TiedConstraint> tied, World& world)
      : tied_(std::move(tied)),
        turning_(*tied_, world),
        shares_(tied_->ties, false, world.nodes.size()),
        forces_(tied_->ties.size()) {}
  std::string name() const override { return "tied contacts"; }
  const FieldSet& over(const World& world) const override { return world.nodes.fields; }
  void declare(const World& world, Accesses& a) const override {
    a.in_start().reads_before(world.nodes.f, Reach::others).reads(world.nodes.x, Reach::others);
    if (turning_) a.reads_before(*turning_.moment, Reach::others);
    a.in_block().updates(world.nodes.f);
    if (turning_) a.updates(*turning_.moment);
  }
  void start(World& world, const Clock&) override {
    for_each(static_cast<Index>(forces_.size()), [&](Index t) {
      const Tie& tie = tied_->ties[static_cast<std::size_t>(t)];
      Forces& out = forces_[static_cast<std::size_t>(t)];
      out.on = on_corners(tie.at, world.nodes.x, world.nodes.f.vec(tie.node));
      if (turning_ && tied_->turns[static_cast<std::size_t>(t)]) out.moment = turning_.moment->vec(tie.node);
    });
  }
  void block(World& world, const Clock&, Index begin, Index end) override {
    for (Index n = begin; n < end; ++n) {
      Vec force = Vec::Zero(), moment = Vec::Zero();
      bool any = false;
      shares_.for_each(n, [&](const TieShares::Share& share) {
        const auto t = static_cast<std::size_t>(share.tie), e = static_cast<std::size_t>(share.corner);
        force += forces_[t].on[e], moment += tied_->ties[t].at.N[e] * forces_[t].moment;
        any = true;
      });
      if (!any) continue;
      world.nodes.f.add(n, force);
      if (turning_) turning_.moment->add(n, moment);
    }
  }

 private:
  struct Forces {
    std::array<Vec, 4> on{};
    Vec moment = Vec::Zero();
  };
  std::shared_ptr<const TiedConstraint> tied_;
  TurningFields turning_;
  TieShares shares_;
  std::vector<Forces> forces_;
};

/// What the faces do to the nodes of one contact: what their motion takes beyond their own forces.
class TiedReport : public Pass, public InterfaceReporter {
 public:
  TiedReport(std::shared_ptr<const TiedConstraint> tied, std::size_t contact, const Nodes& nodes)
      : tied_(std::move(tied)), contact_(contact), nodes_(nodes) {}
  std::string name() const override { return fmt::format("tied contact {}", of().id); }
  InterfaceForce report() const override {
    InterfaceForce out{.id = of().id, .title = of().title};
    for (std::size_t t = of().first; t < of().last; ++t) {
      const Tie& tie = tied_->ties[t];
      Vec a = Vec::Zero();
      for (std::size_t e = 0; e < static_cast<std::size_t>(tie.at.corners); ++e)
        if (const Index n = tie.at.node[e];
            nodes_.follow[n] == 0)  // of bodies it is not known yet, and left out
          a += tie.at.N[e] / nodes_.m[n] * nodes_.f.vec(n);
      out.on_surfa += nodes_.m[tie.node] * a - nodes_.f.vec(tie.node);
    }
    return out;
  }

 private:
  const TiedConstraint::Contact& of() const { return tied_->contacts[contact_]; }
  std::shared_ptr<const TiedConstraint> tied_;
  std::size_t contact_;
  const Nodes& nodes_;
};

class TiedMotion : public Motion {
 public:
  TiedMotion(std::shared_ptr<const TiedConstraint> tied, const World& world)
      : tied_(std::move(tied)), turning_(*tied_, world) {}
  std::string name() const override { return "tied contacts (motion)"; }
  const FieldSet& over(const World& world) const override { return world.nodes.fields; }
  void declare(const World& world, Accesses& a) const override {
    a.in_finish().revises(world.nodes.x).revises(world.nodes.v);
    if (turning_) a.revises(*turning_.angle).revises(*turning_.speed);
  }
  void block(World&, const Clock&, Index, Index) override {}
  void finish(World& world, const Clock& clock) override {
    Nodes& nodes = world.nodes;
    for_each(static_cast<Index>(tied_->ties.size()), [&](Index t) {
      const Tie& tie = tied_->ties[static_cast<std::size_t>(t)];
      const Vec old = nodes.x.vec(tie.node), now = place_of(tie.at, nodes.x);
      // the chord of the step, as of rigid bodies
      if (clock.dt > 0) nodes.v.set(tie.node, (now - old) / clock.dt);
      nodes.x.set(tie.node, now);
      if (!turning_ || !tied_->turns[static_cast<std::size_t>(t)]) return;
      turning_.angle->set(tie.node, mean_of(tie.at, *turning_.angle));
      turning_.speed->set(tie.node, mean_of(tie.at, *turning_.speed));
    });
  }

 private:
  std::shared_ptr<const TiedConstraint> tied_;
  TurningFields turning_;
};

/// Velocities, or angular velocities, with which ties of some weight start.
struct StartField {
  Field<Real>& v;
  Field<Real>& weight;  ///< mass, or rotary inertia
  std::vector<std::size_t> ties;
};

Vec velocity_at(const StartField& start, const Tie& tie, const World& world) {
  return &start.v == &world.nodes.v ? velocity_of(tie.at, world.nodes.x, start.v) : mean_of(tie.at, start.v);
}
std::array<Vec, 4> given_to(const StartField& start, const Tie& tie, const World& world, const Vec& value) {
  if (&start.v == &world.nodes.v) return on_corners(tie.at, world.nodes.x, value);
  std::array<Vec, 4> out{};
  for (std::size_t e = 0; e < 4; ++e) out[e] = tie.at.N[e] * value;
  return out;
}

/// The velocities of corners that are nearest to those that all have: sum m |change|^2 is least, as in a
/// plastic impact, and momenta are kept. Then the corners get the weight of the nodes.
TiedStart join_start(const TiedConstraint& tied, const StartField& start, World& world) {
  std::map<Index, Vec> before;  // of corners
  std::map<Index, Real> added;
  TiedStart out;
  const auto energy = [&](Real m, const Vec& v) { return 0.5 * m * v.squaredNorm(); };
  for (const std::size_t t : start.ties) {
    const Tie& tie = tied.ties[t];
    const std::array<Real, 4> share = mass_shares(tie.at);
    for (std::size_t e = 0; e < static_cast<std::size_t>(tie.at.corners); ++e) {
      before[tie.at.node[e]] = start.v.vec(tie.at.node[e]);
      added[tie.at.node[e]] += share[e] * start.weight[tie.node];
    }
    out.before += energy(start.weight[tie.node], start.v.vec(tie.node));
  }
  for (const auto& [n, v] : before) out.before += energy(start.weight[n], v);
  constexpr int most = 200;
  constexpr Real enough = 1e-15;
  for (int it = 0; it < most; ++it) {
    std::map<Index, Vec> impulse;
    for (const auto& [n, v] : before) impulse[n] = start.weight[n] * (v - start.v.vec(n));
    for (const std::size_t t : start.ties) {
      const Tie& tie = tied.ties[t];
      const Vec lacks = start.v.vec(tie.node) - velocity_at(start, tie, world);
      const std::array<Vec, 4> on = given_to(start, tie, world, start.weight[tie.node] * lacks);
      for (std::size_t e = 0; e < static_cast<std::size_t>(tie.at.corners); ++e)
        impulse[tie.at.node[e]] += on[e];
    }
    Real change = 0, size = 0;
    for (const auto& [n, p] : impulse) {
      const Real m = start.weight[n] + added[n];
      if (!(m > 0)) continue;
      start.v.add(n, p / m);
      change = std::max(change, (p / m).squaredNorm()), size = std::max(size, start.v.vec(n).squaredNorm());
    }
    if (change <= enough * enough * size) break;
  }
  for (const std::size_t t : start.ties) {
    const Tie& tie = tied.ties[t];
    start.v.set(tie.node, velocity_at(start, tie, world));
    out.after += energy(start.weight[tie.node], start.v.vec(tie.node));
  }
  for (const auto& [n, more] : added) {
    out.after += energy(start.weight[n], start.v.vec(n));
    start.weight[n] += more;
  }
  return out;
}

}  // namespace

TiedStart start_constraint(const TiedConstraint& tied, World& world) {
  Nodes& nodes = world.nodes;
  const TurningFields turning(tied, world);
  StartField moving{nodes.v, nodes.m, {}};
  std::vector<std::size_t> that_turn;
  for (std::size_t t = 0; t < tied.ties.size(); ++t) {
    nodes.follow[tied.ties[t].node] = 2;  // not 1: no rigid body moves it
    moving.ties.push_back(t);
    if (turning && tied.turns[t]) (*turning.none)[tied.ties[t].node] = 1, that_turn.push_back(t);
  }
  TiedStart out = join_start(tied, moving, world);
  if (that_turn.empty()) return out;
  const TiedStart of_turns = join_start(tied, {*turning.speed, *turning.inertia, that_turn}, world);
  return {out.before + of_turns.before, out.after + of_turns.after};
}

void add_constraint(std::shared_ptr<const TiedConstraint> tied, World& world) {
  world.passes.add(std::make_shared<TiedForces>(tied, world));
  world.passes.add(std::make_shared<TiedMotion>(tied, world));
  for (std::size_t k = 0; k < tied->contacts.size(); ++k)
    world.passes.add(std::make_shared<TiedReport>(tied, k, world.nodes));
}

}  // namespace courant
