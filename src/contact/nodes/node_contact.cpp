#include "contact/nodes/node_contact.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "parallel/parallel.hpp"
#include "state/shared_fields.hpp"

namespace courant {

namespace {

/// Nodes are looked for this far in front of faces and behind them, of a usual face.
constexpr Real least_reach = 0.3;
/// Lists hold until nodes may have come nearer by this, of a usual face.
constexpr Real list_margin = 0.3;
/// Near candidates hold until nodes may have come nearer by this, of a usual face, or by so many steps.
constexpr Real least_near_margin = 0.05, near_steps = 8;

template <class T>
Field<T>& slot_field(FieldSet& set, const char* name, const char* dimension, int components) {
  return set.add<T>({.name = name, .dimension = dimension, .components = components});
}

}  // namespace

NodeContact::NodeContact(NodeContactLaw law, ContactSides sides, WallBodies bodies, int number, World& world)
    : law_(std::move(law)),
      bodies_(std::move(bodies)),
      number_(number),
      friction_on_(law_.rubs()),
      drag_on_(friction_on_ || law_.vdc > 0),
      nodes_(std::move(sides.nodes)),
      own_(std::move(sides.own)),
      faces_(std::move(sides.faces)),
      edges_(faces_),
      set_(&world.add_set(fmt::format("contact {} nodes", number))),
      eroded_(shared_fields::eroded.find(world.segments.fields)) {
  world.segments.keep_contact_force();
  in_touch_ = &slot_field<Index>(*set_, "in_touch", "-", most_touches);
  leaked_ = &slot_field<Index>(*set_, "leaked", "-", 1);
  depth_ = &slot_field<Real>(*set_, "depth", "L", 1);
  side_ = &slot_field<Real>(*set_, "side", "-", most_touches);
  k_ = &slot_field<Real>(*set_, "stiffness", "M/T2", most_touches);
  slack_ = &slot_field<Real>(*set_, "slack", "L", most_touches);
  area_ = &slot_field<Real>(*set_, "area", "L2", most_touches);
  friction_ = &slot_field<Real>(*set_, "friction", "ML/T2", 3 * most_touches);
  set_->resize(static_cast<Index>(nodes_.size()));
  blocks_.resize(static_cast<std::size_t>(block_count(set_->size())));
  if (const auto& of_node = bodies_.of_node; !of_node.empty())
    body_springs_.assign(static_cast<std::size_t>(*std::max_element(of_node.begin(), of_node.end()) + 1), 0);
  body_push_.assign(body_springs_.size(), Vec::Zero()), body_turn_ = body_push_;
  world.counters.try_emplace("leaked_nodes", 0);
  world.counters["contact_nodes"] += set_->size();
  world.maxima.try_emplace("max_penetration", 0);
  take_involved(world);
  find_sizes();
  if (law_.table) find_parts(world);
}

void NodeContact::take_involved(const World& world) {
  std::vector<char> is_in(static_cast<std::size_t>(world.nodes.size()), 0);
  for (const ContactNode& n : nodes_) is_in[static_cast<std::size_t>(n.node)] = 1;
  for (const ContactFace& f : faces_)
    for (const Index n : f.node) is_in[static_cast<std::size_t>(n)] = 1;
  place_.assign(is_in.size(), -1);
  for (Index n = 0; n < world.nodes.size(); ++n) {
    if (!is_in[static_cast<std::size_t>(n)]) continue;
    place_[static_cast<std::size_t>(n)] = static_cast<Index>(involved_.size());
    involved_.push_back(n);
  }
  listed_at_.assign(involved_.size(), Vec::Zero());
  narrowed_at_ = listed_at_;
}

// Of the smaller half of the faces, so that few large ones make no long lists for all.
void NodeContact::find_sizes() {
  for (const ContactNode& n : nodes_) r_most_ = std::max(r_most_, n.r + n.most_lift);
  std::vector<Real> sizes;
  for (const ContactFace& f : faces_) sizes.push_back(std::sqrt(f.area));
  if (sizes.empty()) return;
  const auto middle = sizes.begin() + static_cast<std::ptrdiff_t>(sizes.size() / 2);
  std::nth_element(sizes.begin(), middle, sizes.end());
  size_ = *middle;
}

std::string NodeContact::name() const {
  return fmt::format("contact {} of nodes", law_.id ? law_.id : number_);
}

const FieldSet& NodeContact::over(const World&) const {
  return *set_;
}

void NodeContact::declare(const World& world, Accesses& a) const {
  const Nodes& n = world.nodes;
  a.reads(n.x, Reach::others).reads(n.v, Reach::others).reads(n.m, Reach::others);
  a.reads(n.held, Reach::others);
  a.updates(*in_touch_)
      .updates(*depth_)
      .updates(*side_)
      .updates(*k_)
      .updates(*slack_)
      .updates(*area_)
      .updates(*friction_);
  a.in_start().reads(n.x, Reach::others).reads(n.v, Reach::others).updates(*in_touch_).updates(*depth_);
  a.reads(n.held, Reach::others);
  if (eroded_) a.reads(*eroded_, Reach::others).in_block().reads(*eroded_, Reach::others);
  a.in_finish().updates(*leaked_).writes(touches_resource_).updates(*world.segments.contact_force);
  a.reads(n.m, Reach::others).reads(n.held, Reach::others);
  if (holder_ || !body_springs_.empty()) a.reads(n.x, Reach::others);
}

// Lists are made anew when nodes may have come nearer than lists reach.
void NodeContact::follow(World& world, const Clock& clock) {
  const Nodes& nodes = world.nodes;
  struct Most {
    Real listed2 = 0, narrowed2 = 0, v2 = 0;
    void take(const Most& other) {
      listed2 = std::max(listed2, other.listed2), narrowed2 = std::max(narrowed2, other.narrowed2);
      v2 = std::max(v2, other.v2);
    }
  };
  const Most most = reduce(
      static_cast<Index>(involved_.size()), Most(),
      [&](Index begin, Index end) {
        Most out;
        for (Index k = begin; k < end; ++k) {
          const auto i = static_cast<std::size_t>(k);
          const Vec x = nodes.x.vec(involved_[i]);
          out.take({(x - listed_at_[i]).squaredNorm(), (x - narrowed_at_[i]).squaredNorm(),
                    nodes.v.vec(involved_[i]).squaredNorm()});
        }
        return out;
      },
      [](Most a, const Most& b) {
        a.take(b);
        return a;
      });
  closing_ = 2.2 * std::sqrt(most.v2) * std::max(clock.dt_old, soft_dt_);
  reach_ = std::max(least_reach * size_, closing_);
  const auto deleted = world.counters.find("deleted_elements");
  const std::int64_t count = deleted == world.counters.end() ? 0 : deleted->second;
  if (count != eroded_count_ || !listed_once_ || reach_ + 2.01 * std::sqrt(most.listed2) > listed_reach_) {
    eroded_count_ = count;
    listed_reach_ = reach_ + std::max(list_margin * size_, reach_ - least_reach * size_);
    list(world);
  }
  moved_ = 1.005 * std::sqrt(most.narrowed2);
  if (fresh_ || !narrowed_ || closing_ + 2 * moved_ > near_closing_ + near_margin_ ||
      reach_ + 2 * moved_ > near_reach_ + near_margin_)
    narrow(world);
}

bool NodeContact::may_touch(const World& world, const ContactNode& n, const ContactFace& f) const {
  if (!(f.passes & (1U << n.pass)) || f.has(n.node) || !is_there(f)) return false;
  const auto all = [&](const auto& holds) { return std::all_of(f.node.begin(), f.node.end(), holds); };
  if (world.nodes.held[n.node] && all([&](Index c) { return world.nodes.held[c] != 0; })) return false;
  const Index body = bodies_.body(n.node);
  return body < 0 || !all([&](Index c) { return bodies_.body(c) == body; });
}

// Who has faces of its own but none that is there is inside of a body, or has lost all of its elements.
bool NodeContact::has_faces(const ContactNode& n) const {
  if (!eroded_ || n.first == n.last) return true;
  bool all_deleted = true, of_solid = false;
  for (Index o = n.first; o < n.last; ++o) {
    const OwnFace& own = own_[static_cast<std::size_t>(o)];
    const Index state = (*eroded_)[own.segment];
    if (state == 0) return true;
    all_deleted = all_deleted && state == shared_fields::deleted;
    of_solid = of_solid || !own.two_sided;
  }
  return all_deleted && (law_.enmass == 2 || (law_.enmass == 1 && of_solid));
}

void NodeContact::list(World& world) {
  may_touch_.resize(nodes_.size());
  for_each(set_->size(), [&](Index i) { may_touch_[static_cast<std::size_t>(i)] = has_faces(node(i)); });
  const Nodes& nodes = world.nodes;
  search_.build(boxes_around(faces_, nodes.x, r_most_ + listed_reach_, least_reach * size_));
  for_each(static_cast<Index>(involved_.size()), [&](Index k) {
    listed_at_[static_cast<std::size_t>(k)] = nodes.x.vec(involved_[static_cast<std::size_t>(k)]);
  });
  for_each_block(set_->size(), [&](Index begin, Index end) { list_block(world, begin, end); });
  std::vector<char> wanted(faces_.size(), 0);
  for (const Block& b : blocks_)
    for (const Index f : b.candidate) wanted[static_cast<std::size_t>(f)] = 1;
  listed_.clear();
  for (std::size_t f = 0; f < faces_.size(); ++f)
    if (wanted[f]) listed_.push_back(static_cast<Index>(f));
  shapes_.resize(faces_.size());
  listed_once_ = true, narrowed_ = false;
}

// Of most nodes in most steps all candidates are too far away to be met: they have no near ones. Who may meet
// one has all that matter to a node in touch.
void NodeContact::narrow(const World& world) {
  near_closing_ = closing_, near_reach_ = reach_, moved_ = 0;
  near_margin_ = std::min(std::max(least_near_margin * size_, near_steps * closing_), listed_reach_ - reach_);
  for_each(static_cast<Index>(listed_.size()), [&](Index k) {
    const auto f = static_cast<std::size_t>(listed_[static_cast<std::size_t>(k)]);
    shapes_[f] = shape_of(corners_of(faces_[f], world.nodes.x), faces_[f].corners);
  });
  for_each(static_cast<Index>(involved_.size()), [&](Index k) {
    narrowed_at_[static_cast<std::size_t>(k)] = world.nodes.x.vec(involved_[static_cast<std::size_t>(k)]);
  });
  for_each_block(set_->size(), [&](Index begin, Index end) { narrow_block(world, begin, end); });
  narrowed_ = !fresh_;
}

void NodeContact::list_block(const World& world, Index begin, Index end) {
  Block& b = blocks_[static_cast<std::size_t>(begin / block_size)];
  b.first.clear(), b.candidate.clear();
  for (Index i = begin; i < end; ++i) {
    b.first.push_back(static_cast<Index>(b.candidate.size()));
    if (!may_touch_[static_cast<std::size_t>(i)]) continue;
    search_.near(world.nodes.x.vec(node(i).node), [&](Index f) {
      if (may_touch(world, node(i), face(f))) b.candidate.push_back(f);
    });
  }
  b.first.push_back(static_cast<Index>(b.candidate.size()));
}

void NodeContact::start(World& world, const Clock& clock) {
  first_step_ = soft_dt_ == 0 && clock.dt_old > 0;
  soft_dt_ = std::max(soft_dt_, clock.dt_old);
  if (law_.sleeps(clock.t)) {
    if (!asleep_)  // at its death what it stores is lost
      for (const Touch& touch : touches_) let_go_ += touch.stored;
    if (!asleep_)
      for (int k = 0; k < most_touches; ++k) std::fill_n(in_touch_->data(k), set_->size(), 0);
    if (!asleep_) depth_->fill(0);
    asleep_ = fresh_ = true;
    return;
  }
  asleep_ = false;
  follow(world, clock);
  touched_.assign(involved_.size(), 0), depths_.assign(involved_.size(), 0);
  for (Block& b : blocks_) b.idle = b.near.empty();
  for (int k = 0; k < most_touches; ++k)
    for (Index i = 0; i < set_->size(); ++i)
      if (in_touch_->data(k)[i] != 0) {
        const auto place = static_cast<std::size_t>(place_[static_cast<std::size_t>(node(i).node)]);
        touched_[place] = 1, depths_[place] = std::max(depths_[place], (*depth_)[i]);
        blocks_[static_cast<std::size_t>(i / block_size)].idle = false;
      }
}

void NodeContact::block(World& world, const Clock& clock, Index begin, Index end) {
  Block& b = blocks_[static_cast<std::size_t>(begin / block_size)];
  b.touches.clear(), b.leaked.clear();
  b.let_go = 0, b.jumped = 0;
  if (asleep_ || b.idle) return;
  for (Index i = begin; i < end; ++i) touch(world, clock, b, i);
}

void NodeContact::finish(World& world, const Clock& clock) {
  touches_.clear();
  Real deepest = 0;
  for (const Block& b : blocks_) {
    touches_.insert(touches_.end(), b.touches.begin(), b.touches.end());
    let_go_ += b.let_go;
    if (b.jumped > 0) world.counters["contact_depth_jumps"] += b.jumped;
    for (const Index i : b.leaked) {
      if ((*leaked_)[i]) continue;
      (*leaked_)[i] = 1;
      ++world.counters["leaked_nodes"];
    }
  }
  for (const Touch& touch : touches_) {
    // beside an edge that of the energy left, as the node is no longer where the face is
    if (touch.stored > 0) deepest = std::max(deepest, std::sqrt(2 * touch.stored / touch.k));
    world.segments.contact_force->add(face(touch.face).segment, -touch.force);
  }
  sum_springs_of_bodies(world, clock);
  if (deepest > 0) {
    acted_ = true;
    Real& most = world.maxima["max_penetration"];
    most = std::max(most, deepest);
  }
  // who is born later than the run tells here what of the start is told while the run is built
  if (!asleep_ && fresh_ && (law_.birth > 0 || law_.gate.there()))
    for (Index i = 0; i < set_->size(); ++i) {
      bool behind = false;
      for (int k = 0; k < most_touches; ++k)
        behind = behind || (load(i, k).face >= 0 && load(i, k).slack > 0);
      world.counters["penetrations_at_birth"] += behind;
    }
  if (!asleep_) fresh_ = false;
  gather(world);
  if (holder_) tell_holder(world);
}

void NodeContact::tell_holder(World& world) {
  for (const Touch& touch : touches_)
    if (touch.pass == 0 && touch.depth > 0) holder_->touched(world, touch.node, face(touch.face).segment);
}

NodeContact::Slot NodeContact::load(Index i, int k) const {
  Slot slot;
  slot.face = in_touch_->data(k)[i] - 1;
  slot.side = side_->data(k)[i], slot.k = k_->data(k)[i];
  slot.slack = slack_->data(k)[i], slot.area = area_->data(k)[i];
  for (int c = 0; c < 3; ++c) slot.friction[c] = friction_->data(3 * k + c)[i];
  return slot;
}

void NodeContact::store(Index i, int k, const Slot& slot) {
  in_touch_->data(k)[i] = slot.face + 1;
  side_->data(k)[i] = slot.side, k_->data(k)[i] = slot.k;
  slack_->data(k)[i] = slot.slack, area_->data(k)[i] = slot.area;
  for (int c = 0; c < 3; ++c) friction_->data(3 * k + c)[i] = slot.friction[c];
}

void NodeContact::keep(Archive& archive) {
  archive("fresh", fresh_);
  archive("asleep", asleep_);
  archive("soft_dt", soft_dt_);
  archive("body_springs", body_springs_);
  archive("body_push", body_push_), archive("body_turn", body_turn_);
  archive("acted", acted_);
  archive("damping_work", damping_work_);
  archive("friction_work", friction_work_);
  if (archive.loading()) listed_once_ = false;
}

NodeContact::Penetrations NodeContact::penetrations(World& world) {
  Penetrations out;
  if (law_.birth > 0 || !law_.gate.open()) return out;
  follow(world, {});
  for (Index i = 0; i < set_->size(); ++i) {
    Block& b = blocks_[static_cast<std::size_t>(i / block_size)];
    Slots slots;
    look(world, b, i, world.nodes.x.vec(node(i).node), slots);
    if (is_undecided(b, i) && out.undecided++ == 0) out.undecided_node = world.nodes.id[node(i).node];
    find_touches(world, {}, b, i, slots);
    Real deepest = 0;
    for (const Slot& slot : slots)
      if (slot.face >= 0) deepest = std::max(deepest, -slot.gap);
    if (!(deepest > 0)) {
      out.lost += is_lost(world, b, i);
      continue;
    }
    ++out.count;
    if (deepest > out.deepest) out.deepest = deepest, out.node = world.nodes.id[node(i).node];
  }
  return out;
}

Index NodeContact::candidates() const {
  Index count = 0;
  for (const Block& b : blocks_) count += static_cast<Index>(b.candidate.size());
  return count;
}

}  // namespace courant
