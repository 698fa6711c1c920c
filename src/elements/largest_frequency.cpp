#include "elements/largest_frequency.hpp"

#include <algorithm>
#include <cmath>
#include <random>

namespace courant {

namespace {

Real largest_component(const NodalVector& u) {
  Real most = 0;
  for (const auto& of_axis : u)
    for (const Real a : of_axis) most = std::max(most, std::abs(a));
  return most;
}

}  // namespace

GroupNodes::GroupNodes(const ElementGroup& group, const std::vector<std::array<bool, 3>>& held_in_world,
                       const Nodes& nodes) {
  std::vector<Index> used;
  for (int c = 0; c < group.corners(); ++c)
    used.insert(used.end(), group.node.data(c), group.node.data(c) + group.size());
  std::sort(used.begin(), used.end());
  used.erase(std::unique(used.begin(), used.end()), used.end());
  for (const Index n : used) {
    for (int k = 0; k < 3; ++k) x[static_cast<std::size_t>(k)].push_back(nodes.x.data(k)[n]);
    held.push_back(held_in_world[static_cast<std::size_t>(n)]);
  }
  m.assign(used.size(), 0);
  corner.resize(static_cast<std::size_t>(group.corners()));
  for (int c = 0; c < group.corners(); ++c)
    for (Index e = 0; e < group.size(); ++e) {
      const auto place = std::lower_bound(used.begin(), used.end(), group.node.data(c)[e]) - used.begin();
      corner[static_cast<std::size_t>(c)].push_back(static_cast<Index>(place));
      m[static_cast<std::size_t>(place)] += group.mass[e] * group.share(e, c);
    }
}

void GroupNodes::assemble(const Field<Real>& of_corners, Real factor, NodalVector& sums,
                          std::size_t first) const {
  for (std::size_t k = 0; k < 3; ++k) {
    Real* const to = sums[k].data() + first;
    std::fill(to, to + m.size(), 0);
    for (std::size_t c = 0; c < corner.size(); ++c) {
      const Real* f = of_corners.data(static_cast<int>(3 * c + k));
      for (std::size_t e = 0; e < corner[c].size(); ++e) to[corner[c][e]] += factor * f[e];
    }
  }
}

Real largest_frequency(const std::vector<Real>& m, const std::vector<std::array<bool, 3>>& held, Real size,
                       const std::function<void(const NodalVector& u, NodalVector& Ku)>& stiffness) {
  constexpr int most_rounds = 60;
  constexpr Real close = 1e-3;  // growth of the estimate over five rounds at which it is taken
  const std::size_t n = m.size();
  NodalVector u, Ku;
  std::mt19937 random(1);
  for (std::size_t k = 0; k < 3; ++k) {
    Ku[k].assign(n, 0);
    for (std::size_t i = 0; i < n; ++i) {
      const Real number = static_cast<Real>(random()) / static_cast<Real>(std::mt19937::max()) - 0.5;
      u[k].push_back(m[i] > 0 && !held[i][k] ? number : 0);
    }
  }
  Real estimate = 0, before = 0;
  for (int round = 0; round < most_rounds; ++round) {
    const Real most = largest_component(u);
    if (!(most > 0)) return 0;
    for (auto& of_axis : u)
      for (Real& a : of_axis) a *= size / most;
    stiffness(u, Ku);
    Real old_norm = 0, new_norm = 0;
    for (std::size_t k = 0; k < 3; ++k)
      for (std::size_t i = 0; i < n; ++i) {
        if (!(m[i] > 0) || held[i][k]) continue;
        old_norm += m[i] * u[k][i] * u[k][i];
        u[k][i] = Ku[k][i] / m[i];
        new_norm += m[i] * u[k][i] * u[k][i];
      }
    if (!(old_norm > 0)) return 0;
    estimate = std::sqrt(std::sqrt(new_norm / old_norm));
    if (round % 5 != 4) continue;
    if (estimate < (1 + close) * before) break;
    before = estimate;
  }
  return estimate;
}

Real below_frequency(Real asked, Real step, Real omega) {
  constexpr Real below = 0.97;  // the estimate of omega comes from below
  if (!(omega > 0 && step > 0)) return asked;
  const Real critical = 2 / (omega * step);
  return std::min({asked, asked * critical, below * critical});
}

std::vector<std::array<bool, 3>> held_at_start(const Model& model, const std::vector<Index>& node_of,
                                               const Nodes& nodes) {
  std::vector<std::array<bool, 3>> held(static_cast<std::size_t>(nodes.size()), {false, false, false});
  for (std::size_t k = 0; k < node_of.size(); ++k)
    if (node_of[k] >= 0) held[static_cast<std::size_t>(node_of[k])] = model.nodes[k].fixed;
  return held;
}

}  // namespace courant
