#include "elements/node_inertias.hpp"

#include <fmt/format.h>

#include <cmath>
#include <limits>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include <Eigen/Eigenvalues>

#include "base/rotation.hpp"
#include "elements/nodal_rotations.hpp"
#include "state/reports.hpp"
#include "state/restartable.hpp"
#include "state/shared_fields.hpp"

namespace courant {

namespace {

constexpr Real round_off = 1e-12;

/// All that cards give a node: the least principal moment about all axes, and what there is beyond.
struct InertiaOfNode {
  Matrix J = Matrix::Zero();
  const ModelInertia* first = nullptr;
  Real least() const {
    const Eigen::SelfAdjointEigenSolver<Matrix> own(J);
    return std::max(Real(0), own.eigenvalues()[0]);
  }
  Matrix beyond() const { return J - least() * Matrix::Identity(); }
  bool same_about_all() const { return beyond().norm() <= round_off * J.norm(); }
};

/// By node of the world that no rigid body moves.
std::map<Index, std::vector<const ModelInertia*>> inertias_beside_bodies(const Model& model,
                                                                         const World& world) {
  std::map<Id, std::vector<const ModelInertia*>> of_id;
  for (const ModelInertia& one : model.inertias)
    of_id[model.nodes[static_cast<std::size_t>(one.node)].id].push_back(&one);
  std::map<Index, std::vector<const ModelInertia*>> out;
  for (Index n = 0; n < world.nodes.size() && !of_id.empty(); ++n)
    if (const auto found = of_id.find(world.nodes.id[n]); found != of_id.end() && world.nodes.follow[n] != 1)
      out[n] = found->second;
  return out;
}

/// Of those that turn.
std::map<Index, InertiaOfNode> inertias_of_nodes(const Model& model, const World& world) {
  std::map<Index, InertiaOfNode> out;
  for (const auto& [n, all] : inertias_beside_bodies(model, world))
    for (const ModelInertia* one : all) {
      if (!one->turns()) continue;
      InertiaOfNode& node = out[n];
      node.J += one->J;
      if (!node.first) node.first = one;
    }
  return out;
}

/// L = J omega along the axes that nothing holds; along the others omega is 0.
Vec turning(Matrix J, Vec L, Index held) {
  for (int k = 0; k < 3; ++k) {
    if (!(held & (1 << k))) continue;
    J.row(k).setZero(), J.col(k).setZero();
    J(k, k) = 1, L[k] = 0;
  }
  return J.inverse() * L;
}

struct Top {
  Index node = 0;
  Matrix J0 = Matrix::Zero();  ///< beyond the rotary inertia, as it was at t = 0, global axes [ML2]
  /// Orientation at the last time level, and in the middle of the step that led there.
  Eigen::Quaterniond q = Eigen::Quaterniond::Identity(), middle = q;
};

/// Moments of nodes are changed to those under which a body with the rotary inertia of the node, the same
/// about all axes, turns as the node does: so all that deals with rotations of nodes need not know. L of
/// t^{n+1/2} is L of t^{n-1/2} + M dt, and its omega belongs to the orientation in the middle of the step
/// (implicit midpoint rule): |L| is kept exactly where nothing acts.
class InertiaTensors : public Impact, public TimeLimit, public EnergyTerm, public Restartable {
 public:
  InertiaTensors(std::vector<Top> tops, World& world)
      : tops_(std::move(tops)),
        nodes_(world.nodes.fields),
        held_(shared_fields::held_rotations.add(world.nodes.fields)),
        kinetic_(tops_.size(), 0),
        half_step_(tops_.size(), 0),
        below_(tops_.size(), 0) {}
  std::string name() const override { return "inertia of nodes"; }

  void strike(World& world, const Clock& clock) override {
    Field<Real>* support = shared_fields::support_moment.find(world.nodes.fields);
    for (std::size_t k = 0; k < tops_.size(); ++k) {
      Top& top = tops_[k];
      const Index n = top.node, held = held_[n];
      const Vec omega = nodes_.speed.vec(n), M = nodes_.moment.vec(n);
      if (clock.cycle != cycle_)
        top.middle = turned_by(0.5 * clock.dt_old * omega, top.q),
        top.q = turned_by(clock.dt_old * omega, top.q);
      const Vec L = inertia(top, top.middle) * omega, after = L + clock.dt_mean() * M;
      Vec next = turning(inertia(top, top.q), after, held);
      for (int it = 0; it < most_iterations; ++it) {
        const Vec better = turning(inertia(top, turned_by(0.5 * clock.dt * next, top.q)), after, held);
        const bool done = (better - next).norm() <= 1e-15 * better.norm();
        next = better;
        if (done) break;
      }
      const Vec as_if = nodes_.inertia[n] / clock.dt_mean() * (next - omega);
      note_energies(k, clock, omega, L, M, as_if);
      if (support && held != 0) add_reaction(top, clock, L, next, held, *support);
      nodes_.moment.set(n, as_if);
    }
    cycle_ = clock.cycle;
  }

  bool rings() const override { return false; }
  /// A fifth of a radian a step: the energy then is right to 0.1 %, and the iteration comes to its end.
  Limit limit(const World& world, const Clock&) override {
    constexpr Real largest_turn = 0.2;
    Real most = 0;
    Index whose = 0;
    for (const Top& top : tops_)
      if (const Real speed = nodes_.speed.vec(top.node).norm(); speed > most) most = speed, whose = top.node;
    return {most > 0 ? largest_turn / most : std::numeric_limits<Real>::infinity(),
            fmt::format("node {} (turning)", world.nodes.id[whose])};
  }

  void record(World&, const Clock& clock, EnergyLedger& ledger) override {
    if (clock.cycle != 0) return;
    for (const Real below : below_) ledger.below_at_start += below;
  }
  void sample(const World&, const Clock&, EnergyLedger& ledger) const override {
    for (std::size_t k = 0; k < tops_.size(); ++k)
      ledger.kinetic += kinetic_[k], ledger.half_step += half_step_[k], ledger.below += below_[k];
  }

  void keep(Archive& archive) override {
    for (std::size_t k = 0; k < tops_.size(); ++k) {
      const Archive::Group inside(archive, "node " + std::to_string(tops_[k].node));
      archive.rows("q", std::vector<Real*>{tops_[k].q.coeffs().data()}, 4);
      archive.rows("middle", std::vector<Real*>{tops_[k].middle.coeffs().data()}, 4);
    }
    archive("cycle", cycle_);
  }

 private:
  static constexpr int most_iterations = 20;

  Matrix inertia(const Top& top, const Eigen::Quaterniond& q) const {
    const Matrix R = q.toRotationMatrix();
    return R * top.J0 * R.transpose() + nodes_.inertia[top.node] * Matrix::Identity();
  }

  /// What the energies are beyond those of a body with the rotary inertia of the node alone.
  void note_energies(std::size_t k, const Clock& clock, const Vec& omega, const Vec& L, const Vec& M,
                     const Vec& as_if) {
    const Top& top = tops_[k];
    const Real half = 0.5 * clock.dt_old, I = nodes_.inertia[top.node];
    kinetic_[k] = 0.5 * omega.dot(L - I * omega);
    const Vec now = L + half * M;
    const Real at_t = 0.5 * now.dot(turning(inertia(top, top.q), now, held_[top.node]));
    const Real told = half * as_if.dot(omega + 0.5 * half / I * as_if);
    half_step_[k] = at_t - 0.5 * omega.dot(L) - told;
    const Real dt = clock.cycle == 0 ? clock.dt : clock.dt_old;
    below_[k] =
        0.125 * dt * dt * (M.dot(turning(inertia(top, top.q), M, held_[top.node])) - as_if.squaredNorm() / I);
  }

  /// What holds an axis turns L about it, too: J omega is not along omega.
  void add_reaction(const Top& top, const Clock& clock, const Vec& L, const Vec& next, Index held,
                    Field<Real>& support) const {
    const Vec change = (inertia(top, turned_by(0.5 * clock.dt * next, top.q)) * next - L) / clock.dt_mean();
    for (int k = 0; k < 3; ++k)
      if (held & (1 << k)) support.data(k)[top.node] += change[k];
  }

  std::vector<Top> tops_;
  NodalRotations nodes_;
  const Field<Index>& held_;
  std::vector<Real> kinetic_, half_step_, below_;  ///< beyond those that KineticEnergy tells [ML2/T2]
  std::int64_t cycle_ = -1;                        ///< whose orientation q is
};

}  // namespace

void add_rotary_inertias(const Deck& deck, const Model& model, World& world, Diagnostics& diagnostics) {
  if (!diagnostics.ok()) return;
  for (const auto& [n, all] : inertias_beside_bodies(model, world))
    for (const ModelInertia* one : all)
      if (one->offset.norm() > 0)
        deck.error(diagnostics, one->card, "X-OFF",
                   fmt::format("an offset is not supported on node {}, which belongs to no rigid body",
                               world.nodes.id[n]),
                   "put the mass at a node of its own, in one *CONSTRAINED_NODAL_RIGID_BODY with this one");
  for (const auto& [n, node] : inertias_of_nodes(model, world)) {
    const Entry& card = node.first->card;
    if (world.dim == 2)
      return deck.error(diagnostics, card, "NID", "inertia of nodes is not supported in plane scenes",
                        "leave IXX to IZZ 0: then it is a mass");
    Real& inertia = (*shared_fields::rotary_inertia.find(world.nodes.fields))[n];
    const Real least = node.least();
    if (!(inertia + least > round_off * node.J.norm()))
      deck.error(
          diagnostics, card, "IXX",
          fmt::format("node {} has no inertia about an axis about which it may turn", world.nodes.id[n]),
          "give it three principal moments > 0");
    inertia += least;
  }
}

void add_inertia_tensors(const Deck& deck, const Model& model, bool damped, World& world,
                         Diagnostics& diagnostics) {
  std::vector<Top> tops;
  const Field<Index>* driven = shared_fields::prescribed_rotation.find(world.nodes.fields);
  const Field<Index>* none = shared_fields::no_rotation.find(world.nodes.fields);
  for (const auto& [n, node] : inertias_of_nodes(model, world)) {
    if (node.same_about_all()) continue;
    const auto refuse = [&, n = n, &node = node](const char* what) {
      deck.error(diagnostics, node.first->card, "IXX",
                 fmt::format("moments that differ are not supported on node {}, {}", world.nodes.id[n], what),
                 "give it the same about all axes, or put it on a rigid body");
    };
    if (driven && (*driven)[n] != 0) refuse("whose rotation is prescribed");
    if (world.nodes.follow[n] != 0 || (*none)[n] != 0) refuse("which is tied");
    if (damped) refuse("in a deck with damping");
    tops.push_back({n, node.beyond()});
  }
  if (!tops.empty()) world.passes.add(std::make_shared<InertiaTensors>(std::move(tops), world));
}

}  // namespace courant
