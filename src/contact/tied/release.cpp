#include <algorithm>
#include <limits>

#include "contact/tied/constraint.hpp"
#include "contact/tied/turning.hpp"
#include "state/shared_fields.hpp"
#include "state/tied_mass.hpp"

namespace courant {

namespace {

/// Frees a tied node once its face is deleted or its contact is dead: the corners return the masses that they
/// had of it. Velocities stay, so momentum and kinetic energy do, but for rotations of corners that differ.
/// Whether a node is tied is in Nodes::follow.
class TiedRelease : public Constraint {
 public:
  TiedRelease(std::shared_ptr<const TiedConstraint> tied, World& world)
      : tied_(std::move(tied)),
        turning_(*tied_, world),
        carried_(shared_fields::tied_mass.add(world.nodes.fields)),
        eroded_(shared_fields::eroded.find(world.segments.fields)),
        given_(tied_->ties.size()) {
    for (std::size_t t = 0; t < given_.size(); ++t) {
      const Tie& tie = tied_->ties[t];
      const std::array<Real, 4> share = mass_shares(tie.at);
      for (std::size_t e = 0; e < 4; ++e) {
        given_[t].mass[e] = share[e] * world.nodes.m[tie.node];
        if (turns(t)) given_[t].inertia[e] = share[e] * (*turning_.inertia)[tie.node];
      }
    }
  }
  std::string name() const override { return "release of tied nodes"; }
  const FieldSet& over(const World& world) const override { return world.nodes.fields; }
  void declare(const World& world, Accesses& a) const override {
    a.in_start().updates(world.nodes.follow).updates(world.nodes.m).updates(carried_);
    if (eroded_) a.reads(*eroded_, Reach::others);
    if (turning_)
      a.updates(*turning_.inertia).updates(*turning_.none).reads_before(*turning_.speed, Reach::others);
  }
  void start(World& world, const Clock& clock) override {
    for (const TiedConstraint::Contact& contact : tied_->contacts)
      for (std::size_t t = contact.first; t < contact.last; ++t) {
        const Tie& tie = tied_->ties[t];
        const bool ends = clock.t >= contact.death || (eroded_ && (*eroded_)[tie.segment] != 0);
        if (ends && is_tied(tie, world)) release(t, world);
      }
  }
  void block(World&, const Clock&, Index, Index) override {}

 private:
  struct Given {  ///< to each corner
    std::array<Real, 4> mass{}, inertia{};
  };
  bool turns(std::size_t t) const { return turning_ && tied_->turns[t] != 0; }

  void release(std::size_t t, World& world) {
    const Tie& tie = tied_->ties[t];
    world.nodes.follow[tie.node] = 0;
    ++world.counters["broken_ties"];
    for (std::size_t e = 0; e < static_cast<std::size_t>(tie.at.corners); ++e)
      world.nodes.m[tie.at.node[e]] -= given_[t].mass[e], carried_[tie.at.node[e]] -= given_[t].mass[e];
    if (!turns(t)) return;
    (*turning_.none)[tie.node] = 0;
    Real lost = -0.5 * (*turning_.inertia)[tie.node] * turning_.speed->vec(tie.node).squaredNorm();
    for (std::size_t e = 0; e < static_cast<std::size_t>(tie.at.corners); ++e) {
      (*turning_.inertia)[tie.at.node[e]] -= given_[t].inertia[e];
      lost += 0.5 * given_[t].inertia[e] * turning_.speed->vec(tie.at.node[e]).squaredNorm();
    }
    world.energy.dissipated += lost;
  }

  std::shared_ptr<const TiedConstraint> tied_;
  TurningFields turning_;
  Field<Real>& carried_;
  const Field<Index>* eroded_;  ///< of segments; null: nothing fails
  std::vector<Given> given_;
};

}  // namespace

void add_release(std::shared_ptr<const TiedConstraint> tied, World& world) {
  const bool dies = std::any_of(tied->contacts.begin(), tied->contacts.end(), [](const auto& contact) {
    return contact.death < std::numeric_limits<Real>::infinity();
  });
  if (dies || shared_fields::eroded.find(world.segments.fields))
    world.passes.add(std::make_shared<TiedRelease>(std::move(tied), world));
}

}  // namespace courant
