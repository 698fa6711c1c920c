// How nodes that are tied exactly start: masses and velocities of the corners of their faces.
#include <algorithm>
#include <array>
#include <map>

#include "base/eigenvalues.hpp"
#include "contact/tied/constraint.hpp"
#include "contact/tied/turning.hpp"
#include "state/tied_mass.hpp"

namespace courant {

namespace {

/// Velocities, or angular velocities, with which ties of some weight start.
struct StartField {
  Field<Real>& v;
  Field<Real>& weight;  ///< mass, or rotary inertia
  std::vector<std::size_t> ties;
  bool turns = false;
};

Vec velocity_at(const StartField& start, const Tie& tie, const World& world, const Field<Real>& v) {
  return start.turns ? mean_of(tie.at, v) : velocity_of(tie.at, world.nodes.x, v);
}
std::array<Vec, 4> given_to(const StartField& start, const Tie& tie, const World& world, const Vec& value) {
  if (!start.turns) return on_corners(tie.at, world.nodes.x, value);
  std::array<Vec, 4> out{};
  for (std::size_t e = 0; e < 4; ++e) out[e] = tie.at.N[e] * value;
  return out;
}

/// The velocities of corners that are nearest to those that all have: sum m |change|^2 is least, as in a
/// plastic impact, and momenta are kept; what supports hold stays at rest. By conjugate gradients:
///   (m + sum_s B_s^T m_s B_s) change = sum_s B_s^T m_s (v_s - B_s v).
class JoinedStart {
 public:
  JoinedStart(const TiedConstraint& tied, const HeldAxes& held, const StartField& start, World& world)
      : tied_(tied), start_(start), world_(world) {
    std::vector<Real> stiffest;
    for (const std::size_t t : start.ties) {
      const Tie& tie = tied.ties[t];
      const std::array<Real, 4> share = mass_shares(tie.at), most = largest_shares(tie.at, world.nodes.x);
      for (std::size_t e = 0; e < static_cast<std::size_t>(tie.at.corners); ++e) {
        const Index n = tie.at.node[e];
        const auto [at, is_new] = place_.try_emplace(n, nodes_.size());
        if (is_new) {
          nodes_.push_back(n), added_.push_back(0), stiffest.push_back(start.weight[n]);
          held_.push_back(held(n, start.turns));
        }
        if (!tied.on_body[t]) added_[at->second] += share[e] * start.weight[tie.node];
        stiffest[at->second] += most[e] * most[e] * start.weight[tie.node];
      }
    }
    for (const Real one : stiffest) inverse_.push_back(one > 0 ? 1 / one : 0);
  }

  TiedStart join() {
    TiedStart out;
    for (std::size_t k = 0; k < nodes_.size(); ++k) start_.v.set(nodes_[k], free(k, start_.v.vec(nodes_[k])));
    out.before = energy();
    solve();
    for (const std::size_t t : start_.ties) {
      const Tie& tie = tied_.ties[t];
      start_.v.set(tie.node, velocity_at(start_, tie, world_, start_.v));
    }
    out.after = energy();
    for (std::size_t k = 0; k < nodes_.size(); ++k) start_.weight[nodes_[k]] += added_[k];
    if (start_.turns) return out;
    Field<Real>& carried = shared_fields::tied_mass.add(world_.nodes.fields);
    for (std::size_t k = 0; k < nodes_.size(); ++k) carried[nodes_[k]] += added_[k];
    for (const std::size_t t : start_.ties) {  // which bodies weigh
      const Tie& tie = tied_.ties[t];
      const std::array<Real, 4> share = mass_shares(tie.at);
      for (std::size_t e = 0; e < static_cast<std::size_t>(tie.at.corners); ++e)
        if (world_.nodes.follow[tie.at.node[e]] == 1) carried[tie.node] += share[e] * start_.weight[tie.node];
    }
    return out;
  }

 private:
  using Vecs = std::vector<Vec>;

  Vec free(std::size_t k, Vec value) const {
    for (std::size_t a = 0; a < 3; ++a)
      if (held_[k][a]) value[static_cast<Eigen::Index>(a)] = 0;
    return value;
  }
  /// Kinetic energy of corners and tied nodes.
  Real energy() const {
    Real out = 0;
    const auto add = [&](Index n) { out += 0.5 * start_.weight[n] * start_.v.vec(n).squaredNorm(); };
    for (const Index n : nodes_) add(n);
    for (const std::size_t t : start_.ties) add(tied_.ties[t].node);
    return out;
  }
  /// B^T m of something that the tied nodes have.
  template <class OfTie>
  void gather(const OfTie& value, Vecs& to) const {
    for (const std::size_t t : start_.ties) {
      const Tie& tie = tied_.ties[t];
      const std::array<Vec, 4> on = given_to(start_, tie, world_, start_.weight[tie.node] * Vec(value(tie)));
      for (std::size_t e = 0; e < static_cast<std::size_t>(tie.at.corners); ++e)
        to[place_.at(tie.at.node[e])] += on[e];
    }
    for (std::size_t k = 0; k < to.size(); ++k) to[k] = inverse_[k] > 0 ? free(k, to[k]) : Vec(Vec::Zero());
  }
  static Real dot(const Vecs& a, const Vecs& b) {
    Real out = 0;
    for (std::size_t k = 0; k < a.size(); ++k) out += a[k].dot(b[k]);
    return out;
  }
  Vecs conditioned(const Vecs& r) const {
    Vecs out(r.size());
    for (std::size_t k = 0; k < r.size(); ++k) out[k] = inverse_[k] * r[k];
    return out;
  }

  void solve() {
    FieldSet scratch("start");
    Field<Real>& of_corner = scratch.add<Real>({.name = "v", .dimension = "-", .components = 3});
    scratch.resize(world_.nodes.size());
    const auto times = [&](const Vecs& p) {
      Vecs out(p.size());
      for (std::size_t k = 0; k < p.size(); ++k)
        out[k] = start_.weight[nodes_[k]] * p[k], of_corner.set(nodes_[k], p[k]);
      gather([&](const Tie& tie) { return velocity_at(start_, tie, world_, of_corner); }, out);
      return out;
    };
    Vecs change(nodes_.size(), Vec::Zero()), r(nodes_.size(), Vec::Zero());
    gather(
        [&](const Tie& tie) -> Vec {
          return start_.v.vec(tie.node) - velocity_at(start_, tie, world_, start_.v);
        },
        r);
    Vecs z = conditioned(r), p = z;
    Real rz = dot(r, z);
    constexpr Real enough = 1e-15;
    const Real first = rz;
    for (std::size_t it = 0; it < 20 * nodes_.size() + 20 && rz > enough * enough * first; ++it) {
      const Vecs q = times(p);
      const Real step = rz / dot(p, q);
      for (std::size_t k = 0; k < p.size(); ++k) change[k] += step * p[k], r[k] -= step * q[k];
      z = conditioned(r);
      const Real now = dot(r, z);
      for (std::size_t k = 0; k < p.size(); ++k) p[k] = z[k] + now / rz * p[k];
      rz = now;
    }
    for (std::size_t k = 0; k < nodes_.size(); ++k) start_.v.add(nodes_[k], change[k]);
  }

  const TiedConstraint& tied_;
  const StartField& start_;
  World& world_;
  std::map<Index, std::size_t> place_;
  std::vector<Index> nodes_;   ///< corners
  std::vector<Real> added_;    ///< weight that each gets
  std::vector<Real> inverse_;  ///< of about its weight in the equations; 0: it has none
  std::vector<std::array<bool, 3>> held_;
};

/// B m_s B^T of a tie over the weights of its corners: no energy of the node is above that of the weights
/// where no eigenvalue is above 1.
class GapInertia {
 public:
  GapInertia(const TiedConstraint& tied, const HeldAxes& held, const World& world)
      : tied_(tied), held_(held), world_(world) {
    for (const Tie& tie : tied.ties)
      for (int e = 0; e < tie.at.corners; ++e) ++ties_of_[tie.at.node[static_cast<std::size_t>(e)]];
  }
  /// Whether node's energies are below `most` times what the corners have for them, and of their own.
  bool is_below(const Tie& tie, Real most) const {
    const Real m = world_.nodes.m[tie.node];
    std::array<std::array<Vec, 4>, 3> on;  // forces on corners of unit ones at the node
    for (std::size_t k = 0; k < 3; ++k)
      on[k] = on_corners(tie.at, world_.nodes.x, Vec::Unit(static_cast<Eigen::Index>(k)));
    const std::array<Real, 4> share = mass_shares(tie.at);
    Matrix sum = Matrix::Zero();
    for (std::size_t e = 0; e < static_cast<std::size_t>(tie.at.corners); ++e) {
      const Index n = tie.at.node[e];
      const std::array<bool, 3> held = held_(n, false);
      if (held[0] && held[1] && held[2]) continue;
      const Real weight = most * share[e] * m + (most - 1) * world_.nodes.m[n] / ties_of_.at(n);
      Matrix one;
      for (std::size_t k = 0; k < 3; ++k)
        for (std::size_t l = 0; l < 3; ++l)
          one(static_cast<Eigen::Index>(k), static_cast<Eigen::Index>(l)) = on[k][e].dot(on[l][e]);
      if (one.trace() == 0) continue;
      if (!(weight > 0)) return false;
      sum += m / weight * one;
    }
    return -least_eigenvalue(Matrix(-sum)) <= 1 + 1e-6;
  }

 private:
  const TiedConstraint& tied_;
  const HeldAxes& held_;
  const World& world_;
  std::map<Index, Real> ties_of_;
};

}  // namespace

bool can_be_released(const Tie& tie, const World& world) {
  return std::all_of(tie.at.node.begin(), tie.at.node.end(),
                     [&](Index n) { return world.nodes.follow[n] != 1; });
}

bool weighs_where_it_is(const Tie& tie, const World& world) {
  constexpr Real none = 1e-9;  // of the width of the face
  Vec low = world.nodes.x.vec(tie.at.node[0]), high = low;
  for (const Index n : tie.at.node) {
    if (world.nodes.follow[n] != 0) return false;
    low = low.cwiseMin(world.nodes.x.vec(n)), high = high.cwiseMax(world.nodes.x.vec(n));
  }
  const bool at_corner = *std::max_element(tie.at.N.begin(), tie.at.N.end()) > 1 - none;
  return !at_corner || std::abs(tie.at.gap) > none * (high - low).norm();
}

Real growth_of_frequencies(const TiedConstraint& tied, const HeldAxes& held, const World& world) {
  const GapInertia inertia(tied, held, world);
  constexpr Real most = 1e8, enough = 1e-3;
  Real out = 1;
  for (std::size_t t = 0; t < tied.ties.size(); ++t) {
    const Tie& tie = tied.ties[t];
    if (tied.on_body[t] || weighs_where_it_is(tie, world)) continue;
    if (!(world.nodes.m[tie.node] > 0) || inertia.is_below(tie, out)) continue;
    Real low = out, high = 2 * out;
    while (high < most && !inertia.is_below(tie, high)) low = high, high *= 2;
    while (high - low > enough * low) {
      const Real middle = 0.5 * (low + high);
      (inertia.is_below(tie, middle) ? high : low) = middle;
    }
    out = high;
  }
  return std::sqrt(out);
}

TiedStart start_constraint(const TiedConstraint& tied, const HeldAxes& held, World& world) {
  Nodes& nodes = world.nodes;
  const TurningFields turning(tied, world);
  StartField moving{nodes.v, nodes.m, {}, false};
  std::vector<std::size_t> that_turn;
  for (std::size_t t = 0; t < tied.ties.size(); ++t) {
    nodes.follow[tied.ties[t].node] = 2;  // not 1: no rigid body moves it
    moving.ties.push_back(t);
    if (turning && tied.turns[t]) (*turning.none)[tied.ties[t].node] = 1, that_turn.push_back(t);
  }
  TiedStart out = JoinedStart(tied, held, moving, world).join();
  if (that_turn.empty()) return out;
  const StartField turned{*turning.speed, *turning.inertia, that_turn, true};
  const TiedStart of_turns = JoinedStart(tied, held, turned, world).join();
  return {out.before + of_turns.before, out.after + of_turns.after};
}

}  // namespace courant
