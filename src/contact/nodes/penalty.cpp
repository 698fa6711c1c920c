#include "contact/nodes/penalty.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace courant {

Vec friction_of(const Friction& mu, const Vec& old, const Vec& n, const Vec& v, Real k_dt, Real fn,
                Real area) {
  const Vec turned = old - old.dot(n) * n;
  const Real size = turned.norm();
  const Vec before = size > 0 ? Vec(turned * (old.norm() / size)) : Vec(Vec::Zero());
  const Vec slip = v - v.dot(n) * n;
  const Vec trial = before - k_dt * slip;
  const Real most = mu.most(slip.norm(), fn, area);
  const Real asked = trial.norm();
  return asked > most ? Vec(trial * (most / asked)) : trial;
}

// Where springs k_t act on nodes with shares b_tn, no frequency is above max_n (sum_t k_t |b_tn| sum_j
// |b_tj|) / m_n (Gershgorin). Elements leave 1 - TSSFAC^2 of the square of a stable step to others.
TimeLimit::Limit limit_of(const NodeContactLaw& law, const StiffestContact& stiffest, Real due, Real part,
                          const std::string& name, const World& world) {
  constexpr Real most_of_elements = 0.95;  // else nothing would be left
  const Real s = std::min(law.tssfac, most_of_elements), xi = 0.02 * law.vdc;
  const Real resolved = std::min(law.tssfac, Real(0.9));  // omega dt, else bounces are too coarse
  const auto allowed = [&](Real omega2) {
    const Real stable = 2 * std::sqrt(part * (1 - s * s)) * (std::sqrt(1 + xi * xi) - xi);
    return std::min(stable, resolved) / std::sqrt(omega2);
  };
  const auto told = [&](Real dt, Index node) {
    return TimeLimit::Limit{dt, fmt::format("{} (node {})", name, world.nodes.id[node])};
  };
  const ContactFrequency &now = stiffest.now, &soon = stiffest.soon;
  const Real dt = now.omega2 > 0 ? allowed(now.omega2) : std::numeric_limits<Real>::infinity();
  // up to the surface but for a short step or two, so that none that is long leads behind it; forces may let
  // the node come sooner
  constexpr Real sure = 0.9;
  if (const Real step = allowed(soon.omega2); soon.omega2 > now.omega2)
    if (const Real then = std::max(sure * due - step, step); then < dt) return told(then, soon.node);
  return now.omega2 > 0 ? told(dt, now.node) : TimeLimit::Limit{dt, name};
}

Vec middle_velocity(const World& world, const WallBodies& bodies, const Clock& clock,
                    const DrivenPoints& driven, Index n) {
  const Nodes& nodes = world.nodes;
  const Vec v = nodes.v.vec(n);
  if (nodes.held[n]) return v;
  if (const Index body = bodies.body(n); body >= 0 && !driven.any(n))
    return v + 0.5 * bodies.change(body, nodes.x.vec(n), clock);
  return driven.velocity_after(n, v, 0.5 * clock.dt_mean() / nodes.m[n] * nodes.f.vec(n), 0.5);
}

}  // namespace courant
