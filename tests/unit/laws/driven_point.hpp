#pragma once
// A point of a law on a path on which some strains are given and some stresses are 0.
#include <array>
#include <memory>
#include <string>
#include <vector>

#include <Eigen/Dense>

#include "laws/strength/strength.hpp"

namespace courant::test {

struct DrivenPoint {
  explicit DrivenPoint(std::shared_ptr<StrengthLaw> of, bool in_plane = false)
      : law(std::move(of)), plane(in_plane) {
    for (const HistoryVariable& h : law->history()) {
      names.push_back(h.name);
      first.push_back(history.size());
      history.resize(history.size() + static_cast<std::size_t>(h.components), 0.0);
    }
  }
  /// A step by these strains of the tensor, xx yy zz xy yz zx.
  void strain(const std::array<Real, 6>& step) {
    std::array<Real, 6> rate = step;
    for (Real& r : rate) r /= dt;
    std::vector<Real*> kept;
    for (Real& h : history) kept.push_back(&h);
    PointBlock block;
    block.count = 1, block.dt = dt, block.sound_speed = &speed, block.history = kept;
    for (std::size_t k = 0; k < 6; ++k) block.rate[k] = &rate[k], block.stress[k] = &stress[k];
    if (plane)
      law->update_in_plane_stress(block, &rate_zz);
    else
      law->update(block);
  }
  /// The same with the strains `free` such that their stresses are 0 after it; they are returned in the order
  /// of the tensor. Newton's method with differences.
  std::array<Real, 6> strain_with_free(std::array<Real, 6> step, const std::vector<std::size_t>& free) {
    const auto old_stress = stress;
    const auto old_history = history;
    Real size = 0;
    for (const Real s : step) size = std::max(size, std::abs(s));
    const auto left = [&](const std::array<Real, 6>& by) {
      stress = old_stress, history = old_history;
      strain(by);
      Eigen::VectorXd out(static_cast<long>(free.size()));
      for (std::size_t k = 0; k < free.size(); ++k) out[static_cast<long>(k)] = stress[free[k]];
      return out;
    };
    const Real stiffness = law->bulk_modulus() + law->shear_modulus();
    for (int round = 0; round < 40; ++round) {
      const Eigen::VectorXd now = left(step);
      if (now.norm() < 1e-13 * stiffness * size) break;
      Eigen::MatrixXd slope(now.size(), now.size());
      for (std::size_t k = 0; k < free.size(); ++k) {
        std::array<Real, 6> moved = step;
        moved[free[k]] += 1e-6 * size;
        slope.col(static_cast<long>(k)) = (left(moved) - now) / (1e-6 * size);
      }
      Eigen::VectorXd by = slope.fullPivLu().solve(now);
      const std::array<Real, 6> from = step;
      for (int halved = 0; halved < 8; ++halved, by *= 0.5) {  // less where flow begins or ends within it
        for (std::size_t k = 0; k < free.size(); ++k)
          step[free[k]] = from[free[k]] - by[static_cast<long>(k)];
        if (left(step).norm() < now.norm()) break;
      }
    }
    left(step);
    return step;
  }
  Real of(const std::string& name) const {
    for (std::size_t k = 0; k < names.size(); ++k)
      if (names[k] == name) return history[first[k]];
    return std::numeric_limits<Real>::quiet_NaN();
  }

  std::shared_ptr<StrengthLaw> law;
  bool plane;
  std::vector<std::string> names{};
  std::vector<std::size_t> first{};
  std::vector<Real> history{};
  std::array<Real, 6> stress{};
  Real dt = 1, speed = 0, rate_zz = 0;
};

}  // namespace courant::test
