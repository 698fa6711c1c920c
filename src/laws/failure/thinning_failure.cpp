#include "laws/failure/thinning_failure.hpp"

#include <algorithm>
#include <cmath>

#include "laws/failure/failing_law.hpp"

namespace courant {

namespace {

/// Keeps the strain beside what the law keeps.
class ThinningFailure : public FailingLaw {
 public:
  ThinningFailure(std::shared_ptr<StrengthLaw> of, const ThinningLimits& limits)
      : FailingLaw(std::move(of), {{"strain", "-", 6}}), limits_(limits) {}

  /// In solids thickness has no meaning: only the law's own limit counts.
  void update(const PointBlock& block) const override {
    of_->update(of_law(block));
    for (Index i = 0; i < block.count; ++i) raise(block, i, plastic_share(block, i));
  }
  void update_in_plane_stress(const PointBlock& block, Real* rate_zz) const override {
    of_->update_in_plane_stress(of_law(block), rate_zz);
    if (!(block.dt > 0)) return;
    Real* const* strain = block.history.data() + kept_;
    for (std::size_t k = 0; k < 6; ++k) {
      const Real* rate = k == 2 ? rate_zz : block.rate[k];
#pragma omp simd
      for (Index i = 0; i < block.count; ++i) strain[k][i] += block.dt * rate[i];
    }
    const Real *xx = strain[0], *yy = strain[1], *zz = strain[2], *xy = strain[3],
               *plastic = block.history[0];
    const Real per_thinning = 1 / limits_.thinning, per_major = 1 / limits_.major,
               per_plastic = 1 / of_->failure_limit();
    Real* ratio = block.history[kept_ + 6];
#pragma omp simd
    for (Index i = 0; i < block.count; ++i) {
      const Real half = 0.5 * (xx[i] - yy[i]),
                 major = 0.5 * (xx[i] + yy[i]) + std::sqrt(half * half + xy[i] * xy[i]);
      const Real thinned = -zz[i] * per_thinning, drawn = major * per_major, flown = plastic[i] * per_plastic;
      const Real one = thinned > drawn ? thinned : drawn, most = one > flown ? one : flown;
      ratio[i] = most > ratio[i] ? most : ratio[i];
    }
  }

 private:
  Real plastic_share(const PointBlock& block, Index i) const {
    return block.history[0][i] / of_->failure_limit();
  }
  void raise(const PointBlock& block, Index i, Real ratio) const {
    Real& kept = block.history[kept_ + 6][i];
    kept = std::max(kept, ratio);
  }

  ThinningLimits limits_;
};

}  // namespace

std::shared_ptr<StrengthLaw> fail_by_thinning(std::shared_ptr<StrengthLaw> of, const ThinningLimits& limits) {
  return std::make_shared<ThinningFailure>(std::move(of), limits);
}

}  // namespace courant
