#pragma once
// Linear viscoelasticity: moduli of shear and volume that decay as sums of exponentials.
#include <cmath>
#include <string>
#include <vector>

#include "laws/strength/strength.hpp"

namespace courant {

/// A modulus that decays as exp(-rate t). [M/LT2], [1/T]
struct PronyTerm {
  Real modulus, rate;
};

/// s = 2 int G(t - u) dev(D) du, -p = int K(t - u) tr(D) du. The stress m of a decaying term is kept; of a
/// rate that is constant in the step m_new = f m + 2 G_k (1 - f)/rate dev(D), f = exp(-rate dt), is exact.
class PronySeries : public StrengthLaw {
 public:
  PronySeries(Real density, const std::vector<PronyTerm>& shear, const std::vector<PronyTerm>& volume) {
    ro = density;
    for (const PronyTerm& term : shear) add(term, G_, stays_G_, shear_);
    for (const PronyTerm& term : volume) add(term, K_, stays_K_, volume_);
  }
  Real bulk_modulus() const override { return K_; }
  Real shear_modulus() const override { return G_; }
  std::vector<HistoryVariable> history() const override {
    std::vector<HistoryVariable> out;
    const auto number = [](const std::vector<PronyTerm>& of, std::size_t k) {
      return of.size() > 1 ? "_" + std::to_string(k + 1) : std::string();
    };
    for (std::size_t k = 0; k < shear_.size(); ++k)
      out.push_back({"maxwell_stress" + number(shear_, k), "M/LT2", 6});
    for (std::size_t k = 0; k < volume_.size(); ++k)
      out.push_back({"maxwell_pressure" + number(volume_, k), "M/LT2"});
    return out;
  }

  void update(const PointBlock& block) const override {
    const auto& D = block.rate;
    const Real stays = 2 * stays_G_ * block.dt, volumetric = stays_K_ * block.dt;
    for (Index i = 0; i < block.count; ++i) {
      const Real trace = D[0][i] + D[1][i] + D[2][i];
      for (std::size_t k = 0; k < 6; ++k)
        block.stress[k][i] += (k < 3 ? volumetric * trace : 0) + stays * (D[k][i] - (k < 3 ? trace / 3 : 0));
    }
    std::size_t kept = 0;
    for (const PronyTerm& term : shear_) {
      const Step step(term, block.dt);
      for (std::size_t k = 0; k < 6; ++k, ++kept)
        for (Index i = 0; i < block.count; ++i) {
          const Real trace = D[0][i] + D[1][i] + D[2][i];
          step.add(block.history[kept][i], 2 * (D[k][i] - (k < 3 ? trace / 3 : 0)), block.stress[k][i]);
        }
    }
    for (const PronyTerm& term : volume_) {
      const Step step(term, block.dt);
      for (Index i = 0; i < block.count; ++i) {
        Real by = 0;
        step.add(block.history[kept][i], D[0][i] + D[1][i] + D[2][i], by);
        for (std::size_t k = 0; k < 3; ++k) block.stress[k][i] += by;
      }
      ++kept;
    }
    keep_stiffness(block, sound_speed());
  }

 private:
  struct Step {
    Real keeps, grows;  ///< [-], [MT/LT2]
    Step(const PronyTerm& term, Real dt) : keeps(std::exp(-term.rate * dt)) {
      const Real x = term.rate * dt;
      grows = term.modulus * dt * (x > 0 ? -std::expm1(-x) / x : 1);
    }
    void add(Real& m, Real rate, Real& stress) const {
      const Real now = keeps * m + grows * rate;
      stress += now - m, m = now;
    }
  };
  static void add(const PronyTerm& term, Real& sum, Real& stays, std::vector<PronyTerm>& decays) {
    if (term.modulus == 0) return;
    sum += term.modulus;
    if (term.rate > 0)
      decays.push_back(term);
    else
      stays += term.modulus;
  }

  std::vector<PronyTerm> shear_{}, volume_{};  ///< terms that decay
  Real G_ = 0, K_ = 0, stays_G_ = 0, stays_K_ = 0;
};

}  // namespace courant
