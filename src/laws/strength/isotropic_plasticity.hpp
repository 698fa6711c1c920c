#pragma once
#include <limits>
#include <utility>
#include <vector>

#include "laws/strength/plane_return.hpp"
#include "laws/strength/radial_return.hpp"
#include "laws/strength/strength.hpp"

namespace courant {

/// J2 plasticity with isotropic hardening beside Hooke's law: s_tr = s + 2 G dev(D) dt is returned along
/// itself to q = q_tr - 3 G de = yield stress at e + de. Yield has increment(block, i, q, e, three_g): the de
/// of point i, whose trial state has q [M/LT2] and plastic strain e; 0 where it does not yield. [-]
/// Where needs_rate() is false the yield stress at e and its slope are at_rest(e, slope). [M/LT2]
template <class Yield>
class IsotropicPlasticity : public StrengthLaw {
 public:
  IsotropicPlasticity(Real density, Real E, Real nu, Yield yield)
      : lambda_(E * nu / ((1 + nu) * (1 - 2 * nu))), shear_(E / (2 * (1 + nu))), yield_(std::move(yield)) {
    ro = density;
  }
  Real bulk_modulus() const override { return lambda_ + 2 * shear_ / 3; }
  Real shear_modulus() const override { return shear_; }
  std::vector<HistoryVariable> history() const override { return {{"plastic_strain", "-"}}; }
  Real failure_limit() const override { return fails_at; }
  LeastStep least_step() const override { return {shortest_step, 0}; }
  Real fails_at = std::numeric_limits<Real>::infinity();  ///< plastic strain [-]
  Real shortest_step = 0;                                 ///< elements with a smaller one fail [T]

  void update(const PointBlock& block) const override {
    PlasticTrial trial;
    go_elastically(lambda_, shear_, block, FixedCentre{}, trial);
    Real* plastic = block.history[0];
    for (Index i = 0; i < block.count; ++i) {
      trial.plastic[i] = yield_.increment(block, i, trial.q[i], plastic[i], 3 * shear_);
      plastic[i] += trial.plastic[i];
    }
    constexpr Real none = 1e-300;  // there is no increment where q is 0
    return_radially(shear_, 0, none, block, FixedCentre{}, trial);
    keep_stiffness(block, sound_speed());
  }
  void update_in_plane_stress(const PointBlock& block, Real* rate_zz) const override {
    if (yield_.needs_rate() || !(block.dt > 0)) return StrengthLaw::update_in_plane_stress(block, rate_zz);
    update_in_plane(in_plane_, {lambda_, shear_}, block, rate_zz,
                    [this](Index count, const Real* e, Real* Y, Real* h) {
                      for (Index i = 0; i < count; ++i) Y[i] = yield_.at_rest(e[i], h[i]);
                    });
    keep_stiffness(block, sound_speed());
  }

 private:
  Real lambda_, shear_;
  Yield yield_;
  PlaneReturnLoops in_plane_ = plane_return_loops();
};

}  // namespace courant
