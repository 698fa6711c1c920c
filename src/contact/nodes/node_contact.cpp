#include "contact/nodes/node_contact.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include <fmt/format.h>

#include "parallel/parallel.hpp"
#include "state/shared_fields.hpp"

namespace courant {

namespace {

/// Nodes are looked for this far in front of faces and behind them, of a usual face.
constexpr Real least_reach = 0.3;
/// Lists hold until nodes may have come nearer by this, of a usual face.
constexpr Real list_margin = 0.5;
constexpr Real unlimited = std::numeric_limits<Real>::infinity();

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
  last_at_ = listed_at_;
}

// Of the smaller half of the faces, so that few large ones make no long lists for all.
void NodeContact::find_sizes() {
  for (const ContactNode& n : nodes_) r_most_ = std::max(r_most_, n.r + n.most_lift);
  std::vector<Real> sizes;
  for (const ContactFace& f : faces_) {
    sizes.push_back(std::sqrt(f.area));
    most_depth_ = std::max(most_depth_, f.depth);
  }
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
  const auto most = [&](const auto& squares) {
    using Squares = std::array<Real, 2>;
    const Squares out = reduce(
        static_cast<Index>(involved_.size()), Squares{},
        [&](Index begin, Index end) {
          Squares all{};
          for (Index k = begin; k < end; ++k) {
            const Squares one = squares(static_cast<std::size_t>(k));
            all = {std::max(all[0], one[0]), std::max(all[1], one[1])};
          }
          return all;
        },
        [](const Squares& a, const Squares& b) {
          return Squares{std::max(a[0], b[0]), std::max(a[1], b[1])};
        });
    return Squares{std::sqrt(out[0]), std::sqrt(out[1])};
  };
  const auto [step, speed] = most([&](std::size_t k) {
    const Vec x = nodes.x.vec(involved_[k]), moved = x - last_at_[k];
    last_at_[k] = x;
    return std::array<Real, 2>{moved.squaredNorm(), nodes.v.vec(involved_[k]).squaredNorm()};
  });
  travelled_ += 2.01 * step;
  closing_ = 2.2 * speed * std::max(clock.dt_old, soft_dt_);
  reach_ = std::max(least_reach * size_, closing_);
  const auto deleted = world.counters.find("deleted_elements");
  const std::int64_t count = deleted == world.counters.end() ? 0 : deleted->second;
  const auto is_beyond_lists = [&] {
    return reach_ + 2.01 * most([&](std::size_t k) {
                      const Vec moved = nodes.x.vec(involved_[k]) - listed_at_[k];
                      return std::array<Real, 2>{moved.squaredNorm(), 0};
                    })[0] >
           listed_reach_;
  };
  if (count != eroded_count_ || !listed_once_ || (fresh_ && !listed_deep_) ||
      (reach_ + travelled_ > listed_reach_ && is_beyond_lists())) {
    eroded_count_ = count;
    listed_reach_ = reach_ + std::max(list_margin * size_, reach_ - least_reach * size_);
    list(world);
  }
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
  search_.build(boxes_around(faces_, nodes.x, r_most_ + listed_reach_, fresh_ ? least_reach * size_ : 0,
                             fresh_ ? 1 : late_reach));
  for_each(static_cast<Index>(involved_.size()), [&](Index k) {
    listed_at_[static_cast<std::size_t>(k)] = nodes.x.vec(involved_[static_cast<std::size_t>(k)]);
  });
  for_each_block(set_->size(), [&](Index begin, Index end) { list_block(world, begin, end); });
  listed_once_ = true, listed_deep_ = fresh_, travelled_ = 0;
}

void NodeContact::list_block(const World& world, Index begin, Index end) {
  Block& b = blocks_[static_cast<std::size_t>(begin / block_size)];
  b.first.clear(), b.candidate.clear(), b.touching.clear();
  for (Index i = begin; i < end; ++i) {
    b.first.push_back(static_cast<Index>(b.candidate.size()));
    if (touches_any(i)) b.touching.push_back(i);
    if (!may_touch_[static_cast<std::size_t>(i)]) continue;
    search_.near(world.nodes.x.vec(node(i).node), [&](Index f) {
      if (may_touch(world, node(i), face(f))) b.candidate.push_back(f);
    });
  }
  b.first.push_back(static_cast<Index>(b.candidate.size()));
  b.first_wake = -unlimited;
  b.clear.assign(b.candidate.size(), -std::numeric_limits<float>::infinity()), b.beside = b.clear;
  b.bounded.assign(b.first.size() - 1, -1), b.left.assign(b.bounded.size(), 0);
  b.wake.resize(b.bounded.size()), b.known.assign(b.bounded.size(), {-1, -1, -1});
  for (std::size_t k = 0; k < b.wake.size(); ++k)
    b.wake[k] = b.first[k] == b.first[k + 1] && !touches_any(begin + static_cast<Index>(k)) ? unlimited
                                                                                            : b.first_wake;
}

// Bounds of the chosen candidates as of now.
void NodeContact::bound(const World& world, Block& b, Index i, const Vec& x) const {
  const Field<Real>& at = world.nodes.x;
  const Real* const positions[3] = {at.data(0), at.data(1), at.data(2)};
  const std::size_t count = b.chosen.size();
  b.corners.resize(count), b.distance.resize(2 * count);
  for (std::size_t j = 0; j < count; ++j)
    b.corners[j] = face(b.candidate[static_cast<std::size_t>(b.chosen[j])]).node.data();
  loops_.bounds(positions, b.corners.data(), static_cast<Index>(count), x.data(), b.distance.data(),
                b.distance.data() + count);
  const auto rounded = [&](Real a) { return static_cast<float>(a - 1e-6 * (size_ + travelled_)); };
  for (std::size_t j = 0; j < count; ++j) {
    const auto c = static_cast<std::size_t>(b.chosen[j]);
    const ContactFace& f = face(b.candidate[c]);
    b.clear[c] = rounded(travelled_ + b.distance[j] - most_distance(i, f) - late_reach * f.depth);
    b.beside[c] = rounded(travelled_ + b.distance[count + j]);
  }
}

// When a node that touches nothing may next meet a face.
Real NodeContact::next_wake(const Block& b, std::size_t k) const {
  Real least = std::numeric_limits<Real>::infinity();
  for (auto c = static_cast<std::size_t>(b.first[k]); c < static_cast<std::size_t>(b.first[k + 1]); ++c)
    least = std::min<Real>(least, std::max(b.clear[c], b.beside[c]));
  return least;
}

void NodeContact::start(World& world, const Clock& clock) {
  first_step_ = soft_dt_ == 0 && clock.dt_old > 0;
  soft_dt_ = std::max(soft_dt_, clock.dt_old);
  if (law_.sleeps(clock.t)) {
    if (!asleep_)  // at its death what it stores is lost
      let_go_ += std::exchange(stored_, 0);
    if (!asleep_)
      for (int k = 0; k < most_touches; ++k) std::fill_n(in_touch_->data(k), set_->size(), 0);
    if (!asleep_) depth_->fill(0);
    asleep_ = fresh_ = true;
    return;
  }
  asleep_ = false;
  follow(world, clock);
  touched_.assign(involved_.size(), 0), depths_.assign(involved_.size(), 0);
  for (Block& b : blocks_) {
    b.idle = !fresh_ && b.touching.empty() && travelled_ + closing_ < b.first_wake;
    for (const Index i : b.touching) {
      const auto place = static_cast<std::size_t>(place_[static_cast<std::size_t>(node(i).node)]);
      touched_[place] = 1, depths_[place] = std::max(depths_[place], (*depth_)[i]);
    }
  }
}

void NodeContact::block(World& world, const Clock& clock, Index begin, Index end) {
  Block& b = blocks_[static_cast<std::size_t>(begin / block_size)];
  b.touches.clear(), b.leaked.clear(), b.touching.clear();
  b.let_go = 0, b.jumped = 0;
  if (asleep_ || b.idle) return;
  for (Index i = begin; i < end; ++i)
    if (fresh_ || b.wake[static_cast<std::size_t>(i - begin)] <= travelled_ + closing_)
      touch(world, clock, b, i);
  b.first_wake = *std::min_element(b.wake.begin(), b.wake.end());
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
  stored_ = 0;
  for (const Touch& touch : touches_) {
    stored_ += touch.stored;
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
  const bool may_end = law_.gate.there() || law_.death < NodeContactLaw{}.death;
  if (may_end && (!archive.loading() || archive.has("stored"))) archive("stored", stored_);
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
