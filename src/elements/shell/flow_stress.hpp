#pragma once
#include <algorithm>

#include "laws/point_block.hpp"
#include "parallel/parallel.hpp"

namespace courant {

/// Finds, over the points of a block of shells, the stress at which their sections flow: von Mises stress of
/// the points whose plastic strain grows in a step, the mean over their thickness.
class FlowStress {
 public:
  explicit FlowStress(Index count) : count_(count) {}
  /// Plastic strain of a point before its law, null where the law has none.
  void before(const Real* plastic) {
    plastic_ = plastic;
    if (plastic) std::copy_n(plastic, count_, before_);
  }
  /// The same point behind its law; `share`: of the thickness.
  void after(const PointBlock& points, Real share) {
    if (!plastic_) return;
    const Real *xx = points.stress[0], *yy = points.stress[1], *xy = points.stress[3], *yz = points.stress[4],
               *zx = points.stress[5], *plastic = plastic_;
#pragma omp simd
    for (Index i = 0; i < count_; ++i) {
      const Real flows = plastic[i] > before_[i] ? share : 0;
      share_[i] += flows;
      sum_[i] += flows * std::sqrt(xx[i] * xx[i] + yy[i] * yy[i] - xx[i] * yy[i] +
                                   3 * (xy[i] * xy[i] + yz[i] * yz[i] + zx[i] * zx[i]));
    }
  }
  /// Where nothing flows the stress of the last flow stays.
  void keep(Real* stress) const {
    for (Index i = 0; i < count_; ++i)
      if (share_[i] > 0) stress[i] = sum_[i] / share_[i];
  }

 private:
  Index count_;
  const Real* plastic_ = nullptr;
  Real before_[block_size], share_[block_size] = {}, sum_[block_size] = {};
};

}  // namespace courant
