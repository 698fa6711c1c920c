#include "elements/largest_frequency.hpp"

#include <Eigen/Eigenvalues>

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
  for (int c = 0; c < group.corners(); ++c)
    used_.insert(used_.end(), group.node.data(c), group.node.data(c) + group.size());
  std::sort(used_.begin(), used_.end());
  used_.erase(std::unique(used_.begin(), used_.end()), used_.end());
  for (const Index n : used_) {
    for (int k = 0; k < 3; ++k) x[static_cast<std::size_t>(k)].push_back(nodes.x.data(k)[n]);
    held.push_back(held_in_world[static_cast<std::size_t>(n)]);
  }
  m.assign(used_.size(), 0);
  corner.resize(static_cast<std::size_t>(group.corners()));
  for (int c = 0; c < group.corners(); ++c)
    for (Index e = 0; e < group.size(); ++e) {
      const auto place = std::lower_bound(used_.begin(), used_.end(), group.node.data(c)[e]) - used_.begin();
      corner[static_cast<std::size_t>(c)].push_back(static_cast<Index>(place));
      m[static_cast<std::size_t>(place)] += group.mass[e] * group.share(e, c);
    }
}

void GroupNodes::assemble(const Field<Real>& of_blocks, const std::vector<Index>& place_node, Real factor,
                          NodalVector& sums, std::size_t first) const {
  for (std::size_t k = 0; k < 3; ++k) {
    Real* const to = sums[k].data() + first;
    std::fill(to, to + m.size(), 0);
    const Real* f = of_blocks.data(static_cast<int>(k));
    for (std::size_t p = 0; p < place_node.size(); ++p) to[place_node[p]] += factor * f[p];
  }
}

std::vector<Index> GroupNodes::nodes_of_places(const BlockSums& sums) const {
  std::vector<Index> out;
  out.reserve(sums.nodes().size());
  for (const Index n : sums.nodes())
    out.push_back(static_cast<Index>(std::lower_bound(used_.begin(), used_.end(), n) - used_.begin()));
  return out;
}

void GroupNodes::assemble(const Field<Real>& of_corners, Real factor, NodalVector& sums) const {
  for (std::size_t k = 0; k < 3; ++k) {
    Real* const to = sums[k].data();
    std::fill(to, to + m.size(), 0);
    for (std::size_t c = 0; c < corner.size(); ++c) {
      const Real* f = of_corners.data(static_cast<int>(3 * c + k));
      for (std::size_t e = 0; e < corner[c].size(); ++e) to[corner[c][e]] += factor * f[e];
    }
  }
}

namespace {

/// What K does to vectors of nodes that move, in the inner product of their masses: M^-1 K.
class MassScaledStiffness {
 public:
  MassScaledStiffness(const std::vector<Real>& m, const std::vector<std::array<bool, 3>>& held, Real size,
                      const std::function<void(const NodalVector& u, NodalVector& Ku)>& stiffness)
      : m_(m), held_(held), size_(size), stiffness_(stiffness) {}

  bool moves(std::size_t i, std::size_t k) const { return m_[i] > 0 && !held_[i][k]; }
  Real product(const NodalVector& a, const NodalVector& b) const {
    Real sum = 0;
    for (std::size_t k = 0; k < 3; ++k)
      for (std::size_t i = 0; i < m_.size(); ++i) sum += m_[i] * a[k][i] * b[k][i];
    return sum;
  }
  /// out = M^-1 K u - b v; `scratch` is of the same size.
  void apply(const NodalVector& u, Real b, const NodalVector& v, NodalVector& scratch,
             NodalVector& out) const {
    const Real scale = size_ / largest_component(u);
    for (std::size_t k = 0; k < 3; ++k)
      for (std::size_t i = 0; i < m_.size(); ++i) scratch[k][i] = scale * u[k][i];
    stiffness_(scratch, out);
    for (std::size_t k = 0; k < 3; ++k)
      for (std::size_t i = 0; i < m_.size(); ++i)
        out[k][i] = moves(i, k) ? out[k][i] / (scale * m_[i]) - b * v[k][i] : 0;
  }

 private:
  const std::vector<Real>& m_;
  const std::vector<std::array<bool, 3>>& held_;
  Real size_;
  const std::function<void(const NodalVector& u, NodalVector& Ku)>& stiffness_;
};

void add_to(NodalVector& to, Real factor, const NodalVector& of) {
  for (std::size_t k = 0; k < 3; ++k)
    for (std::size_t i = 0; i < to[k].size(); ++i) to[k][i] += factor * of[k][i];
}

}  // namespace

// Lanczos' recurrence: the largest eigenvalue of the small tridiagonal matrix grows towards that of M^-1 K.
Real largest_frequency(const std::vector<Real>& m, const std::vector<std::array<bool, 3>>& held, Real size,
                       const std::function<void(const NodalVector& u, NodalVector& Ku)>& stiffness) {
  constexpr Eigen::Index most_rounds = 40, looked_back = 3;
  constexpr Real close = 1e-3;  // growth of the estimate over three rounds at which it is taken
  const MassScaledStiffness A(m, held, size, stiffness);
  NodalVector before, u, next, scratch;
  std::mt19937 random(1);
  for (std::size_t k = 0; k < 3; ++k) {
    for (NodalVector* v : {&before, &next, &scratch}) (*v)[k].assign(m.size(), 0);
    for (std::size_t i = 0; i < m.size(); ++i) {
      const Real number = static_cast<Real>(random()) / static_cast<Real>(std::mt19937::max()) - 0.5;
      u[k].push_back(A.moves(i, k) ? number : 0);
    }
  }
  std::vector<Real> diagonal, beside, estimates{0};
  Real beta = std::sqrt(A.product(u, u)), first = beta;
  for (Eigen::Index round = 1; round <= most_rounds && beta > 1e-12 * first; ++round) {
    for (auto& of_axis : u)
      for (Real& a : of_axis) a /= beta;
    A.apply(u, diagonal.empty() ? 0 : beta, before, scratch, next);
    diagonal.push_back(A.product(next, u));
    add_to(next, -diagonal.back(), u);
    std::swap(before, u), std::swap(u, next);
    beta = std::sqrt(A.product(u, u));
    if (round == 1) first = std::max(std::abs(diagonal.front()), beta);
    Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> small;
    small.computeFromTridiagonal(Eigen::Map<Eigen::VectorXd>(diagonal.data(), round),
                                 Eigen::Map<Eigen::VectorXd>(beside.data(), round - 1),
                                 Eigen::EigenvaluesOnly);
    estimates.push_back(std::sqrt(std::max(Real(0), small.eigenvalues()[round - 1])));
    beside.push_back(beta);
    if (round > looked_back && !(estimates.back() >= (1 + close) * *(estimates.end() - 1 - looked_back)))
      break;
  }
  return estimates.back();
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
