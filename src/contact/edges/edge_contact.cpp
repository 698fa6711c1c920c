#include "contact/edges/edge_contact.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>

#include "parallel/parallel.hpp"
#include "state/shared_fields.hpp"

namespace courant {

namespace {

/// Edges are looked at this far apart, of a usual edge, before there is a step to tell it.
constexpr Real edge_reach = 0.1;
/// Lists hold until nodes may have come nearer by this, of a usual edge.
constexpr Real edge_list_margin = 0.3;

}  // namespace

EdgeContact::EdgeContact(NodeContactLaw law, std::vector<ContactEdge> edges, WallBodies bodies,
                         std::shared_ptr<const NodeContact> nodes, int number, World& world)
    : law_(std::move(law)),
      bodies_(std::move(bodies)),
      nodes_(std::move(nodes)),
      number_(number),
      friction_on_(law_.rubs()),
      drag_on_(friction_on_ || law_.vdc > 0),
      edges_(std::move(edges)),
      set_(&world.add_set(fmt::format("contact {} edges", number))),
      eroded_(shared_fields::eroded.find(world.segments.fields)) {
  set_->resize(static_cast<Index>(edges_.size()));
  blocks_.resize(static_cast<std::size_t>(block_count(set_->size())));
  world.counters.try_emplace("leaked_edges", 0);
  world.counters["contact_edges"] += set_->size();
  world.maxima.try_emplace("max_penetration", 0);
  std::map<Index, std::vector<Index>> at_node;
  std::vector<Real> lengths;
  for (Index e = 0; e < set_->size(); ++e) {
    for (const Index n : edge(e).node) at_node[n].push_back(e);
    start_.push_back(ends(world, e));
    lengths.push_back((start_.back()[1] - start_.back()[0]).norm());
  }
  const auto middle = lengths.begin() + static_cast<std::ptrdiff_t>(lengths.size() / 2);
  std::nth_element(lengths.begin(), middle, lengths.end());
  size_ = lengths.empty() ? 0 : *middle;
  next_.resize(edges_.size());
  place_.assign(static_cast<std::size_t>(world.nodes.size()), -1);
  chain_.resize(edges_.size());
  std::iota(chain_.begin(), chain_.end(), 0);
  const auto root = [&](Index e) {
    while (chain_[static_cast<std::size_t>(e)] != e) e = chain_[static_cast<std::size_t>(e)];
    return e;
  };
  for (const auto& [n, there] : at_node) {
    place_[static_cast<std::size_t>(n)] = static_cast<Index>(involved_.size());
    involved_.push_back(n);
    for (const Index e : there) {
      const Index one = root(there.front()), other = root(e);
      chain_[static_cast<std::size_t>(std::max(one, other))] = std::min(one, other);
      for (const Index other_edge : there)
        if (other_edge != e)
          next_[static_cast<std::size_t>(e)][edge(e).node[0] == n ? 0 : 1].push_back(other_edge);
    }
  }
  for (Index e = 0; e < set_->size(); ++e) chain_[static_cast<std::size_t>(e)] = root(e);
  listed_at_.assign(involved_.size(), Vec::Zero());
  springs_.assign(involved_.size(), 0);
}

std::string EdgeContact::name() const {
  return fmt::format("contact {} of edges", law_.id ? law_.id : number_);
}

void EdgeContact::declare(const World& world, Accesses& a) const {
  const Nodes& n = world.nodes;
  const auto reads_erosion = [&] {
    if (eroded_) a.reads(*eroded_, Reach::others);
    for (const ContactEdge& e : edges_)
      if (e.eroded) a.reads(*e.eroded, Reach::others);
  };
  a.reads(n.x, Reach::others).reads(n.v, Reach::others).reads(n.m, Reach::others);
  a.reads(n.held, Reach::others);
  reads_erosion();
  if (nodes_) a.reads(nodes_->touches(), Reach::others);
  a.in_start().reads(n.x, Reach::others).reads(n.v, Reach::others).reads(n.m, Reach::others);
  a.reads(n.held, Reach::others);
  reads_erosion();
  a.in_finish().writes(touches_resource_).updates(*world.segments.contact_force);
  a.reads(n.m, Reach::others).reads(n.held, Reach::others);
  if (eroded_) a.reads(*eroded_, Reach::others);
}

// Lists are made again when nodes may have come nearer than lists reach.
void EdgeContact::follow(World& world, const Clock& clock) {
  const Nodes& nodes = world.nodes;
  Real moved2 = 0, v2 = 0;
  for (std::size_t k = 0; k < involved_.size(); ++k) {
    moved2 = std::max(moved2, (nodes.x.vec(involved_[k]) - listed_at_[k]).squaredNorm());
    v2 = std::max(v2, nodes.v.vec(involved_[k]).squaredNorm());
  }
  reach_ = std::max(edge_reach * size_, 2.2 * std::sqrt(v2) * longest_step(clock));
  const auto deleted = world.counters.find("deleted_elements");
  const std::int64_t count = deleted == world.counters.end() ? 0 : deleted->second;
  if (count == eroded_count_ && listed_once_ && reach_ + 2.01 * std::sqrt(moved2) <= listed_reach_) return;
  eroded_count_ = count;
  listed_reach_ = 2 * reach_ + edge_list_margin * size_;
  list(world);
}

void EdgeContact::list(World& world) {
  std::vector<BoxGrid::Box> boxes;
  boxes.reserve(edges_.size());
  for (const ContactEdge& e : edges_) {
    const EdgeEnds x = ends_of(e, world.nodes.x);
    const Real around = 0.5 * listed_reach_ + e.r;  // of two boxes: both
    boxes.push_back({x[0].cwiseMin(x[1]).array() - around, x[0].cwiseMax(x[1]).array() + around});
  }
  search_.build(std::move(boxes));
  for (std::size_t k = 0; k < involved_.size(); ++k) listed_at_[k] = world.nodes.x.vec(involved_[k]);
  for_each_block(set_->size(), [&](Index begin, Index end) {
    Block& b = blocks_[static_cast<std::size_t>(begin / block_size)];
    b.first.clear(), b.candidate.clear();
    std::vector<Index> near;
    for (Index i = begin; i < end; ++i) {
      b.first.push_back(static_cast<Index>(b.candidate.size()));
      if (!is_there(edge(i))) continue;
      near.clear();
      search_.near(i, near);
      for (const Index j : near)
        if (may_touch(world, i, j)) b.candidate.push_back(j);
    }
    b.first.push_back(static_cast<Index>(b.candidate.size()));
  });
  listed_once_ = true;
}

// Of shells those that one shell has that is there.
bool EdgeContact::is_there(const ContactEdge& e) const {
  if (e.eroded) return (*e.eroded)[e.element] == 0;
  if (e.faces.empty() || !eroded_) return true;
  const auto count =
      std::count_if(e.faces.begin(), e.faces.end(), [&](Index s) { return (*eroded_)[s] == 0; });
  return e.always ? count > 0 : count == 1;
}

// Not with what they hang together with and overlapped from the start, as short elements of a thick beam.
bool EdgeContact::may_touch(const World& world, Index a, Index b) const {
  const ContactEdge &one = edge(a), &other = edge(b);
  if (!((one.sides & 1U) != 0 && (other.sides & 2U) != 0) &&
      !((one.sides & 2U) != 0 && (other.sides & 1U) != 0))
    return false;
  if (one.has(other.node[0]) || one.has(other.node[1]) || !is_there(one) || !is_there(other)) return false;
  const auto all = [&](const auto& holds) {
    return holds(one.node[0]) && holds(one.node[1]) && holds(other.node[0]) && holds(other.node[1]);
  };
  if (all([&](Index n) { return world.nodes.held[n] != 0; })) return false;
  const Index body = bodies_.body(one.node[0]);
  if (body >= 0 && all([&](Index n) { return bodies_.body(n) == body; })) return false;
  constexpr Real beside_rounding = 1 + 1e-6;
  return chain_[static_cast<std::size_t>(a)] != chain_[static_cast<std::size_t>(b)] ||
         nearest_points(start_[static_cast<std::size_t>(a)], start_[static_cast<std::size_t>(b)]).distance >
             beside_rounding * reach_of(a, b);
}

// Nodes of one at a face of the other: what nodes with faces do there is enough.
bool EdgeContact::held_by_nodes(Index a, Index b) const {
  if (!nodes_) return false;
  const auto at_faces = [&](const ContactEdge& one, const ContactEdge& other) {
    for (const Index s : other.faces)
      if (nodes_->holds(one.node[0], s) || nodes_->holds(one.node[1], s)) return true;
    return false;
  };
  return at_faces(edge(a), edge(b)) || at_faces(edge(b), edge(a));
}

void EdgeContact::start(World& world, const Clock& clock) {
  first_step_ = soft_dt_ == 0 && clock.dt_old > 0;
  soft_dt_ = std::max(soft_dt_, clock.dt_old);
  if (law_.sleeps(clock.t)) {  // at its death what it stores is lost
    for (const Touch& touch : touches_) let_go_ += touch.stored;
    touches_.clear();
    asleep_ = fresh_ = true;
    return;
  }
  asleep_ = false;
  follow(world, clock);
  go_on(world, clock);
}

void EdgeContact::block(World& world, const Clock& clock, Index begin, Index end) {
  Block& b = blocks_[static_cast<std::size_t>(begin / block_size)];
  b.touches.clear(), b.leaked = 0;
  if (asleep_) return;
  const auto of_edge = [&](Index i) {
    Touch key;
    key.a = i, key.b = -1;
    return std::lower_bound(touches_.begin(), touches_.end(), key,
                            [](const Touch& x, const Touch& y) { return x.before(y); });
  };
  for (auto touch = of_edge(begin); touch != touches_.end() && touch->a < end; ++touch)
    b.touches.push_back(*touch);
  for (Index i = begin; i < end; ++i) {
    const auto k = static_cast<std::size_t>(i - begin);
    for (Index c = b.first[k]; c < b.first[k + 1]; ++c)
      begin_touches(world, clock, b, i, b.candidate[static_cast<std::size_t>(c)]);
  }
  std::sort(b.touches.begin(), b.touches.end(), [](const Touch& x, const Touch& y) { return x.before(y); });
  for (Touch& touch : b.touches) push(world, clock, touch);
}

void EdgeContact::finish(World& world, const Clock&) {
  touches_.clear();
  Real deepest = 0;
  for (const Block& b : blocks_) {
    touches_.insert(touches_.end(), b.touches.begin(), b.touches.end());
    leaked_ += b.leaked;
  }
  if (asleep_) touches_.clear();
  world.counters["leaked_edges"] += leaked_, leaked_ = 0;
  for (const Touch& touch : touches_) {
    deepest = std::max(deepest, touch.depth);
    for (const auto& [e, sign] : {std::pair<Index, Real>(touch.a, 1), std::pair<Index, Real>(touch.b, -1)})
      for (const Index s : edge(e).faces) {
        if (eroded_ && (*eroded_)[s] != 0) continue;
        world.segments.contact_force->add(s, sign * touch.force);
        break;
      }
  }
  acted_ = acted_ || deepest > 0;
  Real& most = world.maxima["max_penetration"];
  most = std::max(most, deepest);
  if (!asleep_ && fresh_ && (law_.birth > 0 || law_.gate.there()))
    for (const Touch& touch : touches_) world.counters["penetrations_at_birth"] += touch.slack > 0;
  if (!asleep_) fresh_ = false;
  gather(world);
}

void EdgeContact::keep(Archive& archive) {
  std::vector<Index> of;
  std::vector<Real> reals;
  std::vector<Vec> vectors;
  if (!archive.loading())
    for (const Touch& touch : touches_) {
      if (touch.due > 0) continue;
      of.insert(of.end(), {touch.a, touch.b, touch.place});
      reals.insert(reals.end(), {touch.k, touch.slack, touch.stored});
      vectors.insert(vectors.end(), {touch.n, touch.friction});
    }
  archive("pairs", of);
  archive("stiffness_slack_energy", reals);
  archive("normals_friction", vectors);
  archive("springs", springs_);
  archive("fresh", fresh_);
  archive("asleep", asleep_);
  archive("soft_dt", soft_dt_);
  archive("acted", acted_);
  archive("damping_work", damping_work_);
  archive("friction_work", friction_work_);
  if (!archive.loading()) return;
  listed_once_ = false;
  touches_.assign(of.size() / 3, {});
  for (std::size_t k = 0; k < touches_.size(); ++k) {
    Touch& touch = touches_[k];
    touch.a = of[3 * k], touch.b = of[3 * k + 1], touch.place = of[3 * k + 2];
    touch.k = reals[3 * k], touch.slack = reals[3 * k + 1], touch.stored = reals[3 * k + 2];
    touch.n = vectors[2 * k], touch.friction = vectors[2 * k + 1];
  }
}

EdgeContact::Penetrations EdgeContact::penetrations(World& world) {
  Penetrations out;
  if (law_.birth > 0 || !law_.gate.open()) return out;
  follow(world, {});
  for (Index i = 0; i < set_->size(); ++i) {
    Block& b = blocks_[static_cast<std::size_t>(i / block_size)];
    const auto k = static_cast<std::size_t>(i % block_size);
    b.touches.clear();
    for (Index c = b.first[k]; c < b.first[k + 1]; ++c)
      begin_touches(world, {}, b, i, b.candidate[static_cast<std::size_t>(c)]);
    for (const Touch& touch : b.touches) {
      if (!(-touch.gap > 0) || touch.due > 0) continue;
      ++out.count;
      if (-touch.gap > out.deepest)
        out.deepest = -touch.gap, out.node = world.nodes.id[edge(touch.a).node[0]];
    }
    b.touches.clear();
  }
  return out;
}

}  // namespace courant
