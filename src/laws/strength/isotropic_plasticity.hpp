#pragma once
#include <limits>
#include <utility>
#include <vector>

#include "laws/strength/radial_return.hpp"
#include "laws/strength/strength.hpp"
#include "laws/strength/yield_return.hpp"

namespace courant {

/// J2 plasticity with isotropic hardening beside Hooke's law. Yield declares the yield stress: at(points)
/// fills in what YieldPoints asks for, rate() is the rate it depends on, steep() and smooth() as of
/// ReturnLaw. Where has_increments() is true, increment(q, e, three_g) is the increment of plastic strain of
/// a trial state with q [M/LT2] and plastic strain e in space, 0 where it does not yield. [-]
template <class Yield>
class IsotropicPlasticity : public StrengthLaw {
 public:
  IsotropicPlasticity(Real density, Real E, Real nu, Yield yield) : yield_(std::move(yield)) {
    law_.lambda = E * nu / ((1 + nu) * (1 - 2 * nu)), law_.G = E / (2 * (1 + nu));
    law_.rate = yield_.rate(), law_.steep = yield_.steep(), law_.smooth = yield_.smooth();
    ro = density;
  }
  Real bulk_modulus() const override { return law_.lambda + 2 * law_.G / 3; }
  Real shear_modulus() const override { return law_.G; }
  std::vector<HistoryVariable> history() const override { return {{"plastic_strain", "-"}}; }
  Real failure_limit() const override { return fails_at; }
  LeastStep least_step() const override { return {shortest_step, 0}; }
  Real fails_at = std::numeric_limits<Real>::infinity();  ///< plastic strain [-]
  Real shortest_step = 0;                                 ///< elements with a smaller one fail [T]

  void update(const PointBlock& block) const override {
    PlasticTrial trial;
    go_elastically(law_.lambda, law_.G, block, FixedCentre{}, trial);
    Real* plastic = block.history[0];
    if (yield_.has_increments())
      for (Index i = 0; i < block.count; ++i)
        trial.plastic[i] = yield_.increment(trial.q[i], plastic[i], 3 * law_.G);
    else
      find_increments(loops_, law_, block, plastic, trial,
                      [this](YieldPoints& points) { yield_.at(points); });
    for (Index i = 0; i < block.count; ++i) plastic[i] += trial.plastic[i];
    constexpr Real none = 1e-300;  // there is no increment where q is 0
    return_radially(law_.G, 0, none, block, FixedCentre{}, trial);
    keep_stiffness(block, sound_speed());
  }
  void update_in_plane_stress(const PointBlock& block, Real* rate_zz) const override {
    if (!(block.dt > 0)) return StrengthLaw::update_in_plane_stress(block, rate_zz);
    update_in_plane(loops_, law_, block, nullptr, rate_zz,
                    [this](YieldPoints& points) { yield_.at(points); });
    keep_stiffness(block, sound_speed());
  }

 private:
  ReturnLaw law_;
  Yield yield_;
  ReturnLoops loops_ = return_loops();
};

}  // namespace courant
