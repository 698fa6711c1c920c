// What contact does to walls that move: each touch leaves its force in a slot of its facet, and nodes and
// faces gather theirs on all threads, in a fixed order.
#include "contact/contact.hpp"

#include "surfaces/face_forces.hpp"

namespace courant {

// Facets of a node or of a segment, ascending.
void Contact::find_incidence(const World& world) {
  const auto build = [&](Incidence& out, Index count, auto&& for_each) {
    out.first.assign(static_cast<std::size_t>(count) + 1, 0);
    for_each([&](Index at, Incidence::Corner) { ++out.first[static_cast<std::size_t>(at) + 1]; });
    for (std::size_t k = 1; k < out.first.size(); ++k) out.first[k] += out.first[k - 1];
    out.corners.resize(static_cast<std::size_t>(out.first.back()));
    std::vector<Index> next(out.first.begin(), out.first.end() - 1);
    for_each([&](Index at, Incidence::Corner corner) {
      out.corners[static_cast<std::size_t>(next[static_cast<std::size_t>(at)]++)] = corner;
    });
  };
  build(of_node_, world.nodes.size(), [&](auto&& add) {
    for (const Index f : moving_)
      for (int e = 0; e < facets_[f].corners; ++e) add(facets_[f].node[e], {f, e});
  });
  build(of_segment_, world.segments.size(), [&](auto&& add) {
    for (const Index f : moving_) add(facets_[f].segment, {f, -1});
  });
}

// Blocks, and with them touches, stand in the order of particles.
void Contact::fill_slots() {
  note_access(reactions_resource_);
  slots_.first.assign(facets_.size() + 1, 0);
  for (const Block& b : blocks_)
    for (const Reaction& r : b.reactions)
      ++slots_.first[static_cast<std::size_t>(b.touches[static_cast<std::size_t>(r.touch)].facet) + 1];
  for (std::size_t k = 1; k < slots_.first.size(); ++k) slots_.first[k] += slots_.first[k - 1];
  slots_.slots.resize(static_cast<std::size_t>(slots_.first.back()));
  std::vector<Index> next(slots_.first.begin(), slots_.first.end() - 1);
  for (const Block& b : blocks_)
    for (const Reaction& r : b.reactions) {
      const auto touch = static_cast<std::size_t>(r.touch);
      const auto facet = static_cast<std::size_t>(b.touches[touch].facet);
      slots_.slots[static_cast<std::size_t>(next[facet]++)] = {-force_of(b, touch), r.share};
    }
}

void Contact::add_reaction_on_node(Index node, Vec& force) const {
  note_access(reactions_resource_);
  if (slots_.slots.empty()) return;
  const auto n = static_cast<std::size_t>(node);
  for (Index k = of_node_.first[n]; k < of_node_.first[n + 1]; ++k) {
    const auto [facet, corner] = of_node_.corners[static_cast<std::size_t>(k)];
    const auto f = static_cast<std::size_t>(facet);
    for (Index s = slots_.first[f]; s < slots_.first[f + 1]; ++s) {
      const Slots::Slot& slot = slots_.slots[static_cast<std::size_t>(s)];
      force += slot.share[static_cast<std::size_t>(corner)] * slot.force;
    }
  }
}

void Contact::add_reaction_on_segment(Index segment, Vec& force) const {
  note_access(reactions_resource_);
  if (slots_.slots.empty()) return;
  const auto n = static_cast<std::size_t>(segment);
  for (Index k = of_segment_.first[n]; k < of_segment_.first[n + 1]; ++k) {
    const auto f = static_cast<std::size_t>(of_segment_.corners[static_cast<std::size_t>(k)].facet);
    for (Index s = slots_.first[f]; s < slots_.first[f + 1]; ++s)
      force += slots_.slots[static_cast<std::size_t>(s)].force;
  }
}

namespace {

class NodeReactions : public Force {
 public:
  explicit NodeReactions(std::shared_ptr<const Contact> contact) : contact_(std::move(contact)) {}
  std::string name() const override { return contact_->name() + " (nodes)"; }
  const FieldSet& over(const World& world) const override { return world.nodes.fields; }
  void declare(const World& world, Accesses& a) const override {
    a.reads(contact_->reactions(), Reach::others).updates(world.nodes.f);
  }
  void block(World& world, const Clock&, Index begin, Index end) override {
    for (Index n = begin; n < end; ++n) {
      Vec force = Vec::Zero();
      contact_->add_reaction_on_node(n, force);
      world.nodes.f.add(n, force);
    }
  }

 private:
  std::shared_ptr<const Contact> contact_;
};

class FaceReactions : public Force {
 public:
  explicit FaceReactions(std::shared_ptr<const Contact> contact) : contact_(std::move(contact)) {}
  std::string name() const override { return contact_->name() + " (faces)"; }
  const FieldSet& over(const World& world) const override { return world.segments.fields; }
  void declare(const World& world, Accesses& a) const override {
    a.reads(contact_->reactions(), Reach::others).updates(world.segments.contact_force);
  }
  void block(World& world, const Clock&, Index begin, Index end) override {
    for (Index s = begin; s < end; ++s) {
      Vec force = Vec::Zero();
      contact_->add_reaction_on_segment(s, force);
      world.segments.contact_force.add(s, force);
    }
  }

 private:
  std::shared_ptr<const Contact> contact_;
};

}  // namespace

void add_contact(World& world, const std::shared_ptr<Contact>& contact) {
  world.passes.add(contact);
  if (!contact->has_moving_walls()) return;
  add_clear_face_forces(world);
  world.passes.add(std::make_shared<NodeReactions>(contact));
  world.passes.add(std::make_shared<FaceReactions>(contact));
}

}  // namespace courant
