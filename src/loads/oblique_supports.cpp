// *BOUNDARY_SPC along axes of a system of its own that are not the global ones.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <unordered_map>

#include "extension/additions.hpp"
#include "loads/walls/rigid_wall_card.hpp"
#include "model/cards.hpp"
#include "state/reports.hpp"
#include "state/shared_fields.hpp"

namespace courant {

namespace {

/// A node, and the projection onto the directions that it is free along.
struct ObliqueSupport {
  Index node = 0;
  Matrix free = Matrix::Identity();
};

/// Neither force nor velocity along the held directions; what strikes behind the constraints is held, too.
class ObliqueSupports : public Constraint, public Impact, public BoundaryForceReporter {
 public:
  ObliqueSupports(std::vector<ObliqueSupport> supports, World& world) : supports_(std::move(supports)) {
    reaction_.resize(supports_.size(), Vec::Zero());
    for (const ObliqueSupport& s : supports_) world.nodes.v.set(s.node, s.free * world.nodes.v.vec(s.node));
  }
  std::string name() const override { return "nodes held obliquely (SPC)"; }
  const FieldSet& over(const World& world) const override { return world.nodes.fields; }
  void declare(const World& world, Accesses& a) const override {
    a.in_finish().revises(world.nodes.f).updates(world.nodes.v);
  }
  void block(World&, const Clock&, Index, Index) override {}
  void finish(World& world, const Clock&) override {
    std::fill(reaction_.begin(), reaction_.end(), Vec::Zero());
    hold(world);
    for (const ObliqueSupport& s : supports_) world.nodes.v.set(s.node, s.free * world.nodes.v.vec(s.node));
  }
  void strike(World& world, const Clock&) override { hold(world); }
  void report_forces(const World& world, const Clock&, std::vector<BoundaryForce>& out) const override {
    for (std::size_t k = 0; k < supports_.size(); ++k)
      out.push_back(
          {BoundaryForce::Kind::held_point, world.nodes.id[supports_[k].node], reaction_[k], Vec::Zero(), 0});
  }

 private:
  void hold(World& world) {
    for (std::size_t k = 0; k < supports_.size(); ++k) {
      const Vec f = world.nodes.f.vec(supports_[k].node), left = supports_[k].free * f;
      reaction_[k] += left - f;
      world.nodes.f.set(supports_[k].node, left);
    }
  }
  std::vector<ObliqueSupport> supports_;
  std::vector<Vec> reaction_;
};

class ObliqueReader {
 public:
  ObliqueReader(const Deck& deck, const Model& model, World& world, Diagnostics& diagnostics)
      : deck_(deck), model_(model), world_(world), diagnostics_(diagnostics) {
    for (Index n = 0; n < world.nodes.size(); ++n) node_of_id_.emplace(world.nodes.id[n], n);
  }
  void add(const BoundarySpcCard& card, const std::vector<Index>& nodes) {
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
    if (directions_.empty()) return;
    if (!deck_.all<RigidWallPlanar>().empty() || !deck_.all<RigidWallGeometric>().empty())
      diagnostics_.warning(
          {deck_.files[0].name},
          "rigid walls do not know of supports along oblique axes: nodes that are held so may "
          "get behind them",
          "leave such nodes out by NSIDEX");
    std::vector<ObliqueSupport> supports;
    for (const auto& [node, held] : directions_) supports.push_back({node, free_of(held)});
    world_.passes.add(std::make_shared<ObliqueSupports>(std::move(supports), world_));
  }

 private:
  bool hold(const BoundarySpcCard& card, Id id, const Vec& axis) {
    const auto refuse = [&](const char* what, const char* hint) {
      deck_.error(diagnostics_, card, "CID", fmt::format("node {} {}", id, what), hint);
      return false;
    };
    const auto found = node_of_id_.find(id);
    if (found == node_of_id_.end())
      return refuse("is a particle or of no element, which cannot be held along oblique axes",
                    "hold all three translations, or use a system along the global axes");
    const Index n = found->second;
    if (world_.nodes.follow[n] != 0)
      return refuse("goes with a rigid body or a face, and cannot be held along oblique axes",
                    "hold the body by CMO and CON of *MAT_RIGID");
    const auto* driven = shared_fields::prescribed_motion.find(world_.nodes.fields);
    if (driven && (*driven)[n] != 0)
      return refuse("is driven, too, and cannot be held along oblique axes", "drive it along all axes");
    directions_[n].push_back(axis);
    return true;
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
};

const RegisterAddition oblique_supports{
    "*BOUNDARY_SPC along oblique axes",
    [](const Deck& deck, const Model& model, World& world, Diagnostics& diagnostics) {
      ObliqueReader reader(deck, model, world, diagnostics);
      for (const auto& card : deck.all<BoundarySpcNodeCard>())
        for (std::size_t n = 0; n < model.nodes.size(); ++n)
          if (card.cid != 0 && model.nodes[n].id == card.nid) reader.add(card, {static_cast<Index>(n)});
      for (const auto& card : deck.all<BoundarySpcSetCard>())
        if (const auto set = model.node_sets.find(card.nid); set != model.node_sets.end())
          reader.add(card, set->second);
      reader.finish();
    }};

}  // namespace

}  // namespace courant
