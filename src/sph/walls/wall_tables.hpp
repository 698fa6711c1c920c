#pragma once
// Integrals of a kernel over walls, in tables.
#include <cmath>
#include <vector>

#include "sph/kernel/kernel_choice.hpp"

namespace courant {

/// What a kernel of h = 1 gives at distance R, in tables.
class WallTables {
 public:
  WallTables(KernelChoice kernel, int dim)
      : kernel_(n + 1), slope_(n + 1), tail_(n + 1), plane_(n + 1), behind_(n + 1) {
    with_kernel(kernel, [&](auto k) {
      using Kernel = decltype(k);
      const auto theta = [&](Real R) { return Kernel::C(dim) * Kernel::shape(R); };
      support_ = Kernel::support;
      const Real step = support_ / n;
      for (int i = n; i >= 0; --i) {
        kernel_[i] = theta(i * step);
        slope_[i] = Kernel::C(dim) * Kernel::slope(i * step);
        if (i == n) continue;
        const Real s = (i + 0.5) * step;
        tail_[i] = tail_[i + 1] + theta(s) * (dim == 3 ? s * s : s) * step;
        // dS = 2 pi s ds on a plane; on a line the middle of each interval of t, s^2 = R^2 + t^2
        const Real R = i * step, most = std::sqrt(support_ * support_ - R * R);
        plane_[i] = dim == 3 ? plane_[i + 1] + 2 * pi * theta(s) * s * step : 0;
        for (int t = 0; dim == 2 && t < 200; ++t)
          plane_[i] += 2 * theta(std::hypot(R, most * (t + 0.5) / 200)) * most / 200;
        behind_[i] = behind_[i + 1] + 0.5 * (plane_[i] + plane_[i + 1]) * step;
      }
    });
  }
  Real support() const { return support_; }
  Real kernel(Real R) const { return at(kernel_, R); }
  Real slope(Real R) const { return at(slope_, R); }  ///< dW/dR
  /// int_R W s^(dim-1) ds
  Real tail(Real R) const { return at(tail_, R); }
  /// int W dS over a plane (2D: line) at distance R
  Real plane(Real R) const { return at(plane_, R); }
  /// int W dV behind it
  Real behind(Real R) const { return at(behind_, R); }

 private:
  static constexpr int n = 2000;
  Real at(const std::vector<Real>& table, Real R) const {
    const Real place = R / support_ * n;
    if (!(place < n)) return 0;
    const int i = static_cast<int>(place);
    return table[i] + (place - i) * (table[i + 1] - table[i]);
  }
  Real support_ = 2;
  std::vector<Real> kernel_, slope_, tail_, plane_, behind_;
};

}  // namespace courant
