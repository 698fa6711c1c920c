// *CONSTRAINED_INTERPOLATION.
#include "loads/interpolation.hpp"
#include "loads/load_cards.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <vector>

#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>
#include <Eigen/LU>

#include "base/rotation.hpp"
#include "extension/additions.hpp"
#include "keyword/registry.hpp"
#include "loads/carried_mass.hpp"
#include "state/points.hpp"
#include "state/shared_fields.hpp"
#include "state/tied_mass.hpp"

namespace courant {

namespace {

using CI = ConstrainedInterpolation;

const RegisterKeyword<CI> constrained_interpolation{constrained_interpolation_table()};

/// Nodes are indices into World::nodes.
struct Interpolation {
  Index node = -1;
  bool turns = false;  ///< its rotation follows, too
  std::vector<Index> of{};
  std::vector<Real> weight{};  ///< of each, with the sum 1
};

/// Centre and second moment of the independent nodes, by weight: sum w r, sum w (r^2 - r r).
struct Cloud {
  Vec centre = Vec::Zero();
  Matrix J = Matrix::Zero();
};
Cloud cloud_of(const std::vector<Real>& weight, const std::vector<Vec>& x) {
  Cloud out;
  for (std::size_t k = 0; k < x.size(); ++k) out.centre += weight[k] * x[k];
  for (std::size_t k = 0; k < x.size(); ++k) {
    const Vec r = x[k] - out.centre;
    out.J += weight[k] * (r.squaredNorm() * Matrix::Identity() - r * r.transpose());
  }
  return out;
}
template <class Place>
Cloud cloud_of(const Interpolation& i, const Place& place) {
  std::vector<Vec> x;
  for (const Index n : i.of) x.push_back(place(n));
  return cloud_of(i.weight, x);
}

/// Hands force and moment of the dependent node to the independent ones: w (F + theta x r), theta = J^-1
/// (M + (x - c) x F), so that both sums are kept.
class InterpolationForces : public Constraint {
 public:
  InterpolationForces(std::vector<Interpolation> all, World& world)
      : all_(std::move(all)),
        moment_(shared_fields::moment.find(world.nodes.fields)),
        part_of_(static_cast<std::size_t>(world.nodes.size())) {
    for (std::size_t i = 0; i < all_.size(); ++i)
      for (std::size_t k = 0; k < all_[i].of.size(); ++k)
        part_of_[static_cast<std::size_t>(all_[i].of[k])].push_back({i, all_[i].weight[k]});
  }
  std::string name() const override { return "interpolated nodes"; }
  const FieldSet& over(const World& world) const override { return world.nodes.fields; }
  void declare(const World& world, Accesses& a) const override {
    a.in_start().reads_before(world.nodes.f, Reach::others).reads(world.nodes.x, Reach::others);
    if (moment_) a.reads_before(*moment_, Reach::others);
    a.in_block().updates(world.nodes.f).reads(world.nodes.x);
  }
  void start(World& world, const Clock&) override {
    loads_.clear();
    for (const Interpolation& i : all_) {
      const Cloud cloud = cloud_of(i, [&](Index n) { return world.nodes.x.vec(n); });
      const Vec force = world.nodes.f.vec(i.node), arm = world.nodes.x.vec(i.node) - cloud.centre;
      Vec moment = arm.cross(force);
      if (moment_ && i.turns) moment += moment_->vec(i.node);
      loads_.push_back({cloud.centre, force, cloud.J.inverse() * moment});
    }
  }
  void block(World& world, const Clock&, Index begin, Index end) override {
    for (Index n = begin; n < end; ++n)
      for (const Share& share : part_of_[static_cast<std::size_t>(n)]) {
        const Load& load = loads_[share.of];
        const Vec r = world.nodes.x.vec(n) - load.centre;
        world.nodes.f.add(n, share.weight * (load.force + load.theta.cross(r)));
      }
  }

 private:
  struct Share {
    std::size_t of;
    Real weight;
  };
  struct Load {
    Vec centre, force, theta;
  };
  std::vector<Interpolation> all_;
  const Field<Real>* moment_;  ///< null: nothing turns
  std::vector<std::vector<Share>> part_of_;
  std::vector<Load> loads_;
};

/// The mean velocity and spin of the independent nodes over the step move the dependent one, which a motion
/// of all as one keeps instead exactly.
class ByMeans : public Carriage {
 public:
  explicit ByMeans(std::vector<Interpolation> all) : all_(std::move(all)) {}
  std::size_t size() const override { return all_.size(); }
  Index node(std::size_t i) const override { return all_[i].node; }
  std::span<const Index> carriers(std::size_t i) const override { return all_[i].of; }
  std::span<const Real> shares(std::size_t i) const override { return all_[i].weight; }
  bool spins(std::size_t i) const override { return all_[i].turns; }
  void rates(const World& world, std::size_t i, std::span<Rate> out) const override {
    const Interpolation& one = all_[i];
    const Cloud cloud = cloud_of(one, [&](Index n) { return world.nodes.x.vec(n); });
    const Matrix back = cloud.J.inverse(), arm = skew(world.nodes.x.vec(one.node) - cloud.centre);
    for (std::size_t k = 0; k < one.of.size(); ++k) {
      out[k].W = one.weight[k] * back * skew(world.nodes.x.vec(one.of[k]) - cloud.centre);
      out[k].B = one.weight[k] * Matrix::Identity() - arm * out[k].W;
    }
  }
  Chord chord(const World& world, std::size_t i, std::span<const Vec> x, std::span<const Vec> v,
              Real dt) const override {
    const Interpolation& one = all_[i];
    std::vector<Vec> middle(x.begin(), x.end());
    for (std::size_t k = 0; k < middle.size(); ++k) middle[k] -= 0.5 * dt * v[k];
    const Cloud cloud = cloud_of(one.weight, middle);
    Vec velocity = Vec::Zero(), spin = Vec::Zero();
    for (std::size_t k = 0; k < middle.size(); ++k) {
      velocity += one.weight[k] * v[k];
      spin += one.weight[k] * (middle[k] - cloud.centre).cross(v[k]);
    }
    // of chords: 2 tan(angle/2) over dt
    const Vec rate = cloud.J.inverse() * spin;
    const Real half = 0.5 * dt * rate.norm();
    const Vec turn = half > 0 ? Vec(2 * std::atan(half) / half * 0.5 * dt * rate) : Vec(Vec::Zero());
    const Vec old = world.nodes.x.vec(one.node), arm = old - (cloud.centre - 0.5 * dt * velocity);
    const Vec moved = turned_by(turn, Eigen::Quaterniond::Identity()) * arm - arm;
    return {old + dt * velocity + moved, velocity + moved / dt, turn / dt};
  }

 private:
  std::vector<Interpolation> all_;
};

class InterpolationMotion : public Motion {
 public:
  InterpolationMotion(std::vector<Interpolation> all, std::shared_ptr<CarriedMass> inertia, World& world)
      : all_(std::move(all)),
        inertia_(std::move(inertia)),
        angle_(shared_fields::rotation.find(world.nodes.fields)),
        speed_(shared_fields::angular_velocity.find(world.nodes.fields)) {}
  std::string name() const override { return "interpolated nodes (motion)"; }
  const FieldSet& over(const World& world) const override { return world.nodes.fields; }
  void declare(const World& world, Accesses& a) const override {
    inertia_->declare_move(world, a);
    if (speed_) a.revises(*angle_).revises(*speed_);
  }
  void block(World&, const Clock&, Index, Index) override {}
  void finish(World& world, const Clock& clock) override {
    inertia_->move(world, clock);
    for (const Interpolation& i : all_)
      if (speed_ && i.turns) angle_->add(i.node, clock.dt * speed_->vec(i.node));
  }

 private:
  std::vector<Interpolation> all_;
  std::shared_ptr<CarriedMass> inertia_;
  Field<Real>*angle_, *speed_;  ///< null: nothing turns
};

class InterpolationBuilder {
 public:
  InterpolationBuilder(const Deck& deck, const Model& model, bool mass_grows, World& world,
                       Diagnostics& diagnostics)
      : deck_(deck), model_(model), mass_grows_(mass_grows), world_(world), diagnostics_(diagnostics) {
    beside_ties_ = shared_fields::tied_mass.find(world.nodes.fields) != nullptr;
    for (Index n = 0; n < world.nodes.size(); ++n) world_node_[world.nodes.id[n]] = n;
    for (std::size_t n = 0; n < model.nodes.size(); ++n)
      model_node_[model.nodes[n].id] = static_cast<Index>(n);
  }

  void add(const CI& card) {
    if (mass_grows_)
      return error(card, "DNID", "it is not supported beside mass scaling that goes on",
                   "give MS1ST 1, or leave DT2MS of *CONTROL_TIMESTEP blank");
    if (beside_ties_)
      return error(card, "DNID", "it is not supported beside contacts that tie exactly",
                   "use these contacts with _OFFSET, whose springs are allowed with it");
    Interpolation out;
    const ModelNode* node = find(card, "DNID", card.dnid, out.node);
    if (!node || !check_dependent(card, *node, out)) return;
    std::map<Index, Real> weights;
    for (std::size_t k = 0; k < card.inid.size(); ++k)
      if (!read_independent(card, k, weights)) return;
    Real sum = 0;
    for (const auto& [n, weight] : weights) sum += weight;
    for (const auto& [n, weight] : weights)
      if (weight > 0) out.of.push_back(n), out.weight.push_back(weight / sum);
    if (!spans(out))
      return error(card, "INID",
                   "the independent nodes lie on one line, and do not define how the node rotates",
                   "name three or more that span a plane");
    all_.push_back(std::move(out));
  }

  void finish() {
    for (const Interpolation& i : all_) start(i);
    world_.passes.add(std::make_shared<InterpolationForces>(all_, world_));
    const auto inertia = world_.passes.add(std::make_shared<CarriedMass>(
        std::make_shared<ByMeans>(all_), "inertia of interpolated nodes", world_));
    inertia->join(world_);
    world_.passes.add(std::make_shared<InterpolationMotion>(all_, inertia, world_));
  }
  bool any() const { return !all_.empty(); }

 private:
  void error(const CI& card, const char* field, std::string message, std::string hint) {
    deck_.error(diagnostics_, card, field, std::move(message), std::move(hint));
  }

  const ModelNode* find(const CI& card, const char* field, Id id, Index& out) {
    const auto known = model_node_.find(id);
    const auto found = world_node_.find(id);
    if (known == model_node_.end())
      error(card, field, fmt::format("node {} does not exist", id), "define it with *NODE");
    else if (found == world_node_.end())
      error(card, field, fmt::format("node {} belongs to no element", id),
            "name nodes of solids, shells and beams");
    else if (world_.nodes.follow[found->second] != 0)
      error(card, field,
            fmt::format("node {} goes with a rigid body, a face to which it is tied, or others", id),
            "name nodes that move by their forces");
    else
      return out = found->second, &model_.nodes[static_cast<std::size_t>(known->second)];
    return nullptr;
  }

  bool check_dependent(const CI& card, const ModelNode& node, Interpolation& out) {
    const auto turns = model_.held_rotations.find(static_cast<Index>(&node - model_.nodes.data()));
    const bool held = node.fixed[0] || node.fixed[1] || node.fixed[2] ||
                      (card.ddof != 123 && turns != model_.held_rotations.end());
    const bool twice = !taken_.insert(out.node).second;
    out.turns = card.ddof != 123 && has_rotations(world_.nodes);
    if (!held && !twice) return true;
    error(card, "DNID",
          fmt::format("node {} is {}", node.id,
                      held ? "held by *BOUNDARY_SPC, TC or RC" : "dependent already, on other nodes"),
          held ? "hold the independent nodes" : "name all of them in one keyword");
    return false;
  }

  bool read_independent(const CI& card, std::size_t k, std::map<Index, Real>& weights) {
    const Real w = card.twghtx[k] != 0 ? card.twghtx[k] : 1;
    for (const auto& [field, other] :
         {std::pair("TWGHTY", card.twghty[k]), std::pair("TWGHTZ", card.twghtz[k])})
      if (other != 0 && other != w) {
        error(card, field, fmt::format("'{:g}' differs from TWGHTX", other),
              "one weight for all axes: leave it 0");
        return false;
      }
    if (!(w > 0)) {
      error(card, "TWGHTX", fmt::format("expected a number > 0, got '{:g}'", w), "leave the node out");
      return false;
    }
    std::vector<Id> ids;
    if (card.ityp == 0) {
      ids = {card.inid[k]};
    } else if (const auto set = model_.node_sets.find(card.inid[k]); set != model_.node_sets.end()) {
      for (const Index n : set->second) ids.push_back(model_.nodes[static_cast<std::size_t>(n)].id);
    } else {
      error(card, "INID", fmt::format("node set {} does not exist", card.inid[k]),
            "define it with *SET_NODE");
      return false;
    }
    for (const Id id : ids)
      if (!add_independent(card, id, card.idof[k] != 123, w, weights)) return false;
    return true;
  }

  bool add_independent(const CI& card, Id id, bool turning, Real w, std::map<Index, Real>& weights) {
    Index n = -1;
    if (interpolated_nodes(deck_).contains(id)) {
      error(card, "INID", fmt::format("node {} depends on others itself", id), "name those instead");
      return false;
    }
    if (!find(card, "INID", id, n)) return false;
    const auto* inertia = shared_fields::rotary_inertia.find(world_.nodes.fields);
    if (turning && inertia && (*inertia)[n] > 0) {
      error(card, "IDOF", fmt::format("node {} turns, and its rotation would count", id),
            "give IDOF 123: only positions of independent nodes count here");
      return false;
    }
    if (!(world_.nodes.m[n] > 0)) {
      error(card, "INID", fmt::format("node {} has no mass", id), "name nodes of elements");
      return false;
    }
    weights[n] += w;
    return true;
  }

  bool spans(const Interpolation& i) const {
    if (i.of.empty()) return false;
    const Cloud cloud = cloud_of(i, [&](Index n) { return world_.nodes.x.vec(n); });
    const Eigen::SelfAdjointEigenSolver<Matrix> own(cloud.J, Eigen::EigenvaluesOnly);
    constexpr Real thin = 1e-6;
    return own.eigenvalues()[0] > thin * own.eigenvalues()[2];
  }

  /// The independent nodes get the mass of the dependent one.
  void start(const Interpolation& i) {
    Nodes& nodes = world_.nodes;
    Field<Real>& carried = shared_fields::tied_mass.add(nodes.fields);
    for (std::size_t k = 0; k < i.of.size(); ++k) {
      const Real more = i.weight[k] * nodes.m[i.node];
      nodes.m[i.of[k]] += more, carried[i.of[k]] += more;  // which weighs where the dependent node is
    }
    nodes.follow[i.node] = 2;  // not 1: no rigid body moves it
    if (i.turns) (*shared_fields::no_rotation.find(nodes.fields))[i.node] = 1;
  }

  const Deck& deck_;
  const Model& model_;
  bool mass_grows_, beside_ties_ = false;
  World& world_;
  Diagnostics& diagnostics_;
  std::map<Id, Index> world_node_, model_node_;
  std::set<Index> taken_;
  std::vector<Interpolation> all_;
};

/// Dependent nodes may belong to no element.
const RegisterAddition dependent_nodes{"*CONSTRAINED_INTERPOLATION",
                                       [](const Deck&, const Model&, World&, Diagnostics&) {},
                                       [](const Deck& deck, const Model& model) {
                                         const std::set<Id> ids = interpolated_nodes(deck);
                                         std::vector<Index> out;
                                         for (std::size_t n = 0; n < model.nodes.size() && !ids.empty(); ++n)
                                           if (ids.contains(model.nodes[n].id))
                                             out.push_back(static_cast<Index>(n));
                                         return out;
                                       }};

}  // namespace

std::set<Id> interpolated_nodes(const Deck& deck) {
  std::set<Id> out;
  for (const CI& card : deck.all<CI>()) out.insert(card.dnid);
  return out;
}

void add_interpolations(const Deck& deck, const Model& model, bool mass_grows, World& world,
                        Diagnostics& diagnostics) {
  const auto& cards = deck.all<CI>();
  if (cards.empty()) return;
  InterpolationBuilder builder(deck, model, mass_grows, world, diagnostics);
  for (const CI& card : cards) builder.add(card);
  if (diagnostics.ok() && builder.any()) builder.finish();
}

}  // namespace courant
