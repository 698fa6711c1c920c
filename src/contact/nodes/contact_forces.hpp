#pragma once
// The pass that adds to nodes what a contact of nodes or edges leaves for them.
#include <algorithm>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "state/world.hpp"

namespace courant {

/// Contact: NodeContact or EdgeContact.
template <class Contact>
class ContactForces : public Force {
 public:
  explicit ContactForces(std::shared_ptr<const Contact> contact) : contact_(std::move(contact)) {}
  std::string name() const override { return contact_->name() + " (forces)"; }
  const FieldSet& over(const World& world) const override { return world.nodes.fields; }
  void declare(const World& world, Accesses& a) const override {
    a.reads(contact_->touches(), Reach::others).updates(world.nodes.f);
  }
  void block(World& world, const Clock&, Index begin, Index end) override {
    if (!contact_->touches_something()) return;
    const std::vector<Index>& nodes = contact_->involved();
    for (auto n = std::lower_bound(nodes.begin(), nodes.end(), begin); n != nodes.end() && *n < end; ++n) {
      Vec force = Vec::Zero();
      if (contact_->add_force_on(*n, force)) world.nodes.f.add(*n, force);
    }
  }

 private:
  std::shared_ptr<const Contact> contact_;
};

}  // namespace courant
