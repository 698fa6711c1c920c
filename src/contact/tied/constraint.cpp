#include "contact/tied/constraint.hpp"

#include <fmt/format.h>

#include "contact/tied/turning.hpp"
#include "loads/carried_mass.hpp"
#include "parallel/parallel.hpp"

namespace courant {

namespace {

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
    a.reads(world.nodes.follow, Reach::others);
    if (turning_) a.reads_before(*turning_.moment, Reach::others);
    a.in_block().updates(world.nodes.f);
    if (turning_) a.updates(*turning_.moment);
  }
  void start(World& world, const Clock&) override {
    for_each(static_cast<Index>(forces_.size()), [&](Index t) {
      const Tie& tie = tied_->ties[static_cast<std::size_t>(t)];
      Forces& out = forces_[static_cast<std::size_t>(t)];
      out = {};
      if (!is_tied(tie, world)) return;
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
    std::array<Vec, 4> on{Vec::Zero(), Vec::Zero(), Vec::Zero(), Vec::Zero()};
    Vec moment = Vec::Zero();
  };
  std::shared_ptr<const TiedConstraint> tied_;
  TurningFields turning_;
  TieShares shares_;
  std::vector<Forces> forces_;
};

/// Nodes that faces carry.
class OnFaces : public Carriage {
 public:
  explicit OnFaces(std::shared_ptr<const TiedConstraint> tied) : tied_(std::move(tied)) {
    for (const Tie& tie : tied_->ties) shares_.push_back(mass_shares(tie.at));
  }
  std::size_t size() const override { return tied_->ties.size(); }
  Index node(std::size_t i) const override { return tied_->ties[i].node; }
  std::span<const Index> carriers(std::size_t i) const override {
    return std::span(at(i).node).first(static_cast<std::size_t>(at(i).corners));
  }
  std::span<const Real> shares(std::size_t i) const override {
    return std::span(shares_[i]).first(static_cast<std::size_t>(at(i).corners));
  }
  bool holds(const World& world, std::size_t i) const override { return is_tied(tied_->ties[i], world); }
  bool weighs(const World& world, std::size_t i) const override {
    return weighs_where_it_is(tied_->ties[i], world);
  }
  void rates(const World& world, std::size_t i, std::span<Rate> out) const override {
    const std::array<Matrix, 4> all = rates_of(at(i), world.nodes.x);
    for (std::size_t e = 0; e < out.size(); ++e) out[e].B = all[e];
  }
  Chord chord(const World&, std::size_t i, std::span<const Vec> x, std::span<const Vec> v,
              Real dt) const override {
    const PointStep step = step_of(at(i), x, v, dt);
    return {step.x, step.v};
  }

 private:
  const FacePoint& at(std::size_t i) const { return tied_->ties[i].at; }
  std::shared_ptr<const TiedConstraint> tied_;
  std::vector<std::array<Real, 4>> shares_;
};

/// What the faces do to the nodes of one contact: what their motion takes beyond their own forces.
class TiedReport : public Pass, public InterfaceReporter {
 public:
  TiedReport(std::shared_ptr<const TiedConstraint> tied, std::shared_ptr<const CarriedMass> inertia,
             std::size_t contact, const World& world)
      : tied_(std::move(tied)), inertia_(std::move(inertia)), contact_(contact), world_(world) {}
  std::string name() const override { return fmt::format("tied contact {}", of().id); }
  InterfaceForce report() const override {
    InterfaceForce out{.id = of().id, .title = of().title};
    const Nodes& nodes = world_.nodes;
    for (std::size_t t = of().first; t < of().last; ++t) {
      const Tie& tie = tied_->ties[t];
      if (!is_tied(tie, world_)) continue;
      Vec a = inertia_->counts(t) ? inertia_->acceleration(t) : Vec(Vec::Zero());
      for (std::size_t e = 0; !inertia_->counts(t) && e < static_cast<std::size_t>(tie.at.corners); ++e)
        if (const Index n = tie.at.node[e];
            nodes.follow[n] == 0)  // of bodies it is not known yet, and left out
          a += tie.at.N[e] / nodes.m[n] * nodes.f.vec(n);
      out.on_surfa += nodes.m[tie.node] * a - nodes.f.vec(tie.node);
    }
    return out;
  }

 private:
  const TiedConstraint::Contact& of() const { return tied_->contacts[contact_]; }
  std::shared_ptr<const TiedConstraint> tied_;
  std::shared_ptr<const CarriedMass> inertia_;
  std::size_t contact_;
  const World& world_;
};

class TiedMotion : public Motion {
 public:
  TiedMotion(std::shared_ptr<const TiedConstraint> tied, std::shared_ptr<CarriedMass> inertia,
             const World& world)
      : tied_(std::move(tied)), inertia_(std::move(inertia)), turning_(*tied_, world) {}
  std::string name() const override { return "tied contacts (motion)"; }
  const FieldSet& over(const World& world) const override { return world.nodes.fields; }
  void declare(const World& world, Accesses& a) const override {
    inertia_->declare_move(world, a);
    if (turning_) a.revises(*turning_.angle).revises(*turning_.speed);
  }
  void block(World&, const Clock&, Index, Index) override {}
  void finish(World& world, const Clock& clock) override {
    inertia_->move(world, clock);
    if (!turning_) return;
    for_each(static_cast<Index>(tied_->ties.size()), [&](Index t) {
      const Tie& tie = tied_->ties[static_cast<std::size_t>(t)];
      if (!tied_->turns[static_cast<std::size_t>(t)] || !is_tied(tie, world)) return;
      turning_.angle->set(tie.node, mean_of(tie.at, *turning_.angle));
      turning_.speed->set(tie.node, mean_of(tie.at, *turning_.speed));
    });
  }

 private:
  std::shared_ptr<const TiedConstraint> tied_;
  std::shared_ptr<CarriedMass> inertia_;
  TurningFields turning_;
};

}  // namespace

void add_constraint(std::shared_ptr<const TiedConstraint> tied, World& world) {
  add_release(tied, world);
  world.passes.add(std::make_shared<TiedForces>(tied, world));
  const auto inertia = world.passes.add(
      std::make_shared<CarriedMass>(std::make_shared<OnFaces>(tied), "inertia of tied nodes", world));
  world.passes.add(std::make_shared<TiedMotion>(tied, inertia, world));
  for (std::size_t k = 0; k < tied->contacts.size(); ++k)
    world.passes.add(std::make_shared<TiedReport>(tied, inertia, k, world));
}

}  // namespace courant
