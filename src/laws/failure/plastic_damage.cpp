#include "laws/failure/plastic_damage.hpp"

#include <algorithm>

#include "laws/failure/failing_law.hpp"
#include "parallel/parallel.hpp"

namespace courant {

namespace {

class DamagedPlasticity : public FailingLaw {
 public:
  DamagedPlasticity(std::shared_ptr<StrengthLaw> of, PlasticDamage damage)
      : FailingLaw(std::move(of), {{"damage", "-"}}), damage_(std::move(damage)) {}

  void update(const PointBlock& block) const override {
    around(block, [this](const PointBlock& own) { of_->update(own); });
  }
  void update_in_plane_stress(const PointBlock& block, Real* rate_zz) const override {
    around(block, [&](const PointBlock& own) { of_->update_in_plane_stress(own, rate_zz); });
  }

 private:
  template <class Step>
  void around(const PointBlock& block, const Step& step) const {
    Real before[block_size], factor[block_size];
    Real *plastic = block.history[0], *damage = block.history[kept_];
    for (Index i = 0; i < block.count; ++i) {
      before[i] = plastic[i];
      factor[i] = damage[i] < 1 ? 1 / (1 - damage[i]) : 0;
    }
    scale(block, factor);
    step(of_law(block));
    for (Index i = 0; i < block.count; ++i) {
      if (plastic[i] > before[i]) {
        const auto& s = block.stress;
        damage[i] = damage_.after(
            {before[i], plastic[i], damage[i], {s[0][i], s[1][i], s[2][i], s[3][i], s[4][i], s[5][i]}});
        Real& ratio = block.history[kept_ + 1][i];
        ratio = std::max({ratio, plastic[i] / of_->failure_limit(), damage[i] / damage_.critical});
      }
      factor[i] = std::max(1 - damage[i], Real(0));
    }
    scale(block, factor);
  }
  static void scale(const PointBlock& block, const Real* factor) {
    for (Real* stress : block.stress)
      for (Index i = 0; i < block.count; ++i) stress[i] *= factor[i];
  }

  PlasticDamage damage_;
};

}  // namespace

std::shared_ptr<StrengthLaw> damage_by_flow(std::shared_ptr<StrengthLaw> of, PlasticDamage damage) {
  return std::make_shared<DamagedPlasticity>(std::move(of), std::move(damage));
}

}  // namespace courant
