// *BOUNDARY_SPC along axes of a system of its own that are not the global ones, or from BIRTH to DEATH.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <unordered_map>
#include <utility>

#include "extension/additions.hpp"
#include "loads/walls/rigid_wall_card.hpp"
#include "model/cards.hpp"
#include "state/reports.hpp"
#include "state/shared_fields.hpp"
#include "state/tied_mass.hpp"

namespace courant {

namespace {

/// A node, and the projections onto the directions in which it moves and turns freely from birth to death.
struct HeldNode {
  Index node = 0;
  Matrix free = Matrix::Identity(), turns = Matrix::Identity();
  Real birth = 0, death = std::numeric_limits<Real>::infinity();  ///< [T]
  bool holds(Real t) const { return t >= birth && t < death; }
};

/// Neither force nor velocity along the held directions; what strikes behind the constraints is held, too.
/// A node that still moves at birth is stopped as by a plastic impact, whose energy is booked.
class HeldNodes : public Constraint, public Impact, public EnergyTerm, public BoundaryForceReporter {
 public:
  HeldNodes(std::string name, std::vector<HeldNode> nodes, World& world)
      : name_(std::move(name)),
        held_(std::move(nodes)),
        moment_(shared_fields::moment.find(world.nodes.fields)),
        turn_(shared_fields::angular_velocity.find(world.nodes.fields)),
        inertia_(shared_fields::rotary_inertia.find(world.nodes.fields)) {
    reaction_.resize(held_.size(), Vec::Zero()), reaction_moment_ = reaction_;
    for (const HeldNode& one : held_)
      if (one.holds(0)) stop(one, world);
  }
  std::string name() const override { return name_; }
  const FieldSet& over(const World& world) const override { return world.nodes.fields; }
  void declare(const World& world, Accesses& a) const override {
    a.in_finish().reads(world.nodes.m).revises(world.nodes.f).updates(world.nodes.v);
    if (moment_) a.reads(*inertia_).revises(*moment_).updates(*turn_);
  }
  void block(World&, const Clock&, Index, Index) override {}
  void finish(World& world, const Clock& clock) override {
    std::fill(reaction_.begin(), reaction_.end(), Vec::Zero());
    std::fill(reaction_moment_.begin(), reaction_moment_.end(), Vec::Zero());
    hold(world, clock);
    for (const HeldNode& one : held_)
      if (one.holds(clock.t)) stop(one, world);
  }
  void strike(World& world, const Clock& clock) override { hold(world, clock); }
  void record(World&, const Clock&, EnergyLedger& ledger) override {
    ledger.dissipated += std::exchange(taken_, 0);
  }
  void sample(const World&, const Clock&, EnergyLedger&) const override {}
  void report_forces(const World& world, const Clock& clock, std::vector<BoundaryForce>& out) const override {
    for (std::size_t k = 0; k < held_.size(); ++k) {
      if (!held_[k].holds(clock.t)) continue;
      const Id id = world.nodes.id[held_[k].node];
      if (!held_[k].free.isIdentity(0))
        out.push_back({BoundaryForce::Kind::held_point, id, reaction_[k], Vec::Zero(), 0});
      if (moment_ && !held_[k].turns.isIdentity(0))
        out.push_back({BoundaryForce::Kind::held_rotation, id, Vec::Zero(), reaction_moment_[k], 0});
    }
  }

 private:
  void hold(World& world, const Clock& clock) {
    const auto project = [](Field<Real>& f, Index n, const Matrix& free, Vec& reaction) {
      const Vec before = f.vec(n), left = free * before;
      reaction += left - before;
      f.set(n, left);
    };
    for (std::size_t k = 0; k < held_.size(); ++k) {
      const HeldNode& one = held_[k];
      if (!one.holds(clock.t)) continue;
      project(world.nodes.f, one.node, one.free, reaction_[k]);
      if (moment_) project(*moment_, one.node, one.turns, reaction_moment_[k]);
    }
  }
  void stop(const HeldNode& one, World& world) {
    const auto project = [&](Field<Real>& v, const Matrix& free, Real inertia) {
      const Vec before = v.vec(one.node), left = free * before;
      if (one.birth > 0) taken_ += 0.5 * inertia * (before.squaredNorm() - left.squaredNorm());
      v.set(one.node, left);
    };
    project(world.nodes.v, one.free, world.nodes.m[one.node]);
    if (moment_) project(*turn_, one.turns, (*inertia_)[one.node]);
  }

  std::string name_;
  std::vector<HeldNode> held_;
  Field<Real>*moment_, *turn_, *inertia_;  ///< null: nodes do not turn
  std::vector<Vec> reaction_, reaction_moment_;
  Real taken_ = 0;  ///< since it was booked [ML2/T2]
};

class ObliqueReader {
 public:
  ObliqueReader(const Deck& deck, const Model& model, World& world, Diagnostics& diagnostics)
      : deck_(deck), model_(model), world_(world), diagnostics_(diagnostics) {
    for (Index n = 0; n < world.nodes.size(); ++n) node_of_id_.emplace(world.nodes.id[n], n);
  }
  void add(const BoundarySpcCard& card, const std::vector<Index>& nodes) {
    if (holds_for_a_time(card, model_.endtim)) return add_timed(card, nodes);
    const auto system = model_.coordinate_systems.find(card.cid);
    if (card.cid == 0 || system == model_.coordinate_systems.end() || system->second.moves) return;
    const std::array<bool, 3> held{card.dofx == 1, card.dofy == 1, card.dofz == 1};
    if (held == std::array{true, true, true}) return;  // of all directions none is oblique
    for (std::size_t k = 0; k < 3; ++k) {
      const Vec axis = system->second.axes.col(static_cast<Eigen::Index>(k));
      constexpr Real along = 1 - 1e-9;  // cosine: the others are held as global ones
      if (!held[k] || axis.cwiseAbs().maxCoeff() >= along) continue;
      for (const Index n : nodes)
        if (!hold(card, model_.nodes[static_cast<std::size_t>(n)].id, axis)) return;
    }
  }
  void finish() {
    if (directions_.empty() && timed_.empty()) return;
    if (!deck_.all<RigidWallPlanar>().empty() || !deck_.all<RigidWallGeometric>().empty())
      diagnostics_.warning(
          {deck_.files[0].name},
          "rigid walls do not know of supports along oblique axes or for a time: nodes that are held so may "
          "get behind them",
          "leave such nodes out by NSIDEX");
    Field<Index>& joined = shared_fields::joined_nodes.add(world_.nodes.fields);
    for (const auto& [node, held] : directions_) joined[node] = -1;
    for (const HeldNode& one : timed_) joined[one.node] = -1;
    std::vector<HeldNode> oblique;
    for (const auto& [node, held] : directions_) {
      HeldNode one;
      one.node = node, one.free = free_of(held);
      oblique.push_back(one);
    }
    if (!oblique.empty())
      world_.passes.add(
          std::make_shared<HeldNodes>("nodes held obliquely (SPC)", std::move(oblique), world_));
    if (!timed_.empty())
      world_.passes.add(
          std::make_shared<HeldNodes>("nodes held for a time (SPC)", std::move(timed_), world_));
  }

 private:
  void add_timed(const BoundarySpcCard& card, const std::vector<Index>& nodes) {
    if (!(card.death > card.birth)) return;
    const auto system = model_.coordinate_systems.find(card.cid);
    if (card.cid != 0 && (system == model_.coordinate_systems.end() || system->second.moves))
      return deck_.error(diagnostics_, card, "CID",
                         fmt::format("system {} does not exist or turns with nodes", card.cid),
                         "supports for a time need one that stays");
    const Matrix axes = card.cid == 0 ? Matrix(Matrix::Identity()) : system->second.axes;
    const auto left = [&](const std::array<int, 3>& held) {
      std::vector<Vec> directions;
      for (std::size_t k = 0; k < 3; ++k)
        if (held[k] == 1) directions.push_back(axes.col(static_cast<Eigen::Index>(k)));
      return free_of(directions);
    };
    HeldNode one;
    one.free = left({card.dofx, card.dofy, card.dofz}),
    one.turns = left({card.dofrx, card.dofry, card.dofrz});
    one.birth = card.birth, one.death = card.death;
    for (const Index n : nodes) {
      one.node =
          free_node(model_.nodes[static_cast<std::size_t>(n)].id, "for a time", [&](const std::string& what) {
            diagnostics_.error(deck_.where(card), deck_.keyword(card) + ": " + what);
          });
      if (one.node < 0) return;
      timed_.push_back(one);
    }
  }
  /// Index into World::nodes of a node that nothing else moves; -1: `refuse` gets why.
  template <class Refuse>
  Index free_node(Id id, const char* how, const Refuse& refuse) const {
    const auto refused = [&](const char* what) {
      refuse(fmt::format("node {} {}, and cannot be held {}", id, what, how));
      return Index(-1);
    };
    const auto found = node_of_id_.find(id);
    if (found == node_of_id_.end()) return refused("is a particle or of no element");
    const Index n = found->second;
    if (world_.nodes.follow[n] != 0) return refused("goes with a rigid body or a face");
    const auto* driven = shared_fields::prescribed_motion.find(world_.nodes.fields);
    if (driven && (*driven)[n] != 0) return refused("is driven, too");
    return n;
  }
  bool hold(const BoundarySpcCard& card, Id id, const Vec& axis) {
    const Index n = free_node(id, "along oblique axes", [&](std::string what) {
      deck_.error(
          diagnostics_, card, "CID", std::move(what),
          "hold all three translations, hold a body by CMO and CON of *MAT_RIGID, or drive along all axes");
    });
    if (n >= 0) directions_[n].push_back(axis);
    return n >= 0;
  }
  /// Of what other supports of a node leave, too.
  static Matrix free_of(const std::vector<Vec>& held) {
    Matrix free = Matrix::Identity();
    for (const Vec& axis : held) {
      constexpr Real none = 1e-9;
      const Vec left = free * axis;
      if (left.norm() > none) free -= left.normalized() * left.normalized().transpose();
    }
    return free;
  }

  const Deck& deck_;
  const Model& model_;
  World& world_;
  Diagnostics& diagnostics_;
  std::unordered_map<Id, Index> node_of_id_;
  std::map<Index, std::vector<Vec>> directions_;
  std::vector<HeldNode> timed_;
};

const RegisterAddition oblique_supports{
    "*BOUNDARY_SPC along oblique axes or for a time",
    [](const Deck& deck, const Model& model, World& world, Diagnostics& diagnostics) {
      ObliqueReader reader(deck, model, world, diagnostics);
      for (const auto& card : deck.all<BoundarySpcNodeCard>())
        for (std::size_t n = 0; n < model.nodes.size(); ++n)
          if ((card.cid != 0 || holds_for_a_time(card, model.endtim)) && model.nodes[n].id == card.nid)
            reader.add(card, {static_cast<Index>(n)});
      for (const auto& card : deck.all<BoundarySpcSetCard>())
        if (const auto set = model.node_sets.find(card.nid); set != model.node_sets.end())
          reader.add(card, set->second);
      reader.finish();
    }};

}  // namespace

}  // namespace courant
