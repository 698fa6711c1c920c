#include "contact/tied/constraint.hpp"

#include <fmt/format.h>

#include "contact/tied/turning.hpp"
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

}  // namespace

void add_constraint(std::shared_ptr<const TiedConstraint> tied, World& world) {
  world.passes.add(std::make_shared<TiedForces>(tied, world));
  world.passes.add(std::make_shared<TiedMotion>(tied, world));
  for (std::size_t k = 0; k < tied->contacts.size(); ++k)
    world.passes.add(std::make_shared<TiedReport>(tied, k, world.nodes));
}

}  // namespace courant
