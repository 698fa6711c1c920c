// What contact does to walls that move: each touch leaves its force in its block, facets find theirs, and
// nodes and faces gather theirs on all threads, in a fixed order.
#include "contact/contact.hpp"
#include "parallel/counting_sort.hpp"
#include "parallel/parallel.hpp"
#include "surfaces/face_forces.hpp"

namespace courant {

// Facets of a node or of a segment, ascending.
void Contact::find_incidence(const World& world) {
  place_in_moving_.assign(facets_.size(), -1);
  const auto moving = static_cast<Index>(moving_.size());
  for (Index k = 0; k < moving; ++k) place_in_moving_[moving_[k]] = k;
  const auto build = [&](Incidence& out, Index count, auto&& for_each_corner) {
    std::vector<Index> owner, order;
    std::vector<Incidence::Corner> corners;
    for_each_corner([&](Index at, Incidence::Corner corner) {
      owner.push_back(at);
      corners.push_back(corner);
    });
    counting_sort(owner, count, out.first, order);
    for (const Index k : order) out.corners.push_back(corners[k]);
  };
  build(of_node_, world.nodes.size(), [&](auto&& add) {
    for (Index k = 0; k < moving; ++k)
      for (int e = 0; e < node_count(facets_[moving_[k]]); ++e) add(facets_[moving_[k]].node[e], {k, e});
  });
  build(of_segment_, world.segments.size(), [&](auto&& add) {
    for (Index k = 0; k < moving; ++k) add(facets_[moving_[k]].segment, {k, -1});
  });
}

// Blocks, and with them touches, are in the order of particles.
void Contact::gather_reactions() {
  note_access(reactions_resource_);
  Reactions& r = reactions_;
  r.begin.assign(1, 0);
  for (const Block& b : blocks_) r.begin.push_back(r.begin.back() + static_cast<Index>(b.reactions.size()));
  const Index count = r.begin.back();
  r.all.resize(count);
  r.key.resize(count);
  if (count == 0) return;
  for_each_block(listed_, [&](Index begin, Index) {
    const Index b = begin / block_size;
    Index at = r.begin[b];
    for (const Reaction& one : blocks_[b].reactions) {
      r.all[at] = one;
      r.key[at++] = place_in_moving_[one.facet];
    }
  });
  counting_sort(r.key, static_cast<Index>(moving_.size()), r.first, r.order);
}

// `add(reaction, corner)` for all reactions on the facets of a node or segment, by facet and particle.
template <class Add>
void Contact::for_each_reaction(const Incidence& of, Index at, const Add& add) const {
  note_access(reactions_resource_);
  const Reactions& r = reactions_;
  if (r.all.empty()) return;
  if (at + 1 >= static_cast<Index>(of.first.size())) return;  // it came with a later contact
  for (Index k = of.first[at]; k < of.first[at + 1]; ++k) {
    const auto [moving, corner] = of.corners[k];
    for (Index s = r.first[moving]; s < r.first[moving + 1]; ++s) add(r.all[r.order[s]], corner);
  }
}

void Contact::add_reaction_on_node(Index node, Vec& force) const {
  for_each_reaction(of_node_, node,
                    [&](const Reaction& r, int corner) { force += r.share[corner] * r.force; });
}

// By Gershgorin's theorem no frequency of springs k_t that act on node i with shares N_ti, and 1 on their
// particles, is above that with w^2 = sum of k_t N_ti (1 + sum_j N_tj) / m_i. Rigid bodies have limits of
// their own. [1/T2]
Real Contact::stiffness_of_node(const World& world, Index node) const {
  Real sum = 0;
  for_each_reaction(of_node_, node, [&](const Reaction& r, int corner) {
    Real all = 1;  // with the particle's
    for (const Real share : r.share) all += std::abs(share);
    if (facets_[r.facet].body < 0) sum += all * r.k * std::abs(r.share[corner]);
  });
  if (!(sum > 0) || world.nodes.held[node] || options_.bodies.body(node) >= 0) return 0;
  return sum / world.nodes.m[node];
}

void Contact::add_reaction_on_segment(Index segment, Vec& force) const {
  for_each_reaction(of_segment_, segment, [&](const Reaction& r, int) { force += r.force; });
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
    a.reads(contact_->reactions(), Reach::others).updates(*world.segments.contact_force);
  }
  void block(World& world, const Clock&, Index begin, Index end) override {
    for (Index s = begin; s < end; ++s) {
      Vec force = Vec::Zero();
      contact_->add_reaction_on_segment(s, force);
      world.segments.contact_force->add(s, force);
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
